#include "input/read_held_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "input/read_scene.hpp"
#include "input/source_files.hpp"
#include "portable_math/functions.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

std::size_t column(const CsvLines& csv, const std::string& name) {
  const auto found = std::ranges::find(csv.header.fields, name);
  if (found == csv.header.fields.end())
    throw InputError(fmt::format("{}:{}: {}: is missing", csv.file, csv.header.line, name));
  return static_cast<std::size_t>(found - csv.header.fields.begin());
}

constexpr double least_rate = 1e-9, most_rate = 1e9;  // in any unit; their ratios are finite

double rate(const CsvLines& csv, const CsvLines::Row& row, const std::string& name) {
  const std::string& text = row.fields[column(csv, name)];
  const std::optional<double> value = csv_number(text, csv.decimal_comma);
  if (!value || !(*value >= least_rate && *value <= most_rate))
    throw InputError(fmt::format("{}:{}: {}: \"{}\" is not a number from {:g} to {:g}", csv.file, row.line, name, text,
                                 least_rate, most_rate));
  return *value;
}

}  // namespace

ModelError read_model_error(const CsvLines& csv) {
  std::map<std::string, std::vector<double>> by_material;
  for (const CsvLines::Row& row : csv.rows)
    by_material[row.fields[column(csv, "material")]].push_back(
        portable_math::log(rate(csv, row, "measured") / rate(csv, row, "predicted")));
  std::vector<double> means;
  for (const auto& [material, logarithms] : by_material) {
    double sum = 0;
    for (const double one : logarithms) sum += one;
    means.push_back(sum / static_cast<double>(logarithms.size()));
  }
  return model_error(means);
}

ModelError shipped_model_error() {
  SourceFiles files;
  return read_model_error(files.csv(data_directory() / "models" / "held-out.csv"));
}

}  // namespace vibrosow
