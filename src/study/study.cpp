#include "study/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <system_error>

#include "input/key_units.hpp"
#include "input/read_scene.hpp"
#include "input/table.hpp"
#include "plan/model.hpp"
#include "plan/scene_warnings.hpp"
#include "scene/input_error.hpp"
#include "scene/printable.hpp"
#include "scene/scene_json.hpp"
#include "study/comparison.hpp"
#include "study/study_grid.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

constexpr std::int64_t most_replicates = 1000;

const std::vector<std::string> study_words = {"title", "base", "replicates", "proposals",
                                              "set",   "vary", "measured",   "layout"};

struct NamedDesign {
  std::string name;
  Changes changes;
};

std::string printed(const std::string& key, const TomlValue& value) {
  if (const auto* list = value.get<TomlValue::List>()) {
    std::vector<std::string> parts;
    for (const TomlValue& element : *list) parts.push_back(printed(key, element));
    return fmt::format("{}", fmt::join(parts, ";"));
  }
  if (const auto* number = value.get<double>()) return fmt::format("{:.6g}", *number);
  const auto* text = value.get<std::string>();
  const bool quantity = text != nullptr || value.get<Quantity>() != nullptr;
  try {
    if (quantity && column_unit(key))
      return fmt::format("{:.6g}", to_column_unit(key, value_of(key, quantity_of(key, value))));
  } catch (const UnitError&) {  // "3 diameters"; anything wrong is told by read_scene
  }
  return text != nullptr ? printable(*text) : toml_text(value);
}

/// A value for a table: in the unit of the key's column, a list's elements separated by ";".
std::string printed_value(const Override& change) {
  return change.value ? printed(change.key, *change.value) : "unset";
}

/// What a [set] or [[layout]] table changes: first the keys that `unset` lists are taken out, then its own are laid
/// over.
Changes read_changes(Table& table, const std::set<std::string>& not_keys = {}) {
  Changes changes;
  for (const std::string& key : table.texts("unset", "full keys such as [\"tray.holes.count\"]"))
    changes.push_back({key, std::nullopt, table.origin("unset")});
  for (const Override& change : table.dotted_values())
    if (change.key != "unset" && !not_keys.contains(change.key)) changes.push_back(change);
  return changes;
}

Changes conditions_of(const MeasuredSeries& series) {
  Changes changes;
  for (const Condition& condition : series.conditions) changes.push_back(override_of(condition, series.where));
  return changes;
}

/// Of each series, which of a table's different conditions are its own, in the order of their first series.
std::vector<std::size_t> places_of_conditions(const MeasuredTable& table) {
  std::map<std::vector<std::string>, std::size_t> known;
  std::vector<std::size_t> places;
  for (const MeasuredSeries& series : table.series) {
    std::vector<std::string> texts;  // of one table's columns
    for (const Condition& condition : series.conditions) texts.push_back(condition.text);
    places.push_back(known.try_emplace(std::move(texts), known.size()).first->second);
  }
  return places;
}

/// The conditions under which a table was measured, each once.
std::vector<Changes> measured_grid(const MeasuredTable& table) {
  std::vector<Changes> grid;
  const std::vector<std::size_t> places = places_of_conditions(table);
  for (std::size_t k = 0; k < places.size(); ++k)
    if (places[k] == grid.size()) grid.push_back(conditions_of(table.series[k]));
  return grid;
}

std::vector<NamedDesign> read_designs(Table& study) {
  std::vector<NamedDesign> designs;
  for (Table& layout : study.tables("layout")) {
    const std::string name = printable(layout.required_text("name"));
    if (std::ranges::find(designs, name, &NamedDesign::name) != designs.end())
      layout.fail("name", fmt::format("two layouts are named \"{}\"", name));
    designs.push_back({name, read_changes(layout, {"name"})});
  }
  if (designs.empty()) designs.push_back({});
  return designs;
}

