#include "accuracy/promise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simulation/integrator.hpp"

namespace vibrosow {
namespace {

constexpr int most_further_rounds = 5;  // each takes as long as all before it

double cpu_time_of(const std::vector<AccuracyRun>& runs) {
  double sum = 0;
  for (const AccuracyRun& run : runs) sum += run.cpu_time;
  return sum;
}

double work_of(const Promise& promise) {
  double sum = 0;
  for (const AccuracyRun& run : promise.runs) sum += work_of(promise.settings[run.setting], run.grain_steps);
  return sum;
}

bool same_softness(const AccuracySetting& a, const AccuracySetting& b) {
  return a.shell_compression == b.shell_compression && a.youngs_modulus == b.youngs_modulus;
}

double evaluations_per_second(const AccuracySetting& setting) {
  return evaluations_per_step(setting.integrator) / setting.dt;
}

struct Cost {
  double work = 0, cpu_time = 0;  // as an offer's
};

/// Of several runs; CPU time is known of those made now alone.
class MeanCost {
 public:
  void add(double work, double cpu_time, double times) {
    sum_.work += times * work, sum_.cpu_time += times * cpu_time;
    ++runs_;
    timed_ += cpu_time > 0;
  }
  std::optional<Cost> mean() const {
    if (runs_ == 0) return std::nullopt;
    return Cost{sum_.work / runs_, sum_.cpu_time / std::max(1, timed_)};
  }

 private:
  Cost sum_;
  int runs_ = 0, timed_ = 0;
};

/// Choosing among settings by the fit of the pilots.
class Chooser {
 public:
  Chooser(const PromiseChoices& choices, const Promise& promise) : choices_(choices), promise_(promise) {}

  /// What a run costs: the mean of the setting's pilots, or, by evaluations in a simulated second, of those as soft;
  /// none where none of these has a rate.
  std::optional<Cost> cost_of_run(std::size_t setting) const {
    const AccuracySetting& wanted = promise_.settings[setting];
    MeanCost own, other;
    for (const AccuracyRun& run : promise_.runs) {
      const AccuracySetting& ran = promise_.settings[run.setting];
      if (!run.mass_rate || !same_softness(ran, wanted)) continue;
      const double work = work_of(ran, run.grain_steps);
      if (run.setting == setting) own.add(work, run.cpu_time, 1);
      other.add(work, run.cpu_time, evaluations_per_second(wanted) / evaluations_per_second(ran));
    }
    return own.mean() ? own.mean() : other.mean();
  }

  int pilots_of(std::size_t setting, double window) const {
    return static_cast<int>(std::ranges::count_if(promise_.runs, [&](const AccuracyRun& run) {
      return run.setting == setting && run.window == window && run.mass_rate;
    }));
  }

  /// Without replicates, so cost and half width are of one run.
  std::optional<Offer> single(std::size_t setting, double window) const {
    const std::optional<Cost> one = cost_of_run(setting);
    if (!one || !promise_.fit->tells(setting)) return std::nullopt;
    const double longer = (choices_.lead + window * choices_.window) / (choices_.lead + choices_.window);
    return Offer{.setting = setting,
                 .window = window,
                 .bias = promise_.fit->error(setting),
                 .half_width_percent = half_width_of_run() / std::sqrt(window),
                 .work = one->work * longer,
                 .cpu_time = one->cpu_time * longer};
  }

  /// Of a run over the scene's window.
  double half_width_of_run() const {
    return student_t_95(promise_.fit->degrees_of_freedom()) * promise_.fit->scatter_percent();
  }

  std::optional<Offer> within(std::size_t setting, double window, double percent) const {
    const std::optional<Offer> offer = single(setting, window);
    if (!offer || !(offer->bias.bound() < percent)) return std::nullopt;
    const double ratio = offer->half_width_percent / (percent - offer->bias.bound()), needed = std::ceil(ratio * ratio);
    if (!(needed <= most_replicates)) return std::nullopt;
    return with_replicates(*offer, static_cast<int>(needed));
  }

