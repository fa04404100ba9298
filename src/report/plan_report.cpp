#include "report/plan_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "agronomy/sowing_rate.hpp"
#include "files/whole_file.hpp"
#include "input/toml_value.hpp"
#include "report/expected_report.hpp"
#include "report/terminal_text.hpp"
#include "scene/seed_lot.hpp"
#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

constexpr Unit kilometres_per_hour{"km/h", kilometre_per_hour}, hertz{"Hz", 1};
constexpr std::size_t most_printed_rows = 12;  // of the table on a screen

/// What the table of one hole was simulated with: seeders/one-hole.toml, which a test compares.
constexpr struct {
  double shell_compression = 1e-4, friction = 0.45, wall_friction = 0.35, restitution = 0.5;
  double section = 16, height = 20;  // d
  double packing = 0.6;              // by which the number of seeds is called a depth
} table_model;

/// A layout and its plan.
struct PlannedLayoutRow {
  const SowingPlan* plan;
  const PlannedLayout* layout;
  std::size_t rank;
};

std::string_view class_name(HoleClass risk) {
  switch (risk) {
    case HoleClass::rarely_clogs:
      return "rarely clogs";
    case HoleClass::kept_open:
      return "kept open by the shaking";
    case HoleClass::clogs:
      return "clogs";
  }
  return "";
}

/// 1/s, as planned.
double hole_rate(const PlannedLayoutRow& row) {
  const HolesForRows& feed = row.layout->feed;
  return row.plan->task.row_seed_rate() * feed.rows / feed.holes;
}

Columns<PlannedLayoutRow> plan_columns() {
  using R = const PlannedLayoutRow&;
  Columns<PlannedLayoutRow> columns = {
      text_column<PlannedLayoutRow>("rank", "1 is the best", [](R r) { return r.rank; }),
      text_column<PlannedLayoutRow>("holes", "so many holes feed so many rows: the holes",
                                    [](R r) { return r.layout->feed.holes; }),
      text_column<PlannedLayoutRow>("rows", "the rows", [](R r) { return r.layout->feed.rows; }),
      quantity_column<PlannedLayoutRow>("width_mm", millimetres, "of a round hole",
                                        [](R r) { return r.layout->width; }),
      quantity_column<PlannedLayoutRow>("width_over_seed", plain,
                                        "over the diameter of the ball of a seed's volume; of a mixture's largest crop",
                                        [](R r) { return r.layout->width_over_largest; }),
      text_column<PlannedLayoutRow>("risk",
                                    "of clogging, by the hole over the largest crop's seed: rarely clogs (5 and more), "
                                    "kept open by the shaking (3 to 5), clogs",
                                    [](R r) { return std::string(class_name(r.layout->risk())); }),
      quantity_column<PlannedLayoutRow>(
          "stood_still_percent", percent,
          "share of the simulated holes that once let nothing through for 10 sqrt(d / g), the largest "
          "of the table's places around",
          [](R r) { return r.layout->estimate.stood_still; }),
      quantity_column<PlannedLayoutRow>("bed_mm", millimetres, "depth of the bed",
                                        [](R r) { return r.layout->depth_over_d * r.plan->task.seed.diameter; }),
      quantity_column<PlannedLayoutRow>("frequency_Hz", hertz, "to set", [](R r) { return r.layout->frequency; }),
      quantity_column<PlannedLayoutRow>("amplitude_mm", millimetres, "half the stroke, to set",
                                        [](R r) { return r.layout->amplitude; }),
      quantity_column<PlannedLayoutRow>("hole_seeds_per_s", per_second, "of one hole", hole_rate),
      quantity_column<PlannedLayoutRow>("low_seeds_per_s", per_second,
                                        "of one hole, lower end of the range that holds the true rate in 95 % of cases",
                                        [](R r) { return hole_rate(r) * expected_range(r.layout->error).low; }),
      quantity_column<PlannedLayoutRow>("high_seeds_per_s", per_second, "upper end",
                                        [](R r) { return hole_rate(r) * expected_range(r.layout->error).high; }),
  };
  add_part_columns(
      columns, [](R r) -> const auto& { return r.layout->error; });
  append(columns,
         {
             quantity_column<PlannedLayoutRow>("least_speed_km_per_h", kilometres_per_hour,
                                               "the slowest drill that frequency alone keeps at the sowing rate",
                                               [](R r) { return r.layout->speeds.least; }),
             quantity_column<PlannedLayoutRow>("most_speed_km_per_h", kilometres_per_hour, "the fastest",
                                               [](R r) { return r.layout->speeds.most; }),
             text_column<PlannedLayoutRow>(
                 "more_by", "faster or slower: which shaking sows more",
                 [](R r) { return std::string(r.layout->more_by_faster ? "faster" : "slower"); }),
             quantity_column<PlannedLayoutRow>(
                 "dispersion", plain,
                 "of the counts of a hole: variance over mean, 1 for seeds that come at random; the largest "
                 "of the places around",
                 [](R r) { return r.layout->estimate.dispersion; }),
             quantity_column<PlannedLayoutRow>(
                 "contact_times", plain,
                 "what the table's outflow was multiplied by for the crop's own contact; 1 of one that names none",
                 [](R r) { return r.plan->table_times; }),
             text_column<PlannedLayoutRow>("measured", "whether anything of it was ever measured",
                                           [](R) { return std::string("no"); }),
         });
  return columns;
}

