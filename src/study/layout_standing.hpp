#pragma once

#include <string_view>

namespace vibrosow {

/// Where a layout stands in an answer.
enum class LayoutStanding {
  // Of a sweep:
  ok,
  doubtful,           // there are serious doubts
  outside_the_model,  // a run was: its figures are told, and nothing is decided by them
  stopped,            // by the guard
  incomplete,         // runs are missing, or were interrupted
  // Of a decision:
  best,
  not_shown_worse,
  undecided,
  worse,
  ruled_out_by_drafts,
  // Of a search:
  on_front,
  may_be_on_front,
  dominated,
  spills,
  misses_the_rate_or_spills,
  // Of a decision or a search:
  misses_the_rate,
  clogs,
  failed,
  // Of any:
  invalid,
};

/// "best", "not shown to be worse", ..: as tables and pages have it.
std::string_view name_of(LayoutStanding standing);

/// Whether a layout's figures are compared with those of others.
bool is_compared(LayoutStanding standing);

}  // namespace vibrosow