/// The file that a key names, relative to the file that holds the key.
std::filesystem::path named_file(Table& table, const std::string& key) {
  std::filesystem::path file = (table.directory() / table.required_text(key)).lexically_normal();
  if (!table.files()->has(file)) table.fail(key, fmt::format("there is no file {}", file.string()));
  return file;
}

std::optional<MeasuredPart> read_measured_part(Table& study) {
  auto table = study.table("measured");
  if (!table) return std::nullopt;
  MeasuredPart part;
  part.file = named_file(*table, "file");
  part.scale = static_cast<MeasuredScale>(table->choice("scale", {"none", "depth", "free"}).value_or(0));
  part.time_zero = table->quantity("time_zero", Dimension::time, 0, 1e6);
  part.table = read_measured(study.files()->csv(part.file));
  if (part.table.quantity == MeasuredQuantity::fraction_curve && part.scale != MeasuredScale::none)
    table->fail("scale", "discharged_percent needs no scale; only \"none\" is allowed");
  if (part.time_zero && !is_curve(part.table.quantity))
    table->fail("time_zero", "goes with a curve, a table with time_s; rates are taken from run.measure_from on");
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

/// Keys and values, in their order.
std::string text_of(const Changes& changes) {
  std::string text;
  for (const Override& change : changes)
    text += change.key + "=" + (change.value ? toml_text(*change.value) : "") + "\n";
  return text;
}

/// The scene of each layout, each different one kept once. All on one parsed base.
class Scenes {
 public:
  Scenes(Study& study, std::shared_ptr<SourceFiles> files) : study_(study), files_(std::move(files)) {}

  void resolve() {
    for (Layout& layout : study_.layouts) {
      try {
        const auto [scene, drill, drawings] = read_seeder(study_.base, layout.overrides, files_);
        prepare_to_run(scene);
        const auto [place, is_new] = places_.try_emplace(scene_to_json(untitled(scene)), study_.scenes.size());
        if (is_new) study_.scenes.push_back(scene);
        layout.scene = place->second;
        layout.drill = drill;
      } catch (const UnreadableValue&) {
        throw;
      } catch (const InputError& error) {
        layout.invalid = error.what();
      }
      made_by_.emplace(text_of(layout.overrides), layout.scene);
    }
  }

  /// Which of the study's scenes these changes of the base make; none where they make another, or none at all.
  std::optional<std::size_t> made_by(const Changes& changes) {
    const auto [made, is_new] = made_by_.try_emplace(text_of(changes));
    if (!is_new) return made->second;
    try {
      const auto place = places_.find(scene_to_json(untitled(read_scene(study_.base, changes, files_))));
      if (place != places_.end()) made->second = place->second;
    } catch (const InputError&) {  // conditions under which no layout stands
    }
    return made->second;
  }

 private:
  Study& study_;
  std::shared_ptr<SourceFiles> files_;
  std::map<std::string, std::size_t> places_;                  // of a scene by what it says
  std::map<std::string, std::optional<std::size_t>> made_by_;  // by the text of changes
};

/// That a layout can be measured as the series was.
void check_layout_measurable(const MeasuredPart& part, const MeasuredSeries& series, const Scene& scene,
                             std::size_t layout, const std::filesystem::path& base) {
  check_measurable(part, series, scene, fmt::format("layout {}", layout + 1));
  if (part.scale == MeasuredScale::depth && !scene.tray.depth)
    throw InputError(fmt::format("{}: measured.scale = \"depth\" needs tray.depth", base.string()));
}

/// What fits, by layout and then by series. Conditions fit a layout when, laid over it, they change nothing; so a
/// condition that the study does not name means the base's value. Layouts that differ in what is laid over them alone
/// become one and the same, which is read once.
std::vector<MeasuredMatch> matches_of(const Study& study, Scenes& scenes) {
  const MeasuredTable& table = study.measured->table;
  const std::vector<Changes> conditions = measured_grid(table);
  std::vector<std::vector<std::size_t>> series_at(conditions.size());
  const std::vector<std::size_t> places = places_of_conditions(table);
  for (std::size_t series = 0; series < places.size(); ++series) series_at[places[series]].push_back(series);
  const auto is_laid_over = [&](const Override& change) {
    return std::ranges::find(table.condition_keys, change.key) != table.condition_keys.end();
  };
  std::map<std::string, std::map<std::size_t, std::vector<std::size_t>>> alike;  // layouts, by the rest and by scene
  for (std::size_t layout = 0; layout < study.layouts.size(); ++layout) {
    if (!study.layouts[layout].scene) continue;
    Changes rest = study.layouts[layout].overrides;
    std::erase_if(rest, is_laid_over);
    alike[text_of(rest)][*study.layouts[layout].scene].push_back(layout);
  }
  std::vector<MeasuredMatch> matches;
  for (const auto& [rest, layouts_of] : alike)
    for (std::size_t k = 0; k < conditions.size(); ++k) {
      Changes changes = study.layouts[layouts_of.begin()->second.front()].overrides;
      add_changes(changes, conditions[k]);
      const std::optional<std::size_t> scene = scenes.made_by(changes);
      const auto layouts = scene ? layouts_of.find(*scene) : layouts_of.end();
      if (layouts == layouts_of.end()) continue;
      for (const std::size_t layout : layouts->second)
        for (const std::size_t series : series_at[k]) matches.push_back({layout, series});
    }
  std::ranges::sort(matches, {}, [](const MeasuredMatch& match) { return std::pair(match.layout, match.series); });
  return matches;
}

void match_measured(Study& study, std::vector<MeasuredMatch> matches) {
  MeasuredPart& part = *study.measured;
  part.matches = std::move(matches);
  for (const auto& [layout, series] : part.matches)
    check_layout_measurable(part, part.table.series[series], study.scenes[*study.layouts[layout].scene], layout,
                            study.base);
  if (part.matches.empty())
    throw InputError(fmt::format("{}: no row was measured under the conditions of a layout", part.file.string()));
}

bool is_study_key(const Override& change) {
  return std::ranges::find(study_words, change.key.substr(0, change.key.find('.'))) != study_words.end();
}

}  // namespace

