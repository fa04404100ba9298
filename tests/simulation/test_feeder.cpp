#include "simulation/feeder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "plan/effects.hpp"
#include "scene/clump_shape.hpp"
#include "scene/seed_lot.hpp"
#include "simulation/simulation.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

using Kind = SizeDistribution::Kind;

Scene kept_full(const SeedLot& lot) {
  Scene scene;
  scene.lots = {lot};
  scene.contact.seed.friction = 0.3;
  scene.tray.name = "tray";
  scene.tray.length = 0.2;
  scene.tray.height = 1;
  scene.tray.fill = Fill{300, Packing::poured, 1e-3, true};
  scene.run.duration = 1;
  return scene;
}

SeedLot scattered_balls() {
  SeedLot lot{"a", 4e-3, 4e-5, Shape::ball, 1};
  lot.sizes = {Kind::uniform, 4e-3, 0, 3e-3, 5e-3, {}, {}};
  return lot;
}

SeedLot grains_of_wheat() {
  SeedLot lot{"a", 0, 4e-5, Shape::clump, 1};
  lot.discs = about_centre_of_mass(elongated(7e-3, 3e-3));
  lot.gyration2 = plate_of(lot.discs).gyration2;
  lot.diameter = 2 * holding_radius(lot.discs);
  return lot;
}

/// Every grain has a size of its own within the lot's, and the density of all.
void expect_scattered(const Grains& grains) {
  std::set<double> radii;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    radii.insert(grains.radius[i]);
    EXPECT_GE(grains.radius[i], 1.5e-3);
    EXPECT_LE(grains.radius[i], 2.5e-3);
    EXPECT_NEAR(grains.mass[i], 4e-5 * std::pow(grains.radius[i] / 2e-3, 3), 1e-18);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(std::hypot(grains.x[i] - grains.x[j], grains.y[i] - grains.y[j]),
                (grains.radius[i] + grains.radius[j]) * (1 - 1e-5));
  }
  EXPECT_EQ(radii.size(), 300u);
}

/// A feeder and vessels without any grain.
struct Fed {
  Model model;
  SimulationState state;
  Walls walls;
  Feeder feeder;

  explicit Fed(const Scene& scene)
      : model(prepare(scene)),
        state(starting_state(model, 1, none(model))),
        walls(model.vessels, model.scene.space),
        feeder(model, state.feeder) {
    walls.place(0);
  }
  static Grains none(const Model& model) { return no_grains(model); }
};

TEST(Sizes, OfStartingGrainsAreDrawn) {
  const Scene scene = kept_full(scattered_balls());
  const Model model = prepare(scene);
  ASSERT_TRUE(model.effects.polydisperse) << "one lot, many sizes";
  const Grains grains = starting_state(model, 1).grains;
  ASSERT_EQ(grains.size(), 300u);
  expect_scattered(grains);
}

TEST(Sizes, OfFedGrainsAreDrawn) {
  Fed fed(kept_full(scattered_balls()));
  auto& [model, state, walls, feeder] = fed;
  Grains& grains = state.grains;
  EXPECT_EQ(feeder.top_up(grains, std::vector<char>(grains.size(), 1), walls, 0), 300);
  expect_scattered(grains);
  EXPECT_TRUE(grains.angle.empty());
}

TEST(Angles, OfFedClumpsAreDrawn) {
  Fed fed(kept_full(grains_of_wheat()));
  auto& [model, state, walls, feeder] = fed;
  Grains& grains = state.grains;
  const int added = feeder.top_up(grains, std::vector<char>(grains.size(), 1), walls, 0);
  EXPECT_EQ(added, 300);
  ASSERT_EQ(grains.angle.size(), 300u);
  EXPECT_EQ(std::set<double>(grains.angle.begin(), grains.angle.end()).size(), 300u);
  EXPECT_EQ(feeder.top_up(grains, std::vector<char>(grains.size(), 1), walls, 0), 0);
}