std::string speed_text(double speed) {
  return to_digits(speed / kilometre_per_hour, 3);
}

/// sqrt(d / g), s
double unit_of_time(const SowingPlan& plan) {
  return std::sqrt(plan.task.seed.diameter / standard_gravity);
}

std::string feed_text(const HolesForRows& feed) {
  const std::string holes = feed.holes == 1 ? "one hole" : fmt::format("{} holes", feed.holes);
  return feed.rows == 1 ? holes + " a row" : fmt::format("{} for {} rows", holes, feed.rows);
}

// The need.

std::string per_area_text(double sowing_rate, double seeds_per_area) {
  return fmt::format("{} kg/ha, {} seeds/m2", to_digits(sowing_rate / kilogram_per_hectare, 3),
                     to_digits(seeds_per_area, 3));
}

std::string seed_text(const PlannedSeed& seed) {
  return fmt::format("seeds of {} mg, as large as balls of {} mm{}", to_digits(seed.mass / milligram, 4),
                     to_digits(seed.diameter / millimetre, 3),
                     seed.aspect > 1 ? fmt::format(", {} times as long as wide", to_digits(seed.aspect, 3)) : "");
}

/// The seeds of a lot by itself.
PlannedSeed seed_of(const PlannedLot& planned) {
  SeedLot alone = planned.sown.lot;
  alone.number_fraction = 1;
  return planned_seed({alone});
}

std::string rate_text(const PlanSource& source) {
  const SowingTask& task = source.plan.task;
  std::string text = per_area_text(task.sowing_rate, task.seeds_per_area());
  if (source.plants)
    text += fmt::format(" for {} plants/m2 at an establishment of {} %", to_digits(*source.plants, 3),
                        two_digit_percent(*source.establishment));
  return text;
}

std::string need_text(const PlanSource& source) {
  const SowingTask& task = source.plan.task;
  const double seeds = task.row_seed_rate();
  std::string text;
  for (const std::string& sentence : need_sentences(source)) text += wrapped(sentence);
  text += fmt::format("a row, every {} cm at {} km/h: {} g/s, {} seeds/s, one every {} mm\n",
                      to_digits(task.pace.row_spacing * 100, 3), speed_text(task.pace.speed),
                      to_digits(task.row_mass_rate() / gram, 3), to_digits(seeds, 2 + (seeds >= 100)),
                      to_digits(mean_spacing(seeds, task.pace.speed) / millimetre, 3));
  if (source.rows)
    text += fmt::format("{} rows: {} g/s, {} seeds/s\n", *source.rows,
                        to_digits(*source.rows * task.row_mass_rate() / gram, 3), to_digits(*source.rows * seeds, 3));
  return text;
}

// The risk.

/// Of all layouts with one hole a row, the widest hole over the seed.
std::optional<double> widest_of_one_a_row(const SowingPlan& plan) {
  std::optional<double> widest;
  for (const PlannedLayout& layout : plan.layouts)
    if (layout.feed.holes == 1 && layout.feed.rows == 1)
      widest = std::max(widest.value_or(0), layout.width_over_largest);
  return widest;
}

