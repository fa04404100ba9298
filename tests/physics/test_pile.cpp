// A pile at rest: under a tangential spring it stays, under the sign law it creeps apart.
// VIBROSOW_REPORTS=FOLDER: the table is written to FOLDER/pile.csv too.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "input/read_scene.hpp"
#include "plan/step_plan.hpp"
#include "simulation/simulation.hpp"
#include "support/committed_report.hpp"

namespace vibrosow {
namespace {

constexpr double settled_at = 5, watched = 5;  // s

struct PileShape {
  double height;           // m, to the top of the highest grain
  double half_width;       // m, of the triangle with the pile's mean distance from its middle: 3 times that
  double angle_of_repose;  // degree, of the triangle with the pile's mean height and that half width
};

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// A triangle of height h and half width b has its mass on average h / 3 high and b / 3 from the middle.
PileShape shape_of(const Grains& grains) {
  const double middle = mean(grains.x);
  std::vector<double> distance;
  for (double x : grains.x) distance.push_back(std::abs(x - middle));
  return {*std::ranges::max_element(grains.y) + grains.kinds[0].radius, 3 * mean(distance),
          std::atan2(mean(grains.y), mean(distance)) * 180 / std::numbers::pi};
}

/// Kinetic energy a grain, over m g r.
double kinetic_fraction(const Grains& grains) {
  const GrainKind& kind = grains.kinds[0];
  return kinetic_energy(grains) / static_cast<double>(grains.size()) / (kind.mass * standard_gravity * kind.radius);
}

/// How far the grain went that went furthest of those still there, in radii.
double largest_displacement(const Grains& before, const Grains& after) {
  double largest = 0;
  for (std::size_t i = 0, k = 0; i < after.size(); ++i) {
    while (before.id[k] != after.id[i]) ++k;
    largest = std::max(largest, std::hypot(after.x[i] - before.x[k], after.y[i] - before.y[k]));
  }
  return largest / before.kinds[0].radius;
}

Grains after(const Scene& scene, Grains grains, double duration) {
  const Model model = prepare(scene);
  Simulation run(model, starting_state(model, 1, std::move(grains)));
  while (run.time() < duration)
    if (!run.step()) throw std::runtime_error(*run.guard().stop_reason());
  return run.grains();
}

Scene pile_scene(const std::vector<Override>& overrides = {}) {
  return read_scene(std::string(VIBROSOW_SOURCE_DIR) + "/seeders/verification/pile.toml", overrides);
}

std::string row(const std::string& law, const std::string& slip_speed, double time, const Grains& grains,
                double displacement) {
  const PileShape shape = shape_of(grains);
  return fmt::format("{},{},{:g},{},{:.3f},{:.2f},{:.3f},{:.2e},{:.2e}\n", law, slip_speed, time, grains.size(),
                     1e3 * shape.height, 1e3 * shape.half_width, shape.angle_of_repose, kinetic_fraction(grains),
                     displacement);
}

TEST(Pile, StaysUnderTheTangentialSpringAndSpreadsUnderTheSignLaw) {
  std::string table =
      "# seeders/verification/pile.toml settles for 5 s under springs; the same pile then stands 5 s under each "
      "friction model\n"
      "friction_model,slip_speed_mm_per_s,time_s,grains,height_mm,half_width_mm,angle_of_repose_deg,"
      "kinetic_energy_per_grain_over_mgr,largest_displacement_since_5_s_over_r\n";

  // One run, so that the springs keep their memory.
  const Scene scene = pile_scene();
  Simulation run(prepare(scene), 1);
  while (run.time() < settled_at) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  const Grains settled = run.grains();
  EXPECT_LT(kinetic_fraction(settled), 1e-12);
  EXPECT_GT(shape_of(settled).angle_of_repose, 10);
  while (run.time() < settled_at + watched) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  const double stayed = largest_displacement(settled, run.grains());
  EXPECT_LT(stayed, 1e-6);
  EXPECT_EQ(run.grains().size(), settled.size());
  table += row("spring", "", settled_at, settled, 0);
  table += row("spring", "", settled_at + watched, run.grains(), stayed);

  for (const std::string slip_speed : {"2", "20"}) {
    const Scene sliding =
        pile_scene({parse_override("contact.friction_model=\"sliding\""), parse_override("contact.tangential_ratio="),
                    parse_override("contact.slip_speed=" + slip_speed + " mm/s")});
    const Grains crept = after(sliding, settled, watched);
    const double creep = largest_displacement(settled, crept);
    table += row("sliding", slip_speed, settled_at + watched, crept, creep);
    EXPECT_LT(shape_of(crept).height, shape_of(settled).height) << slip_speed;
    // Not the half width: grains that roll off the shelf are no longer part of it.
    EXPECT_LT(shape_of(crept).angle_of_repose, shape_of(settled).angle_of_repose) << slip_speed;
    EXPECT_LT(crept.size(), settled.size()) << slip_speed;
    EXPECT_GT(creep, 1e4 * 1e-6) << slip_speed;
  }
  expect_committed("pile.csv", table);
}

}  // namespace
}  // namespace vibrosow
