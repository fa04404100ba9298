// A tray without end walls, and one whose ends are joined.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>
#include <utility>

#include "scene/input_error.hpp"
#include "simulation/simulate.hpp"
#include "support/bench.hpp"
#include "support/same_bits.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

Scene slice() {
  Scene scene = Bench().scene;
  scene.lots = {{"grain", 6e-3, 2e-4, Shape::ball, 0.6}, {"small", 4e-3, 8e-5, Shape::ball, 0.4}};
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.contact.slip_speed = 0.1;
  scene.tray.length = 0.1;
  scene.tray.height = 0.1;
  scene.tray.sides = Sides::periodic;
  scene.tray.fill = Fill{80, Packing::layers, 1e-3, false};
  scene.tray.motion = HarmonicMotion{0.6, 4e-3, 12, 0.1};
  scene.run.duration = 0.5;
  return scene;
}

TEST(OpenSides, GrainsRollOffTheEndsAndAreSpilled) {
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.tray.sides = Sides::open;
  bench.place(0.05, Bench::radius, -0.6, 0).place(0.95, Bench::radius, 0.5, 0).place(0.5, Bench::radius);
  Simulation& run = bench.start(1e-5);
  run.steps(40000);
  ASSERT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
  EXPECT_EQ(run.result().balance.spilled, 2);
  EXPECT_EQ(run.result().balance.inside, 1);
  EXPECT_LT(run.result().events[0].x, 0);
  EXPECT_GT(run.result().events[1].x, 1);
}

TEST(PeriodicSides, AGrainThatLeavesComesInAtTheOtherEnd) {
  for (const double speed : {2.0, -2.0}) {
    Bench bench;
    bench.gravity = {0, -standard_gravity};
    bench.scene.tray.sides = Sides::periodic;
    bench.place(0.6, Bench::radius, speed, 0);
    Simulation& run = bench.start(1e-5);
    run.steps(100000);  // 1 s: two lengths
    ASSERT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
    EXPECT_EQ(run.result().balance.inside, 1);
    EXPECT_NEAR(run.grains().x[0], 0.6, 1e-9);
    EXPECT_NEAR(run.grains().y[0], Bench::radius, 0.001 * Bench::radius) << "the floor goes on beyond the ends";
  }
}

/// A tray in whose period a closed hopper stands, full of seeds at rest: to the seam, or as long as the tray.
Scene slice_under_hopper(Space space, double left, double length) {
  Scene scene = slice();
  scene.space = space;
  scene.tray.fill.reset();
  scene.tray.motion = HarmonicMotion{0, 8e-3, 12, 0};
  Vessel& hopper = scene.hopper.emplace(scene.tray);
  hopper.name = "hopper", hopper.sides = Sides::walls, hopper.motion.reset();
  hopper.origin = {left, 0.12}, hopper.length = length;
  hopper.fill = Fill{40, Packing::layers, 1e-3, false};
  if (space == Space::three_dimensional) {
    scene.tray.depth = hopper.depth = 0.04;
    scene.tray.front_and_back = Sides::periodic;
    hopper.fill->count = 150;
  }
  scene.run.duration = 0.2;
  return scene;
}

TEST(PeriodicSides, AHopperHoldsItsSeedsInEveryPeriod) {
  for (const Space space : {Space::two_dimensional, Space::three_dimensional})
    for (const auto& [left, length] : {std::pair(0.001, 0.09), std::pair(0.0, 0.1), std::pair(0.02, 0.08)})
      for (const double tilt : {0.0, left > 0 ? 0.3 : 0.0}) {
        Scene scene = slice_under_hopper(space, left, length);
        scene.hopper->tilt = tilt;
        const Vessel& hopper = *scene.hopper;
        Simulation run(prepare(scene), 1);
        run.run_until(scene.run.duration);
        ASSERT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
        for (std::size_t i = 0; i < run.grains().size(); ++i) {
          // The hopper's own frame, or that of one in another period.
          const auto is_in = [&](double shift) {
            const Eigen::Vector3d own =
                point_in_vessel(hopper, {}, place_of(run.grains(), i) + Eigen::Vector3d(shift, 0, 0));
            return own.x() > 0 && own.x() < hopper.length && own.y() > 0;
          };
          EXPECT_TRUE(is_in(0) || is_in(0.1) || is_in(-0.1))
              << place_of(run.grains(), i).transpose() << ", left " << left << ", tilt " << tilt;
        }
      }
}