std::string wider_text(const SowingPlan& plan, const std::optional<NearestChange::WiderHole>& hole) {
  constexpr int rows_tried = 4;
  if (!hole || hole->rows <= rows_tried) return "";
  return fmt::format("a hole of {:g} mm, {} seeds wide, would have to feed at least {} rows", hole->width / millimetre,
                     to_digits(hole->width / plan.task.seed.largest_diameter(), 2), hole->rows);
}

std::string change_text(const SowingPlan& plan) {
  const bool needs_open = plan.layouts.empty() || plan.layouts.front().risk() == HoleClass::clogs;
  const std::string open = needs_open ? wider_text(plan, plan.change.kept_open) : "";
  const std::string wide = wider_text(plan, plan.change.rarely_clogs);
  if (open.empty() && wide.empty()) return "";
  return fmt::format(
      "The nearest change: {}{}{}, with a divider below it; or a precision tray, which shakes a single layer "
      "forward and which this table does not cover.",
      open, open.empty() || wide.empty() ? "" : ", ", wide);
}

std::string none_text(const SowingPlan& plan) {
  const NearestChange& change = plan.change;
  if (plan.too_uncertain > 0)
    return fmt::format(
        "None of these is known to give the rate: of the {} that should, each is unsure by more than {} %. The table "
        "knows such seeds too little at such holes and frequencies.",
        plan.too_uncertain, two_digit_percent(most_uncertain));
  if (change.most_share <= 0)
    return "None of these does: within the shaker's limits the table has no frequency for such seeds.";
  if (change.least_share > 1)
    return fmt::format(
        "None of these does: the least that any gives, one narrow hole for four rows, is {} times too much. {}",
        to_digits(change.least_share, 2), change_text(plan));
  if (change.most_share < 1)
    return fmt::format(
        "None of these does: the most that any gives, three wide holes a row, is {} % of what is needed. "
        "The nearest change: {} such holes a row, or a slower drill.",
        two_digit_percent(change.most_share), static_cast<int>(std::ceil(3 / change.most_share)));
  return "None of these does: between steps of 0.5 mm no width gives the rate.";
}

std::string risk_text(const SowingPlan& plan) {
  if (plan.layouts.empty()) return none_text(plan);
  const PlannedLayout& best = plan.layouts.front();
  std::string text =
      fmt::format("The best is {}, {} seeds wide. ", feed_text(best.feed), to_digits(best.width_over_largest, 2));
  if (best.risk() == HoleClass::rarely_clogs) text += "Such a hole rarely clogs.";
  if (best.risk() == HoleClass::kept_open)
    text +=
        "It clogs without vibration; vibration keeps it flowing. A straw or a cluster stops it sooner than a wider "
        "hole.";
  if (best.risk() == HoleClass::clogs)
    text =
        fmt::format("None of these stays clear of clogging: the best, {}, is {} seeds wide, and holes under {:g} clog.",
                    feed_text(best.feed), to_digits(best.width_over_largest, 2), kept_open_from);
  if (const auto one = widest_of_one_a_row(plan); one && *one < kept_open_from)
    text += fmt::format(" One hole a row would be at most {} seeds wide.", to_digits(*one, 2));
  const std::string change = best.risk() == HoleClass::rarely_clogs ? "" : change_text(plan);
  return change.empty() ? text : text + " " + change;
}

// The layouts.

/// The best of each feed and bed, in the order of the plan.
std::vector<const PlannedLayout*> shown_layouts(const SowingPlan& plan) {
  std::vector<const PlannedLayout*> shown;
  for (const PlannedLayout& layout : plan.layouts) {
    const auto alike = [&](const PlannedLayout* other) {
      return other->feed.holes == layout.feed.holes && other->feed.rows == layout.feed.rows &&
             other->depth_over_d == layout.depth_over_d;
    };
    if (std::ranges::none_of(shown, alike) && shown.size() < most_printed_rows) shown.push_back(&layout);
  }
  return shown;
}

