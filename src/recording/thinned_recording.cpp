#include "recording/thinned_recording.hpp"

namespace vibrosow {
namespace {

constexpr int most_skipped = 512;  // of 500 frames the first and the last are left

bool is_over(const Simulation& simulation) {
  return simulation.at_end() || simulation.state().guard.stop_reason || !simulation.state().run.end_reason.empty();
}

}  // namespace

ThinnedRecording::ThinnedRecording(const Model& model) : frame_interval_(frame_interval(model)) {
  parts_.push_back({1, Recording(model)});
  for (int every = 2; every <= most_skipped; every *= 2)
    parts_.push_back({every, Recording(model)}), parts_.push_back({every + every / 2, Recording(model)});
}

std::vector<Observer> ThinnedRecording::observers() {
  return {{frame_interval_, [this](Simulation& now) { add(now); }}};
}

void ThinnedRecording::add(Simulation& simulation) {
  if (simulation.time() == time_) return;
  time_ = simulation.time();
  for (Part& part : parts_)
    if (frames_ % part.every == 0 || is_over(simulation)) part.recording.add(simulation);
  ++frames_;
}

std::string ThinnedRecording::file(std::size_t most_bytes) const {
  for (const Part& part : parts_)
    if (std::string file = part.recording.file(); file.size() <= most_bytes) return file;
  return "";
}

}  // namespace vibrosow
