// A bed of balls: how densely poured and shaken ones lie, and on how many others each rests.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "input/read_scene.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {
namespace {

constexpr double diameter = 4e-3;

/// Slightly unequal balls, eight diameters wide and periodic, so that the floor alone orders them.
Scene bed() {
  Scene scene;
  scene.space = Space::three_dimensional;
  SeedLot lot{"ball", diameter, 4e-5, Shape::ball, 1};
  lot.sizes = {SizeDistribution::Kind::uniform, diameter, 0, 0.9 * diameter, 1.1 * diameter, {}, {}};
  scene.lots = {lot};
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.5, 0.5, 0, 0};
  scene.contact.friction_model = FrictionModel::spring;
  scene.tray.name = "tray";
  scene.tray.length = 8 * diameter, scene.tray.depth = 8 * diameter, scene.tray.height = 0.2;
  scene.tray.sides = scene.tray.front_and_back = Sides::periodic;
  scene.tray.fill = Fill{1000, Packing::poured, 0, false};
  scene.run.duration = 10;
  return scene;
}

/// Volume of a ball between two heights, m3; both from its centre.
double slice_volume(double radius, double from, double to) {
  const double a = std::clamp(from, -radius, radius), b = std::clamp(to, -radius, radius);
  return std::numbers::pi * (radius * radius * (b - a) - (b * b * b - a * a * a) / 3);
}

/// Inside, three diameters off the floor and off the top.
struct Inside {
  double from = 3 * diameter, to = 9 * diameter;  // m
  double packing_fraction = 0, coordination_number = 0;
};

Inside look(const Simulation& run) {
  const Grains& g = run.grains();
  const Vessel& tray = run.model().scene.tray;
  const double floor = run.field().walls().poses().front().displacement.y();
  Inside inside;
  double volume = 0, contacts = 0, balls = 0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double height = g.y[i] - floor;
    volume += slice_volume(g.radius[i], inside.from - height, inside.to - height);
    if (height < inside.from || height > inside.to) continue;
    ++balls;
    for (std::size_t j = 0; j < g.size(); ++j) {
      const double dx = std::remainder(g.x[i] - g.x[j], tray.length);
      const double dz = std::remainder(g.z[i] - g.z[j], *tray.depth);
      if (i != j && std::hypot(dx, g.y[i] - g.y[j], dz) < g.radius[i] + g.radius[j]) ++contacts;
    }
  }
  inside.packing_fraction = volume / (tray.length * *tray.depth * (inside.to - inside.from));
  inside.coordination_number = contacts / balls;
  return inside;
}

TEST(Bed3d, PouredBallsLieLooselyAndShakenOnesDenser) {
  Simulation run(prepare_to_run(bed()), 1);
  ASSERT_TRUE(run.run_until(0.4));
  const Inside poured = look(run);
  EXPECT_GT(poured.packing_fraction, 0.56);
  EXPECT_LT(poured.packing_fraction, 0.63);
  EXPECT_GT(poured.coordination_number, 4);  // of rough balls at rest at least 4, of smooth ones 6
  EXPECT_LT(poured.coordination_number, 6.5);

  // Thrown up by twice its weight, thirty times a second.
  run.set_motion(0, HarmonicMotion{std::numbers::pi / 2, 0.55e-3, 30});
  ASSERT_TRUE(run.run_until(1.6));
  run.set_motion(0, std::nullopt);
  ASSERT_TRUE(run.run_until(1.9));
  const Inside shaken = look(run);
  EXPECT_GT(shaken.packing_fraction, poured.packing_fraction + 0.005);
  EXPECT_LT(shaken.packing_fraction, 0.66);
  RecordProperty("poured", std::to_string(poured.packing_fraction) + " " + std::to_string(poured.coordination_number));
  RecordProperty("shaken", std::to_string(shaken.packing_fraction) + " " + std::to_string(shaken.coordination_number));
}

/// Balls that rain all over a tray roll to its middle down a groove that is drawn out along it.
TEST(Bed3d, InAGrooveAlongTheTrayBallsRollToTheMiddle) {
  Scene scene = bed();
  scene.contact.seed.friction = scene.contact.wall.friction = 0.1;
  Vessel& tray = scene.tray;
  tray.sides = tray.front_and_back = Sides::walls;
  tray.depth = 20 * diameter, tray.height = 0.1;
  tray.fill.reset();
  tray.rain = Rain{.rate = 200, .from = 0, .to = tray.length, .height = 0.05, .stop = 0.2};
  const double middle = *tray.depth / 2, slope = 0.5;
  for (const bool groove : {false, true}) {
    if (groove)
      tray.pieces = {{.a = {0, slope * middle}, .b = {middle, 0}},
                     {.a = {middle, 0}, .b = {*tray.depth, slope * middle}}};
    for (WallPiece& piece : tray.pieces) piece.drawn_out = DrawnOut::along;
    Simulation run(prepare_to_run(scene), 1);
    ASSERT_TRUE(run.run_until(0.8));
    const Grains& balls = run.grains();
    EXPECT_GE(balls.size(), 38u);
    double furthest = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      furthest = std::max(furthest, std::abs(balls.z[i] - middle));
      EXPECT_GT(balls.y[i], groove ? slope * std::abs(balls.z[i] - middle) : 0) << "above the slopes";
    }
    if (groove)
      EXPECT_LT(furthest, 0.35 * middle);
    else
      EXPECT_GT(furthest, 0.8 * middle) << "on a flat floor they lie all over it";
  }
}

TEST(Bed3d, TheWheatTrayStartsWithGrainsInPlaceOfBalls) {
  const auto height_of_tray = [](const std::vector<Override>& changes) {
    const Simulation run(prepare_to_run(read_scene(data_directory() / "seeders" / "wheat-tray-3d.toml", changes)), 1);
    const std::vector<double>& y = run.grains().y;
    EXPECT_EQ(y.size(), 9400u + 2400u);
    return *std::max_element(y.begin(), y.begin() + 9400);
  };
  EXPECT_LT(height_of_tray({}), 1.25 * height_of_tray({parse_override("seeds.wheat.crop=wheat-ball")}));
}

}  // namespace
}  // namespace vibrosow
