#include "design/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <system_error>

#include "input/document.hpp"
#include "input/key_units.hpp"
#include "input/read_scene.hpp"
#include "input/toml_lib.hpp"
#include "plan/model.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_json.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

constexpr std::size_t most_layouts = 100000;
constexpr std::int64_t most_replicates = 1000;

const std::vector<std::string> study_words = {"title", "base", "replicates", "set", "vary", "measured", "layout"};

/// Changes that one point of the grid, or one named design, makes.
using Changes = std::vector<Override>;

struct NamedDesign {
  std::string name;
  Changes changes;
};

std::string without_quotes(const std::string& toml) {
  const bool quoted = toml.size() >= 2 && (toml.front() == '"' || toml.front() == '\'') && toml.back() == toml.front();
  return quoted ? toml.substr(1, toml.size() - 2) : toml;
}

/// "7 Hz" into 7 and "Hz"; a plain number has no unit.
struct NumberWithUnit {
  double number;
  std::string unit;
};

NumberWithUnit split_number(const std::string& text) {
  double number = 0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, number);
  if (error != std::errc{}) throw std::invalid_argument(fmt::format("\"{}\" is not a number", text));
  const char* unit = std::find_if(stop, end, [](char c) { return c != ' '; });
  return {number, std::string(unit, end)};
}

/// A value in SI, or the plain number of a key without a unit.
double value_of(const std::string& key, const std::string& text) {
  if (const auto unit = column_unit(key)) return parse_quantity(text, unit->dimension);
  const NumberWithUnit value = split_number(text);
  if (!value.unit.empty()) throw std::invalid_argument(fmt::format("\"{}\": a plain number is expected", text));
  return value.number;
}

std::string printed(const std::string& key, const toml::node& node) {
  if (const toml::array* list = node.as_array()) {
    std::vector<std::string> parts;
    for (const toml::node& element : *list) parts.push_back(printed(key, element));
    return fmt::format("{}", fmt::join(parts, ";"));
  }
  if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("{:.6g}", number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  const std::string text = node.value_or(std::string());
  const auto unit = column_unit(key);
  if (!unit) return text;
  try {
    return fmt::format("{:.6g}", to_column_unit(key, parse_quantity(text, unit->dimension)));
  } catch (const UnitError&) {
    return text;  // "3 diameters"; anything wrong is told by read_scene
  }
}

/// A value for a table: in the unit of the key's column, a list's elements separated by ";".
std::string printed_value(const Override& change) {
  try {
    const toml::table parsed = toml::parse("value = " + change.toml_value);
    const toml::node& value = *parsed.get("value");
    return value.is_table() ? change.toml_value : printed(change.key, value);
  } catch (const toml::parse_error&) {
    return change.toml_value;
  }
}

std::vector<std::string> values_of(Table& vary, const std::string& key) {
  const auto range = vary.table_at(key);
  if (!range) return vary.toml_elements(key);
  for (const std::string& word : range->keys())
    if (word != "from" && word != "to" && word != "step")
      vary.fail(key, fmt::format("a range has from, to and step, not \"{}\"", word));
  Table ends = *range;
  const auto text = [&](const std::string& word) {
    const auto value = ends.toml_text(word);
    if (!value) vary.fail(key, fmt::format("a range needs from, to and step; {} is missing", word));
    return without_quotes(*value);
  };
  try {
    return range_values(key, text("from"), text("to"), text("step"));
  } catch (const std::invalid_argument& error) {
    vary.fail(key, error.what());
  } catch (const UnitError& error) {
    vary.fail(key, error.what());
  }
}

/// Every key of a [set] or [[layout]] table.
Changes read_changes(Table& table, const std::set<std::string>& not_keys = {}) {
  Changes changes;
  for (const std::string& key : table.dotted_keys())
    if (!not_keys.contains(key)) changes.push_back({key, *table.toml_text(key), table.origin(key)});
  return changes;
}

/// The full grid, first key slowest.
std::vector<Changes> read_grid(Table& vary) {
  std::vector<Changes> grid{{}};
  for (const std::string& key : vary.dotted_keys()) {
    const std::vector<std::string> values = values_of(vary, key);
    if (values.empty()) vary.fail(key, "an empty list; at least one value is needed");
    if (grid.size() * values.size() > most_layouts)
      vary.fail(key, fmt::format("the grid has more than {} layouts", most_layouts));
    std::vector<Changes> longer;
    longer.reserve(grid.size() * values.size());
    for (const Changes& point : grid) {
      for (const std::string& value : values) {
        longer.push_back(point);
        longer.back().push_back({key, value, vary.origin(key)});
      }
    }
    grid = std::move(longer);
  }
  return grid;
}

/// The conditions under which a table was measured, each once.
std::vector<Changes> measured_grid(const MeasuredTable& table) {
  std::vector<Changes> grid;
  std::vector<std::vector<Condition>> seen;
  for (const MeasuredSeries& series : table.series) {
    if (std::ranges::find(seen, series.conditions) != seen.end()) continue;
    seen.push_back(series.conditions);
    Changes point;
    for (const Condition& condition : series.conditions) point.push_back(override_of(condition, series.where));
    grid.push_back(point);
  }
  return grid;
}

std::vector<NamedDesign> read_designs(Table& study) {
  std::vector<NamedDesign> designs;
  for (Table& layout : study.tables("layout")) {
    const std::string name = layout.required_text("name");
    if (std::ranges::find(designs, name, &NamedDesign::name) != designs.end())
      layout.fail("name", fmt::format("two layouts are named \"{}\"", name));
    designs.push_back({name, read_changes(layout, {"name"})});
  }
  if (designs.empty()) designs.push_back({});
  return designs;
}

/// The file that a key names, relative to the file that holds the key.
std::filesystem::path named_file(Table& table, const std::string& key) {
  const std::filesystem::path file = (table.directory() / table.required_text(key)).lexically_normal();
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) table.fail(key, fmt::format("there is no file {}", file.string()));
  return file;
}