std::string table_text(const SowingPlan& plan) {
  std::string text = fmt::format("{:>5} {:>5} {:>6} {:>5} {:>6} {:>6} {:>14} {:>10} {:>7}  {}\n", "holes", "hole",
                                 "hole /", "bed", "freq.", "ampl.", "speeds", "expect", "stood", "more");
  text += fmt::format("{:>5} {:>5} {:>6} {:>5} {:>6} {:>6} {:>14} {:>10} {:>7}  {}\n", ":rows", "mm", "seed", "mm",
                      "Hz", "mm", "km/h", "%", "still %", "by");
  for (const PlannedLayout* layout : shown_layouts(plan)) {
    const FactorRange expected = expected_range(layout->error);
    text += fmt::format("{:>5} {:>5.1f} {:>6.2f} {:>5.1f} {:>6.2f} {:>6.1f} {:>14} {:>10} {:>7}  {}\n",
                        fmt::format("{}:{}", layout->feed.holes, layout->feed.rows), layout->width / millimetre,
                        layout->width_over_largest, layout->depth_over_d * plan.task.seed.diameter / millimetre,
                        layout->frequency, layout->amplitude / millimetre,
                        fmt::format("{} to {}{}", speed_text(layout->speeds.least), speed_text(layout->speeds.most),
                                    layout->reaches_working_speeds() ? "*" : " "),
                        fmt::format("{:.0f} to {:.0f}", 100 * expected.low, 100 * expected.high),
                        two_digit_percent(layout->estimate.stood_still), layout->more_by_faster ? "faster" : "slower");
  }
  text += '\n';
  if (std::ranges::none_of(plan.layouts, &PlannedLayout::reaches_working_speeds))
    text += wrapped(fmt::format(
                "No layout keeps the sowing rate from {} to {} km/h by frequency alone: set the rate by the holes' "
                "width, or a slide over them.",
                speed_text(working_speeds.least), speed_text(working_speeds.most))) +
            '\n';
  text += wrapped(
      fmt::format("{} the rate{}. The table shows the best for each number of holes and depth of bed, the best first.",
                  plan.layouts.size() == 1 ? "One layout gives" : fmt::format("{} layouts give", plan.layouts.size()),
                  plan.too_uncertain > 0 ? fmt::format("; {} more are left out, as they are unsure by more than {} %",
                                                       plan.too_uncertain, two_digit_percent(most_uncertain))
                                         : ""));
  const auto line = [&text](std::string_view column, const std::string& meaning) {
    text += wrapped_beside(fmt::format("  {:<12}", column), meaning);
  };
  line("speeds", fmt::format("driving speeds at which frequency alone gives the rate; *: all of {} to {} km/h",
                             speed_text(working_speeds.least), speed_text(working_speeds.most)));
  line("expect", "range of the true rate until you weigh (95 %), in % of the planned rate");
  line("stood still", fmt::format("share of the simulated holes that once let nothing through for {} s{}",
                                  to_digits(long_pause * unit_of_time(plan), 2),
                                  plan.task.seed.has_larger() ? "; of the mean seed" : ""));
  line("more by", "whether faster or slower shaking sows more");
  return text;
}

// How far to trust it.

/// What is said of the best layout.
std::string certainty_text(const SowingPlan& plan) {
  const PlannedLayout& best = plan.layouts.front();
  const double rate = plan.task.row_mass_rate() * best.feed.rows / best.feed.holes;
  return fmt::format(
      "How sure: a hole of the best layout is to give {} g/s. Expect {} until you weigh (95 %); of it {}. {} The "
      "simulated holes like it were watched for {} s in all, so clogs that are rarer were not seen. ",
      to_digits(rate / gram, 2), range_text(rate, expected_range(best.error)), parts_text(best.error),
      model_text(best.error), to_digits(best.estimate.watched * unit_of_time(plan), 2));
}

/// What the table leaves out of a mixture; empty of one crop.
std::string mixture_doubt(const PlanSource& source) {
  if (source.lots.size() < 2) return "";
  return "Segregation is not in the table: it knows seeds of one kind, and the mixture is looked up as seeds of its "
         "mean "
         "volume, mass and shape. In a shaken bed small and heavy seeds sink and leave first, so what each crop gives "
         "drifts while the tray empties; nothing of that is in the range. Sort what you catch, when the tray is full "
         "and when it is nearly empty, and weigh each crop. How many seeds wide a hole is said to be, and how it "
         "clogs, goes "
         "by the largest crop.";
}

