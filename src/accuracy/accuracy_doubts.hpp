#pragma once

#include <vector>

#include "accuracy/accuracy.hpp"
#include "outflow/doubts.hpp"

namespace vibrosow {

/// What speaks against runs of settings of a scene: what can hardly be meant in it (`scene_warnings`); those that have
/// no rate, with the reason of the first; the doubts of those that have one (their "layouts" are settings, 1..); those
/// that passed less than half of what the median run did, as where an outlet clogs; the doubts of runs for the depth's
/// error; and what speaks against the errors that are told. Serious ones first.
std::vector<SharedDoubt> doubts_about(const AccuracyResult& result, const Scene& scene);

}  // namespace vibrosow
