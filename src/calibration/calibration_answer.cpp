#include "calibration/calibration_answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "input/key_units.hpp"
#include "input/read_contact.hpp"
#include "study/layout_doubts.hpp"

namespace vibrosow {
namespace {

constexpr double few_effective_points = 200;
constexpr double little_contraction = 0.2;
constexpr double unlikely_misfit = 0.01;
constexpr double most_of_the_noise = 3;  // that the best point may miss the table by

RangeEdge edge_of(const KeyRange& range, const FittedValue& value) {
  constexpr double near = 0.02;  // of the range, along which it was taken to be even
  if (value.contraction < little_contraction) return RangeEdge::none;
  if (range.part_of(value.low) < near) return RangeEdge::lower;
  return range.part_of(value.high) > 1 - near ? RangeEdge::upper : RangeEdge::none;
}

std::vector<FittedNumber> numbers_of(const CalibrationTask& task, const Calibration& of) {
  std::vector<FittedNumber> numbers;
  for (std::size_t k = 0; k < task.keys.size(); ++k) {
    const KeyRange& key = task.keys[k];
    const auto unit = column_unit(key.key);
    numbers.push_back(
        {key.key, unit ? std::string(unit->unit) : "", key.low, key.high, of.values[k], edge_of(key, of.values[k])});
  }
  if (of.depth_factor) numbers.push_back({depth_factor_name, "", {}, {}, *of.depth_factor});
  for (const FittedPair& pair : of.correlations)
    if (std::abs(pair.correlation) > not_told_apart) {
      numbers[pair.a].not_told_apart_from.push_back(numbers[pair.b].name);
      numbers[pair.b].not_told_apart_from.push_back(numbers[pair.a].name);
    }
  return numbers;
}

/// What speaks against the runs that were fitted to.
std::vector<CountedDoubt> doubts_of_runs(const std::vector<ReducedRun>& runs) {
  std::vector<const std::vector<Doubt>*> that_count;
  for (const ReducedRun& run : runs)
    if (run.reason.empty()) that_count.push_back(&run.doubts);
  return counted_doubts(that_count);
}

/// What can hardly be meant in the scenes of the measured conditions, each sentence once.
std::vector<CountedDoubt> doubts_of_scenes(const CalibrationDesign& design) {
  std::vector<CountedDoubt> doubts;
  std::vector<bool> seen(design.conditions.size(), false);
  for (const CalibrationRun& run : design.runs) {
    if (seen.at(run.condition)) continue;
    seen[run.condition] = true;
    for (CountedDoubt& doubt : doubts_of_scene(run.scene))
      if (std::ranges::find(doubts, doubt.text, &CountedDoubt::text) == doubts.end())
        doubts.push_back(std::move(doubt));
  }
  return doubts;
}

/// Whether each of several lots has the contact model of its crop, so that one file cannot hold them.
bool takes_contacts_of_crops(const CalibrationDesign& design) {
  if (design.runs.empty()) return false;
  const Scene& scene = design.runs.front().scene;
  return scene.lots.size() > 1 && !scene.contact.model.is_known() && !scene.contact.overrides.empty() &&
         crops_have_contacts(scene.lots);
}

/// How many of the values that were held out lie outside their intervals, and how many there are.
std::pair<int, int> held_out_misses(const Calibration& of) {
  int outside = 0, held_out = 0;
  for (const PredictedValue& value : of.predictions) {
    if (!value.held_out) continue;
    ++held_out;
    outside += value.measured < value.low || value.measured > value.high ? 1 : 0;
  }
  return {outside, held_out};
}

/// At least two, and more than half: those of a curve go together, so the binomial of 5 % would find too many.
bool missed_too_often(int outside, int held_out) {
  return outside >= 2 && 2 * outside > held_out;
}

/// Of the fit itself, and of each value.
std::vector<CountedDoubt> doubts_of_fit(const CalibrationAnswer& answer) {
  using enum DoubtKind;
  const Calibration& of = answer.calibration;
  std::vector<CountedDoubt> doubts;
  const auto add = [&](DoubtKind kind, std::string text) { doubts.push_back({kind, 0, 0, std::move(text)}); };
  if (!answer.is_fitted)
    add(nothing_fitted, fmt::format("no values within the ranges meet the table: the best ones miss it by {:.2g} times "
                                    "its noise. Nothing was fitted",
                                    of.misfit_over_noise));
  else if (of.misfit_probability < unlikely_misfit)
    add(misfit, "the model nowhere meets the table within its noise, so the intervals are too narrow");
  for (const FittedPair& pair : of.correlations)
    if (std::abs(pair.correlation) > not_told_apart)
      add(confused_values, fmt::format("{} and {} cannot be told apart by this table (correlation {:.2f})",
                                       answer.numbers[pair.a].name, answer.numbers[pair.b].name, pair.correlation));
  std::vector<std::string> unknown;
  for (std::size_t k = 0; k < answer.task.keys.size(); ++k)
    if (of.values[k].contraction < little_contraction) unknown.push_back(answer.numbers[k].name);
  if (!unknown.empty()) add(little_learned, fmt::format("the table says little of {}", fmt::join(unknown, ", ")));
  for (std::size_t k = 0; k < answer.task.keys.size(); ++k) {
    const FittedNumber& number = answer.numbers[k];
    if (number.edge != RangeEdge::none)
      add(edge_of_range, fmt::format("{} lies at the {} edge of its range, {:g} to {:g}: what is better may lie beyond "
                                     "it",
                                     number.name, name_of(number.edge), *number.low, *number.high));
    if (number.value.contraction < 0)
      add(wider_than_its_range, fmt::format("{} scatters more than an even spread over its range would (its "
                                            "uncertainty is larger than before): the table agrees with both ends of "
                                            "the range at once",
                                            number.name));
  }
  if (of.posterior.effective_points < few_effective_points)
    add(few_points, fmt::format("the intervals rest on {:.0f} effective points only", of.posterior.effective_points));
  if (const std::size_t left_out = answer.runs.size() - answer.runs_used; left_out > 0)
    add(runs_left_out, fmt::format("{} of {} runs were left out", left_out, answer.runs.size()));
  if (const auto [outside, held_out] = held_out_misses(of); missed_too_often(outside, held_out))
    add(misfit, fmt::format("{} of {} values that were held out lie outside the intervals in which 95 % of such should "
                            "lie: the fit does not predict what it was not fitted to",
                            outside, held_out));
  if (!of.held_out_rms) add(nothing_held_out, "nothing was held out, so that no prediction was tested");
  return doubts;
}

}  // namespace

std::string name_of(RangeEdge edge) {
  return edge == RangeEdge::none ? "" : edge == RangeEdge::lower ? "lower" : "upper";
}

CalibrationAnswer answer_of(const CalibrationTask& task, const CalibrationDesign& design,
                            const std::vector<ReducedRun>& runs, const Calibration& calibration) {
  CalibrationAnswer answer{task, design, runs, calibration, numbers_of(task, calibration)};
  answer.runs_used = static_cast<std::size_t>(std::ranges::count(runs, std::string(), &ReducedRun::reason));
  answer.is_fitted = calibration.misfit_over_noise <= most_of_the_noise;
  std::vector<CountedDoubt> doubts = doubts_of_runs(runs);
  std::ranges::move(doubts_of_scenes(design), std::back_inserter(doubts));
  std::ranges::move(doubts_of_fit(answer), std::back_inserter(doubts));
  for (const CountedDoubt& doubt : doubts) {
    using enum DoubtKind;
    for (const DoubtKind kind : {nothing_fitted, misfit, edge_of_range, seeds_lost})
      if (doubt.kind == kind) answer.gives_a_contact = false;
  }
  answer.lots_have_own_contacts = takes_contacts_of_crops(design);
  if (answer.lots_have_own_contacts) answer.gives_a_contact = false;
  answer.doubts = shared_doubts({{0, doubts}});
  return answer;
}

}  // namespace vibrosow
