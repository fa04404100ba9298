#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agronomy/sowing_plan.hpp"
#include "agronomy/sowing_rate.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "input/input_file.hpp"
#include "input/measured.hpp"
#include "input/presets.hpp"
#include "input/read_crop_lot.hpp"
#include "input/read_held_out.hpp"
#include "input/read_hole_table.hpp"
#include "input/read_scene.hpp"
#include "report/plan_report.hpp"
#include "scene/input_error.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

struct PlanOptions {
  CommonOptions common;
  std::string crop, rate, plants, establishment, row_spacing, speed, thousand_grain_weight;
  std::optional<int> rows;
  std::string layout;
  std::vector<std::string> weighed;
};

/// A quantity of an option, from `least` to `most` (SI). Throws InputError.
double quantity(const std::string& option, const std::string& text, Dimension dimension, double least, double most,
                std::string_view example = {}) {
  try {
    const double value = parse_quantity(text, dimension, example);
    if (value >= least && value <= most) return value;
  } catch (const UnitError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
  const std::string_view unit = si_unit(dimension);
  throw InputError(fmt::format("{}: \"{}\" is out of range; from {:g} to {:g} {}", option, text, least, most, unit));
}

/// Seeds are counted where the unit says so.
bool counts_seeds(const std::string& text) {
  try {
    const std::string unit = split_quantity(text).unit;
    return is_unit_of(unit, Dimension::seeds_per_area) || is_unit_of(unit, Dimension::plants_per_area);
  } catch (const UnitError&) {
    return false;
  }
}

constexpr double fewest_per_area = 0.1, most_per_area = 1e5;  // 1/m2

PlanSource source_of(const PlanOptions& options) {
  PlanSource source;
  if (const auto meaning = changed_meaning(options.crop, "crops")) print_notes({*meaning});
  source.crop = options.crop;
  source.lot = read_crop_lot(options.crop, "--crop");
  if (!options.thousand_grain_weight.empty()) {
    const double mass = quantity("--tkw", options.thousand_grain_weight, Dimension::seed_mass, 1e-6, 10, "45 g") / 1000;
    source.lot = of_mass(source.lot, mass);
    source.own_mass = true;
  }
  SowingTask& task = source.plan.task;
  task.seed = planned_seed(source.lot);
  task.pace.row_spacing = quantity("--row-spacing", options.row_spacing, Dimension::length, 0.01, 10, "15 cm");
  task.pace.speed = quantity("--speed", options.speed, Dimension::travel_speed, 0.01, 20);
  if (!options.plants.empty()) {
    source.plants = quantity("--plants", options.plants, Dimension::plants_per_area, fewest_per_area, most_per_area);
    source.establishment = quantity("--establishment", options.establishment, Dimension::fraction, 0.01, 1, "85 %");
    task.sowing_rate = mass_of_seeds(seeds_for_plants(*source.plants, *source.establishment), task.seed.mass);
  } else if (counts_seeds(options.rate)) {
    task.sowing_rate = mass_of_seeds(
        quantity("--rate", options.rate, Dimension::seeds_per_area, fewest_per_area, most_per_area), task.seed.mass);
  } else {
    task.sowing_rate = quantity("--rate", options.rate, Dimension::mass_per_area, 1e-6, 1);
  }
  source.rows = options.rows;
  return source;
}

constexpr double usual_weighing_error = 0.02;  // half width of 95 %: a kitchen scale and a clock

/// The tray of the layout with one change to it.
WeighedTray weighed_tray(const std::string& layout, const std::vector<Override>& changes, double mass_rate,
                         double half_width) {
  try {
    return {table_tray(read_scene(layout, changes)), mass_rate, half_width / normal_95};
  } catch (const InputError& error) {
    const std::string what = error.what();
    throw InputError(what.find(layout) == std::string::npos ? layout + ": " + what : what);
  }
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

/// "0.17 g/s at 6.4 Hz", or "0.17 g/s +- 3 % at 6.4 Hz".
WeighedTray weighing_of(const std::string& layout, const std::string& text) {
  constexpr const char* example = "expected a rate and where, such as \"0.17 g/s at 6.4 Hz\"";
  const auto at = text.find(" at ");
  if (at == std::string::npos) throw InputError(fmt::format("--weighed: \"{}\": {}", text, example));
  std::string rate = text.substr(0, at);
  double half_width = usual_weighing_error;
  if (const auto sign = rate.find("+-"); sign != std::string::npos) {
    half_width = quantity("--weighed", trimmed(rate.substr(sign + 2)), Dimension::fraction, 1e-4, 1, "3 %");
    rate = trimmed(rate.substr(0, sign));
  }
  const std::string frequency = trimmed(text.substr(at + 4));
  quantity("--weighed", frequency, Dimension::frequency, 0.01, 1000, "6.4 Hz");
  return weighed_tray(layout, {parse_override("tray.motion.frequency=" + frequency)},
                      quantity("--weighed", rate, Dimension::mass_rate, 1e-9, 1e3, "0.17 g/s"), half_width);
}

/// The rows of a table of measured outflow.
std::vector<WeighedTray> weighings_of(const PlanOptions& options, const std::string& file, double seed_mass) {
  SourceFiles files;
  const MeasuredTable table = read_measured(files.csv(file));
  if (is_curve(table.quantity)) throw InputError(file + ": is of curves; expected rates, or what was caught in a time");
  std::vector<WeighedTray> rows;
  for (const MeasuredSeries& series : table.series) {
    if (series.hole != "all" || series.lot != "all")
      throw InputError(fmt::format("{}: is of one hole or lot; expected all of the tray", series.where));
    std::vector<Override> changes;
    for (const Condition& condition : series.conditions) changes.push_back(override_of(condition, series.where));
    const MeanWithInterval& value = series.values.front();
    const double mass = table.quantity == MeasuredQuantity::seed_rate ? seed_mass : 1;
    rows.push_back(weighed_tray(options.layout, changes, value.mean * mass,
                                std::max(usual_weighing_error, value.half_width_95.value_or(0) / value.mean)));
  }
  return rows;
}

/// How many rows the tray feeds, by its [drill]; else one a hole.
int rows_of(const std::string& layout) {
  const Seeder seeder = read_seeder(layout);
  return seeder.drill ? seeder.drill->rows() : static_cast<int>(seeder.scene.tray.holes.size());
}

int run_weighed(PlanOptions options, const SowingTask& task) {
  options.layout = input_file(options.layout, FileKind::seeder).path.string();
  std::vector<WeighedTray> weighed;
  for (const std::string& text : options.weighed) {
    if (text.ends_with(".csv"))
      std::ranges::move(weighings_of(options, text, task.seed.mass), std::back_inserter(weighed));
    else
      weighed.push_back(weighing_of(options.layout, text));
  }
  constexpr double same = 0.01;
  const PlannedSeed& seed = weighed.front().tray.seed;
  if (std::abs(seed.mass / task.seed.mass - 1) > same || std::abs(seed.diameter / task.seed.diameter - 1) > same)
    throw InputError(
        fmt::format("--layout: its seeds weigh {:.3g} mg and are as large as balls of {:.3g} mm, those of "
                    "--crop {:.3g} mg and {:.3g} mm; give the crop of the layout",
                    seed.mass * 1e6, seed.diameter * 1e3, task.seed.mass * 1e6, task.seed.diameter * 1e3));
  const int rows = rows_of(options.layout);
  const WeighedPlan plan =
      plan_weighed(rows * task.row_mass_rate(), weighed, shipped_hole_table(), shipped_model_error());
  const auto print_plan = [&] { print_text(weighed_text(task, rows, plan)); };
  if (options.common.out.empty()) {
    print_plan();
    return exit_done;
  }
  const OutputFolder folder = options.common.output_folder("plan", plan_file_texts());
  write_then_print(
      false, [&] { folder.write(weighed_files(plan, options.common.csv)); }, print_plan);
  print("reports: {}\n", folder.path().string());
  return exit_done;
}

int run_plan(const PlanOptions& options) {
  if (options.rate.empty() == options.plants.empty()) throw InputError("one of --rate and --plants is needed");
  PlanSource source = source_of(options);
  if (!options.layout.empty()) return run_weighed(options, source.plan.task);
  try {
    source.plan = plan_sowing(source.plan.task, shipped_hole_table(), shipped_model_error());
  } catch (const InputError& error) {
    throw InputError(fmt::format("--crop: {}: {}", options.crop, error.what()));
  }
  if (options.common.out.empty()) {
    print_text(plan_text(source));
    return exit_done;
  }
  const OutputFolder folder = options.common.output_folder("plan", plan_file_texts());
  write_then_print(
      false, [&] { folder.write(plan_files(source, options.common.csv)); }, [&] { print_text(plan_text(source)); });
  print("reports: {}\n", folder.path().string());
  return exit_done;
}

}  // namespace

void add_plan_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* command = app.add_subcommand("plan", "which holes, frequency and amplitude sow a crop at a rate");
  const auto add = [&](const char* name, std::string& value, const char* help, const char* kind) {
    return command->add_option(name, value, help)->type_name(kind);
  };
  add("--crop", options->crop, "a shipped crop (vibrosow presets crops) or a path ending in .toml", "CROP")->required();
  CLI::Option* rate = add("--rate", options->rate, "\"180 kg/ha\", or seeds: \"350 seeds/m2\"", "RATE");
  CLI::Option* plants =
      add("--plants", options->plants, "instead: plants that are to stand, \"280 plants/m2\"", "RATE");
  CLI::Option* establishment =
      add("--establishment", options->establishment, "the part of the seeds that becomes plants, \"85 %\"", "PERCENT");
  rate->excludes(plants);
  plants->needs(establishment);
  establishment->needs(plants);
  add("--row-spacing", options->row_spacing, "between neighbouring rows, \"15 cm\"", "LENGTH")->required();
  add("--speed", options->speed, "of the drill, \"8 km/h\"", "SPEED")->required();
  command->add_option("--rows", options->rows, "of the drill, for what all take together")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  add("--tkw", options->thousand_grain_weight, "mass of a thousand seeds, \"4.5 g\"; default the crop's", "MASS");
  CLI::Option* layout =
      add("--layout", options->layout, "a tray that was weighed: seeder.toml of a plan, or one's own", "FILE");
  CLI::Option* weighed =
      command
          ->add_option("--weighed", options->weighed,
                       "what it gave, \"0.17 g/s at 6.4 Hz\", or a table of it (.csv); any number of times")
          ->type_name("RATE");
  layout->needs(weighed);
  weighed->needs(layout);
  add("--out", options->common.out, "directory for plan.csv and the best layout's seeder; default none", "DIR");
  add_csv_option(*command, options->common);
  add_examples(*command, {"vibrosow plan --crop pea --rate 200kg/ha --row-spacing 15cm --speed 8km/h",
                          "vibrosow plan --crop wheat --rate \"350 1/m2\" --row-spacing 12cm --speed 9km/h",
                          "vibrosow plan --crop rye --rate 140kg/ha --row-spacing 15cm --speed 2m/s"});
  command->callback([options, &exit_code] { exit_code = run_plan(*options); });
}

}  // namespace vibrosow
