#include "report/accuracy_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "accuracy/accuracy_doubts.hpp"
#include "report/accuracy_page.hpp"
#include "report/answer_doubts.hpp"
#include "report/columns.hpp"
#include "report/json_keys.hpp"
#include "report/kept_page.hpp"
#include "report/number_text.hpp"
#include "report/page.hpp"
#include "report/terminal_text.hpp"
#include "scene/integrator_names.hpp"
#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

using R = const AccuracyRow&;
using Value = std::optional<double>;

/// None where a part of a setting is absent, which is 0.
Value present(double value) {
  return value > 0 ? Value(value) : Value();
}

/// The first columns of every file; `setting_of` gives a row's setting.
template <class Row, class SettingOf>
Columns<Row> setting_columns(SettingOf setting_of) {
  return {
      text_column<Row>("integrator", "scheme", [=](const Row& r) { return integrator_name(setting_of(r).integrator); }),
      quantity_column<Row>("dt_s", seconds, "time step", [=](const Row& r) { return setting_of(r).dt; }),
      quantity_column<Row>("steps_per_contact", plain, "contact duration over the time step",
                           [=](const Row& r) { return setting_of(r).steps_per_contact; }),
      quantity_column<Row>("shell_compression", plain, "eps / r; empty where the law has no shell",
                           [=](const Row& r) { return present(setting_of(r).shell_compression); }),
      quantity_column<Row>("youngs_modulus_MPa", megapascals, "empty where the law has a shell",
                           [=](const Row& r) { return present(setting_of(r).youngs_modulus); }),
      quantity_column<Row>("slip_speed_mm_per_s", millimetres_per_second,
                           "slip speed of friction; empty where friction has none, as a spring has",
                           [=](const Row& r) { return present(setting_of(r).slip_speed); })};
}

Columns<AccuracyRow> row_setting_columns() {
  return setting_columns<AccuracyRow>([](R r) -> const AccuracySetting& { return r.setting; });
}

Columns<AccuracyRow> accuracy_columns() {
  const Metric& rate = metric_named("rate_g_per_s");
  const Unit unit{rate.unit, rate.unit_size};
  Columns<AccuracyRow> columns = row_setting_columns();
  append(columns,
         {text_column<AccuracyRow>("replicates", "runs that finished, of which the figures are",
                                   [](R r) { return r.replicates; }),
          quantity_column<AccuracyRow>(std::string(rate.name), unit, std::string(rate.description),
                                       [](R r) { return r.mass_rate ? Value(r.mass_rate->mean) : Value(); }),
          quantity_column<AccuracyRow>("rate_ci95", unit, "half width of its 95 % interval",
                                       [](R r) { return r.mass_rate ? r.mass_rate->half_width_95 : Value(); }),
          quantity_column<AccuracyRow>("error_percent", Unit{"%", 1}, "difference of the rate from the reference's",
                                       [](R r) { return r.error_percent; }),
          quantity_column<AccuracyRow>("error_ci95", Unit{"%", 1}, "half width of its 95 % interval, of both rates",
                                       [](R r) { return r.error_ci95; }),
          quantity_column<AccuracyRow>("fitted_error_percent", Unit{"%", 1},
                                       "error against the limit of step 0 and rigid grains, by the main effects of all "
                                       "runs",
                                       [](R r) { return r.fitted ? Value(r.fitted->percent) : Value(); }),
          quantity_column<AccuracyRow>("fitted_error_band95", Unit{"%", 1},
                                       "half width of its 95 % band, for all settings at once",
                                       [](R r) { return r.fitted ? Value(r.fitted->band) : Value(); }),
          quantity_column<AccuracyRow>("grain_steps", plain, "grains times steps, mean of a run",
                                       [](R r) { return r.mass_rate ? Value(r.grain_steps) : Value(); }),
          quantity_column<AccuracyRow>("cost_ratio", plain,
                                       "grain-steps times force evaluations a step, over the reference's",
                                       [](R r) { return r.cost_ratio; }),
          text_column<AccuracyRow>("on_front",
                                   "yes where it errs less, beyond chance, than every cheaper setting so marked",
                                   [](R r) -> std::string {
                                     if (!r.mass_rate) return "";
                                     return r.on_front ? "yes" : "no";
                                   })});
  return columns;
}

