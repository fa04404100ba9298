// Strong damping and friction, in 2D and in 3D: beds that rest stay silent, beds that slide only creep.
#include <cmath>

#include "scene/make_clump.hpp"
#include "stability/bounds.hpp"

namespace vibrosow {
namespace {

class StrongDamping : public testing::TestWithParam<Space> {
 protected:
  /// Balls of 4 mm that rest in a box, with the step that is chosen for them.
  static Scene damped_bed() {
    Scene scene;
    scene.space = GetParam();
    scene.lots = {{"ball", 4e-3, 40e-6, Shape::ball, 1}};
    scene.contact.shell_compression = is_3d() ? 3e-4 : 1e-4;
    scene.contact.seed = scene.contact.wall = {1.0, 0.1};
    scene.contact.friction_model = FrictionModel::spring;
    if (is_3d()) hold_from_rolling(scene.contact);
    scene.tray.name = "tray";
    scene.tray.length = 0.1, scene.tray.height = 0.2;
    if (is_3d()) scene.tray.length = 0.02, scene.tray.depth = 0.02;
    scene.tray.fill = Fill{balls(), Packing::poured, 0, false};
    scene.run.duration = 0.5;
    return scene;
  }
  static bool is_3d() { return GetParam() == Space::three_dimensional; }
  static int balls() { return is_3d() ? 30 : 200; }
  /// In 3D springs alone leave balls free to roll round each other, and to spin where nothing resists twisting.
  static void hold_from_rolling(Contact& contact) {
    contact.rolling = Rolling::spring;
    for (Surface* surface : {&contact.seed, &contact.wall})
      surface->rolling_friction = surface->twisting_friction = 0.1;
  }
  /// s, from the start on.
  static double settled() { return is_3d() ? 0.2 : 0.3; }

  static Bounds bounds_of(const std::string& name, const Scene& scene) {
    return {name, {scene.space, scene.numerics.integrator, scene.contact.law}, scene.contact};
  }

  static void expect_silence(const std::string& name, const Scene& scene) {
    Simulation run(prepare(scene), 1);
    while (run.time() < settled()) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
    bounds_of(name, scene)
        .at_most("kinetic energy of a grain", kinetic_energy(run.grains()) / balls(),
                 1e-9 * 40e-6 * standard_gravity * 2e-3, "J");
  }

  /// Whether a bed gets to `end` (s); what still moves then only creeps, as friction below its slip speed lets it.
  static void expect_only_creep(const std::string& name, const Scene& scene, double end) {
    Simulation run(prepare(scene), 1);
    while (run.time() < end) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
    EXPECT_GT(run.statistics().slip_raised, 0) << "no hard impact: nothing was tried";
    const double mass = run.model().kinds.front().mass * static_cast<double>(run.grains().size());
    const double speed = std::sqrt(2 * kinetic_energy(run.grains()) / mass);
    bounds_of(name, scene).at_most("speed", speed, scene.contact.slip_speed, "m/s");
  }
};
INSTANTIATE_TEST_SUITE_P(Spaces, StrongDamping, testing::ValuesIn(both_spaces), named_by_space);

TEST_P(StrongDamping, ABedAtRestFallsSilent) {
  for (const Integrator scheme : every_scheme)
    for (const double ratio : {2.0 / 7, 14.0 / 17}) {
      SCOPED_TRACE(testing::Message() << "scheme " << static_cast<int>(scheme) << ", ratio " << ratio);
      Scene scene = damped_bed();
      scene.numerics.integrator = scheme;
      scene.contact.tangential_ratio = ratio;
      expect_silence("bed with friction 1 and e = 0.1 falls silent", scene);
    }
}

TEST_P(StrongDamping, ABedThatSlidesComesToRest) {
  for (const Integrator scheme : every_scheme)
    for (const double rolling : {0.0, 0.1}) {
      SCOPED_TRACE(testing::Message() << "scheme " << static_cast<int>(scheme) << ", rolling friction " << rolling);
      Scene scene = damped_bed();
      scene.numerics.integrator = scheme;
      scene.contact.friction_model = FrictionModel::sliding;
      scene.contact.rolling = Rolling::constant_torque;
      scene.contact.seed.rolling_friction = scene.contact.wall.rolling_friction = rolling;
      scene.contact.seed.twisting_friction = scene.contact.wall.twisting_friction = rolling;
      expect_only_creep(rolling > 0 ? "bed that slides and rolls with friction 1" : "bed that slides with friction 1",
                        scene, settled());
    }
}

/// Forty discs of 2 mm in a rod of 2 cm, in 3D ten balls of it: many of them touch at once when it lies flat, on the
/// floor or another rod.
TEST_P(StrongDamping, RodsThatSlideComeToRest) {
  Scene scene = damped_bed();
  std::vector<ClumpDisc> rod;
  const int discs = is_3d() ? 10 : 40;
  for (int k = 0; k < discs; ++k) rod.push_back({0.5e-3 * (k - 0.5 * (discs - 1)), 0, 1e-3});
  scene.lots[0].name = "rod";
  make_clump(scene.lots[0], rod, GetParam());
  scene.tray.fill->count = 12;
  scene.contact.friction_model = FrictionModel::sliding, scene.contact.rolling = Rolling::none;
  expect_only_creep("rods that slide and lie flat", scene, is_3d() ? 0.2 : 0.05);
}

TEST_P(StrongDamping, HertzWithFrictionTwoFallsSilent) {
  Scene scene = damped_bed();
  scene.contact.law = Law::hertz;
  scene.contact.youngs_modulus = 1e7;
  scene.contact.seed.friction = scene.contact.wall.friction = 2;
  scene.contact.seed.restitution = scene.contact.wall.restitution = 0.05;
  expect_silence("bed with friction 2 and e = 0.05 falls silent", scene);
}

}  // namespace
}  // namespace vibrosow
