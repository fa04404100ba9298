#include "input/read_hole_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "input/read_scene.hpp"
#include "input/source_files.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

/// A column and where its value goes. Values reach from `least` to `most`.
struct Field {
  std::string_view name;
  double least, most;
  void (*set)(HoleRecord&, double);
  bool may_be_empty = false;
};

constexpr double any = 1e9;

constexpr std::array fields = {
    Field{"aspect", 1, 20, [](HoleRecord& r, double value) { r.at.aspect = value; }},
    Field{"width_over_d", 0.1, 1e3, [](HoleRecord& r, double value) { r.at.width = value; }},
    Field{"peak_speed", 1e-3, 1e3, [](HoleRecord& r, double value) { r.at.peak_speed = value; }},
    Field{"depth_over_d", 0.1, 1e3, [](HoleRecord& r, double value) { r.at.depth = value; }},
    Field{"amplitude_over_d", 1e-3, 1e3, [](HoleRecord& r, double value) { r.amplitude = value; }},
    Field{"friction", 1e-3, 10, [](HoleRecord& r, double value) { r.contact.friction = value; }},
    Field{"wall_friction", 0, 10, [](HoleRecord& r, double value) { r.contact.wall_friction = value; }},
    Field{"rolling_friction", 0, 10, [](HoleRecord& r, double value) { r.contact.rolling_friction = value; }},
    Field{"restitution", 0.01, 1, [](HoleRecord& r, double value) { r.contact.restitution = value; }},
    Field{"runs", 1, any, [](HoleRecord& r, double value) { r.runs = static_cast<int>(value); }},
    Field{"seeds", 1, any, [](HoleRecord& r, double value) { r.seeds = value; }},
    Field{"outflow", 1e-9, any, [](HoleRecord& r, double value) { r.outflow = value; }},
    Field{"outflow_ci95", 0, any, [](HoleRecord& r, double value) { r.half_width_95 = value; }},
    Field{"dispersion", 0, any, [](HoleRecord& r, double value) { r.dispersion = value; }, true},
    Field{"longest_pause", 0, any, [](HoleRecord& r, double value) { r.longest_pause = value; }},
    Field{"stood_still", 0, 1, [](HoleRecord& r, double value) { r.stood_still = value; }},
    Field{"watched", 1e-9, any, [](HoleRecord& r, double value) { r.watched = value; }},
};

[[noreturn]] void fail(const CsvLines& csv, int line, std::string_view column, const std::string& message) {
  throw InputError(fmt::format("{}:{}: {}: {}", csv.file, line, column, message));
}

/// Of each column of the file, its field.
std::vector<const Field*> fields_of(const CsvLines& csv) {
  std::vector<const Field*> found;
  for (const std::string& name : csv.header.fields) {
    const auto field = std::ranges::find(fields, name, &Field::name);
    if (field == fields.end()) fail(csv, csv.header.line, name, "unknown column");
    if (std::ranges::count(found, &*field) > 0) fail(csv, csv.header.line, name, "stands twice");
    found.push_back(&*field);
  }
  for (const Field& field : fields)
    if (std::ranges::count(found, &field) == 0) fail(csv, csv.header.line, field.name, "is missing");
  return found;
}

HoleRecord record_of(const CsvLines& csv, const CsvLines::Row& row, const std::vector<const Field*>& columns) {
  HoleRecord record;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Field& field = *columns[i];
    const std::string& text = row.fields[i];
    if (text.empty() && field.may_be_empty) continue;
    const std::optional<double> value = csv_number(text, csv.decimal_comma);
    if (!value) fail(csv, row.line, field.name, fmt::format("\"{}\" is not a number", text));
    if (*value < field.least || *value > field.most)
      fail(csv, row.line, field.name, fmt::format("{} is not from {:g} to {:g}", text, field.least, field.most));
    field.set(record, *value);
  }
  return record;
}

}  // namespace

std::vector<HoleRecord> read_hole_records(const CsvLines& csv) {
  const std::vector<const Field*> columns = fields_of(csv);
  std::vector<HoleRecord> records;
  for (const CsvLines::Row& row : csv.rows) records.push_back(record_of(csv, row, columns));
  return records;
}

namespace {

/// What is made of the rows, which may not be enough for it.
template <class Made>
Made made_of(const CsvLines& csv) {
  try {
    return Made(read_hole_records(csv));
  } catch (const std::invalid_argument& fault) {
    throw InputError(fmt::format("{}: {}", csv.file, fault.what()));
  }
}

CsvLines shipped(const char* name) {
  SourceFiles files;
  return files.csv(data_directory() / "models" / "outflow" / name);
}

}  // namespace

HoleTable read_hole_table(const CsvLines& csv) {
  return made_of<HoleTable>(csv);
}

ContactSlopes read_contact_slopes(const CsvLines& csv) {
  return made_of<ContactSlopes>(csv);
}

HoleTable shipped_hole_table() {
  return read_hole_table(shipped("one-hole.csv"));
}

ContactSlopes shipped_contact_slopes() {
  return read_contact_slopes(shipped("one-hole-contacts.csv"));
}

}  // namespace vibrosow
