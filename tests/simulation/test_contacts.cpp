// Contacts one by one add up to what the integrators are given.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "scene/make_clump.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

using Vector = Eigen::Vector3d;

Vector as_vector(const std::array<double, 3>& a) {
  return {a[0], a[1], a[2]};
}

/// A shaken bed with friction that remembers, periodic or with walls, of single grains or clumps.
Scene shaken_bed(Space space, Sides sides, bool clumps) {
  Scene scene = Bench().scene;
  scene.space = space;
  scene.tray.length = 0.06, scene.tray.height = 0.2, scene.tray.sides = sides;
  scene.tray.fill = Fill{60, Packing::layers, 1e-3, false};
  scene.tray.motion = HarmonicMotion{0, 0.004, 10, 0.01};
  scene.lots[0].shape = space == Space::two_dimensional ? Shape::disc : Shape::ball;
  if (space == Space::three_dimensional) scene.tray.depth = 0.03;
  if (clumps) {
    scene.lots[0].shape = Shape::clump;
    make_clump(scene.lots[0], {{-2e-3, 0, 3e-3}, {2e-3, 0, 3e-3}}, space);
  }
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.4, 0.5};
  scene.contact.friction_model = FrictionModel::spring;
  scene.run.duration = 0.3;
  return scene;
}

void expect_sums_to_be_the_forces(Simulation& run) {
  run.field().evaluate(run.time(), {});  // sliding friction's speeds are those of now
  std::map<std::int64_t, Vector> sums;
  const std::vector<GrainContact> contacts = run.field().contacts();
  std::ptrdiff_t walls = 0;
  for (const GrainContact& c : contacts) {
    const Vector normal = as_vector(c.normal_force), along = as_vector(c.tangential_force);
    const Vector apart = as_vector(c.to) - as_vector(c.from);
    EXPECT_GT(c.overlap, 0);
    EXPECT_LE(std::abs(normal.dot(along)), 1e-12 * (normal.squaredNorm() + along.squaredNorm()));
    EXPECT_LE(normal.cross(apart).norm(), 1e-9 * normal.norm() * apart.norm());
    sums.try_emplace(c.grain, Vector::Zero()).first->second += normal + along;
    if (c.partner >= 0)
      sums.try_emplace(c.partner, Vector::Zero()).first->second -= normal + along;
    else
      ++walls;
  }
  EXPECT_GT(walls, 5);
  EXPECT_GT(std::ssize(contacts) - walls, 30);
  double largest = 0;
  for (std::size_t i = 0; i < run.grains().size(); ++i) largest = std::max(largest, force_on(run, i).norm());
  run.field().evaluate(run.time(), {});
  for (std::size_t i = 0; i < run.grains().size(); ++i) {
    const auto sum = sums.find(run.grains().id[i]);
    const Vector added = sum == sums.end() ? Vector(Vector::Zero()) : sum->second;
    EXPECT_LE((added - force_on(run, i)).norm(), 1e-10 * largest) << "grain " << i;
  }
}

struct Case {
  Space space;
  Sides sides;
  bool clumps;
  // Not its bytes, of which some are never set.
  friend void PrintTo(const Case& one, std::ostream* out) {
    *out << (one.space == Space::three_dimensional ? "3D" : "2D") << (one.sides == Sides::periodic ? ", periodic" : "")
         << (one.clumps ? ", clumps" : "");
  }
};
class ContactsOf : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Contacts, ContactsOf,
                         testing::Values(Case{Space::two_dimensional, Sides::walls, false},
                                         Case{Space::two_dimensional, Sides::periodic, false},
                                         Case{Space::two_dimensional, Sides::walls, true},
                                         Case{Space::three_dimensional, Sides::walls, false},
                                         Case{Space::three_dimensional, Sides::periodic, false},
                                         Case{Space::three_dimensional, Sides::walls, true}));

TEST_P(ContactsOf, ABedAddUpToTheForcesOnItsGrains) {
  const Case c = GetParam();
  Simulation run(with_step(prepare(shaken_bed(c.space, c.sides, c.clumps)), 5e-5), 1);
  ASSERT_TRUE(run.run_until(0.25));
  expect_sums_to_be_the_forces(run);
}

TEST(Contacts, AreLookedAtWithoutATrace) {
  const Model model = with_step(prepare(shaken_bed(Space::two_dimensional, Sides::walls, false)), 5e-5);
  Simulation seen(model, 1), unseen(model, 1);
  seen.watch(0.001, [](Simulation& now) { EXPECT_FALSE(now.frame().bed.x.empty()); });
  ASSERT_TRUE(seen.run_until(0.3));
  ASSERT_TRUE(unseen.run_until(0.3));
  EXPECT_EQ(seen.grains().x, unseen.grains().x);
  EXPECT_EQ(seen.grains().omega, unseen.grains().omega);
}

}  // namespace
}  // namespace vibrosow
