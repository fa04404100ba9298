#include "study/layout_doubts.hpp"

#include "plan/scene_warnings.hpp"

namespace vibrosow {

std::vector<CountedDoubt> doubts_of_runs(const std::vector<Evaluation>& runs) {
  std::vector<const std::vector<Doubt>*> finished;
  for (const Evaluation& run : runs)
    if (run.finished()) finished.push_back(&run.outflow.doubts);
  return counted_doubts(finished);
}

std::vector<CountedDoubt> doubts_of_scene(const Scene& scene) {
  std::vector<CountedDoubt> doubts;
  for (const std::string& warning : scene_warnings(scene)) doubts.push_back({DoubtKind::unlikely_scene, 0, 0, warning});
  return doubts;
}

std::vector<CountedDoubt> doubts_of_layout(const Scene& scene, const std::vector<Evaluation>& runs,
                                           bool tests_clogging) {
  std::vector<CountedDoubt> doubts = doubts_of_runs(runs);
  if (tests_clogging)
    std::erase_if(doubts, [](const CountedDoubt& doubt) { return doubt.kind == DoubtKind::stopped_flowing; });
  for (CountedDoubt& doubt : doubts_of_scene(scene)) doubts.push_back(std::move(doubt));
  return doubts;
}

}  // namespace vibrosow