/// A run and its setting.
struct RunRow {
  const AccuracyRun* run;
  const AccuracySetting* setting;
};

Columns<RunRow> run_columns() {
  using Row = const RunRow&;
  Columns<RunRow> columns = setting_columns<RunRow>([](Row r) -> const AccuracySetting& { return *r.setting; });
  append(columns,
         {quantity_column<RunRow>("window", plain, "length of the measuring window over the seeder's",
                                  [](Row r) { return r.run->window; }),
          text_column<RunRow>("random_seed", "of the run", [](Row r) { return r.run->random_seed; }),
          quantity_column<RunRow>("rate_g_per_s", grams_per_second, "mass flow through all holes in the window",
                                  [](Row r) { return r.run->mass_rate; }),
          quantity_column<RunRow>("grain_steps", plain, "grains times steps",
                                  [](Row r) { return present(r.run->grain_steps); }),
          text_column<RunRow>("reason", "why there is no rate", [](Row r) { return r.run->refused; })});
  return columns;
}

std::string softness_text(const AccuracySetting& setting) {
  return setting.shell_compression > 0 ? fmt::format("eps/r {:.3g}", setting.shell_compression)
                                       : fmt::format("E {:.4g} MPa", setting.youngs_modulus / megapascal);
}

ErrorRow row_of(const MainEffect& effect) {
  const auto row = [&](const char* source, const std::string& from, const std::string& to) {
    return ErrorRow{source, from, to, effect.error.percent, effect.error.band};
  };
  const auto slip_speed = [](const AccuracySetting& s) {
    return fmt::format("{:.4g} mm/s", s.slip_speed / millimetre_per_second);
  };
  const auto steps = [](const AccuracySetting& s) { return fmt::format("{:.4g} a contact", s.steps_per_contact); };
  switch (effect.source) {
    case ErrorSource::softness:
      return row("softness", softness_text(effect.from), softness_text(effect.to));
    case ErrorSource::slip_speed:
      return row("slip speed", slip_speed(effect.from), slip_speed(effect.to));
    case ErrorSource::step:
      return row(fmt::format("step, {}", integrator_name(effect.from.integrator)).c_str(), steps(effect.from),
                 steps(effect.to));
    case ErrorSource::scheme:
      break;
  }
  return row(fmt::format("scheme, {:.4g} steps", effect.to.steps_per_contact).c_str(),
             integrator_name(effect.from.integrator), integrator_name(effect.to.integrator));
}

Columns<ErrorRow> error_columns() {
  using Row = const ErrorRow&;
  return {
      text_column<ErrorRow>("source",
                            "what was varied; chance: standard deviation of one run; depth: 2D in the place of the "
                            "tray, at the seeder's own setting",
                            [](Row r) { return r.source; }),
      text_column<ErrorRow>("from", "finest level", [](Row r) { return r.from; }),
      text_column<ErrorRow>("to", "coarsest level", [](Row r) { return r.to; }),
      quantity_column<ErrorRow>(
          "rate_change_percent", Unit{"%", 1},
          "what that does to the rate, of the limit's, by the main effects of all runs; of depth: of the rate in 3D",
          [](Row r) { return r.percent; }),
      quantity_column<ErrorRow>("rate_change_ci95", Unit{"%", 1}, "half width of its 95 % interval",
                                [](Row r) { return r.band; })};
}

bool timed(const AccuracyRow& row) {
  return row.mass_rate && row.cpu_time > 0;
}

/// `reference`: CPU time of the reference, s.
Columns<AccuracyRow> timing_columns(double reference) {
  Columns<AccuracyRow> columns = row_setting_columns();
  append(columns,
         {quantity_column<AccuracyRow>("cpu_s", seconds, "CPU time of a run on this machine, mean of those made now",
                                       [](R r) { return timed(r) ? Value(r.cpu_time) : Value(); }),
          quantity_column<AccuracyRow>("grain_steps_per_s", per_second, "grains times steps in a second of it",
                                       [](R r) { return timed(r) ? Value(r.grain_steps / r.cpu_time) : Value(); }),
          quantity_column<AccuracyRow>("cpu_ratio", plain, "CPU time over the reference's", [reference](R r) {
            return timed(r) && reference > 0 ? Value(r.cpu_time / reference) : Value();
          })});
  return columns;
}

