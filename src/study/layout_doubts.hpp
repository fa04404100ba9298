#pragma once

#include <vector>

#include "outflow/doubts.hpp"
#include "scene/scene.hpp"
#include "study/evaluate.hpp"

namespace vibrosow {

/// Of the runs that finished.
std::vector<CountedDoubt> doubts_of_runs(const std::vector<Evaluation>& runs);

/// What in a scene can hardly be meant (`scene_warnings`).
std::vector<CountedDoubt> doubts_of_scene(const Scene& scene);

/// Of a layout that is decided about: of its runs that finished, and of its scene. Where `tests_clogging`, that runs
/// stopped flowing is not among them: the decision leaves those out and tells how many there were.
std::vector<CountedDoubt> doubts_of_layout(const Scene& scene, const std::vector<Evaluation>& runs,
                                           bool tests_clogging);

}  // namespace vibrosow