std::size_t compared_series(const MeasuredPart& part) {
  std::set<std::size_t> series;
  for (const MeasuredMatch& match : part.matches) series.insert(match.series);
  return series.size();
}

std::vector<std::string> study_warnings(const Study& study) {
  std::vector<std::pair<std::string, std::vector<int>>> told;  // and by which layouts, in their order
  for (const Layout& layout : study.layouts) {
    if (!layout.scene) continue;
    for (const std::string& warning : scene_warnings(study.scenes[*layout.scene])) {
      auto known = std::ranges::find(told, warning, &std::pair<std::string, std::vector<int>>::first);
      if (known == told.end()) known = told.insert(known, {warning, {}});
      known->second.push_back(layout.number);
    }
  }
  std::vector<std::string> warnings;
  if (study.measured && compared_series(*study.measured) < study.measured->table.series.size())
    warnings.push_back(fmt::format(
        "measured: {} of the {} series of {} {} measured under the conditions of a layout; the rest counts for nothing",
        compared_series(*study.measured), study.measured->table.series.size(), study.measured->file.string(),
        compared_series(*study.measured) == 1 ? "was" : "were"));
  for (const auto& [warning, layouts] : told)
    warnings.push_back(
        layouts.size() == study.layouts.size()
            ? warning
            : fmt::format("layout{} {}: {}", layouts.size() == 1 ? "" : "s", fmt::join(layouts, ", "), warning));
  return warnings;
}