  /// As many replicates as `budget` allows, of work or of CPU time.
  std::optional<Offer> affordable(std::size_t setting, double window, double Offer::*cost, double budget) const {
    const std::optional<Offer> offer = single(setting, window);
    if (!offer) return std::nullopt;
    const int made = pilots_of(setting, window);
    const double more = std::clamp(std::floor(budget / *offer.*cost), 0.0, double(most_replicates));
    if (made + more < 1) return std::nullopt;
    return with_replicates(*offer, made + static_cast<int>(more));
  }

  /// The best of all settings and windows.
  template <class Make, class Badness>
  std::optional<Offer> best(Make make, Badness badness) const {
    std::optional<Offer> best;
    for (std::size_t setting = 0; setting < promise_.settings.size(); ++setting)
      for (const double window : choices_.windows) {
        const std::optional<Offer> offer = make(setting, window);
        if (offer && (!best || badness(*offer) < badness(*best))) best = offer;
      }
    return best;
  }

 private:
  /// With so many replicates in all, or as many as there are pilots.
  Offer with_replicates(Offer offer, int replicates) const {
    const int made = pilots_of(offer.setting, offer.window);
    offer.replicates = std::max(replicates, std::max(1, made));
    offer.to_run = offer.replicates - made;
    offer.work *= offer.replicates;
    offer.cpu_time *= offer.replicates;
    offer.half_width_percent /= std::sqrt(offer.replicates);
    return offer;
  }

