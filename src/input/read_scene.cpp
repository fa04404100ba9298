#include "input/read_scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "input/lengths.hpp"
#include "input/presets.hpp"
#include "input/read_contact.hpp"
#include "input/read_drill.hpp"
#include "input/read_lot.hpp"
#include "input/read_vessel.hpp"
#include "input/table.hpp"
#include "scene/accuracy_level.hpp"
#include "scene/integrator_names.hpp"
#include "scene/list_limits.hpp"
#include "scene/mixture.hpp"
#include "scene/printable.hpp"
#include "scene/seed_lot.hpp"
#include "scene/spaces.hpp"
#include "vessel/hopper_images.hpp"

namespace vibrosow {
namespace {

/// Fractions of all lots by number, from fractions by mass or by number.
void read_fractions(Table& seeds, std::vector<SeedLot>& lots) {
  std::string key;
  double sum = 0;
  for (SeedLot& lot : lots) {
    Table table = seeds.required_table(lot.name);
    const auto by_mass = table.quantity("mass_fraction", Dimension::fraction, 1e-9, 1);
    const auto by_number = table.quantity("number_fraction", Dimension::fraction, 1e-9, 1);
    if (by_mass && by_number) table.fail("number_fraction", "contradicts mass_fraction; give one of them");
    const std::string given = by_mass ? "mass_fraction" : by_number ? "number_fraction" : "";
    if (given.empty() && lots.size() == 1) return;
    if (key.empty()) key = given.empty() ? "mass_fraction" : given;
    if (given.empty())
      table.fail(key, "is missing; with several lots each has mass_fraction, or each has number_fraction");
    if (given != key) table.fail(given, fmt::format("another lot has {}; give every lot the same", key));
    lot.number_fraction = by_mass ? *by_mass : *by_number;
    sum += lot.number_fraction;
  }
  if (std::abs(sum - 1) > 1e-6) {
    seeds.required_table(lots.back().name)
        .fail(key, fmt::format("the fractions of all lots sum to {:g} %, not to 100 %", sum * 100));
  }
  if (key == "mass_fraction") {
    for (SeedLot& lot : lots) lot.number_fraction /= mean_mass(lot);
  }
  double total = 0;
  for (const SeedLot& lot : lots) total += lot.number_fraction;
  for (SeedLot& lot : lots) lot.number_fraction /= total;
}

void check_lot_name(const Table& seeds, const std::string& name) {
  if (!is_lot_name(name)) {
    seeds.fail(name, "a lot's name has letters, digits, _ and - only, and is not \"all\" or \"wall\"");
  }
}

std::vector<SeedLot> read_lots(Table seeds, Space space) {
  std::vector<SeedLot> lots;
  for (const std::string& name : seeds.keys()) {
    check_lot_name(seeds, name);
    Table table = seeds.required_table(name);
    lots.push_back(read_lot(table, name, space));
  }
  seeds.refuse_more("", lots.size(), list_limits::lots);
  if (lots.empty()) seeds.fail("", "names no seed lot; expected a table such as [seeds.wheat]");
  read_fractions(seeds, lots);
  return lots;
}

/// A level by its name, or the cheapest whose error with such seeds is known to be within a fraction.
AccuracyLevel read_accuracy(Table& root, const std::vector<SeedLot>& lots, Space space) {
  const std::optional<std::string> text = root.text("accuracy");
  if (!text) return AccuracyLevel::as_written;
  for (const AccuracyLevelValues& level : accuracy_levels)
    if (*text == level.name) return level.level;
  if (!text->ends_with('%')) {
    root.fail(
        "accuracy",
        fmt::format("\"{}\" is neither \"draft\", \"design\" nor \"reference\", nor an error such as \"3 %\"", *text));
  }
  const double wanted = *root.quantity("accuracy", Dimension::fraction, 0, 1);
  const auto error = [&](const AccuracyLevelValues& level) { return level.error(space, has_clumps(lots)); };
  for (const AccuracyLevelValues& level : accuracy_levels)
    if (error(level) <= wanted * (1 + 1e-9)) return level.level;
  root.fail("accuracy",
            fmt::format(
                "{} is too small: the finest level errs by up to {:g} % with such seeds; `vibrosow accuracy --within` "
                "may do better for one seeder",
                *text, 100 * error(accuracy_levels.back())));
}

/// A level takes the place of the softness that a file gives. One that is asked for beside it would count for nothing.
void refuse_softness_beside(AccuracyLevel accuracy, const Table& contact, Table& seeds) {
  if (accuracy == AccuracyLevel::as_written) return;
  const auto refuse = [](const Table& table) {
    constexpr const char* key = "shell_compression";
    if (table.is_laid_over(key)) table.fail(key, "contradicts accuracy, which sets it");
  };
  refuse(contact);
  for (const std::string& lot : seeds.keys())
    if (const auto table = seeds.table(lot)) refuse(*table);
}

Numerics read_numerics(Table table, Law law, AccuracyLevel accuracy) {
  Numerics numerics;
  for (const char* key : {"dt", "steps_per_contact"})
    if (accuracy != AccuracyLevel::as_written && table.has(key)) table.fail(key, "contradicts accuracy, which sets it");
  numerics.integrator = static_cast<Integrator>(table.choice("integrator", integrator_names()).value_or(0));
  numerics.dt = table.quantity("dt", Dimension::time, 1e-12, 10);
  if (numerics.dt) numerics.where = table.where("dt");
  const auto steps = table.number("steps_per_contact", 1, 1e6);
  if (numerics.dt && steps) table.fail("steps_per_contact", "contradicts dt; give one of them");
  numerics.steps_per_contact = steps.value_or(usual_steps_per_contact(numerics.integrator));
  numerics.impact_speed = table.quantity("impact_speed", Dimension::speed, 1e-6, 1000);
  if (numerics.impact_speed && law == Law::elastic_shell) {
    table.fail("impact_speed", "belongs to law = \"hertz\"; an elastic shell's contact lasts as long at any speed");
  }
  numerics.allow_long_step = table.boolean("allow_long_step").value_or(numerics.allow_long_step);
  return numerics;
}

GuardLimits read_guard(Table table) {
  GuardLimits guard;
  guard.warn_relative_overlap = table.number("warn_relative_overlap", 1e-9, 1000).value_or(guard.warn_relative_overlap);
  guard.stop_relative_overlap = table.number("stop_relative_overlap", 1e-9, 1000).value_or(guard.stop_relative_overlap);
  guard.energy_tolerance = table.number("energy_tolerance", 1e-9, 1e12).value_or(guard.energy_tolerance);
  if (guard.stop_relative_overlap < guard.warn_relative_overlap) {
    table.fail(table.has("stop_relative_overlap") ? "stop_relative_overlap" : "warn_relative_overlap",
               fmt::format("the guard would stop at {:g}, before it warns at {:g}", guard.stop_relative_overlap,
                           guard.warn_relative_overlap));
  }
  return guard;
}

RunPlan read_run(Table table) {
  RunPlan run;
  run.duration = table.required_quantity("duration", Dimension::time, 1e-9, 1e6);
  run.measure_from = table.quantity("measure_from", Dimension::time, 0, 1e6).value_or(0);
  if (run.measure_from >= run.duration) {
    table.fail("measure_from",
               fmt::format("{:g} s is not before the end of the run, {:g} s", run.measure_from, run.duration));
  }
  run.count_below = table.quantity("count_below", Dimension::length, 1e-6, 100).value_or(run.count_below);
  run.end_after_pause = table.quantity("end_after_pause", Dimension::time, 1e-3, 1e6);
  run.start = table.choice("start", {"at-rest", "with-tray"}).value_or(0) == 0 ? Start::at_rest : Start::with_tray;
  return run;
}

/// Seeds are counted below the floor's holes.
void check_counting_line(Table& root, const Scene& scene) {
  for (const Hole& hole : scene.tray.holes)
    if (hole.thickness >= scene.run.count_below)
      root.required_table("tray").required_table("holes").fail(
          "thickness", fmt::format("{} reaches to the counting line, {} below the floor (run.count_below), or below it",
                                   millimetres(hole.thickness), millimetres(scene.run.count_below)));
}

/// 0, every, 2 every, .. up to the end of the run, which a rounding error must not pass.
std::vector<double> repeated_times(Table& table, double every, double duration) {
  constexpr double most = list_limits::snapshots, rounding = 1e-9;
  const double count = std::floor(duration / every * (1 + rounding)) + 1;
  if (count > most) table.fail("every", fmt::format("asks for {:.0f} snapshots, more than {:.0f}", count, most));
  std::vector<double> times;
  for (int i = 0; i < static_cast<int>(count); ++i) times.push_back(std::min(i * every, duration));
  return times;
}

std::vector<double> read_times(Table& table, double duration) {
  std::vector<double> times = table.quantities("times", Dimension::time, 0, duration);
  const std::optional<double> every = table.quantity("every", Dimension::time, 1e-9, duration);
  table.refuse_more("times", times.size(), list_limits::snapshots);
  if (!times.empty() && every) table.fail("every", "contradicts times; give one of them");
  if (every) return repeated_times(table, *every, duration);
  if (times.empty()) table.fail("times", "is missing; give times such as [\"2 s\", \"6 s\"], or every");
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) continue;
    table.fail("times", fmt::format("{:g} s after {:g} s; expected ascending times", times[i], times[i - 1]));
  }
  return times;
}

