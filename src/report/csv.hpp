#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrosow {

/// One field of a row. A number keeps its decimal point here; what is written depends on the file's format.
struct CsvField {
  std::string text;
  bool is_number = false;
  CsvField(std::string text_ = {}, bool is_number_ = false) : text(std::move(text_)), is_number(is_number_) {}
  CsvField(const char* text_) : text(text_) {}
};

/// A number as every CSV file of the program has it: 6 significant digits; empty where it is undefined (no value, not a
/// number, infinite).
CsvField csv_number(double value);
CsvField csv_number(const std::optional<double>& value);
CsvField csv_number(std::int64_t value);

/// A text, or a whole number.
inline CsvField csv_field(std::string text) {
  return {std::move(text)};
}
inline CsvField csv_field(std::integral auto number) {
  return {std::to_string(number), true};
}

/// A text that is a number where it reads as one.
CsvField csv_text_or_number(std::string text);

/// A text that a spreadsheet would take for a formula, with an apostrophe before it; any other as it is. What reads as
/// a number, with a unit or without, is none.
std::string defused(const std::string& text);

/// How a CSV file is written: as programs read it, or as spreadsheets of countries with a decimal comma do.
struct CsvFormat {
  char separator = ',';
  char decimal = '.';
};
inline constexpr CsvFormat semicolon_csv{';', ','};

/// Separated text (RFC 4180, line ends \n): a header, then rows. Fields are quoted where they need it, and texts
/// `defused`.
class CsvTable {
 public:
  explicit CsvTable(const std::vector<std::string>& columns, CsvFormat format = {});
  /// Throws std::invalid_argument for another number of fields than columns.
  void add_row(const std::vector<CsvField>& fields);
  const std::string& text() const { return text_; }

 private:
  void add_line(const std::vector<CsvField>& fields);

  std::size_t columns_;
  CsvFormat format_;
  std::string text_;
};

}  // namespace vibrosow
