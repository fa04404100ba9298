#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "result/snapshot.hpp"

namespace vibrosow {

/// A contact at one moment, of two grains or of a grain and a wall; of clumps between two of their discs or balls, so
/// that two clumps may touch more than once. In the lab frame; in 2D the third number is 0.
struct GrainContact {
  std::int64_t grain = 0, partner = 0;       // ids; negative: a wall
  std::array<double, 3> from{}, to{};        // m, the grain's centre (its disc's), the partner's or the wall's nearest
                                             // point; across a periodic boundary both on the grain's side
  std::array<double, 3> normal_force{};      // N, on the grain
  std::array<double, 3> tangential_force{};  // N, on the grain
  double overlap = 0;                        // m
};

/// The bed and its contacts at one moment.
struct Frame {
  Snapshot bed;
  std::vector<GrainContact> contacts{};  // by grain, those with walls last
};

}  // namespace vibrosow
