#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "result/frame.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Whether what the user names is the folder of a run's reports.
bool is_run_folder(const std::filesystem::path& path);

/// The scene of a run's folder. Throws InputError where its run.json is missing or not vibrosow's.
Scene scene_of_run(const std::filesystem::path& folder);

/// The frames that a run's folder keeps, by time: those of its page (run --html), else its snapshots ([record]). They
/// have no contacts; those of a page have places alone. Throws InputError where there are none.
struct KeptFrames {
  std::vector<Frame> frames;
  bool have_speeds;
};
KeptFrames kept_frames(const std::filesystem::path& folder, const Scene& scene);

/// Of each time (s) the nearest of the frames (at least one), each once.
std::vector<Frame> nearest_frames(std::vector<Frame> frames, const std::vector<double>& times);

}  // namespace vibrosow