std::string contact_text(const PlanSource& source) {
  if (!source.contact) return "The crop names no contact model, so what its own friction does is not in it.";
  const PlannedContact& contact = *source.contact;
  return fmt::format(
      "For the crop's own contact (friction {:.2g}, on the tray {:.2g}, rolling {:.2g}, restitution {:.2g}) the rates "
      "are taken {} times, by runs with other contacts{}.",
      contact.seed.friction, contact.seed.wall_friction, contact.seed.rolling_friction, contact.seed.restitution,
      to_digits(source.plan.table_times, 3), contact.is_beyond ? ": the nearest of them, as it lies beyond them" : "");
}

std::string trust_text(const PlanSource& source) {
  const SowingPlan& plan = source.plan;
  return (plan.layouts.empty() ? "How sure: " : certainty_text(plan)) +
         fmt::format(
             "Nothing of this was ever measured. It is simulated: one round hole in a level tray that is shaken along "
             "its floor by {:g} seeds to each side, friction {:g} ({:g} on the tray), restitution {:g}, dry seeds of "
             "one size, without straw or dust. {} Even drill charts miss the real rate by 25 to 50 % (MSU P3112): "
             "weigh "
             "what comes "
             "in a minute before sowing, and ask again with --layout and --weighed.",
             plan.amplitude_over_d, table_model.friction, table_model.wall_friction, table_model.restitution,
             contact_text(source));
}

// The seeder.

/// A length as a seeder has it.
std::string in_millimetres(double length) {
  return fmt::format("\"{:.6g} mm\"", length / millimetre);
}

/// A lot: the crop by name, or written out where its seeds were made heavier or lighter.
std::string lot_text(const PlannedLot& planned, const std::string& name) {
  const bool is_file = has_extension(planned.crop, ".toml");
  const auto whole_path = [](const std::string& file) {
    return std::filesystem::absolute(file).lexically_normal().string();
  };
  const std::string crop = is_file ? whole_path(planned.crop) : planned.crop;
  const SeedLot& lot = planned.sown.lot;
  std::string text = fmt::format("[seeds.{}]\n", name);
  if (!planned.crop_mass) return text + fmt::format("crop = {}\n", toml_text({crop}));
  text += fmt::format("mass = \"{:.6g} mg\"\n", lot.mass / milligram);
  if (lot.contact.is_known())
    text += fmt::format("contact = {}\n", toml_text({is_file ? whole_path(lot.contact.file) : lot.contact.name}));
  if (lot.shape == Shape::ball)
    return text + fmt::format("shape = \"ball\"\ndiameter = {}\n", in_millimetres(lot.diameter));
  text += "shape = \"discs\"\ndiscs = [\n";
  for (const ClumpDisc& disc : lot.discs)
    text += fmt::format("  {{ x = {}, y = {}, z = {}, diameter = {} }},\n", in_millimetres(disc.x),
                        in_millimetres(disc.y), in_millimetres(disc.z), in_millimetres(2 * disc.radius));
  return text + "]\n";
}

std::string lots_text(const PlanSource& source) {
  if (source.lots.size() == 1) return lot_text(source.lots.front(), "seed");
  std::string text;
  for (std::size_t i = 0; i < source.lots.size(); ++i)
    text += fmt::format("{}number_fraction = \"{:.9g} %\"\n{}", lot_text(source.lots[i], fmt::format("seed-{}", i + 1)),
                        100 * source.lots[i].sown.lot.number_fraction, i + 1 < source.lots.size() ? "\n" : "");
  return text;
}

Columns<PlannedLot> lot_columns() {
  using R = const PlannedLot&;
  return {text_column<PlannedLot>("crop", "as it was asked for", [](R r) { return r.crop; }),
          quantity_column<PlannedLot>("rate_kg_per_ha", Unit{"kg/ha", kilogram_per_hectare}, "to be sown",
                                      [](R r) { return r.sown.sowing_rate; }),
          quantity_column<PlannedLot>("seeds_per_m2", Unit{"1/m2", 1}, "to be sown",
                                      [](R r) { return r.sown.seeds_per_area(); }),
          quantity_column<PlannedLot>("number_percent", percent, "of all seeds that are sown",
                                      [](R r) { return r.sown.lot.number_fraction; })};
}