namespace {

/// A number, or { interval = "2 %", most = 40 }.
Replicates read_replicates(Table& study) {
  Replicates replicates;
  if (!study.is_table("replicates")) {
    replicates.number = static_cast<int>(study.whole_number("replicates", 1, most_replicates).value_or(5));
    return replicates;
  }
  auto table = study.table("replicates");
  replicates.interval = table->required_quantity("interval", Dimension::fraction, 1e-4, 0.5);
  replicates.most = static_cast<int>(
      table->whole_number("most", Replicates::least_by_interval, most_replicates).value_or(replicates.most));
  return replicates;
}

/// What points a [vary] stands for.
using GridOf = std::function<std::vector<Changes>(Table& study, Table& vary, std::optional<std::int64_t> proposals)>;

Study read_study_with(const std::filesystem::path& file, const std::vector<Override>& overrides,
                      const std::shared_ptr<SourceFiles>& files, const GridOf& grid_of) {
  Changes of_study, of_seeder;
  for (const Override& change : overrides) (is_study_key(change) ? of_study : of_seeder).push_back(change);

  Table table(Document::read(file, of_study, files));
  Study study;
  study.title = printable(table.text("title").value_or(file.stem().string()));
  study.base = named_file(table, "base");
  study.replicates = read_replicates(table);
  auto set = table.table("set");
  auto vary = table.table("vary");
  const auto proposals = table.whole_number("proposals", 1, most_layouts);
  if (proposals && !vary) table.fail("proposals", "these are points within the ranges of [vary], which is missing");
  const Changes fixed = set ? read_changes(*set) : Changes{};
  const std::vector<NamedDesign> designs = read_designs(table);
  study.measured = read_measured_part(table);
  std::vector<Changes> grid{{}};
  if (vary) {
    grid = grid_of(table, *vary, proposals);
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
    reject_set_and_varied(of_seeder, design.changes);
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
  add_keys(study.varied, grid.front());
  add_keys(study.keys, grid.front());
  Scenes scenes(study, files);
  scenes.resolve();
  if (study.measured && !study.scenes.empty()) match_measured(study, matches_of(study, scenes));
  return study;
}

}  // namespace

Study read_study(const std::filesystem::path& file, const std::vector<Override>& overrides,
                 const std::shared_ptr<SourceFiles>& files) {
  Study study = read_study_with(file, overrides, files, [](Table&, Table& vary, std::optional<std::int64_t> proposals) {
    return proposals ? read_proposals(vary, static_cast<std::size_t>(*proposals)) : read_grid(vary);
  });
  if (study.scenes.empty()) throw InputError(study.layouts.front().invalid);
  return study;
}

StudySpace read_study_space(const std::filesystem::path& file, const std::vector<Override>& overrides,
                            const std::shared_ptr<SourceFiles>& files) {
  StudySpace space;
  read_study_with(file, overrides, files, [&](Table& study, Table& vary, std::optional<std::int64_t> proposals) {
    if (study.has("layout"))
      study.fail("layout", "optimise looks in the ranges of [vary] alone; vary keys in place of designs");
    const VariedSpace varied(vary);
    space.keys = varied.names(), space.values = varied.values();
    if (proposals) space.proposals = static_cast<std::size_t>(*proposals);
    return std::vector<Changes>{varied.at(std::vector<double>(varied.axes(), 0.5))};
  });
  if (space.values.empty())
    throw InputError(fmt::format("{}: there is no [vary] to look for layouts in", file.string()));
  return space;
}

Study read_study_at(const std::filesystem::path& file, const std::vector<Override>& overrides,
                    const std::shared_ptr<SourceFiles>& files, const std::vector<std::vector<double>>& points) {
  return read_study_with(file, overrides, files, [&](Table&, Table& vary, std::optional<std::int64_t>) {
    const VariedSpace varied(vary);
    std::vector<Changes> grid;
    for (const std::vector<double>& point : points) grid.push_back(varied.at(point));
    return grid;
  });
}

}  // namespace vibrosow
