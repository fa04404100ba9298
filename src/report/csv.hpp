#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrosow {

/// A number as every CSV file of the program has it: 6 significant digits, decimal point; empty where it is
/// undefined (no value, not a number, infinite).
std::string csv_number(double value);
std::string csv_number(const std::optional<double>& value);
std::string csv_number(std::int64_t value);

/// Comma-separated text (RFC 4180, line ends \n): a header, then rows. Fields are quoted where they need it.
class CsvTable {
 public:
  explicit CsvTable(const std::vector<std::string>& columns);
  /// Throws std::invalid_argument for another number of fields than columns.
  void add_row(const std::vector<std::string>& fields);
  const std::string& text() const { return text_; }

 private:
  std::size_t columns_;
  std::string text_;
};

}  // namespace vibrosow