struct CommandTiming {
  AccuracyTiming command;
  double run_time = 0, grain_steps = 0;
  std::vector<Value> settings{};  // s
  std::string sentence{};
};

JsonKeys<CommandTiming> timing_keys() {
  using T = const CommandTiming&;
  return {
      {"wall_s", "s", "wall time of the command", [](T t) { return t.command.wall_time; }},
      {"jobs", "", "runs in parallel", [](T t) { return t.command.jobs; }},
      {"run_cpu_s", "s", "CPU times of the runs that it made, summed", [](T t) { return t.run_time; }},
      {"grain_steps", "", "grains times steps of these, summed", [](T t) { return t.grain_steps; }},
      {"grain_steps_per_s", "1/s", "these in a second of the command's wall time",
       [](T t) { return t.command.wall_time > 0 ? t.grain_steps / t.command.wall_time : 0; }},
      {"setting_cpu_s", "s", "of each setting the CPU time of a run, as in accuracy_timing.csv; null without a rate",
       [](T t) {
         auto times = nlohmann::ordered_json::array();
         for (const Value& time : t.settings) times.push_back(time ? nlohmann::ordered_json(*time) : nullptr);
         return times;
       }},
      {"cost", "", "of a promise, in words", [](T t) { return t.sentence; }}};
}

/// "-0.4 +- 1.6 %".
std::string error_text(double percent, const Value& band) {
  return band ? fmt::format("{:+.2f} +- {:.2f} %", percent, *band) : fmt::format("{:+.2f} %", percent);
}

/// Against the limit, or without a fit against the reference.
std::string error_text(const AccuracyRow& row, bool reference) {
  if (row.fitted) return error_text(row.fitted->percent, row.fitted->band);
  if (reference) return "reference";
  return row.error_percent ? error_text(*row.error_percent, row.error_ci95) : "";
}

std::string setting_columns_text(std::size_t number, const AccuracySetting& setting) {
  const double softness = setting.youngs_modulus > 0 ? setting.youngs_modulus / megapascal : setting.shell_compression;
  const std::string slip_speed =
      setting.slip_speed > 0 ? fmt::format("{:>9.4g} ", setting.slip_speed / millimetre_per_second) : "";
  return fmt::format("{:>2} {:>5.4g} {:>9.4g} {}{:>9.3g} ", number, setting.steps_per_contact, softness, slip_speed,
                     setting.dt);
}

/// A line of the table for a terminal.
std::string row_text(std::size_t number, const AccuracyRow& row, bool reference) {
  const std::string setting = setting_columns_text(number, row.setting);
  if (!row.mass_rate) return wrapped_beside(setting, row.refused);
  const std::string cost = row.cost_ratio ? fmt::format("{:.3g}", *row.cost_ratio) : "";
  return fmt::format("{}{:>10.5g} {:>19} {:>8}{}\n", setting, row.mass_rate->mean / gram, error_text(row, reference),
                     cost, row.on_front ? " *" : "");
}

std::string rate_text(const MeanWithInterval& rate) {
  return interval_text(rate.mean / gram, *rate.half_width_95 / gram);
}

/// For a terminal.
std::string errors_text(const AccuracyResult& result) {
  std::string text;
  if (result.fit) {
    const MeanWithInterval& limit = result.fit->limit();
    text += wrapped(
        fmt::format("Errors by source, 95 %, of the limit of step 0 and rigid grains, {} g/s:", rate_text(limit)));
  }
  for (const ErrorRow& row : error_rows(result))
    text += fmt::format("  {:<21} {:>15} {} {:<15} {}\n", row.source, row.from, row.to.empty() ? "  " : "to", row.to,
                        row.band ? error_text(row.percent, row.band) : fmt::format("{:.2f} %", row.percent));
  if (result.depth)
    text += wrapped(fmt::format("The tray sows {} g/s in 2D, {} g/s in 3D.", rate_text(result.depth->plane),
                                rate_text(result.depth->space)));
  return text;
}

