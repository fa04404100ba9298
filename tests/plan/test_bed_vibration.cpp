// The bed that Verlet's step is planned from: how it is packed, and the step that it allows, against closed forms and
// against what the scheme does.
#include "plan/bed_vibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "plan/meeting.hpp"
#include "plan/model.hpp"
#include "scene/mixture.hpp"
#include "support/bench.hpp"
#include "support/solid_clumps.hpp"

namespace vibrosow {
namespace {

/// What `prepare` plans a step from.
struct Basis {
  explicit Basis(const Scene& scene)
      : model(prepare(scene)),
        sizes(sizes_of(model.scene.lots)),
        touching(model.kinds),
        step{model.scene, model.effects, model.contacts, *model.law,
             model.kinds, touching,      model.loads,    model.smallest_radius} {}

  Model model;
  std::vector<SeedSizes> sizes;
  std::vector<GrainKind> touching;
  StepBasis step;
};

/// Of many sizes, so that no lattice bounds the step.
Scene scene_of(Space space, double restitution, bool springs) {
  Bench bench(space);
  Scene& scene = bench.scene;
  scene.contact.seed = scene.contact.wall = {springs ? 0.3 : 0, restitution};
  scene.contact.friction_model = FrictionModel::spring;
  scene.lots[0].sizes = {SizeDistribution::Kind::uniform, 8e-3, 0, 7.9e-3, 8.1e-3, {}, {}};
  return scene;
}

BedSeed seed_of(const Basis& basis) {
  const GrainKind& kind = basis.model.kinds.front();
  return {0,
          1,
          kind,
          {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()},
          {{kind, Eigen::Vector3d::Zero()}}};
}

/// h^2 k / 4 + h c / 2 over 1 + c h / (2 m_c), times `per_mass`: what is to be 9/16, or 9/10 of a lattice.
double used(double h, double stiffness, double dashpot, double yield, double per_mass) {
  return per_mass * (h * h * stiffness / 4 + h * dashpot / 2) / (1 + h * dashpot * yield / 2);
}

TEST(BedVibration, OfAPairIsThatOfItsSpringAndDashpot) {
  for (const Space space : both_spaces)
    for (const double restitution : {1.0, 0.5, 0.1}) {
      const Basis basis(scene_of(space, restitution, false));
      const GrainKind& kind = basis.model.kinds.front();
      const PackedBed bed{{seed_of(basis), seed_of(basis)}, {{0, 1, 0, 0, Eigen::Vector3d(0.6, 0.8, 0)}}};
      const double k = with_grain(basis.step, kind, kind).stiffness, per_mass = 2 / kind.mass;
      const double zeta = basis.model.contacts.pairs.front().damping_ratio;
      const double dashpot = 2 * zeta * std::sqrt(k / per_mass);
      EXPECT_NEAR(used(longest_stable_step(basis.step, bed), k, dashpot, per_mass, per_mass), 9.0 / 16, 0.004)
          << restitution;
    }
}

/// However few of them touch in the bed, equal seeds may come to lie as close as can be. There, without friction, the
/// square of their fastest vibration is 6 k / m in the plane and 8 k / m in space.
TEST(BedVibration, OfEqualSeedsHoldsForTheirClosestPackingToo) {
  for (const Space space : both_spaces)
    for (const double restitution : {1.0, 0.5}) {
      Scene scene = scene_of(space, restitution, false);
      scene.lots[0].sizes = {};
      const Basis basis(scene);
      const GrainKind& kind = basis.model.kinds.front();
      const PackedBed bed{{seed_of(basis), seed_of(basis)}, {{0, 1, 0, 0, Eigen::Vector3d(0.6, 0.8, 0)}}};
      const double k = with_grain(basis.step, kind, kind).stiffness, yield = 2 / kind.mass;
      const double dashpot = 2 * basis.model.contacts.pairs.front().damping_ratio * std::sqrt(k / yield);
      const double fastest = (space == Space::two_dimensional ? 6 : 8) / kind.mass;
      EXPECT_NEAR(used(longest_stable_step(basis.step, bed), k, dashpot, yield, fastest), 9.0 / 10, 0.006)
          << restitution;
    }
}

TEST(BedVibration, OfABallBetweenPlatesIsTheFasterOfItsTwo) {
  const Basis basis(scene_of(Space::three_dimensional, 0.5, true));
  const GrainKind& kind = basis.model.kinds.front();
  const PackedBed bed{{seed_of(basis)},
                      {{0, BedContact::plate, 0, 0, Eigen::Vector3d::UnitY()},
                       {0, BedContact::plate, 0, 0, -Eigen::Vector3d::UnitY()}}};
  const double k = on_wall(basis.step, kind).stiffness;
  const SurfaceParameters& wall = basis.model.contacts.walls.front();
  const double dashpot = 2 * wall.damping_ratio * std::sqrt(k * kind.mass);
  // Spinning between them, held by both springs at their rims: 2 r^2 / I; the spring's own part is 1/m + r^2 / I.
  const double spins = 2 * kind.radius * kind.radius * kind.inverse_inertia, yield = 1 / kind.mass + spins / 2;
  const double h = longest_stable_step(basis.step, bed);
  const double to_and_fro = used(h, k, dashpot, 1 / kind.mass, 2 / kind.mass);
  const double spinning = used(h, wall.tangential_ratio * k, wall.tangential_damping * dashpot, yield, spins);
  EXPECT_NEAR(std::max(to_and_fro, spinning), 9.0 / 16, 0.004);
  EXPECT_GT(spinning, to_and_fro);
}

/// Contacts of seeds with others and with plates, a seed.
double contacts_a_seed(const PackedBed& bed) {
  double count = 0;
  for (const BedContact& contact : bed.contacts) count += contact.b == BedContact::plate ? 1 : 2;
  return count / static_cast<double>(bed.seeds.size());
}

TEST(PackedBed, HasTheContactsOfOneThatHolds) {
  Scene plane = Bench(Space::two_dimensional).scene, space = Bench(Space::three_dimensional).scene;
  EXPECT_GT(contacts_a_seed(packed_bed(Basis(plane).step)), 3.7);  // four
  EXPECT_LT(contacts_a_seed(packed_bed(Basis(plane).step)), 6.01);
  EXPECT_GT(contacts_a_seed(packed_bed(Basis(space).step)), 5.5);  // six, but for those that rattle
  EXPECT_LT(contacts_a_seed(packed_bed(Basis(space).step)), 9);
  const Basis clumps(clump_scene(solid_lot(dipole(4e-3, 4e-3), 1e-4)));
  EXPECT_GT(contacts_a_seed(packed_bed(clumps.step)), 8);  // five ways to move, without friction
  EXPECT_LT(contacts_a_seed(packed_bed(clumps.step)), 14);
}

TEST(PackedBed, IsOfSeedsAsStiffAsItsScenesWhateverWasPackedBefore) {
  Scene balls = scene_of(Space::three_dimensional, 0.5, true);
  for (const Scene& scene : {balls, clump_scene(solid_lot(dipole(4e-3, 4e-3), 1e-4))}) {
    const Basis soft(scene);
    const PackedBed before = packed_bed(soft.step);
    Scene stiffer = scene;
    stiffer.contact.shell_compression /= 7;
    const Basis stiff(stiffer);
    const PackedBed bed = packed_bed(stiff.step);
    ASSERT_EQ(bed.contacts.size(), before.contacts.size());
    ASSERT_EQ(bed.seeds.size(), before.seeds.size());
    for (std::size_t s = 0; s < bed.seeds.size(); ++s) {
      EXPECT_DOUBLE_EQ(bed.seeds[s].kind.compliance, before.seeds[s].kind.compliance / 7);
      for (std::size_t k = 0; k < bed.seeds[s].discs.size(); ++k)
        EXPECT_DOUBLE_EQ(bed.seeds[s].discs[k].kind.compliance, before.seeds[s].discs[k].kind.compliance / 7);
    }
    Scene larger = scene;
    for (SeedLot& lot : larger.lots) lot.mass *= 2;
    const Basis heavy(larger);
    EXPECT_DOUBLE_EQ(packed_bed(heavy.step).seeds.front().kind.mass, 2 * bed.seeds.front().kind.mass);
  }
}

TEST(PackedBed, HasSeedsOfEveryLotAndIsTheSameAgain) {
  Scene scene = Bench(Space::three_dimensional).scene;
  scene.lots.push_back({"rare", 4e-3, 1e-4, Shape::ball, 0.01});
  scene.lots[0].number_fraction = 0.99;
  const Basis basis(scene);
  const PackedBed bed = packed_bed(basis.step), again = packed_bed(basis.step);
  std::map<int, int> seeds;
  for (const BedSeed& seed : bed.seeds) ++seeds[seed.lot];
  EXPECT_GE(seeds[1], 8);
  ASSERT_EQ(bed.contacts.size(), again.contacts.size());
  for (std::size_t k = 0; k < bed.contacts.size(); ++k) EXPECT_EQ(bed.contacts[k].normal, again.contacts[k].normal);
}

}  // namespace
}  // namespace vibrosow