/// Which rows the layout's holes feed.
std::string drill_text(const RowPace& pace, const HolesForRows& feed) {
  std::string text = fmt::format("\n[drill]\nrow_spacing = {}\nspeed = \"{:.6g} km/h\"\n",
                                 in_millimetres(pace.row_spacing), pace.speed / kilometre_per_hour);
  if (feed.holes == 1) return text + fmt::format("rows_per_hole = {}\n", feed.rows);
  std::string rows = "1";
  for (int hole = 1; hole < feed.holes; ++hole) rows += ", 1";
  return text + fmt::format("hole_to_row = [{}]\n", rows);
}

// A tray that was weighed.

using SettingRow = CorrectedSetting;

Columns<SettingRow> setting_columns() {
  using R = const SettingRow&;
  return {
      quantity_column<SettingRow>("frequency_Hz", hertz, "to set", [](R r) { return r.frequency; }),
      quantity_column<SettingRow>("predicted_g_per_s", grams_per_second, "of all holes, by the table alone",
                                  [](R r) { return r.predicted; }),
      quantity_column<SettingRow>("low_g_per_s", grams_per_second,
                                  "lower end of the range that holds the true rate in 95 % of cases, after weighing",
                                  [](R r) { return r.low; }),
      quantity_column<SettingRow>("high_g_per_s", grams_per_second, "upper end", [](R r) { return r.high; }),
      text_column<SettingRow>("more_by", "faster or slower: which shaking sows more",
                              [](R r) { return std::string(r.more_by_faster ? "faster" : "slower"); }),
  };
}

Columns<WeighedRow> weighed_columns() {
  using R = const WeighedRow&;
  return {
      quantity_column<WeighedRow>("frequency_Hz", hertz, "at which it was weighed",
                                  [](R r) { return r.weighed.tray.frequency; }),
      quantity_column<WeighedRow>("weighed_g_per_s", grams_per_second, "of all holes",
                                  [](R r) { return r.weighed.mass_rate; }),
      quantity_column<WeighedRow>("predicted_g_per_s", grams_per_second, "by the table alone",
                                  [](R r) { return r.predicted; }),
      quantity_column<WeighedRow>(
          "likely_percent", percent,
          "how likely a rate so far off, or further, is by the other rows and the model's error; "
          "under 1 % it contradicts them",
          [](R r) { return r.surprise; }),
      quantity_column<WeighedRow>(
          "repeats_scatter_percent", percent,
          "standard deviation of its repeats over their mean; 0 of one. Above 10 % they contradict each other",
          [](R r) { return r.weighed.repeats_scatter; }),
  };
}

std::string weighed_row_text(const WeighedRow& row, bool is_only) {
  const WeighedTray& weighed = row.weighed;
  std::string text = fmt::format("weighed {} g/s at {:.4g} Hz, {} times the {} g/s of the table",
                                 to_digits(weighed.mass_rate / gram, 3), weighed.tray.frequency,
                                 to_digits(weighed.mass_rate / row.predicted, 3), to_digits(row.predicted / gram, 3));
  if (row.surprise < surprising)
    text += fmt::format(": this contradicts {} (so far off in {} % of cases): weigh again, and look at the unit",
                        is_only ? "what the model errs by" : "the other rows and what the model errs by",
                        two_digit_percent(row.surprise));
  if (weighed.repeats_scatter > contradicting_scatter)
    text += fmt::format(": its repeats scatter by {} %, so they contradict each other: look at each, and weigh again",
                        two_digit_percent(weighed.repeats_scatter));
  return text;
}

/// Of seeds so much heavier or lighter than the crop's that a unit may be wrong; else empty.
std::string mass_doubt(const PlannedLot& lot) {
  constexpr double far = 2;
  if (!lot.crop_mass) return "";
  const double times = mean_mass(lot.sown.lot) / *lot.crop_mass;
  if (times <= far && times >= 1 / far) return "";
  return fmt::format(" (doubtful: {} times as heavy as the crop's own, of {} g a thousand; look at the unit)",
                     to_digits(times, 2), to_digits(*lot.crop_mass * 1e6, 3));
}

}  // namespace