/// In the tray's period the hopper stands at the end that the grain flies away from.
TEST(PeriodicSides, AGrainReboundsFromTheHopperOfThePeriodToEitherSide) {
  for (const Space space : both_spaces)
    for (const int axis : {0, 2})
      for (const double speed : {1.0, -1.0}) {
        if (axis == 2 && space == Space::two_dimensional) continue;
        Bench bench(space);
        Scene& scene = bench.scene;
        scene.tray.height = 0.1;
        scene.tray.sides = scene.tray.front_and_back = Sides::periodic;
        Vessel& hopper = scene.hopper.emplace(scene.tray);
        hopper.name = "hopper", hopper.sides = hopper.front_and_back = Sides::walls;
        hopper.height = 0.4;
        const double beside = 2e-3, from = speed > 0 ? beside : 0.5, to = speed > 0 ? 0.5 : 1 - beside;
        hopper.origin = {axis == 0 ? from : beside, 0.2}, hopper.length = axis == 0 ? to - from : 1 - 2 * beside;
        if (axis == 2) hopper.front = from, hopper.depth = to - from;
        const double wall = speed > 0 ? 1 + beside : -beside, way = 0.03,
                     touch = wall - std::copysign(Bench::radius, speed);
        Eigen::Vector3d at(0.5, 0.4, 0.5);
        at[axis] = touch - way * speed;
        Simulation& run = bench.place(at, speed * Eigen::Vector3d::Unit(axis)).start(1e-5);
        ASSERT_TRUE(run.run_until(2 * way)) << *run.guard().stop_reason();
        EXPECT_NEAR(velocity_of(run.grains(), 0)[axis], -speed, 1e-3) << axis << ", " << speed;
        const double back = touch - (run.time() - way - bench.contact_time()) * speed;
        EXPECT_NEAR(place_of(run.grains(), 0)[axis], back, 0.1 * Bench::radius) << axis << ", " << speed;
      }
}

TEST(PeriodicSides, ASeedAtRestInAHopperDoesNotGoToAndFro) {
  Scene scene = slice_under_hopper(Space::two_dimensional, 0, 0.1);
  scene.tray.motion = HarmonicMotion{0, 12e-3, 12, 0};  // further than the diameter of a seed
  Simulation run(prepare(scene), 1);
  const std::vector<double> before = run.grains().x;
  double farthest = 0;
  run.watch(1e-3, [&](Simulation& now) {
    for (std::size_t i = 0; i < before.size(); ++i)
      farthest = std::max(farthest, std::abs(now.grains().x[i] - before[i]));
  });
  run.run_until(scene.run.duration);
  EXPECT_LT(farthest, 0.5 * scene.tray.length);
}

TEST(PeriodicSides, AKeptHopperCountsItsSeedsInEveryPeriod) {
  Scene scene = slice_under_hopper(Space::two_dimensional, 0.001, 0.09);
  scene.hopper->fill->keep = true;
  Simulation run(prepare(scene), 1);
  run.run_until(scene.run.duration);
  ASSERT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
  EXPECT_EQ(run.grains().size(), 40u);
}