std::string share(double percent) {
  return number_text(percent) + " %";
}

std::string goal_text(const PromiseGoal& goal) {
  return goal.within_percent ? fmt::format("within {:g} %", *goal.within_percent)
                             : fmt::format("for {:g} s of CPU time", *goal.cpu_time);
}

std::string offer_text(const Promise& promise, const Offer& offer) {
  const std::string window = offer.window == 1 ? "" : fmt::format(" over {:g} times the window", offer.window);
  return fmt::format("{} {}{} of {}: it errs by {} at most{}, the mean of the runs by {} of chance, together {}",
                     offer.replicates, offer.replicates == 1 ? "run" : "runs", window,
                     setting_text(promise.settings[offer.setting]), share(offer.bias.bound()),
                     fmt::format(" ({:+.2f} +- {:.2f} %)", offer.bias.percent, offer.bias.band),
                     share(offer.half_width_percent), share(offer.error_bound()));
}

std::string cost_text(const Promise& promise) {
  const Offer& offer = *promise.offer;
  if (const auto kept =
          std::ranges::count_if(promise.runs, [](const AccuracyRun& run) { return run.mass_rate && !run.made(); }))
    return fmt::format("{} of the {} runs were kept from before; the others took {:.3g} s of CPU time.", kept,
                       promise.runs.size(), promise.pilot_cpu_time + promise.answer_cpu_time);
  std::string text = fmt::format(
      "Cost: {} pilots {:.3g} s of CPU time, {} more {} {:.3g} s (predicted {:.3g} s). Another layout with this "
      "setting: "
      "{:.3g} s",
      promise.pilots, promise.pilot_cpu_time, offer.to_run, offer.to_run == 1 ? "run" : "runs", promise.answer_cpu_time,
      offer.cpu_time_to_run(), offer.cpu_time);
  if (promise.finest && promise.finest->setting != offer.setting)
    text += fmt::format("; with the finest: {} runs, {:.3g} s", promise.finest->replicates, promise.finest->cpu_time);
  return text + ".";
}

struct PromiseSource {
  const Scene* scene;
  const Promise* promise;
  const PromiseGoal* goal;
  const Offer* offer() const { return promise->offer ? &*promise->offer : nullptr; }
};

/// Null without an offer.
template <class Get>
auto of_offer(Get get) {
  return [get](const PromiseSource& s) -> nlohmann::ordered_json {
    if (!s.offer()) return nullptr;
    return get(*s.promise, *s.offer());
  };
}

