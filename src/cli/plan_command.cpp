#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "agronomy/sowing_plan.hpp"
#include "agronomy/sowing_rate.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "input/read_crop_lot.hpp"
#include "input/read_hole_table.hpp"
#include "report/plan_report.hpp"
#include "scene/input_error.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

struct PlanOptions {
  CommonOptions common;
  std::string crop, rate, plants, establishment, row_spacing, speed, thousand_grain_weight;
  std::optional<int> rows;
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

int run_plan(const PlanOptions& options) {
  if (options.rate.empty() == options.plants.empty()) throw InputError("one of --rate and --plants is needed");
  PlanSource source = source_of(options);
  try {
    source.plan = plan_sowing(source.plan.task, shipped_hole_table());
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
  add("--out", options->common.out, "directory for plan.csv and the best layout's seeder; default none", "DIR");
  add_csv_option(*command, options->common);
  add_examples(*command, {"vibrosow plan --crop pea --rate 200kg/ha --row-spacing 15cm --speed 8km/h",
                          "vibrosow plan --crop wheat --rate \"350 1/m2\" --row-spacing 12cm --speed 9km/h",
                          "vibrosow plan --crop rye --rate 140kg/ha --row-spacing 15cm --speed 2m/s"});
  command->callback([options, &exit_code] { exit_code = run_plan(*options); });
}

}  // namespace vibrosow