std::optional<MeasuredPart> read_measured_part(Table& study) {
  auto table = study.table("measured");
  if (!table) return std::nullopt;
  MeasuredPart part;
  part.file = named_file(*table, "file");
  part.scale = static_cast<MeasuredScale>(table->choice("scale", {"none", "depth", "free"}).value_or(0));
  part.table = read_measured(part.file);
  if (part.table.quantity == MeasuredQuantity::fraction_curve && part.scale != MeasuredScale::none)
    table->fail("scale", "discharged_percent needs no scale; only \"none\" is allowed");
  return part;
}

void add_keys(std::vector<std::string>& keys, const Changes& changes) {
  for (const Override& change : changes)
    if (std::ranges::find(keys, change.key) == keys.end()) keys.push_back(change.key);
}

/// A later change of the same key replaces the earlier one, so that every key is changed once.
void add_changes(Changes& all, const Changes& more) {
  for (const Override& change : more) {
    std::erase_if(all, [&](const Override& one) { return one.key == change.key; });
    all.push_back(change);
  }
}

void reject_set_and_varied(const Changes& set, const Changes& varied) {
  for (const Override& change : varied)
    for (const Override& fixed : set)
      if (fixed.key == change.key)
        throw InputError(fmt::format("{}: {}: varied here, and set at {}; leave one of them out", change.where,
                                     change.key, fixed.where));
}

/// What a run depends on.
Scene untitled(Scene scene) {
  scene.title.clear();
  return scene;
}

/// Reads the scene of each layout and keeps each different one once.
void resolve_scenes(Study& study) {
  std::map<std::string, std::size_t> known;
  for (Layout& layout : study.layouts) {
    try {
      const Scene scene = read_scene(study.base, layout.overrides);
      prepare_to_run(scene);
      const auto [place, is_new] = known.try_emplace(scene_to_json(untitled(scene)), study.scenes.size());
      if (is_new) study.scenes.push_back(scene);
      layout.scene = place->second;
    } catch (const InputError& error) {
      layout.invalid = error.what();
    }
  }
  if (study.scenes.empty()) throw InputError(study.layouts.front().invalid);
}

/// A series fits a layout when its conditions, laid over the layout, change nothing; so a condition that the study does
/// not name means the base's value.
bool fits(const Study& study, const Layout& layout, const MeasuredSeries& series) {
  if (!layout.scene) return false;
  Changes conditions;
  for (const Condition& condition : series.conditions) conditions.push_back(override_of(condition, series.where));
  if (conditions.empty()) return true;
  Changes changes = layout.overrides;
  add_changes(changes, conditions);
  try {
    return untitled(read_scene(study.base, changes)) == untitled(study.scenes[*layout.scene]);
  } catch (const InputError&) {
    return false;
  }
}

bool has_hole_and_lot(const Scene& scene, const MeasuredSeries& series) {
  const bool hole = series.hole == "all" || std::stoul(series.hole) <= scene.tray.holes.size();
  const bool lot = series.lot == "all" || std::ranges::find(scene.lots, series.lot, &SeedLot::name) != scene.lots.end();
  return hole && lot;
}

bool has_fill(const Scene& scene) {
  return scene.tray.fill || (scene.hopper && scene.hopper->fill);
}