JsonKeys<PromiseSource> promise_keys() {
  using S = const PromiseSource&;
  using P = const Promise&;
  using O = const Offer&;
  using Json = nlohmann::ordered_json;
  const auto or_null = [](const Value& value) { return value ? Json(*value) : Json(nullptr); };
  const auto setting = [](P p, O o) -> const AccuracySetting& { return p.settings[o.setting]; };
  return {
      {"goal.within_percent", "%", "wanted error; null with a budget",
       [=](S s) { return or_null(s.goal->within_percent); }},
      {"goal.cpu_s", "s", "CPU time to be spent; null without a budget",
       [=](S s) { return or_null(s.goal->cpu_time); }},
      {"pilots", "", "runs made to choose by", [](S s) { return s.promise->pilots; }},
      {"refused", "", "why nothing is promised; empty where something is", [](S s) { return s.promise->refused; }},
      {"doubts", "", "what speaks against its runs, as in decision.json; of settings by their rows in accuracy.csv",
       [](S s) { return doubts_json(doubts_about(result_of(*s.promise), *s.scene), "setting"); }},
      {"integrator", "", "scheme chosen",
       of_offer([=](P p, O o) { return integrator_name(setting(p, o).integrator); })},
      {"steps_per_contact", "", "contact duration over the time step",
       of_offer([=](P p, O o) { return setting(p, o).steps_per_contact; })},
      {"dt_s", "s", "time step", of_offer([=](P p, O o) { return setting(p, o).dt; })},
      {"shell_compression", "", "eps / r; null where the law has no shell",
       of_offer([=](P p, O o) { return or_null(present(setting(p, o).shell_compression)); })},
      {"youngs_modulus_MPa", "MPa", "null where the law has a shell", of_offer([=](P p, O o) {
         const Value modulus = present(setting(p, o).youngs_modulus);
         return modulus ? Json(*modulus / megapascal) : Json(nullptr);
       })},
      {"slip_speed_mm_per_s", "mm/s", "slip speed of friction; null where friction has none", of_offer([=](P p, O o) {
         const Value speed = present(setting(p, o).slip_speed);
         return speed ? Json(*speed / millimetre_per_second) : Json(nullptr);
       })},
      {"window", "", "length of the measuring window over the seeder's", of_offer([](P, O o) { return o.window; })},
      {"replicates", "", "runs whose mean is the answer, pilots of this setting included",
       of_offer([](P, O o) { return o.replicates; })},
      {"rate_g_per_s", "g/s", "their mean rate; null where a run of it failed",
       [](S s) { return s.promise->mass_rate ? Json(s.promise->mass_rate->mean / gram) : Json(nullptr); }},
      {"bias_percent", "%", "error of the setting against the limit, fitted",
       of_offer([](P, O o) { return o.bias.percent; })},
      {"bias_bound_percent", "%", "what its size is below at 95 %, for all settings at once",
       of_offer([](P, O o) { return o.bias.bound(); })},
      {"half_width_percent", "%", "half width of the mean's 95 % interval",
       of_offer([](P, O o) { return o.half_width_percent; })},
      {"error_bound_percent", "%", "the sum of the two before: what is promised",
       of_offer([](P, O o) { return o.error_bound(); })}};
}

}  // namespace

std::string accuracy_csv(const AccuracyResult& result, CsvFormat format) {
  return csv_of(accuracy_columns(), result.rows, format);
}

std::string accuracy_runs_csv(const AccuracyResult& result, CsvFormat format) {
  Csv<RunRow> csv(run_columns(), format);
  for (const AccuracyRun& run : result.runs) csv.add({&run, &result.rows[run.setting].setting});
  return csv.text();
}

std::string accuracy_errors_csv(const AccuracyResult& result, CsvFormat format) {
  return csv_of(error_columns(), error_rows(result), format);
}

std::string accuracy_timing_csv(const AccuracyResult& result, CsvFormat format) {
  return csv_of(timing_columns(result.rows[result.reference].cpu_time), result.rows, format);
}

std::string accuracy_table(const AccuracyResult& result) {
  const AccuracySetting& first = result.rows.front().setting;
  std::string text =
      fmt::format(" # {:>5} {:>9} {}{:>9} {:>10} {:>19} {:>8}\n", "steps", first.youngs_modulus > 0 ? "E MPa" : "eps/r",
                  first.slip_speed > 0 ? "slip mm/s " : "", "dt s", "rate g/s", "error", "cost");
  std::string scheme;
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const AccuracyRow& row = result.rows[i];
    if (const std::string& name = integrator_name(row.setting.integrator); name != scheme)
      scheme = name, text += name + '\n';
    text += row_text(i + 1, row, i == result.reference);
  }
  return text + '\n' +
         wrapped(fmt::format("error: {}; cost: grain-steps times force evaluations a step, of the finest setting's; *: "
                             "errs less, beyond "
                             "chance, than all that cost less",
                             result.fit ? "of the rate against the limit, with a band for all settings at once"
                                        : "of the rate against the finest setting's")) +
         '\n' + errors_text(result);
}