std::vector<std::string> need_sentences(const PlanSource& source) {
  const SowingTask& task = source.plan.task;
  if (source.lots.size() == 1)
    return {fmt::format("{}: {}{}", source.lots.front().crop, seed_text(task.seed), mass_doubt(source.lots.front())),
            rate_text(source)};
  std::vector<std::string> sentences;
  for (const PlannedLot& lot : source.lots)
    sentences.push_back(fmt::format("{}: {}{}; {}", lot.crop, seed_text(seed_of(lot)), mass_doubt(lot),
                                    per_area_text(lot.sown.sowing_rate, lot.sown.seeds_per_area())));
  sentences.push_back(fmt::format("together {}, looked up as {}", rate_text(source), seed_text(task.seed)));
  return sentences;
}

std::string risk_sentence(const SowingPlan& plan) {
  return risk_text(plan);
}

std::vector<std::string> trust_sentences(const PlanSource& source) {
  std::vector<std::string> sentences;
  if (const std::string doubt = mixture_doubt(source); !doubt.empty()) sentences.push_back(doubt);
  sentences.push_back(trust_text(source));
  return sentences;
}

std::vector<std::string> weighed_sentences(const PlanSource& source, int rows, const WeighedPlan& plan) {
  const SowingTask& task = source.plan.task;
  std::vector<std::string> sentences = {fmt::format(
      "{} row{} of {} kg/ha, every {} cm at {} km/h, need{} {} g/s of this tray", rows, rows == 1 ? "" : "s",
      to_digits(task.sowing_rate / kilogram_per_hectare, 3), to_digits(task.pace.row_spacing * 100, 3),
      speed_text(task.pace.speed), rows == 1 ? "s" : "", to_digits(plan.needed / gram, 3))};
  const auto add = [&](std::string sentence) { sentences.push_back(std::move(sentence)); };
  for (const WeighedRow& row : plan.rows) add(weighed_row_text(row, plan.rows.size() == 1));
  const auto spread = [](const FactorRange& range) {
    return fmt::format("{} to {} %", two_digit_percent(range.low), two_digit_percent(range.high));
  };
  add(fmt::format(
      "So the tray gives {} times what the table says, by all that is known. The rate at a frequency far from these "
      "was known to {} of it before weighing, and is known to {} now.",
      to_digits(plan.factor, 3), spread(plan.before), spread(plan.after)));
  if (plan.settings.empty())
    add(fmt::format(
        "No frequency of this tray gives {} g/s: it can give {} to {} g/s. Take {} hole, or another number of "
        "rows.",
        to_digits(plan.needed / gram, 3), to_digits(plan.reach.least / gram, 3), to_digits(plan.reach.most / gram, 3),
        plan.reach.most < plan.needed ? "a wider" : "a narrower"));
  for (const CorrectedSetting& setting : plan.settings)
    add(fmt::format("set {:.3g} Hz: expect {} to {} g/s (95 %); {} shaking sows more", setting.frequency,
                    to_digits(setting.low / gram, 3), to_digits(setting.high / gram, 3),
                    setting.more_by_faster ? "faster" : "slower"));
  if (const double width = plan.hole_width / task.seed.largest_diameter(); hole_class(width) == HoleClass::clogs)
    add(fmt::format("Its holes are {} seeds wide, and holes under {:g} clog: this is no tray to sow with.",
                    to_digits(width, 2), kept_open_from));
  if (!plan.settings.empty()) add("Weigh at the frequency that you set: a setting near a weighed one is known best.");
  if (const std::string doubt = mixture_doubt(source); !doubt.empty()) add(doubt);
  return sentences;
}

std::string weighed_text(const PlanSource& source, int rows, const WeighedPlan& plan) {
  std::string text;
  for (const std::string& sentence : weighed_sentences(source, rows, plan)) text += wrapped(sentence);
  return text;
}

std::vector<OutputFile> weighed_files(const PlanSource& source, const WeighedPlan& plan, CsvFormat format) {
  Csv<SettingRow> settings(setting_columns(), format);
  for (const CorrectedSetting& setting : plan.settings) settings.add(setting);
  Csv<WeighedRow> weighed(weighed_columns(), format);
  for (const WeighedRow& row : plan.rows) weighed.add(row);
  return {{"settings.csv", settings.text()},
          {"weighed.csv", weighed.text()},
          {"lots.csv", csv_of(lot_columns(), source.lots, format)}};
}

std::string plan_text(const PlanSource& source) {
  const SowingPlan& plan = source.plan;
  std::string text = need_text(source) + '\n' + wrapped(risk_text(plan)) + '\n';
  if (!plan.layouts.empty()) text += table_text(plan) + '\n';
  for (const std::string& sentence : trust_sentences(source)) text += wrapped(sentence);
  return text;
}

