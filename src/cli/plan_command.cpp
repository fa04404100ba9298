#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agronomy/settings_card.hpp"
#include "agronomy/sowing_plan.hpp"
#include "agronomy/sowing_rate.hpp"
#include "agronomy/weighed_plan.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "files/atomic_file.hpp"
#include "files/whole_file.hpp"
#include "input/input_file.hpp"
#include "input/measured.hpp"
#include "input/presets.hpp"
#include "input/read_crop_lot.hpp"
#include "input/read_held_out.hpp"
#include "input/read_hole_table.hpp"
#include "input/read_scene.hpp"
#include "outflow/statistics.hpp"
#include "plan/scene_warnings.hpp"
#include "report/plan_page.hpp"
#include "report/plan_report.hpp"
#include "scene/input_error.hpp"
#include "scene/seed_lot.hpp"
#include "scene/trimmed.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

struct PlanOptions {
  CommonOptions common;
  std::vector<std::string> crops, rates, thousand_grain_weights;  // several: a mixture, one after the other
  std::string plants, establishment, row_spacing, speed, html;
  std::optional<int> rows;
  std::string layout;
  std::vector<std::string> weighed;
};

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

/// A crop and its own thousand grain mass; empty: the crop's.
PlannedLot lot_of(const std::string& crop, const std::string& thousand_grain_weight) {
  if (const auto meaning = changed_meaning(crop, "crops")) print_notes({*meaning});
  PlannedLot planned;
  planned.crop = crop;
  planned.sown.lot = read_crop_lot(crop, "--crop");
  if (!thousand_grain_weight.empty()) {
    const double mass = quantity_option("--tkw", thousand_grain_weight, Dimension::seed_mass, 1e-6, 10, "45 g") / 1000;
    planned.crop_mass = mean_mass(planned.sown.lot);
    planned.sown.lot = of_mass(planned.sown.lot, mass);
  }
  return planned;
}

/// kg/m2, of seeds of that mass (kg).
double sowing_rate_of(const std::string& rate, double seed_mass) {
  if (counts_seeds(rate))
    return mass_of_seeds(quantity_option("--rate", rate, Dimension::seeds_per_area, fewest_per_area, most_per_area),
                         seed_mass);
  return quantity_option("--rate", rate, Dimension::mass_per_area, 1e-6, 1);
}

/// Every crop has its rate, and its thousand grain mass where any has one.
void check_counts(const PlanOptions& options) {
  if (options.rates.empty() == options.plants.empty()) throw InputError("one of --rate and --plants is needed");
  const std::size_t crops = options.crops.size();
  if (crops > 1 && !options.plants.empty())
    throw InputError("--plants: is of one crop; give each of a mixture a --rate");
  if (options.plants.empty() && options.rates.size() != crops)
    throw InputError(fmt::format("--rate: there are {} for {} crops; give each --crop its --rate, in the same order",
                                 options.rates.size(), crops));
  if (!options.thousand_grain_weights.empty() && options.thousand_grain_weights.size() != crops)
    throw InputError(fmt::format("--tkw: there are {} for {} crops; give each --crop its own, or none",
                                 options.thousand_grain_weights.size(), crops));
  for (std::size_t i = 1; i < crops; ++i)
    if (std::find(options.crops.begin(), options.crops.begin() + static_cast<std::ptrdiff_t>(i), options.crops[i]) !=
        options.crops.begin() + static_cast<std::ptrdiff_t>(i))
      throw InputError(fmt::format("--crop: {} is given twice", options.crops[i]));
}

SeedContact seed_contact(const Contact& contact) {
  return {contact.seed.friction, contact.wall.friction,
          contact.rolling == Rolling::none ? 0 : contact.seed.rolling_friction, contact.seed.restitution};
}

/// Of a value that lies in a range in 95 % of cases.
double deviation_in(const std::optional<std::array<double, 2>>& range, double (*scale)(double)) {
  return range ? (scale((*range)[1]) - scale((*range)[0])) / (2 * normal_95) : 0;
}

/// The contact of a plan's seeds: mean over lots by volume, as of the aspect.
struct MeanContact {
  SeedContact contact{.restitution = 0};
  SeedContactError error;
};