/// Maps reach over all vessels.
void check_cell(const Table& table, double cell, const Scene& scene) {
  constexpr double most = 1e6;
  Eigen::Vector2d low(0, 0), high(scene.tray.length, scene.tray.height);
  if (scene.hopper) {
    const Vessel& hopper = *scene.hopper;
    low = low.cwiseMin(hopper.origin);
    high = high.cwiseMax(hopper.origin + Eigen::Vector2d(hopper.length, hopper.height));
  }
  const Eigen::Vector2d extent = high - low;
  const double cells = (extent.x() / cell + 1) * (extent.y() / cell + 1);
  if (cells > most)
    table.fail(
        "cell",
        fmt::format("{} makes maps of {:.3g} cells, more than {:.0f}; {} makes few enough", millimetres(cell), cells,
                    most, millimetres(1.1 * std::max(std::sqrt(extent.prod() / most), extent.maxCoeff() / most))));
}

Record read_record(Table table, const Scene& scene) {
  table.reject_keys_other_than({"times", "every", "cell", "view"});
  Record record;
  record.times = read_times(table, scene.run.duration);
  const double diameter = largest_mean_diameter(scene.lots);
  const std::vector<TomlValue> cell = table.values_of("cell");
  if (cell.size() > 1) table.fail("cell", "must be one value");
  record.cell = read_width(table, "cell", cell.empty() ? TomlValue{"2 diameters"} : cell.front(), diameter);
  check_cell(table, record.cell, scene);
  const std::size_t view = table.choice("view", {"projection", "slice"}).value_or(0);
  if (scene.space != Space::two_dimensional) record.view = static_cast<MapView>(view);
  return record;
}

}  // namespace

