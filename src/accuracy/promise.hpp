#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/accuracy_settings.hpp"
#include "accuracy/error_fit.hpp"
#include "accuracy/pilot_plan.hpp"
#include "outflow/statistics.hpp"

namespace vibrosow {

/// What a promise chooses among.
struct PromiseChoices {
  AccuracyDesign design;              // pilots of a round; a setting without a pilot may be chosen as well
  double lead = 0;                    // s, of a run before its measuring window
  double window = 1;                  // s
  std::vector<double> windows = {1};  // times as long (windows_alike)
};

/// A setting, so many runs of it, and what their mean rate may err by.
struct Offer {
  std::size_t setting = 0;
  double window = 1;  // times the scene's
  int replicates = 0;
  int to_run = 0;                 // of these; the others are pilots
  RateError bias{};               // systematic error, its band simultaneous over the settings
  double half_width_percent = 0;  // of the mean's 95 % interval
  double work = 0;                // grain-steps times force evaluations a step, predicted for all replicates
  double cpu_time = 0;            // s, the same, on this machine; 0 where no run of it was made now
  double cpu_time_to_run() const { return cpu_time * to_run / replicates; }
  double error_bound() const { return bias.bound() + half_width_percent; }
};

struct Promise {
  std::vector<AccuracySetting> settings;
  std::vector<AccuracyRun> runs;                   // pilots first
  std::size_t pilots = 0;                          // how many of the runs
  std::optional<ErrorFit> fit;                     // of the pilots; none: too few of them, or
  std::string_view of_one_value;                   // what all of them have one value of (`part_of_one_value`)
  std::optional<Offer> offer;                      // what was chosen and run
  std::optional<Offer> least;                      // where nothing was chosen: the smallest error within reach
  std::optional<Offer> finest;                     // the finest setting run directly, if it is within the goal
  std::optional<MeanWithInterval> mass_rate;       // kg/s; the interval is the offer's half width
  std::string refused;                             // why nothing was chosen
  double pilot_cpu_time = 0, answer_cpu_time = 0;  // s
};

/// Makes the wanted runs, as SettingRunner::run does.
using RunSettings = std::function<std::vector<AccuracyRun>(const std::vector<SettingRuns>&)>;

/// Told before each stage but the first: how many runs it takes, and their CPU time, s, as the pilots foretell it.
using TellCost = std::function<void(int runs, double cpu_time)>;

/// In three stages. A round of pilots, of which main effects and scatter are fitted. As many more pilots as make the
/// whole cheapest (plan_pilots); where no setting is within the goal by then and some may yet be, the pilots are
/// doubled (plan_further_pilots) and that is planned anew, five times at most. Then, of all settings, windows and
/// numbers of runs whose |bias| is bounded by its upper 95 % bound, simultaneous over the settings, plus a half width
/// of t s / sqrt(n) with the pilots' s (Stein's two-stage rule: n is fixed before the runs are made), the one within
/// the goal whose runs would be the least work if made afresh, as they are for every further layout. The finest setting
/// is one of them, and a setting's own pilots count among its runs. Work is counted in grain-steps, so no clock
/// decides; only a goal of CPU time asks one, and wants every run made now. Interrupted or refused runs leave the
/// promise without an offer. Throws std::invalid_argument unless the goal is one of the two.
Promise promise(const PromiseChoices& choices, const PromiseGoal& goal, const RunSettings& run,
                const TellCost& tell = {});

}  // namespace vibrosow
