#include "report/csv.hpp"

#include <cmath>
#include <stdexcept>

#include <csv.h>
#include <fmt/format.h>

namespace vibrosow {
namespace {

std::string quoted(const std::string& field) {
  std::string text(csv_write(nullptr, 0, field.data(), field.size()), '\0');
  csv_write(text.data(), text.size(), field.data(), field.size());
  return text;
}

/// A leading # would be read as a comment, and space at an end would be trimmed, by our own reader too.
bool needs_quotes(const std::string& field) {
  if (field.empty()) return false;
  return field.find_first_of(",\"\r\n") != std::string::npos || field.front() == '#' || field.front() == ' ' ||
         field.back() == ' ';
}

std::string line_of(const std::vector<CsvField>& fields) {
  std::string line;
  for (const CsvField& field : fields) {
    if (&field != &fields.front()) line += ',';
    line += needs_quotes(field.text) ? quoted(field.text) : field.text;
  }
  return line + '\n';
}

}  // namespace

CsvField csv_number(double value) {
  if (!std::isfinite(value)) return {};
  return {fmt::format("{:.6g}", value == 0 ? 0.0 : value), true};  // no "-0"
}

CsvField csv_number(const std::optional<double>& value) {
  return value ? csv_number(*value) : CsvField();
}

CsvField csv_number(std::int64_t value) {
  return {fmt::format("{}", value), true};
}

CsvTable::CsvTable(const std::vector<std::string>& columns)
    : columns_(columns.size()), text_(line_of({columns.begin(), columns.end()})) {}

void CsvTable::add_row(const std::vector<CsvField>& fields) {
  if (fields.size() != columns_)
    throw std::invalid_argument(fmt::format("{} fields for {} columns", fields.size(), columns_));
  text_ += line_of(fields);
}

}  // namespace vibrosow