  const PromiseChoices& choices_;
  const Promise& promise_;
};

std::optional<Offer> best_offer(const Chooser& chooser, const PromiseGoal& goal, double cpu_time_spent) {
  if (goal.within_percent)
    return chooser.best([&](std::size_t s, double w) { return chooser.within(s, w, *goal.within_percent); },
                        [](const Offer& offer) { return offer.work; });
  return chooser.best(
      [&](std::size_t s, double w) {
        return chooser.affordable(s, w, &Offer::cpu_time, *goal.cpu_time - cpu_time_spent);
      },
      [](const Offer& offer) { return offer.error_bound(); });
}

/// Costs in the goal's own measure: work, or s of CPU time.
PilotBasis basis_of(const Chooser& chooser, const PromiseGoal& goal, const Promise& made) {
  PilotBasis basis{.fit = *made.fit, .half_width_of_run = chooser.half_width_of_run()};
  for (std::size_t i = 0; i < made.settings.size(); ++i) {
    const std::optional<Cost> cost = chooser.cost_of_run(i);
    basis.costs.push_back(cost ? (goal.cpu_time ? cost->cpu_time : cost->work) : 0);
    basis.made.push_back(chooser.pilots_of(i, 1));
  }
  return basis;
}

std::vector<SettingRuns> more_pilots(const Chooser& chooser, const PromiseGoal& goal, const Promise& made) {
  PromiseGoal left = goal;
  if (left.cpu_time) *left.cpu_time -= made.pilot_cpu_time;
  return runs_of(plan_pilots(basis_of(chooser, goal, made), left));
}

/// Where no setting is within a goal of an error: what leads there as it looks now, or else tells whether any may be.
std::vector<SettingRuns> further_pilots(const Chooser& chooser, const PromiseGoal& goal, const Promise& made) {
  std::vector<SettingRuns> planned = more_pilots(chooser, goal, made);
  if (!planned.empty()) return planned;
  return runs_of(plan_further_pilots(basis_of(chooser, goal, made), *goal.within_percent, work_of(made)));
}

void tell_cost_of_pilots(const Chooser& chooser, const std::vector<SettingRuns>& pilots, const TellCost& tell) {
  if (!tell || pilots.empty()) return;
  int runs = 0;
  double cpu_time = 0;
  for (const SettingRuns& of : pilots) {
    runs += of.runs;
    if (const std::optional<Cost> one = chooser.cost_of_run(of.setting)) cpu_time += of.runs * one->cpu_time;
  }
  tell(runs, cpu_time);
}

std::size_t finest(const std::vector<AccuracySetting>& settings) {
  return static_cast<std::size_t>(std::ranges::min_element(settings, {}, coarseness) - settings.begin());
}

void add(std::vector<AccuracyRun>& runs, const std::vector<AccuracyRun>& more) {
  runs.insert(runs.end(), more.begin(), more.end());
}

/// Whether some run was cut short, so that nothing may be concluded.
bool interrupted(const std::vector<AccuracyRun>& runs) {
  return std::ranges::any_of(runs, [](const AccuracyRun& run) { return run.refused == interrupted_run; });
}

std::string why_no_fit(const Promise& made) {
  const std::vector<AccuracyRun>& pilots = made.runs;
  if (interrupted(pilots)) return interrupted_run;
  if (!made.of_one_value.empty())
    return fmt::format("all pilots have one {}, so what it errs by is not known; give two or more", made.of_one_value);
  const auto stood_still = [](const AccuracyRun& run) { return run.mass_rate == 0.0; };
  return std::ranges::all_of(pilots, stood_still) ? "nothing flows" : "too few of the pilots have a rate";
}

void make_pilots(Promise& made, const std::vector<SettingRuns>& pilots, const RunSettings& run) {
  add(made.runs, run(pilots));
  made.pilots = made.runs.size();
  made.pilot_cpu_time = cpu_time_of(made.runs);
  made.of_one_value = part_of_one_value(made.settings, made.runs);
  const bool can_tell = !interrupted(made.runs) && made.of_one_value.empty();
  made.fit = can_tell ? ErrorFit::of(made.settings, made.runs) : std::nullopt;
}

}  // namespace

Promise promise(const PromiseChoices& choices, const PromiseGoal& goal, const RunSettings& run, const TellCost& tell) {
  if (goal.within_percent.has_value() == goal.cpu_time.has_value())
    throw std::invalid_argument("a promise has an error or a CPU time as its goal");
  Promise made;
  made.settings = choices.design.settings;
  make_pilots(made, runs_of(choices.design.runs), run);
  const Chooser chooser(choices, made);
  const auto make_more = [&](const std::vector<SettingRuns>& more) {
    if (more.empty()) return false;
    tell_cost_of_pilots(chooser, more, tell);
    make_pilots(made, more, run);
    return made.fit.has_value();
  };
  if (made.fit) make_more(more_pilots(chooser, goal, made));
  if (made.fit) made.offer = best_offer(chooser, goal, made.pilot_cpu_time);
  for (int round = 0; made.fit && !made.offer && goal.within_percent && round < most_further_rounds; ++round) {
    if (!make_more(further_pilots(chooser, goal, made))) break;
    made.offer = best_offer(chooser, goal, made.pilot_cpu_time);
  }
  if (!made.fit) {
    made.refused = why_no_fit(made);
    return made;
  }
  if (goal.within_percent) made.finest = chooser.within(finest(made.settings), 1, *goal.within_percent);
  if (!made.offer) {
    const double spent = work_of(made);
    made.least = chooser.best([&](std::size_t s, double w) { return chooser.affordable(s, w, &Offer::work, spent); },
                              [](const Offer& offer) { return offer.error_bound(); });
    made.refused = goal.within_percent ? "no setting is known well enough" : "the pilots used it up";
    return made;
  }
  if (made.offer->to_run > 0) {
    if (tell) tell(made.offer->to_run, made.offer->cpu_time_to_run());
    const std::vector<AccuracyRun> answer = run({{made.offer->setting, made.offer->to_run, made.offer->window}});
    made.answer_cpu_time = cpu_time_of(answer);
    add(made.runs, answer);
  }
  double sum = 0;
  int runs = 0;
  for (const AccuracyRun& one : made.runs)
    if (one.setting == made.offer->setting && one.window == made.offer->window && one.mass_rate)
      sum += *one.mass_rate, ++runs;
  if (runs < made.offer->replicates) {
    made.refused = interrupted(made.runs) ? interrupted_run : "a run of the answer has no rate";
    return made;
  }
  made.mass_rate = {sum / runs, made.offer->half_width_percent / 100 * made.fit->limit().mean};
  return made;
}

}  // namespace vibrosow