/// That a layout can be measured as the series was.
void check_measurable(const MeasuredPart& part, const MeasuredSeries& series, const Scene& scene, std::size_t layout,
                      const std::filesystem::path& base) {
  if (!has_hole_and_lot(scene, series))
    throw InputError(fmt::format("{}: hole {}, lot {}: layout {} has no such hole or lot", series.where, series.hole,
                                 series.lot, layout + 1));
  if (part.table.quantity == MeasuredQuantity::fraction_curve && !has_fill(scene))
    throw InputError(
        fmt::format("{}: discharged_percent is of the fill, and layout {} has none; expected mass_g or seeds",
                    series.where, layout + 1));
  if (part.scale == MeasuredScale::depth && !scene.tray.depth)
    throw InputError(fmt::format("{}: measured.scale = \"depth\" needs tray.depth", base.string()));
}

void match_measured(Study& study) {
  MeasuredPart& part = *study.measured;
  for (std::size_t layout = 0; layout < study.layouts.size(); ++layout) {
    for (std::size_t series = 0; series < part.table.series.size(); ++series) {
      const MeasuredSeries& measured = part.table.series[series];
      if (!fits(study, study.layouts[layout], measured)) continue;
      const Scene& scene = study.scenes[*study.layouts[layout].scene];
      check_measurable(part, measured, scene, layout, study.base);
      part.matches.push_back({layout, series});
    }
  }
  if (part.matches.empty())
    throw InputError(fmt::format("{}: no row was measured under the conditions of a layout", part.file.string()));
}

bool is_study_key(const Override& change) {
  return std::ranges::find(study_words, change.key.substr(0, change.key.find('.'))) != study_words.end();
}

}  // namespace

std::vector<std::string> range_values(const std::string& key, const std::string& from, const std::string& to,
                                      const std::string& step) {
  const double first = value_of(key, from);
  const double last = value_of(key, to);
  const double by = value_of(key, step);
  if (!std::isfinite(first) || !std::isfinite(last) || !std::isfinite(by))
    throw std::invalid_argument("a range is of finite numbers");
  const double steps = (last - first) / by;
  if (by == 0 || steps < 0) throw std::invalid_argument("the range's step does not lead from its start to its end");
  if (steps > static_cast<double>(most_layouts))
    throw std::invalid_argument(fmt::format("the range has more than {} values", most_layouts));
  if (std::abs(steps - std::round(steps)) > 1e-6)
    throw std::invalid_argument(fmt::format("a step of {} from {} does not end at {}", step, from, to));

  const NumberWithUnit start = split_number(from);
  const auto unit = column_unit(key);
  const double size = unit ? unit_size(start.unit, unit->dimension) : 1;
  std::vector<std::string> values;
  for (int i = 0; i <= static_cast<int>(std::round(steps)); ++i) {
    // Twelve digits: 0.1 + 2 * 0.1 is written 0.3.
    const std::string number = fmt::format("{:.12g}", start.number + i * by / size);
    values.push_back(unit ? fmt::format("\"{} {}\"", number, start.unit) : number);
  }
  return values;
}

bool is_study(const std::filesystem::path& file) {
  return Table(Document::read(file)).has("base");
}

Study read_study(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  Changes of_study, of_seeder;
  for (const Override& change : overrides) (is_study_key(change) ? of_study : of_seeder).push_back(change);

  Table table(Document::read(file, of_study));
  Study study;
  study.title = table.text("title").value_or(file.stem().string());
  study.base = named_file(table, "base");
  study.replicates = static_cast<int>(table.whole_number("replicates", 1, most_replicates).value_or(5));
  auto set = table.table("set");
  auto vary = table.table("vary");
  const Changes fixed = set ? read_changes(*set) : Changes{};
  const std::vector<NamedDesign> designs = read_designs(table);
  study.measured = read_measured_part(table);
  std::vector<Changes> grid{{}};
  if (vary) {
    grid = read_grid(*vary);
  } else if (study.measured) {
    grid = measured_grid(study.measured->table);
  }
  table.reject_unknown_keys();
  if (grid.size() * designs.size() > most_layouts)
    throw InputError(fmt::format("{}: the study has more than {} layouts", file.string(), most_layouts));

  reject_set_and_varied(of_seeder, grid.front());
  if (vary) reject_set_and_varied(fixed, grid.front());
  for (const NamedDesign& design : designs) {
    if (vary) reject_set_and_varied(design.changes, grid.front());
    add_keys(study.keys, design.changes);
    for (const Changes& point : grid) {
      Layout layout;
      layout.number = static_cast<int>(study.layouts.size()) + 1;
      layout.name = design.name;
      layout.overrides = fixed;
      for (const Changes& changes : {design.changes, point, of_seeder}) add_changes(layout.overrides, changes);
      for (const Changes& changes : {design.changes, point, of_seeder})
        for (const Override& change : changes) layout.values[change.key] = printed_value(change);
      study.layouts.push_back(std::move(layout));
    }
  }
  add_keys(study.keys, grid.front());
  resolve_scenes(study);
  if (study.measured) match_measured(study);
  return study;
}

}  // namespace vibrosow