std::string plan_csv(const SowingPlan& plan, CsvFormat format) {
  Csv<PlannedLayoutRow> csv(plan_columns(), format);
  for (std::size_t i = 0; i < plan.layouts.size(); ++i) csv.add({&plan, &plan.layouts[i], i + 1});
  return csv.text();
}

std::string planned_seeder(const PlanSource& source) {
  const SowingPlan& plan = source.plan;
  if (plan.layouts.empty()) throw std::invalid_argument("a plan without a layout has no seeder");
  const PlannedLayout& best = plan.layouts.front();
  const double d = plan.task.seed.diameter, time = unit_of_time(plan);
  const double section = table_model.section * table_model.section;
  const double count = best.depth_over_d * table_model.packing * section / (std::numbers::pi / 6);
  const HolesForRows& feed = best.feed;
  std::string text = fmt::format(
      "# The best layout of a plan, {}, in an endless tray. It should give {} seeds/s;\n"
      "# nothing of it was ever measured. {}\n"
      "title = {}\nspace = \"3d\"\n\n",
      feed_text(feed), to_digits(plan.task.row_seed_rate() * feed.rows, 3),
      source.contact ? "Contacts are the crops' own, as soft as in the table that the plan was looked up in."
                     : "Contacts are those of the table that the plan was looked up in.",
      toml_text(
          {fmt::format("{}, {} kg/ha", feed_text(feed), to_digits(plan.task.sowing_rate / kilogram_per_hectare, 3))}));
  text += lots_text(source);
  if (source.contact)
    text += fmt::format("\n[contact]\nshell_compression = {:g}\n", table_model.shell_compression);
  else
    text += fmt::format(
        "\n[contact]\nlaw = \"elastic-shell\"\nshell_compression = {:g}\nfriction = {:g}\nrestitution = {:g}\n"
        "friction_model = \"spring\"\nwall = {{ friction = {:g}, restitution = {:g} }}\n",
        table_model.shell_compression, table_model.friction, table_model.restitution, table_model.wall_friction,
        table_model.restitution);
  text += fmt::format(
      "\n[tray]\nlength = {3}\ndepth = {0}\nheight = {1}\nsides = \"periodic\"\nfront_and_back = \"periodic\"\n"
      "fill = {{ count = {2:.0f}, packing = \"poured\", keep = true }}\n",
      in_millimetres(table_model.section * d), in_millimetres(table_model.height * d), count * feed.holes,
      in_millimetres(table_model.section * d * feed.holes));
  text += fmt::format("\n[tray.holes]\nshape = \"round\"\ncount = {}\nwidth = {}\n", feed.holes,
                      in_millimetres(best.width));
  text += fmt::format(
      "\n[tray.motion]\nkind = \"harmonic\"\ndirection = \"0 degree\"\namplitude = {}\nfrequency = \"{:.6g} Hz\"\n"
      "ramp = \"{:.3g} s\"\n",
      in_millimetres(best.amplitude), best.frequency, 5 * time);
  text += drill_text(plan.task.pace, feed);
  return text + fmt::format("\n[run]\nduration = \"{:.3g} s\"\nmeasure_from = \"{:.3g} s\"\n", 100 * time, 14 * time);
}

std::vector<FileText> plan_file_texts() {
  return {file_text("plan.csv", "one row per layout that gives the rate, the best first", plan_columns()),
          file_text("lots.csv", "one row per crop that is sown", lot_columns()),
          {"seeder.toml", "the best layout in an endless tray, to simulate and to weigh; none without a layout", {}},
          file_text("settings.csv", "with --layout: the frequencies that give what is needed", setting_columns()),
          file_text("weighed.csv", "with --layout: one row per weighing", weighed_columns())};
}

std::vector<OutputFile> plan_files(const PlanSource& source, CsvFormat format) {
  std::vector<OutputFile> files = {{"plan.csv", plan_csv(source.plan, format)},
                                   {"lots.csv", csv_of(lot_columns(), source.lots, format)}};
  if (!source.plan.layouts.empty()) files.push_back({"seeder.toml", planned_seeder(source)});
  return files;
}

}  // namespace vibrosow