std::string accuracy_sentence(const AccuracyResult& result) {
  const AccuracyRow& reference = result.rows[result.reference];
  const std::string finest = setting_text(reference.setting);
  if (!reference.mass_rate)
    return fmt::format("The finest setting ({}) has no result ({}), so there is nothing to compare with.", finest,
                       reference.refused);
  if (!reference.error_percent)
    return fmt::format("Nothing flows at the finest setting ({}), so there is nothing to compare with.", finest);
  if (!result.of_one_value.empty())
    return fmt::format("All runs have one {}, so what it errs by is not known: give two values or more.",
                       result.of_one_value);
  if (!result.fit) return "Too few runs to tell the errors apart: more replicates would.";
  if (!reference.fitted)
    return fmt::format("What the scheme of the finest setting ({}) errs by is not known: give it two numbers of steps.",
                       finest);
  std::string text = fmt::format("The finest setting ({}) is within {} of the limit (95 %).", finest,
                                 share(reference.fitted->bound()));
  if (const auto cheapest = cheapest_within(result, 1.0))
    return fmt::format("{} The cheapest setting shown to be within 1 % is {} (error {}, at {:.3g} of its cost).", text,
                       setting_text(result.rows[*cheapest].setting), error_text(result.rows[*cheapest], false),
                       result.rows[*cheapest].cost_ratio.value_or(1));
  return text + " None is shown to be within 1 %: more replicates would narrow the bands.";
}

std::string setting_text(const AccuracySetting& setting) {
  const std::string softness = setting.shell_compression > 0
                                   ? fmt::format("shell compression {:g}", setting.shell_compression)
                                   : fmt::format("Young's modulus {:g} MPa", setting.youngs_modulus / megapascal);
  const std::string slip_speed =
      setting.slip_speed > 0 ? fmt::format(", slip speed {:g} mm/s", setting.slip_speed / millimetre_per_second) : "";
  return fmt::format("{}, {:g} steps a contact, {}{}", integrator_name(setting.integrator), setting.steps_per_contact,
                     softness, slip_speed);
}

std::vector<ErrorRow> error_rows(const AccuracyResult& result) {
  std::vector<ErrorRow> rows;
  if (result.fit) {
    for (const MainEffect& effect : result.fit->effects()) rows.push_back(row_of(effect));
    rows.push_back({"chance of one run", "", "", result.fit->scatter_percent()});
  }
  if (result.depth) rows.push_back({"depth", "space", "plane", result.depth->error.percent, result.depth->error.band});
  return rows;
}

AccuracyResult result_of(const Promise& promise) {
  return accuracy_of(promise.settings, std::vector<std::string>(promise.settings.size()), promise.runs);
}

std::vector<std::string> promise_paragraphs(const Promise& promise, const PromiseGoal& goal) {
  if (!promise.offer) {
    std::string text = fmt::format("A rate {} cannot be promised: {}.", goal_text(goal), promise.refused);
    if (promise.least)
      text += fmt::format(" The most that as much time again would buy: {}.", offer_text(promise, *promise.least));
    return {text};
  }
  std::vector<std::string> all = {fmt::format("A rate {}: {}.", goal_text(goal), offer_text(promise, *promise.offer))};
  if (promise.mass_rate)
    all.push_back(fmt::format("The rate is {:.5g} g/s, at most {} from that of step 0 and rigid grains (95 %).",
                              promise.mass_rate->mean / gram, share(promise.offer->error_bound())));
  else
    all.push_back(fmt::format("There is no rate: {}.", promise.refused));
  return all;
}

std::string promise_cost(const Promise& promise) {
  if (promise.offer) return cost_text(promise);
  return fmt::format("Cost: {} pilots {:.3g} s of CPU time.", promise.pilots, promise.pilot_cpu_time);
}

std::string promise_text(const Scene& scene, const Promise& promise, const PromiseGoal& goal) {
  std::string text;
  for (const std::string& paragraph : promise_paragraphs(promise, goal)) text += wrapped(paragraph);
  text += doubts_paragraph(doubts_about(result_of(promise), scene), "setting", all_doubts);
  text += wrapped(promise_cost(promise));
  return text;
}