/// None where a crop names no contact model.
std::optional<MeanContact> contact_of(const std::vector<PlannedLot>& lots) {
  MeanContact mean;
  double all = 0;
  for (const PlannedLot& planned : lots) all += planned.sown.lot.number_fraction * mean_volume(planned.sown.lot);
  for (const PlannedLot& planned : lots) {
    const std::optional<CropContact> model = read_crop_contact(planned.crop, "--crop");
    if (!model) return std::nullopt;
    const SeedContact own = seed_contact(model->contact);
    const double part = planned.sown.lot.number_fraction * mean_volume(planned.sown.lot) / all;
    for (double SeedContact::*value : {&SeedContact::friction, &SeedContact::wall_friction,
                                       &SeedContact::rolling_friction, &SeedContact::restitution})
      mean.contact.*value += part * own.*value;
    mean.error.log_friction = std::hypot(
        mean.error.log_friction, part * deviation_in(model->reference.friction, [](double x) { return std::log(x); }));
    mean.error.rolling_friction =
        std::hypot(mean.error.rolling_friction,
                   part * deviation_in(model->reference.rolling_friction, [](double x) { return x; }));
  }
  return mean;
}

/// The table of one hole for the seeds of a plan, with their contact in it.
HoleTable table_of(PlanSource& source) {
  const HoleTable table = shipped_hole_table();
  const std::optional<MeanContact> mean = contact_of(source.lots);
  if (!mean) return table;
  const ContactSlopes slopes = shipped_contact_slopes();
  const ContactFactor factor =
      slopes.between(source.plan.task.seed.aspect, table.contact(), mean->contact, mean->error);
  source.contact = {mean->contact, !slopes.holds(mean->contact)};
  return table.times(factor);
}

PlanSource source_of(const PlanOptions& options) {
  check_counts(options);
  PlanSource source;
  std::vector<SownLot> sown;
  for (std::size_t i = 0; i < options.crops.size(); ++i) {
    const bool own_mass = !options.thousand_grain_weights.empty();
    source.lots.push_back(lot_of(options.crops[i], own_mass ? options.thousand_grain_weights[i] : ""));
    SownLot& of_lot = source.lots.back().sown;
    const double mass = mean_mass(of_lot.lot);
    if (!options.plants.empty()) {
      source.plants =
          quantity_option("--plants", options.plants, Dimension::plants_per_area, fewest_per_area, most_per_area);
      source.establishment =
          quantity_option("--establishment", options.establishment, Dimension::fraction, 0.01, 1, "85 %");
      of_lot.sowing_rate = mass_of_seeds(seeds_for_plants(*source.plants, *source.establishment), mass);
    } else {
      of_lot.sowing_rate = sowing_rate_of(options.rates[i], mass);
    }
    sown.push_back(of_lot);
  }
  share_out(sown);
  SowingTask& task = source.plan.task;
  std::vector<SeedLot> lots;
  for (std::size_t i = 0; i < sown.size(); ++i) {
    source.lots[i].sown = sown[i];
    lots.push_back(sown[i].lot);
    task.sowing_rate += sown[i].sowing_rate;
  }
  task.seed = planned_seed(lots);
  task.pace.row_spacing = quantity_option("--row-spacing", options.row_spacing, Dimension::length, 0.01, 10, "15 cm");
  task.pace.speed = quantity_option("--speed", options.speed, Dimension::travel_speed, 0.01, 20);
  source.rows = options.rows;
  task.rows = options.rows;
  return source;
}

constexpr double usual_weighing_error = 0.02;  // half width of 95 %: a kitchen scale and a clock

/// The tray of the layout with one change to it.
TableTray tray_of(const std::string& layout, const std::vector<Override>& changes = {}) {
  try {
    return table_tray(read_scene(layout, changes));
  } catch (const InputError& error) {
    const std::string what = error.what();
    throw InputError(what.find(layout) == std::string::npos ? layout + ": " + what : what);
  }
}

WeighedTray weighed_tray(const std::string& layout, const std::vector<Override>& changes, double mass_rate,
                         double half_width) {
  return {tray_of(layout, changes), mass_rate, half_width / normal_95};
}