namespace {

/// With file and line, where `prepare` knows but the key.
void refuse_missing_lot(Table root, const Scene& scene) {
  const auto missing = missing_lot(scene);
  if (!missing) return;
  const bool filled = missing->source == SeedSource::fill;
  const Table source = root.required_table(missing->vessel->name).required_table(filled ? "fill" : "rain");
  source.fail(!filled ? "rate" : source.has("height") ? "height" : "count", missing->message);
}

/// "plane" is an older word for "2d".
Space read_space(Table& root) {
  if (root.text("space") == "plane") return Space::two_dimensional;
  constexpr Space spaces[] = {Space::two_dimensional, Space::three_dimensional};
  return spaces[root.choice("space", {"2d", "3d"}).value_or(0)];
}

/// In its own space, or in the one that is wanted; in another than its own without a drill.
Seeder read_seeder_in(std::optional<Space> wanted, const std::filesystem::path& file,
                      const std::vector<Override>& overrides, const std::shared_ptr<SourceFiles>& files) {
  Table root(Document::read(file, overrides, files));
  root.reject_keys_other_than({"title", "space", "accuracy", "seeds", "contact", "tray", "hopper", "numerics", "guard",
                               "run", "record", "drill"});
  Seeder seeder;
  Scene& scene = seeder.scene;
  scene.title = printable(root.text("title").value_or(file.stem().string()));
  const Space own = read_space(root);
  scene.space = wanted.value_or(own);
  Table seeds = root.required_table("seeds");
  scene.lots = read_lots(seeds, scene.space);
  std::optional<double> slice;  // m, where seeds are counted in the other space
  if (scene.space != own) slice = slice_thickness(read_lots(seeds, Space::two_dimensional));
  const Table contact =
      crops_have_contacts(scene.lots) ? root.table_or_empty("contact") : root.required_table("contact");
  scene.contact = read_contact(contact, seeds, scene.lots);
  Table tray = root.required_table("tray");
  scene.tray = read_vessel(tray, "tray", scene.lots, scene.space, seeder.drawings, nullptr, slice);
  if (auto hopper = root.table("hopper")) {
    scene.hopper = read_vessel(*hopper, "hopper", scene.lots, scene.space, seeder.drawings, &scene.tray, slice);
    scene.hopper->origin.x() = hopper->required_quantity("left", Dimension::length, -100, 100);
    scene.hopper->origin.y() = hopper->required_quantity("above", Dimension::length, 0, 100);
    if (const auto fault = image_fault(scene)) hopper->fail(fault->key, fault->message);
  }
  const auto gives_seeds = [](const Vessel& vessel) { return vessel.fill || vessel.rain; };
  if (!gives_seeds(scene.tray) && !(scene.hopper && gives_seeds(*scene.hopper))) {
    tray.fail("fill", "is missing, no hopper has one, and no rain falls: there is nothing to sow");
  }
  const AccuracyLevel accuracy = read_accuracy(root, scene.lots, scene.space);
  refuse_softness_beside(accuracy, contact, seeds);
  if (auto numerics = root.table("numerics")) scene.numerics = read_numerics(*numerics, scene.contact.law, accuracy);
  scene.numerics.accuracy = accuracy;
  if (auto guard = root.table("guard")) scene.guard = read_guard(*guard);
  scene.run = read_run(root.required_table("run"));
  check_counting_line(root, scene);
  if (auto record = root.table("record")) scene.record = read_record(*record, scene);
  if (scene.space != own)
    root.skip("drill");  // which is of the holes in the file's own space
  else if (auto drill = root.table("drill"))
    seeder.drill = read_drill(*drill, scene.tray.holes.size());
  root.reject_unknown_keys();
  refuse_missing_lot(root, scene);
  scene.doubts_of_reader.sentences = drawing_warnings(scene, seeder.drawings);
  return seeder;
}

}  // namespace

Seeder read_seeder(const std::filesystem::path& file, const std::vector<Override>& overrides,
                   const std::shared_ptr<SourceFiles>& files) {
  return read_seeder_in(std::nullopt, file, overrides, files);
}

BothSpaces read_in_both_spaces(const std::filesystem::path& file, const std::vector<Override>& overrides,
                               const std::shared_ptr<SourceFiles>& files) {
  BothSpaces both{read_seeder_in(Space::two_dimensional, file, overrides, files).scene,
                  read_seeder_in(Space::three_dimensional, file, overrides, files).scene};
  if (!both.plane.tray.depth) both.plane.tray.depth = both.space.tray.depth;  // a round tray's is its length
  return both;
}

Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides,
                 const std::shared_ptr<SourceFiles>& files) {
  return read_seeder(file, overrides, files).scene;
}

}  // namespace vibrosow