std::string promised_numerics(const Scene& scene, const Promise& promise, const PromiseGoal& goal) {
  AccuracySetting setting = promise.settings[promise.offer->setting];
  const Scene set = scene_with(scene, setting);
  std::string text = fmt::format("# A rate {}: the mean of {} runs errs by at most {} (95 %).\n[contact]\n",
                                 goal_text(goal), promise.offer->replicates, share(promise.offer->error_bound()));
  const auto in_megapascal = [](double modulus) { return fmt::format("\"{:.4g} MPa\"", modulus / megapascal); };
  const bool has_shell = setting.shell_compression > 0;
  if (has_shell)
    text += fmt::format("shell_compression = {:.4g}\n", set.contact.shell_compression);
  else
    text += fmt::format("youngs_modulus = {}\n", in_megapascal(set.contact.youngs_modulus));
  if (set.contact.wall_youngs_modulus)
    text += fmt::format("wall_youngs_modulus = {}\n", in_megapascal(*set.contact.wall_youngs_modulus));
  if (setting.slip_speed > 0)
    text += fmt::format("slip_speed = \"{:.4g} mm/s\"\n", setting.slip_speed / millimetre_per_second);
  text += fmt::format("[numerics]\nintegrator = \"{}\"\nsteps_per_contact = {:.4g}\n",
                      integrator_name(setting.integrator), setting.steps_per_contact);
  for (const SeedLot& lot : set.lots) {  // those with a softness of their own
    if (has_shell && lot.shell_compression)
      text += fmt::format("[seeds.{}]\nshell_compression = {:.4g}\n", lot.name, *lot.shell_compression);
    if (!has_shell && lot.youngs_modulus)
      text += fmt::format("[seeds.{}]\nyoungs_modulus = {}\n", lot.name, in_megapascal(*lot.youngs_modulus));
  }
  return text;
}

std::vector<FileText> accuracy_file_texts() {
  return {
      file_text("accuracy.csv", "one row per setting; one that gave no rate has its cells empty", accuracy_columns()),
      file_text("accuracy_runs.csv", "one row per run", run_columns()),
      file_text("accuracy_errors.csv",
                "one row per part of a setting that was varied, and one of chance; none where the runs were too few",
                error_columns()),
      file_text("accuracy_timing.csv", "one row per setting: what it took on this machine", timing_columns(0)),
      file_text(page_times_name, "what the command took on this machine", timing_keys()),
      page_data_text(),
      accuracy_page_text(),
      doubts_file_text("setting"),
      file_text("promise.json", "with --within or --budget: what was chosen and what it may err by", promise_keys()),
      {"numerics.toml", "with --within or --budget: the keys of a seeder that set it so", {}}};
}

namespace {

/// `cost`: of a promise, in words.
std::vector<OutputFile> files_of(const AccuracyResult& result, const AccuracyTiming& timing, const std::string& cost,
                                 CsvFormat format) {
  CommandTiming sums{.command = timing, .sentence = cost};
  for (const AccuracyRun& run : result.runs) {
    if (!run.made()) continue;
    sums.grain_steps += run.grain_steps;
    sums.run_time += run.cpu_time;
  }
  for (const AccuracyRow& row : result.rows) sums.settings.push_back(timed(row) ? Value(row.cpu_time) : Value());
  return {{"accuracy.csv", accuracy_csv(result, format)},
          {"accuracy_runs.csv", accuracy_runs_csv(result, format)},
          {"accuracy_errors.csv", accuracy_errors_csv(result, format)},
          {"accuracy_timing.csv", accuracy_timing_csv(result, format)},
          {page_times_name, json_of(timing_keys(), sums)}};
}

}  // namespace

std::vector<OutputFile> accuracy_files(const AccuracyResult& result, const AccuracyTiming& timing, CsvFormat format) {
  return files_of(result, timing, "", format);
}

std::vector<OutputFile> promise_files(const Scene& scene, const Promise& promise, const PromiseGoal& goal,
                                      const AccuracyTiming& timing, CsvFormat format) {
  std::vector<OutputFile> files = files_of(result_of(promise), timing, promise_cost(promise), format);
  files.push_back({"promise.json", json_of(promise_keys(), PromiseSource{&scene, &promise, &goal})});
  if (promise.offer) files.push_back({"numerics.toml", promised_numerics(scene, promise, goal)});
  return files;
}

}  // namespace vibrosow