TEST(PeriodicSides, AHopperThatDoesNotClearItsImagesIsRefused) {
  const auto refused = [](const std::function<void(Scene&)>& change) {
    Scene scene = slice_under_hopper(Space::two_dimensional, 0.001, 0.09);
    change(scene);
    try {
      prepare(scene);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused([](Scene&) {}), "");
  EXPECT_EQ(refused([](Scene& scene) { scene.hopper->origin.x() = -1e-17; }), "") << "a rounding is no fault";
  EXPECT_EQ(refused([](Scene& scene) { scene.hopper->origin.x() = 0.02; }),
            "hopper.left: the hopper does not lie within the length of the periodic tray");
  EXPECT_EQ(
      refused([](Scene& scene) { scene.hopper->tilt = 0.5; }),
      "hopper.length: the hopper, as it leans and turns and with its pieces, takes 102.6 mm along a periodic tray "
      "of 100 mm: it would pass through the hopper of the next period");
  EXPECT_EQ(refused([](Scene& scene) {
              scene.hopper->motion = RockingMotion{{0, 0}, 0.5, 3};
            }).substr(0, 14),
            "hopper.length:");
  EXPECT_EQ(refused([](Scene& scene) {
              scene.hopper->pieces.push_back({.a = {-0.02, 0.05}, .b = {0, 0.05}});
            }).substr(0, 14),
            "hopper.length:");
  EXPECT_EQ(refused([](Scene& scene) {
              scene.tray.motion = HarmonicMotion{0, 0.07, 3, 0};
            }),
            "hopper.motion: tray and hopper move by up to 70 mm against each other, too far for a period of 100 mm");
  const auto move = [](Scene& scene) { scene.tray.motion = HarmonicMotion{0, 0.05, 3, 0}; };
  EXPECT_EQ(refused(move), "");
  EXPECT_EQ(refused([move](Scene& scene) {
              move(scene);
              SizeDistribution& sizes = scene.lots[0].sizes;
              sizes.kind = SizeDistribution::Kind::table;
              sizes.diameter = {5.7e-3, 24e-3}, sizes.fraction = {0.99, 0.01};
            }).substr(0, 14),
            "hopper.motion:")
      << "the largest seeds touch walls further on";
}

TEST(PeriodicSides, AHoleCountsModuloTheLength) {
  // Thrown off the right end so as to come down a full length and 0.3 m on, in the first hole.
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.tray.holes = {{0.3, 0.1}, {0.7, 0.1}};
  bench.scene.tray.sides = Sides::periodic;
  const double drop = 0.2, time = std::sqrt(2 * drop / standard_gravity);
  bench.place(0.9, drop, 1.4 / time, 0);
  Simulation& run = bench.start(1e-5);
  run.steps(40000);
  ASSERT_EQ(run.result().events.size(), 1u);
  EXPECT_EQ(run.result().events[0].hole, 1);
  EXPECT_NEAR(run.result().events[0].x, 0.3, 1e-4);
}

TEST(PeriodicSides, FunnelSlopesMeetAtTheSeam) {
  Vessel vessel = slice().tray;
  vessel.holes = {{0.02, 0.02}, {0.09, 0.02}};
  vessel.funnel = 0.5;
  double covered = 0;
  for (const WallSegment& wall : vessel_walls(vessel)) {
    covered += wall.b.x() - wall.a.x();
    EXPECT_GE(wall.a.x(), -0.1 - 1e-15);
    EXPECT_LE(wall.b.x(), 0.2 + 1e-15);
  }
  EXPECT_NEAR(covered, 3 * (0.1 - 0.04), 1e-12);
  // From the hole that ends at 0.1 to the one that begins at 0.11: a ridge at 0.105.
  EXPECT_NEAR(highest_floor(vessel), std::tan(0.5) * 0.5 * 0.05, 1e-12) << "between 0.03 and 0.08";
}

TEST(PeriodicSides, SeamPairsAreThoseOfBruteForce) {
  const Scene scene = slice();
  Simulation run(with_step(prepare(scene), 2e-5), 3);
  const double period = run.field().neighbours().images().front().x;
  EXPECT_EQ(period, 0.1);
  std::size_t met = 0;
  for (int step = 0; step < 20000; ++step) {
    run.step();
    if (step % 7 != 0) continue;
    const Grains& grains = run.grains();
    const PairList& boundary = run.state().contacts.boundaries.front().pairs;
    std::set<std::pair<int, int>> all, found;
    const auto touches = [&](std::size_t i, std::size_t j) {
      return std::hypot(grains.x[j] - grains.x[i] - period, grains.y[j] - grains.y[i]) <
             grains.kind(i).radius + grains.kind(j).radius;
    };
    for (std::size_t i = 0; i < grains.size(); ++i)
      for (std::size_t j = 0; j < grains.size(); ++j)
        if (touches(i, j)) all.emplace(static_cast<int>(i), static_cast<int>(j));
    for (std::size_t k = 0; k < boundary.size(); ++k)
      if (touches(static_cast<std::size_t>(boundary.grain[k]), static_cast<std::size_t>(boundary.partner[k])))
        found.emplace(boundary.grain[k], boundary.partner[k]);
    ASSERT_EQ(found, all) << "step " << step;
    met += all.size();
  }
  EXPECT_GT(met, 500u);
}

class PeriodicPairs : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(Spaces, PeriodicPairs, testing::ValuesIn(both_spaces), named_by_space);

// Two that touch across the seam, along, across and over a corner, as deep as they would within the tray.
TEST_P(PeriodicPairs, PushAsHardAsTwoSideBySide) {
  const bool is_3d = GetParam() == Space::three_dimensional;
  std::vector<Eigen::Vector3d> directions = {{1, 0, 0}, {1, 0.3, 0}, {-1, 0.3, 0}};
  if (is_3d)
    directions.insert(directions.end(), {{0, 0.2, 1}, {0, 0, -1}, {1, 0, 1}, {1, 0.1, -1}, {-1, 0, 1}, {-1, 0, -1}});
  for (Eigen::Vector3d direction : directions) {
    direction.normalize();
    Bench bench(GetParam());
    bench.scene.tray.sides = bench.scene.tray.front_and_back = Sides::periodic;
    const double overlap = 1e-5, apart = 2 * Bench::radius - overlap;
    Eigen::Vector3d at = Eigen::Vector3d::Constant(0.5), other;
    for (const int axis : {0, 2})
      if (direction[axis] != 0) at[axis] = direction[axis] > 0 ? 1 - 0.3 * Bench::radius : 0.3 * Bench::radius;
    other = at + apart * direction;
    for (const int axis : {0, 2}) other[axis] -= std::floor(other[axis]);
    bench.place(at).place(other);
    Simulation& run = bench.start(1e-9);
    const double stiffness = 0.5 * Bench::mass * standard_gravity / (1e-4 * Bench::radius);
    EXPECT_LT((force_on(run, 0) + stiffness * overlap * direction).norm(), 1e-6 * stiffness * overlap) << direction;
    EXPECT_LT((force_on(run, 0) + force_on(run, 1)).norm(), 1e-12 * stiffness * overlap) << direction;
    EXPECT_NEAR(run.field().elastic_energy(), 0.5 * stiffness * overlap * overlap,
                1e-6 * stiffness * overlap * overlap);
    EXPECT_EQ(run.field().touching(), (std::vector<char>{1, 1}));
  }
}

// Whichever of a list's renewals and carryings over a contact goes through, it keeps its memory.
TEST_P(PeriodicPairs, RememberThroughEveryRenewalOfTheLists) {
  Scene scene = slice();
  scene.contact.friction_model = FrictionModel::spring, scene.contact.rolling = Rolling::spring;
  scene.contact.seed.rolling_friction = scene.contact.wall.rolling_friction = 0.1;
  if (GetParam() == Space::three_dimensional) {
    scene.space = Space::three_dimensional;
    scene.tray.length = 0.04, scene.tray.depth = 0.04, scene.tray.front_and_back = Sides::periodic;
    scene.tray.motion =
        HarmonicMotion{.direction = 0.6, .amplitude = 4e-3, .frequency = 12, .ramp = 0.1, .across = 0.5};
  }
  bool remembered = false;
  const auto run = [&](NeighbourMargins margins) {
    auto simulation =
        std::make_unique<Simulation>(with_step(prepare(scene), 5e-5), 3, ComputeOptions{.margins = margins});
    simulation->watch(1e-3, [&](Simulation& now) {
      for (const BoundaryContacts& boundary : now.state().contacts.boundaries)
        for (std::size_t k = 0; k < boundary.pairs.size(); ++k) remembered |= boundary.histories.has_history(k);
    });
    simulation->steps(4000);
    return simulation;
  };
  const auto usual = run({}), other = run({0.3, 0.02, 0.3});
  EXPECT_TRUE(remembered);
  EXPECT_NE(other->field().neighbours().prunes(), usual->field().neighbours().prunes());
  EXPECT_EQ(bits(other->grains()), bits(usual->grains()));
}

// An oblique impact that lasts while both are carried over the seam leaves them as one in the middle of the tray does.
TEST_P(PeriodicPairs, KeepTheirSpringsAcrossTheSeam) {
  for (const int axis : {0, 2})
    for (const double speed : {3.0, -3.0}) {
      if (axis == 2 && GetParam() == Space::two_dimensional) continue;
      const auto after = [&](double place, bool first_ahead) {
        Bench bench(GetParam());
        bench.scene.tray.sides = bench.scene.tray.front_and_back = Sides::periodic;
        Contact& contact = bench.scene.contact;
        contact.shell_compression = 1e-2;  // it lasts 6 ms
        contact.seed = {.friction = 0.5, .restitution = 0.8, .rolling_friction = 0.2};
        contact.friction_model = FrictionModel::spring, contact.rolling = Rolling::spring;
        const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis), across(0, 0.2, 0);
        Eigen::Vector3d at(0.5, 0.5, 0.5);
        at[axis] = place;
        const Eigen::Vector3d arm = (Bench::radius + 1e-5) * along, spin(7, 11, 30);
        const auto behind = [&] { bench.place(at - arm, (speed + 0.1) * along + across, spin); };
        if (!first_ahead) behind();
        bench.place(at + arm, speed * along, -spin);
        if (first_ahead) behind();
        Simulation& run = bench.start(1e-5);
        while (run.time() < 0.012)
          if (!run.step()) throw std::runtime_error(*run.guard().stop_reason());
        EXPECT_EQ(run.field().elastic_energy(), 0);
        std::vector<Eigen::Vector3d> moves;
        for (const std::size_t i : {0u, 1u})
          moves.push_back(velocity_of(run.grains(), i)), moves.push_back(Bench::radius * turning_of(run.grains(), i));
        return moves;
      };
      // Where the first is ahead, the seam's list has the two in the other order than the tray's own.
      for (const bool first_ahead : {false, true}) {
        const auto within = after(0.5, first_ahead), over = after(speed > 0 ? 0.995 : 0.005, first_ahead);
        for (std::size_t k = 0; k < within.size(); ++k)
          EXPECT_LT((within[k] - over[k]).norm(), 1e-9) << axis << ", " << speed << ", " << first_ahead;
      }
    }
}

TEST(PeriodicSides, WithoutAPeriodThereIsNoSeam) {
  Bench bench;
  bench.place(0.5, 0.5);
  const Simulation& run = bench.start(1e-5);
  EXPECT_TRUE(run.field().neighbours().images().empty());
}

}  // namespace
}  // namespace vibrosow
