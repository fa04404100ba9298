#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "fields/mean_map.hpp"
#include "scene/measuring_window.hpp"
#include "simulation/simulate.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {

/// A run to be looked at: where its grains and vessels are, frame by frame, rounded to a two-hundredth of the smallest
/// seed and packed to a byte or so a coordinate; in at most 50 frames its contacts with their forces; and packing and
/// velocity by cell, in the mean over the measuring window: of the tray without what is in the hopper, and of what is
/// in the hopper, each in its own frame. docs/reference/recording-format.md has the format.
class Recording {
 public:
  explicit Recording(const Model& model);

  /// What a run does for it (SimulationOptions::looks); they are called while the recording lives.
  std::vector<Observer> observers();

  /// Appends the grains and vessels as they are now; a second frame of one time is left out.
  void add(Simulation& simulation);
  /// Adds the seeds as they are now to the means; what is before the measuring window is left out.
  void add_to_map(Simulation& simulation);

  /// The recording so far as a file.
  std::string file() const;

 private:
  /// Places of one grain in counts of the field's unit, of the frame before and of the one before that.
  struct Known {
    std::array<std::int32_t, 7> last{}, before{};
    int frames = 0;  // of this block
  };
  struct Block {
    int frames;
    std::size_t offset, bytes;
  };

  /// Of a vessel, which stands for the tray in a scene with a [record].
  struct VesselMap {
    std::size_t vessel;
    Scene scene;
    MeanMapSum sum;
  };

  struct FrameContacts {
    int frame;
    std::size_t offset, bytes;
  };

  void add_vessels(const Simulation& simulation);
  void add_changes(const Grains& grains);
  void add_places(const Grains& grains);
  void add_contacts(Simulation& simulation);
  void close_block();

  std::vector<Vessel> vessels_;
  std::vector<std::string> fields_;
  std::vector<double> units_;  // by field
  double time_ = -1;           // s, of the last frame
  std::vector<std::int64_t> present_;
  std::unordered_map<std::int64_t, Known> known_;  // looked up, never walked through
  std::vector<std::array<float, 3>> first_seen_;   // m, by id
  int frames_ = 0, frames_in_block_ = 0;
  std::string block_;   // frames of the block that is open
  std::string packed_;  // blocks that are closed
  std::vector<Block> blocks_;
  double frame_interval_;  // s
  int frames_per_contacts_;
  std::string packed_contacts_;
  std::vector<FrameContacts> contacts_;
  MeasuringWindow window_;
  GrainExtents extents_;
  std::vector<VesselMap> maps_;
  double map_time_ = -1;  // s, of the last look
};

/// How often a run is looked at, s: as often as keeps its recording to some megabytes, 500 frames at most.
double frame_interval(const Model& model);

}  // namespace vibrosow