TEST(Feeder, SaysThatItFallsBehind) {
  Scene scene = kept_full(scattered_balls());
  const auto warning = [&] {
    Fed fed(scene);
    fed.feeder.top_up(fed.state.grains, {}, fed.walls, 0.5);
    const std::vector<std::string> warnings = fed.feeder.warnings(0.5);
    return warnings.empty() ? std::string() : warnings.front();
  };
  EXPECT_EQ(warning(), "");
  scene.tray.height = 8e-3;  // room for two layers of 300 balls' six
  EXPECT_THAT(warning(), testing::StartsWith("tray.fill.keep falls behind: "));
  EXPECT_THAT(warning(), testing::HasSubstr(" of 300 seeds missing at 0.5 s"));
}

TEST(Feeder, SaysThatItsVesselWasTippedOver) {
  Scene scene = kept_full(scattered_balls());
  scene.tray.motion = TableMotion{{0, 0.05, 0.1, 0.2}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 1, 2.1, 2.1}, {}};
  Fed fed(scene);
  fed.walls.place(0.15);
  fed.feeder.top_up(fed.state.grains, {}, fed.walls, 0.15);
  const std::vector<std::string> warnings = fed.feeder.warnings(0.15);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "tray.fill.keep falls behind: 300 of 300 seeds missing at 0.15 s, as the tray was tipped over");
}

TEST(Feeder, LaysSeedsDownAsTheirVesselMoves) {
  for (const Space space : {Space::two_dimensional, Space::three_dimensional})
    for (const VesselMotion& motion :
         {VesselMotion(HarmonicMotion{0.4, 0.02, 5}), VesselMotion(RockingMotion{{0.05, 0}, 0.05, 5})}) {
      Scene scene = kept_full(scattered_balls());
      scene.space = space;
      if (space == Space::three_dimensional) scene.tray.depth = 0.1;
      scene.tray.motion = motion;
      Fed fed(scene);
      constexpr double time = 0.02;
      fed.walls.place(time);
      ASSERT_EQ(fed.feeder.top_up(fed.state.grains, {}, fed.walls, time), 300);
      const Pose pose = fed.walls.pose(0, time);
      const PoseRate rate = fed.walls.rate(0, time);
      const Grains& g = fed.state.grains;
      double fastest = 0;
      for (std::size_t i = 0; i < g.size(); ++i) {
        const Eigen::Vector3d expected = point_velocity(scene.tray, pose, rate, place_of(g, i));
        EXPECT_LT((velocity_of(g, i) - expected).norm(), 1e-12);
        fastest = std::max(fastest, expected.norm());
      }
      EXPECT_GT(fastest, 0.1);
    }
}

/// m, between the centres of two seeds, or of one and the other's nearest image in a periodic tray.
double apart(const Vessel& tray, const Grains& grains, std::size_t i, std::size_t j) {
  Eigen::Vector3d way = place_of(grains, i) - place_of(grains, j);
  if (tray.sides == Sides::periodic) way.x() = std::remainder(way.x(), tray.length);
  if (grains.is_3d && tray.front_and_back == Sides::periodic) way.z() = std::remainder(way.z(), *tray.depth);
  return way.norm();
}