/// "0.17 g/s at 6.4 Hz", or "0.17 g/s +- 3 % at 6.4 Hz".
WeighedTray weighing_of(const std::string& layout, const std::string& text) {
  constexpr const char* example = "expected a rate and where, such as \"0.17 g/s at 6.4 Hz\"";
  const auto at = text.find(" at ");
  if (at == std::string::npos) throw InputError(fmt::format("--weighed: \"{}\": {}", text, example));
  std::string rate = text.substr(0, at);
  double half_width = usual_weighing_error;
  if (const auto [sign, length] = find_plus_minus(rate); sign != std::string::npos) {
    half_width = quantity_option("--weighed", std::string(trimmed(rate.substr(sign + length))), Dimension::fraction,
                                 1e-4, 1, "3 %");
    rate = trimmed(rate.substr(0, sign));
  }
  const std::string frequency(trimmed(text.substr(at + 4)));
  quantity_option("--weighed", frequency, Dimension::frequency, 0.01, 1000, "6.4 Hz");
  return weighed_tray(layout, {parse_override("tray.motion.frequency=" + frequency)},
                      quantity_option("--weighed", rate, Dimension::mass_rate, 1e-9, 1e3, "0.17 g/s"), half_width);
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
    if (const int repeats = series.repeats.front(); repeats > 1)
      rows.back().repeats_scatter =
          value.half_width_95.value_or(0) / value.mean * std::sqrt(repeats) / student_t_95(repeats - 1);
  }
  return rows;
}

/// How many rows the tray feeds, by its [drill] or else as asked; else one a hole.
int rows_of(const PlanOptions& options) {
  const Seeder seeder = read_seeder(options.layout);
  if (!seeder.drill) return options.rows.value_or(static_cast<int>(seeder.scene.tray.holes.size()));
  if (options.rows && *options.rows != seeder.drill->rows())
    throw InputError(
        fmt::format("--rows: the [drill] of --layout says how many rows the tray feeds, {}, not {}; leave "
                    "it out",
                    seeder.drill->rows(), *options.rows));
  return seeder.drill->rows();
}

/// The command that asks again when a layout was weighed.
std::string asked_again(const PlanOptions& options) {
  std::vector<std::string> words{"plan"};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  for (std::size_t i = 0; i < options.crops.size(); ++i) {
    add("--crop", options.crops[i]);
    if (!options.rates.empty()) add("--rate", options.rates[i]);
    if (!options.thousand_grain_weights.empty()) add("--tkw", options.thousand_grain_weights[i]);
  }
  add("--plants", options.plants);
  add("--establishment", options.establishment);
  add("--row-spacing", options.row_spacing);
  add("--speed", options.speed);
  const std::string written = options.common.out.empty() ? "SEEDER.toml" : options.common.out + "/seeder.toml";
  add("--layout", options.layout.empty() ? written : options.layout);
  if (options.rows && !options.layout.empty()) add("--rows", std::to_string(*options.rows));
  for (const std::string& weighed : options.weighed) add("--weighed", weighed);
  add("--html", options.html);
  return typed_line(words);
}

/// Writes what was asked for, then prints the answer.
void answer(const PlanOptions& options, const PlanPage& page, const std::vector<OutputFile>& files,
            const std::string& text) {
  std::optional<OutputFolder> folder;
  if (!options.common.out.empty()) folder = options.common.output_folder("plan", plan_file_texts());
  const auto write = [&] {
    if (folder) folder->write(files);
    if (!options.html.empty()) write_file_atomically(std::filesystem::path(options.html), plan_page(page));
  };
  write_then_print(false, write, [&] { print_text(text); });
  if (folder) print("reports: {}\n", folder->path().string());
  if (!options.html.empty()) print("page: {}\n", options.html);
}

int run_weighed(PlanOptions options, PlanSource source) {
  const SowingTask& task = source.plan.task;
  const std::string command = asked_again(options);
  options.layout = input_file(options.layout, FileKind::seeder).path.string();
  std::vector<std::string> warnings = scene_warnings(read_scene(options.layout, {}));
  std::erase_if(warnings,
                [](const std::string& warning) { return warning.starts_with("contact."); });  // the table has its own
  print_warnings(warnings);
  std::vector<WeighedTray> weighed;
  for (const std::string& text : options.weighed) {
    if (has_extension(text, ".csv"))
      std::ranges::move(weighings_of(options, text, task.seed.mass), std::back_inserter(weighed));
    else
      weighed.push_back(weighing_of(options.layout, text));
  }
  constexpr double same = 0.01;
  const TableTray tray = tray_of(options.layout);
  const PlannedSeed& seed = tray.seed;
  const auto differs = [](double one, double other) { return std::abs(one / other - 1) > same; };
  if (differs(seed.mass, task.seed.mass) || differs(seed.diameter, task.seed.diameter) ||
      differs(seed.aspect, task.seed.aspect))
    throw InputError(fmt::format(
        "--layout: its seeds weigh {:.3g} mg, are as large as balls of {:.3g} mm and {:.3g} times as long as "
        "wide, those of --crop {:.3g} mg, {:.3g} mm and {:.3g} times; give the crop of the layout",
        seed.mass * 1e6, seed.diameter * 1e3, seed.aspect, task.seed.mass * 1e6, task.seed.diameter * 1e3,
        task.seed.aspect));
  const int rows = rows_of(options);
  const HoleTable table = table_of(source);
  const ModelError model = shipped_model_error();
  const WeighedPlan plan = plan_weighed(rows * task.row_mass_rate(), tray, weighed, table, model);
  PlanPage page{.source = source, .weighed = &plan, .command = command};
  PlanCard card;
  if (!options.html.empty()) {
    const TrayRates rates = weighed_rates(tray, weighed, table, model);
    card = {rates.tray(), rows, settings_card(rates, task, rows)};
    page.card = &card;
  }
  answer(options, page, weighed_files(source, plan, options.common.csv), weighed_text(source, rows, plan));
  return exit_done;
}

