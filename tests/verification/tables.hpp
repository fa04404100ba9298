#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "input/source_files.hpp"
#include "report/csv.hpp"
#include "scene/scene.hpp"
#include "support/report_file.hpp"

namespace vibrosow {

/// A table of tests/data, by column name.
class DataTable {
 public:
  explicit DataTable(const std::string& file)
      : csv_(SourceFiles().csv(std::filesystem::path(VIBROSOW_SOURCE_DIR) / "tests" / "data" / file)) {}

  std::size_t rows() const { return csv_.rows.size(); }
  const std::string& text(std::size_t row, const std::string& column) const {
    const auto& names = csv_.header.fields;
    const auto found = std::find(names.begin(), names.end(), column);
    if (found == names.end()) throw std::out_of_range(column);
    return csv_.rows.at(row).fields[static_cast<std::size_t>(found - names.begin())];
  }
  double number(std::size_t row, const std::string& column) const { return std::stod(text(row, column)); }

 private:
  CsvLines csv_;
};

/// The name of what the same test reports in one space or the other.
inline std::string report_in(Space space, const std::string& name) {
  return space == Space::two_dimensional ? name : name + "_in_space";
}

/// A report for plotting: written as NAME.csv into the directory that VIBROSOW_REPORTS names, or not at all.
class VerificationReport {
 public:
  VerificationReport(std::string name, std::string about, const std::vector<std::string>& columns)
      : name_(std::move(name)), about_(std::move(about)), table_(columns) {}
  ~VerificationReport() { write_report(name_ + ".csv", "# " + about_ + "\n" + table_.text()); }
  VerificationReport(const VerificationReport&) = delete;
  VerificationReport& operator=(const VerificationReport&) = delete;

  template <class... Fields>
  void add(const Fields&... fields) {
    table_.add_row({field(fields)...});
  }

 private:
  static CsvField field(const std::string& text) { return text; }
  static CsvField field(const char* text) { return text; }
  static CsvField field(double value) { return csv_number(value); }
  static CsvField field(int value) { return csv_number(std::int64_t{value}); }

  std::string name_, about_;
  CsvTable table_;
};

}  // namespace vibrosow
