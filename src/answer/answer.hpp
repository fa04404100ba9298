#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "optimise/decide.hpp"
#include "optimise/optimise.hpp"
#include "outflow/doubts.hpp"
#include "outflow/statistics.hpp"
#include "study/expected_rate.hpp"
#include "study/layout_standing.hpp"
#include "study/study.hpp"
#include "study/sweep.hpp"

namespace vibrosow {

enum class AnswerKind { sweep, decision, search };

enum class Wanted { any, high, low };

/// A figure that an answer has of its layouts.
struct AnswerMetric {
  std::string_view name, heading{};  // of its column, with its unit; of a column on a screen, empty without
  std::string_view unit{};           // empty for a plain number
  double unit_size = 1;              // of that unit, in SI
  std::string_view description{};    // a clause without a full stop
  bool has_interval = true;
  Wanted wanted = Wanted::any;
  bool is_goal = false;  // layouts are compared by it
};

/// Share of runs that clogged.
inline constexpr std::string_view clogged_metric = "clogged_percent";

/// What came of a layout.
struct AnsweredLayout {
  std::size_t layout = 0;  // index in Study::layouts
  LayoutStanding standing = LayoutStanding::invalid;
  std::string reason{};  // why it is invalid, stopped, incomplete or failed
  std::vector<CountedDoubt> doubts{};
  int runs = 0;                                           // its figures are of those that flowed
  std::vector<std::optional<MeanWithInterval>> values{};  // SI, of each of Answer::figures; empty without runs
  bool is_named = false;                                  // the answer is about it: its doubts are the answer's
  bool is_first_by_means = false;                         // of a search
  std::vector<std::string> at_edge{};                     // of a search: keys whose values end their ranges
  std::vector<HoleMetrics> holes{};                       // of a sweep
  std::optional<MeanWithInterval> misfit_percent{};       // likewise, against measured outflow
  std::optional<ExpectedRate> expected{};                 // of its rate, of any answer
};

/// What is known of the layouts of a study, in one form for every question; pages, charts and the doubts of an answer
/// are drawn from it. Refers to the result that it is of.
struct Answer {
  AnswerKind kind;
  const Study* study;
  std::uint64_t first_random_seed = 1;
  std::vector<AnswerMetric> metrics{};    // a decision's and a search's goals first
  std::vector<AnsweredLayout> layouts{};  // of each of Study::layouts
  std::vector<std::size_t> best_first{};  // of these, those that are worth a look, the best first
};

/// It cannot be built, or its runs cannot be used.
bool has_failed(LayoutStanding standing);

Answer answer_of(const StudyResult& result, std::uint64_t first_random_seed);
Answer answer_of(const DecisionResult& result);
Answer answer_of(const OptimiseResult& result);

/// What speaks against the runs of the layouts that an answer names: of a sweep all, of a decision those that are best,
/// not shown to be worse or undecided, of a search those that lead. An answer that names none, since no layout meets
/// what is asked, rests on all that did not fail.
std::vector<SharedDoubt> doubts_about(const Answer& answer);

}  // namespace vibrosow