void expect_clear(const Vessel& tray, const Grains& grains) {
  for (std::size_t i = 0; i < grains.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      ASSERT_GE(apart(tray, grains, i, j), grains.kind(i).radius + grains.kind(j).radius) << i << ' ' << j;
}

/// A narrow tray in 3D that goes on to all sides.
Scene endless() {
  Scene scene = kept_full(scattered_balls());
  scene.space = Space::three_dimensional;
  scene.tray.length = 0.03;
  scene.tray.depth = 0.02;
  scene.tray.sides = scene.tray.front_and_back = Sides::periodic;
  return scene;
}

/// Seeds that lie at the seams of that tray, and so reach in from the other side too.
void add_at_the_seams(Fed& fed, double height) {
  const auto add = [&](double x, double z) {
    fed.state.grains.add(Eigen::Vector3d(x, height, z), Eigen::Vector3d::Zero(), 0, fed.model.kinds[0]);
  };
  for (int k = 0; k < 6; ++k) add(2.5e-3 + 5e-3 * k, 1e-4);
  for (int k = 0; k < 3; ++k) add(1e-4, 6e-3 + 5e-3 * k);
}

TEST(Feeder, LaysNothingIntoImagesAcrossASeam) {
  const Scene scene = endless();
  Fed fed(scene);
  add_at_the_seams(fed, 2.5e-3);
  Grains& grains = fed.state.grains;
  ASSERT_EQ(fed.feeder.top_up(grains, std::vector<char>(grains.size(), 1), fed.walls, 0), 300 - 9);
  expect_clear(scene.tray, grains);
}

TEST(Feeder, RainsNothingOntoImagesAcrossASeam) {
  Scene scene = endless();
  scene.tray.fill.reset();
  scene.tray.rain = Rain{1e5, 0, scene.tray.length, 0.5};
  Fed fed(scene);
  add_at_the_seams(fed, 0.5);
  Grains& grains = fed.state.grains;
  for (int k = 1; k <= 5; ++k) fed.feeder.rain(grains, fed.walls, 0.01 * k);  // a thousand more each time
  ASSERT_GT(grains.size(), 9U + 4);                                           // as many as have room side by side
  ASSERT_LT(grains.size(), 60U);
  expect_clear(scene.tray, grains);
}

TEST(Feeder, LaysNothingOverTheWalls) {
  for (const Space space : both_spaces) {
    Scene scene = kept_full(scattered_balls());
    scene.space = space;
    if (space == Space::three_dimensional) scene.tray.length = 0.04, scene.tray.depth = 0.04;
    scene.tray.height = 12e-3;
    Fed fed(scene);
    Grains& grains = fed.state.grains;
    const int added = fed.feeder.top_up(grains, {}, fed.walls, 0);
    EXPECT_GT(added, 30);
    EXPECT_LT(added, 300) << "some have no room";
    double most = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) most = std::max(most, grains.y[i] + grains.radius[i]);
    EXPECT_LE(most, scene.tray.height * (1 + 1e-12));
    EXPECT_GT(most, scene.tray.height - 2e-3);
  }
}

TEST(Feeder, RainsNothingIntoAWall) {
  for (const Space space : both_spaces) {
    Scene scene = kept_full(scattered_balls());
    scene.space = space;
    if (space == Space::three_dimensional) scene.tray.depth = 0.1;
    scene.tray.fill.reset();
    scene.tray.rain = Rain{1e4, 0, scene.tray.length, 1.9e-3};  // over a floor that the larger seeds would reach into
    Fed fed(scene);
    Grains& grains = fed.state.grains;
    for (int k = 1; k <= 20; ++k) {
      fed.feeder.rain(grains, fed.walls, 1e-2 * k);
      if (grains.size() > 0) {
        EXPECT_LE(*std::ranges::max_element(grains.radius), 1.9e-3 * (1 + 1e-8));
      }
    }
  }
}

/// A tray of one seed's width, wanted to hold one seed more than it does; the height at which it is laid, in radii.
double laid_over(const std::vector<double>& heights, bool in_the_heap) {
  Scene scene = kept_full({"a", 4e-3, 4e-5, Shape::ball, 1});
  scene.tray.length = 4.2e-3;
  scene.tray.fill->count = static_cast<int>(heights.size()) + 1;
  Fed fed(scene);
  Grains& grains = fed.state.grains;
  for (const double height : heights) grains.add(2.1e-3, 2e-3 * height, 0, 0, 0);
  const std::size_t before = grains.size();
  EXPECT_EQ(fed.feeder.top_up(grains, std::vector<char>(before, in_the_heap ? 1 : 0), fed.walls, 0), 1);
  expect_clear(scene.tray, grains);
  return grains.y.back() / 2e-3;
}

/// A heap that sinks fast is fed fast: not only over what still falls from high above.
TEST(Feeder, LaysSeedsBetweenThoseThatFallAndOnTheHeap) {
  EXPECT_NEAR(laid_over({}, false), 1, 1e-9) << "on the floor";
  EXPECT_NEAR(laid_over({100}, false), 1, 1e-9) << "under one that falls";
  EXPECT_NEAR(laid_over({100}, true), 102, 0.03) << "on one that lies";
  EXPECT_NEAR(laid_over({2}, false), 4, 0.03) << "there is no room under it";
  EXPECT_NEAR(laid_over({5.5, 3}, false), 7.5, 0.03) << "nor between these two, whichever comes first";
  EXPECT_NEAR(laid_over({9, 3}, false), 5, 0.03) << "but between these";
}

