// A rod along the vessel, a line turned about an axis along x.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "simulation/simulate.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

constexpr double rod_radius = 0.02, rod_height = 0.1;

/// With x and z exchanged.
Eigen::Vector3d exchanged(const Eigen::Vector3d& v) {
  return {v.z(), v.y(), v.x()};
}

/// So far from each other that they never meet: their impacts would multiply the rounding errors.
std::vector<Eigen::Vector3d> places_above_rod() {
  std::vector<Eigen::Vector3d> places;
  for (int k = 0; k < 24; ++k)
    places.push_back({0.2 + 0.022 * k, rod_height + rod_radius + 0.006 + 0.001 * (k % 3), 0.5 + 0.003 * (k % 5 - 2)});
  return places;
}

/// Balls that fall on a rod through the whole box, which is 1 m wide in all directions; `across`: drawn out along z.
Bench balls_on_rod(bool across) {
  Bench bench(Space::three_dimensional);
  bench.gravity = {0, -standard_gravity};
  bench.scene.contact.friction_model = FrictionModel::spring;
  bench.scene.contact.seed = bench.scene.contact.wall = {0.5, 0.5};
  WallPiece rod;
  if (across)
    rod.centre = {0.5, rod_height}, rod.radius = rod_radius, rod.to = 2 * Bench::pi;
  else
    rod.a = {rod_radius, 0}, rod.b = {rod_radius, 1}, rod.about = {rod_height, 0.5}, rod.axis = PieceAxis::along;
  bench.scene.tray.pieces = {rod};
  for (const Eigen::Vector3d& at : places_above_rod()) {
    const Eigen::Vector3d velocity(0.1, -0.5, 0.02);
    bench.place(across ? exchanged(at) : at, across ? exchanged(velocity) : velocity);
  }
  return bench;
}

TEST(Rod, AlongItIsWhatACircleDrawnOutAcrossIsWithTheDirectionsExchanged) {
  Bench along = balls_on_rod(false), across = balls_on_rod(true);
  Simulation &one = along.start(1e-5), &other = across.start(1e-5);
  int deflected = 0;
  for (int k = 0; k < 20; ++k) {
    EXPECT_TRUE(one.run_until(0.005 * (k + 1)) && other.run_until(0.005 * (k + 1)));
    for (std::size_t i = 0; i < one.grains().size(); ++i) {
      const Grains &a = one.grains(), &b = other.grains();
      EXPECT_NEAR(a.x[i], b.z[i], 1e-12) << i;
      EXPECT_NEAR(a.y[i], b.y[i], 1e-12) << i;
      EXPECT_NEAR(a.z[i], b.x[i], 1e-12) << i;
      // A reflection: spins turn the other way. Overlaps, differences of places, are known to some 1e-9 of themselves.
      EXPECT_NEAR(a.omega_x[i], -b.omega[i], 1e-8 * (1 + std::abs(b.omega[i]))) << i;
    }
  }
  for (std::size_t i = 0; i < one.grains().size(); ++i)
    deflected += std::abs(one.grains().z[i] - places_above_rod()[i].z()) > Bench::radius;
  EXPECT_GT(deflected, 8) << "they never met the rod";
}

TEST(Rod, ABallOutsideItsEndsMeetsItsRimAlone) {
  Bench bench(Space::three_dimensional);
  WallPiece rod{.a = {rod_radius, 0.2}, .b = {rod_radius, 0.6}, .about = Eigen::Vector2d(rod_height, 0.5)};
  rod.axis = PieceAxis::along;
  bench.scene.tray.pieces = {rod};
  const double overlap = 1e-6, aside = Bench::radius - overlap;
  bench.place({0.4, rod_height + rod_radius + aside, 0.5});                    // on its back
  bench.place({0.2 - aside, rod_height + rod_radius, 0.5});                    // beyond its left end, beside the rim
  bench.place({0.6 + 2 * Bench::radius, rod_height, 0.5});                     // beyond its right end, where nothing is
  bench.place({0.5, rod_height, 0.5 - rod_radius + Bench::radius - overlap});  // within, at its front
  const Simulation& run = bench.start(1e-9);
  const std::vector<GrainVector> forces = run.field().forces_3d();
  const double force = Bench::mass * standard_gravity / (1e-4 * Bench::radius) * overlap;
  const auto expect = [&](std::size_t i, const Eigen::Vector3d& direction) {
    EXPECT_NEAR(forces[i].x, force * direction.x(), 1e-6 * force) << i;
    EXPECT_NEAR(forces[i].y, force * direction.y(), 1e-6 * force) << i;
    EXPECT_NEAR(forces[i].z, force * direction.z(), 1e-6 * force) << i;
  };
  expect(0, {0, 1, 0});
  expect(1, {-1, 0, 0});
  expect(2, {0, 0, 0});
  expect(3, {0, 0, 1});
}

}  // namespace
}  // namespace vibrosow
