// Walls: the pair's law, found through Box2D alone, each touched once.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "contact/wall_contacts.hpp"
#include "contact/wall_contacts_3d.hpp"
#include "plan/model.hpp"
#include "support/bench.hpp"
#include "vessel/nearest_on_face.hpp"
#include "vessel/vessel_walls.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {
namespace {

// A wall is a grain of infinite radius and mass with a rigid shell.
TEST(Wall, IsAGrainOfInfiniteRadiusAndMass) {
  for (const Law law : {Law::elastic_shell, Law::hertz}) {
    Bench bench;
    bench.scene.contact.law = law;
    bench.scene.contact.youngs_modulus = 1e9;
    bench.scene.contact.seed = bench.scene.contact.wall = {0.3, 0.5};
    EffectSet effects = prepare(bench.scene).effects;
    effects.polydisperse = true;
    const double overlap = 1e-5, giant = 1e3;
    Scene scene = bench.scene;  // the giant is a lot with a rigid shell
    scene.lots.push_back({"giant", 2 * giant, 1e300, Shape::disc, 0});
    const auto forces = [&](bool as_wall) {
      std::vector<GrainKind> kinds = prepare(bench.scene).kinds;
      kinds.push_back({giant, 1e300, 0, 0, 0});
      Grains grains(kinds, true, true);
      grains.add(0.5, Bench::radius - overlap, 0.07, -0.02, 0);
      grains.omega[0] = 5;
      if (!as_wall) grains.add(0.5, -giant, 0.01, 0.03, 1);
      const PairList pairs = as_wall ? PairList{} : PairList{{0}, {1}};
      const std::vector<PlacedWall> walls{{0, 0, 1, 0, {0.01, 0.03}, {0.01, 0.03}}};
      std::vector<WallCandidate> near;
      if (as_wall) near.push_back({0, 0, 1});
      Forces f(2);
      ContactStatistics statistics;
      const Motion at{grains.x.data(),  grains.y.data(),     grains.vx.data(),
                      grains.vy.data(), grains.omega.data(), grains.x.data()};
      const KernelSet& kernels = kernels_for(law, effects);
      const ContactParameters parameters = prepare(scene).contacts;
      ContactHistories none;
      std::vector<ForeignForce> foreign;
      add_pair_forces(kernels.vectors[0].pair, surfaces_of(grains), at, pairs, {0, static_cast<int>(pairs.size())},
                      parameters, {}, none, {0, 0}, f, foreign, statistics);
      WallContacts contacts;
      WallContactFinder().find(grains, near, 0, walls, contacts);
      add_metrics(kernels.vectors[0].wall(surfaces_of(grains), at, parameters, {}, none, contacts), statistics);
      add_wall_forces(contacts, kernels.effects.rotation, f);
      EXPECT_EQ(statistics.contacts + contacts.count, 1);
      EXPECT_NEAR(statistics.max_relative_overlap, overlap / Bench::radius, 1e-7);
      return f;
    };
    const Forces wall = forces(true), pair = forces(false);
    // The giant's centre is 1 km away: its surface is placed to 1e-13 m, 1e-8 of the overlap, and 1/R* is out by 4e-6.
    const double tolerance = law == Law::elastic_shell ? 1e-6 : 3e-6;
    EXPECT_NEAR(wall[0].fx, pair[0].fx, tolerance * std::abs(pair[0].fx));
    EXPECT_NEAR(wall[0].fy, pair[0].fy, tolerance * std::abs(pair[0].fy));
    EXPECT_NEAR(wall[0].torque, pair[0].torque, tolerance * std::abs(pair[0].torque));
    EXPECT_GT(pair[0].fy, 0);
  }
}

TEST(Wall, AJointOfTwoPiecesPushesOnce) {
  // A funnel's ridge between two holes: two slopes share a vertex; a grain resting on it touches that vertex alone, and
  // the force is one shell's.
  Bench bench;
  bench.scene.tray.holes = {{0.2, 0.1}, {0.8, 0.1}};
  bench.scene.tray.funnel = 0.5;
  const double ridge = std::tan(0.5) * 0.25, overlap = 1e-6;
  bench.place(0.5, ridge + Bench::radius - overlap);
  Simulation& run = bench.start(1e-9);
  const double stiffness = Bench::mass * standard_gravity / (1e-4 * Bench::radius);
  EXPECT_NEAR(run.field().forces()[0].fy, stiffness * overlap, 1e-6 * stiffness * overlap);
}

TEST(Wall, ACentreOnItIsPushedBackToTheSideItCameFrom) {
  Bench bench(Space::two_dimensional), is_3d(Space::three_dimensional);
  for (const double side : {1.0, -1.0}) {
    bench.scene.tray.holes.clear();
    Grains grains(prepare(bench.scene).kinds, false, false);
    grains.add(0.5, 0, 0, 0, 0);
    WallContacts contacts;
    const std::vector<WallCandidate> below = {{0, 0, side}};
    WallContactFinder().find(grains, below, 0, {{0, 0, 1, 0, {0, 1}, {0, 1}}}, contacts);  // above is left: positive
    ASSERT_EQ(contacts.count, 1);
    EXPECT_EQ(contacts.normal_y[0], -side) << "towards the wall";
    Grains balls(prepare(is_3d.scene).kinds, false, false);
    balls.is_3d = true;
    balls.add({0.5, 0, 0.5}, Eigen::Vector3d::Zero(), 0, balls.kinds.front());
    const Walls walls({is_3d.scene.tray}, Space::three_dimensional);
    const int floor = static_cast<int>(walls.named("tray floor 1").front());
    WallContacts3d touched;
    const std::vector<WallCandidate> near = {{0, floor, side}};
    WallFinder3d().find(balls, near, 0, walls.placed_faces(), touched);
    ASSERT_EQ(touched.count, 1);
    EXPECT_EQ(std::abs(touched.normal.y[0]), 1);
    const double above = nearest_on_face(walls.placed_faces()[static_cast<std::size_t>(floor)], {0.5, 0.1, 0.5}).side;
    EXPECT_EQ(touched.normal.y[0], above * side > 0 ? -1 : 1) << "towards the face";
  }
}

TEST(Wall, AVertexIsDroppedWhereAnAdjacentFaceIsTouched) {
  Bench bench;
  bench.scene.tray.holes = {{0.5, 0.1}};
  const double overlap = 1e-4, inside = 1e-5;  // just beside the hole's left edge at 0.45
  bench.place(0.45 - inside, Bench::radius - overlap);
  Simulation& run = bench.start(1e-9);
  const double stiffness = Bench::mass * standard_gravity / (1e-4 * Bench::radius);
  EXPECT_NEAR(run.field().forces()[0].fy, stiffness * overlap, 1e-9 * stiffness * overlap);
  EXPECT_NEAR(run.field().forces()[0].fx, 0, 1e-9 * stiffness * overlap);
}

TEST(Wall, IsKnownToTheContactsThroughBox2DAlone) {
  for (const bool without : {false, true}) {
    Bench bench;
    bench.gravity = {0, -standard_gravity};
    bench.scene.guard.stop_relative_overlap = 100;
    bench.place(0.5, 2 * Bench::radius);
    Simulation& run = bench.start(1e-5);
    const std::vector<WallSegment> walls = vessel_walls(bench.scene.tray);
    if (without)
      for (std::size_t w = 0; w < walls.size(); ++w)
        if (walls[w].name.find("floor") != std::string::npos)
          run.field().neighbours().broadphase().remove_wall(static_cast<int>(w));
    run.field().neighbours().start_afresh();
    run.steps(8000);
    if (without)
      EXPECT_LT(run.grains().size() == 0 ? -1.0 : run.grains().y[0], -0.01) << "nothing else may hold the grain";
    else
      EXPECT_GT(run.grains().y[0], 0.9 * Bench::radius);
  }
}

TEST(Wall, WorkOfAMovingFloorIsAccountedFor) {
  // Elastic grains on a vibrating floor: energy gained is the walls' work, to the schemes' accuracy.
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.tray.motion = HarmonicMotion{1.5707963267948966, 1e-3, 20, 0.05};
  for (int k = 0; k < 10; ++k) bench.place(0.1 + 0.05 * k, (1.5 + 0.3 * k) * Bench::radius);
  Simulation& run = bench.start(bench.contact_time() / 200);
  const double before = kinetic_energy(run.grains()) + potential_energy(run.grains(), bench.gravity);
  run.steps(100000);
  const vibrosow::Run result = run.result();
  ASSERT_GT(std::abs(result.energy.wall_work), 1e-5);
  const double account = result.energy.kinetic + result.energy.potential + result.energy.elastic - before;
  EXPECT_NEAR(account, result.energy.wall_work, 0.01 * std::abs(result.energy.wall_work));
}

}  // namespace
}  // namespace vibrosow
