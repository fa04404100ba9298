#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "simulation/checkpoint.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {

/// Where grains are, how they move and how clumps in 3D lie, to be compared to the last bit.
inline std::vector<double> bits(const Grains& g) {
  std::vector<double> all;
  for (const auto* array : {&g.x, &g.y, &g.z, &g.vx, &g.vy, &g.vz, &g.omega, &g.omega_x, &g.omega_y, &g.angle, &g.q_w,
                            &g.q_x, &g.q_y, &g.q_z})
    all.insert(all.end(), array->begin(), array->end());
  return all;
}

/// A run that is saved at `cut` (s) and restored ends at `end` (s) with the bits of one that was not; its grains meet
/// at least `contacts` times.
inline void expect_a_cut_run_goes_on(const Model& model, const SimulationState& start, double cut, double end,
                                     std::int64_t contacts) {
  Simulation whole(model, start);
  whole.run_until(cut);
  const std::string saved = save(model, whole.state());
  whole.run_until(end);
  Simulation resumed(model, restore(model, saved));
  resumed.run_until(end);
  EXPECT_EQ(bits(resumed.grains()), bits(whole.grains()));
  EXPECT_GT(whole.result().force_evaluations, contacts);
}

}  // namespace vibrosow
