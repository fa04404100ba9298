#include "report/csv.hpp"

#include <algorithm>
#include <charconv>
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
bool needs_quotes(const std::string& field, char separator) {
  if (field.empty()) return false;
  return field.find_first_of("\"\r\n") != std::string::npos || field.find(separator) != std::string::npos ||
         field.front() == '#' || field.front() == ' ' || field.back() == ' ';
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

CsvField csv_text_or_number(std::string text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return {std::move(text), whole};
}

CsvTable::CsvTable(const std::vector<std::string>& columns, CsvFormat format)
    : columns_(columns.size()), format_(format) {
  add_line({columns.begin(), columns.end()});
}

void CsvTable::add_row(const std::vector<CsvField>& fields) {
  if (fields.size() != columns_)
    throw std::invalid_argument(fmt::format("{} fields for {} columns", fields.size(), columns_));
  add_line(fields);
}

void CsvTable::add_line(const std::vector<CsvField>& fields) {
  for (const CsvField& field : fields) {
    if (&field != &fields.front()) text_ += format_.separator;
    const std::size_t from = text_.size();
    text_ += needs_quotes(field.text, format_.separator) ? quoted(field.text) : field.text;
    if (field.is_number)
      std::replace(text_.begin() + static_cast<std::ptrdiff_t>(from), text_.end(), '.', format_.decimal);
  }
  text_ += '\n';
}

}  // namespace vibrosow
