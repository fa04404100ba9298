#include "report/csv.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include <csv.h>
#include <fmt/format.h>

namespace vibrosow {
namespace {

std::string in_quotes(const std::string& field) {
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

/// Whether a text begins with a number behind its sign and goes on, if at all, with letters, digits and signs of a
/// unit.
bool is_signed_number(std::string_view text) {
  text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return std::ranges::all_of(text, [](unsigned char c) {
    return std::isalnum(c) || c >= 0x80 ||
           std::string_view(" %/.,^").find(static_cast<char>(c)) != std::string_view::npos;
  });
}

}  // namespace

std::string defused(const std::string& text) {
  if (text.empty() || std::string_view("=+-@\t\r").find(text.front()) == std::string_view::npos) return text;
  const bool is_number = (text.front() == '-' || text.front() == '+') && is_signed_number(text);
  return is_number ? text : "'" + text;
}

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
    const std::string text = field.is_number ? field.text : defused(field.text);
    if (&field != &fields.front()) text_ += format_.separator;
    const std::size_t from = text_.size();
    text_ += needs_quotes(text, format_.separator) ? in_quotes(text) : text;
    if (field.is_number)
      std::replace(text_.begin() + static_cast<std::ptrdiff_t>(from), text_.end(), '.', format_.decimal);
  }
  text_ += '\n';
}

}  // namespace vibrosow