int run_plan(const PlanOptions& options) {
  PlanSource source = source_of(options);
  if (!options.layout.empty()) return run_weighed(options, source);
  const HoleTable table = table_of(source);
  const ModelError model = shipped_model_error();
  try {
    source.plan = plan_sowing(source.plan.task, table, model);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--crop: {}: {}", fmt::join(options.crops, ", "), error.what()));
  }
  PlanPage page{.source = source, .command = asked_again(options)};
  PlanCard card;
  if (!options.html.empty() && !source.plan.layouts.empty()) {
    const PlannedLayout& best = source.plan.layouts.front();
    const TrayRates rates(table_tray(source.plan.task, best), table, model);
    card = {rates.tray(), best.feed.rows, settings_card(rates, source.plan.task, best.feed.rows, best.more_by_faster)};
    page.card = &card;
  }
  answer(options, page, plan_files(source, options.common.csv), plan_text(source));
  return exit_done;
}

}  // namespace

void add_plan_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* command = app.add_subcommand("plan", "find holes, frequency and amplitude that sow a crop at a rate");
  const auto add = [&](const char* name, std::string& value, const char* help, const char* kind) {
    return command->add_option(name, value, help)->type_name(kind);
  };
  const auto add_each = [&](const char* name, std::vector<std::string>& values, const char* help, const char* kind) {
    return command->add_option(name, values, help)
        ->type_name(kind)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  add_each(
      "--crop", options->crops,
      "a shipped crop (vibrosow presets crops) or a path ending in .toml; several, each with its --rate: a mixture",
      "CROP")
      ->required();
  CLI::Option* rate = add_each("--rate", options->rates, "\"180 kg/ha\", or seeds: \"350 seeds/m2\"", "RATE");
  CLI::Option* plants =
      add("--plants", options->plants, "instead of --rate: plants that are to stand, \"280 plants/m2\"", "RATE");
  CLI::Option* establishment =
      add("--establishment", options->establishment, "share of the seeds that become plants, \"85 %\"", "PERCENT");
  rate->excludes(plants);
  plants->needs(establishment);
  establishment->needs(plants);
  add("--row-spacing", options->row_spacing, "distance between rows, \"15 cm\"", "LENGTH")->required();
  add("--speed", options->speed, "speed of the drill, \"8 km/h\"", "SPEED")->required();
  command->add_option("--rows", options->rows, "rows of the drill: for its totals, and for holes that feed several")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  add_each("--tkw", options->thousand_grain_weights, "mass of a thousand seeds, \"4.5 g\"; default the crop's", "MASS");
  CLI::Option* layout =
      add("--layout", options->layout, "a tray that was weighed: seeder.toml of a plan, or one's own", "FILE");
  CLI::Option* weighed =
      command
          ->add_option("--weighed", options->weighed,
                       "what that tray gave, \"0.17 g/s at 6.4 Hz\", or a table of it (.csv); repeatable")
          ->type_name("RATE");
  layout->needs(weighed);
  weighed->needs(layout);
  add("--html", options->html, "a page to print: what to set from 4 to 14 km/h, and what to weigh", "FILE");
  add("--out", options->common.out, "directory for plan.csv and the best layout's seeder; default none", "DIR");
  add_csv_option(*command, options->common);
  add_examples(*command, {"vibrosow plan --crop pea --rate 200kg/ha --row-spacing 15cm --speed 8km/h",
                          "vibrosow plan --crop wheat --rate \"350 1/m2\" --row-spacing 12cm --speed 9km/h",
                          "vibrosow plan --crop rye --rate 140kg/ha --row-spacing 15cm --speed 2m/s"});
  command->callback([options, &exit_code] { exit_code = run_plan(*options); });
}

}  // namespace vibrosow
