#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "recording/recording.hpp"

namespace vibrosow {

/// A recording for a place of limited size, which is not known before the run has ended: it is kept of every frame, of
/// every second one, and so on.
class ThinnedRecording {
 public:
  explicit ThinnedRecording(const Model& model);

  /// As `Recording::looks`, but for the maps, which are left out. The first frame, and the one of the run's end, are in
  /// every part.
  std::vector<Observer> observers();
  void add(Simulation& simulation);

  /// The one with the most frames of those whose file takes at most so many bytes; empty where none does.
  std::string file(std::size_t most_bytes) const;

 private:
  struct Part {
    int every;  // how many frames one of it stands for
    Recording recording;
  };

  double frame_interval_;    // s
  std::vector<Part> parts_;  // those with more frames first
  int frames_ = 0;
  double time_ = -1;  // s, of the last frame
};

}  // namespace vibrosow