TEST(Feeder, DrawsLotsByTheirShares) {
  Scene scene = kept_full(scattered_balls());
  SeedLot other = scattered_balls();
  other.name = "b";
  scene.lots[0].number_fraction = 0.7, other.number_fraction = 0.3;
  scene.lots.push_back(other);
  scene.tray.fill->count = 2000, scene.tray.height = 10;
  Fed fed(scene);
  ASSERT_EQ(fed.feeder.top_up(fed.state.grains, {}, fed.walls, 0), 2000);
  const auto of_first = std::ranges::count(fed.state.grains.lot, 0);
  EXPECT_NEAR(static_cast<double>(of_first) / 2000, 0.7, 4 * std::sqrt(0.7 * 0.3 / 2000));
}

/// In a tray that has not room for all that is missing, a seed that waits comes before others: else what is fed is what
/// fits.
TEST(Feeder, FeedsWhatIsDrawnAndNotWhatFits) {
  for (const Space space : {Space::two_dimensional, Space::three_dimensional}) {
    Scene scene = kept_full({"small", 3e-3, 2e-5, Shape::ball, 0.5});
    scene.lots.push_back({"large", 9e-3, 2e-4, Shape::ball, 0.5});
    scene.space = space;
    if (space == Space::three_dimensional) scene.tray.depth = 0.03;
    scene.tray.length = 0.05, scene.tray.height = 0.02;
    scene.tray.fill->count = space == Space::two_dimensional ? 20 : 60;
    Fed fed(scene);
    Grains& grains = fed.state.grains;
    std::ptrdiff_t large = 0;
    std::size_t all = 0;
    for (int round = 0; round < 200; ++round) {
      fed.feeder.top_up(grains, std::vector<char>(grains.size(), 1), fed.walls, 0);
      ASSERT_LT(static_cast<int>(grains.size()), scene.tray.fill->count) << "there is room for all";
      large += std::ranges::count(grains.lot, 1);
      all += grains.size();
      grains = no_grains(fed.model);
    }
    const double share = static_cast<double>(large) / static_cast<double>(all);
    EXPECT_NEAR(share, 0.5, 4 * 0.5 / std::sqrt(static_cast<double>(all))) << all;
  }
}

TEST(Feeder, KeepsTheSizeOfASeedThatWaits) {
  Scene scene = kept_full(scattered_balls());
  scene.tray.length = 0.03, scene.tray.height = 6e-3, scene.tray.fill->count = 12;
  Fed fed(scene);
  Grains& grains = fed.state.grains;
  double sum = 0, all = 0;
  for (int round = 0; round < 500; ++round) {
    fed.feeder.top_up(grains, std::vector<char>(grains.size(), 1), fed.walls, 0);
    ASSERT_LT(grains.size(), 12u) << "there is room for all";
    for (std::size_t i = 0; i < grains.size(); ++i) sum += 2 * grains.radius[i], ++all;
    grains = no_grains(fed.model);
  }
  EXPECT_NEAR(sum / all, 4e-3, 4 * 2e-3 / std::sqrt(12 * all)) << "uniform from 3 to 5 mm";
}

TEST(Feeder, LaysNothingIntoAGrainThatReachesInThroughAnOutlet) {
  Scene scene = kept_full(scattered_balls());
  scene.tray.holes = {{0.5 * scene.tray.length, 0.9 * scene.tray.length}};
  Fed fed(scene);
  auto& [model, state, walls, feeder] = fed;
  Grains& grains = state.grains;
  const double radius = grains.kinds.front().radius;
  for (int k = 0; k < 40; ++k)  // a row that hangs through the floor, centres just below it
    grains.add((k + 0.5) * scene.tray.length / 40, -0.2 * radius, 0, 0, 0);
  const std::size_t below = grains.size();
  feeder.top_up(grains, std::vector<char>(below, 1), walls, 0);
  ASSERT_GT(grains.size(), below);
  for (std::size_t i = below; i < grains.size(); ++i)
    for (std::size_t j = 0; j < below; ++j)
      EXPECT_GE(std::hypot(grains.x[i] - grains.x[j], grains.y[i] - grains.y[j]),
                grains.kind(i).radius + grains.kind(j).radius);
}

}  // namespace
}  // namespace vibrosow
