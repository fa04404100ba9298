// At the longest step that the plan allows (velocity Verlet): beds that rest fall silent, however they are packed and
// damped, and an elastic gas keeps its energy but for a random walk of its impacts.
#include <cmath>

#include "scene/make_clump.hpp"
#include "stability/bounds.hpp"

namespace vibrosow {
namespace {

class LongestStep : public testing::TestWithParam<Space> {
 protected:
  static bool is_3d() { return GetParam() == Space::three_dimensional; }

  static Scene bed(Packing packing, double restitution) {
    Scene scene;
    scene.space = GetParam();
    scene.lots = {{"ball", 4e-3, 40e-6, Shape::ball, 1}};
    scene.contact.shell_compression = 3e-4;
    scene.contact.seed = scene.contact.wall = {0.5, restitution};
    scene.contact.friction_model = FrictionModel::spring;
    scene.contact.rolling = Rolling::spring;
    for (Surface* surface : {&scene.contact.seed, &scene.contact.wall})
      surface->rolling_friction = surface->twisting_friction = 0.1;
    scene.tray.name = "tray";
    scene.tray.length = is_3d() ? 0.02 : 0.1, scene.tray.height = 0.2;
    if (is_3d()) scene.tray.depth = 0.02;
    scene.tray.fill = Fill{is_3d() ? 60 : 120, packing, 0, false};
    scene.run.duration = 1;
    return scene;
  }

  /// kinetic energy of a seed over m g d, `time` (s) after the start; none where the guard stops the run.
  static double restlessness(Scene scene, double time) {
    scene.numerics.dt = prepare(scene).step.longest_safe * (1 - 1e-9);
    Simulation run(prepare_to_run(scene), 1);
    while (run.time() < time)
      if (!run.step()) return std::nan("");
    const SeedLot& lot = scene.lots.front();
    return kinetic_energy(run.grains()) / static_cast<double>(run.grains().size()) /
           (lot.mass * standard_gravity * lot.diameter);
  }

  static void expect_silence(const std::string& name, const Scene& scene) {
    Bounds(name, {scene.space, scene.numerics.integrator, scene.contact.law}, scene.contact)
        .at_most("kinetic energy of a seed over m g d", restlessness(scene, 0.5), 1e-9, "");
  }
};
INSTANTIATE_TEST_SUITE_P(Spaces, LongestStep, testing::ValuesIn(both_spaces), named_by_space);

TEST_P(LongestStep, BedsThatRestFallSilent) {
  for (const double restitution : {0.9, 0.5, 0.1})
    for (const Packing packing : {Packing::poured, Packing::hexagonal}) {
      SCOPED_TRACE(testing::Message() << restitution << " packing " << static_cast<int>(packing));
      expect_silence("bed at rest at the longest step", bed(packing, restitution));
    }
}

TEST_P(LongestStep, BedsOfClumpsFallSilent) {
  for (const double restitution : {0.9, 0.5, 0.1}) {
    SCOPED_TRACE(restitution);
    Scene scene = bed(Packing::poured, restitution);
    make_clump(scene.lots[0], {{-2e-3, 0, 1.5e-3}, {0, 0, 2e-3}, {2e-3, 0, 1.5e-3}}, GetParam());
    scene.tray.fill->count = is_3d() ? 30 : 60;
    expect_silence("bed of clumps at rest at the longest step", scene);
  }
}

// Each impact errs by where in a step it begins and ends, either way. What the scheme keeps is not quite kinetic and
// elastic energy while contacts are pressed, so means over many steps are compared, from when all have met.
TEST_P(LongestStep, AnElasticGasDriftsNoMoreThanItsImpactsErr) {
  double sum = 0, square = 0;
  constexpr int runs = 12;
  for (int k = 1; k <= runs; ++k) {
    Scene scene = bed(Packing::hexagonal, 1);
    scene.contact.seed = scene.contact.wall = {0, 1};
    scene.contact.rolling = Rolling::none;
    scene.tray.height = 0.05;
    scene.numerics.dt = prepare(scene).step.longest_safe * (1 - 1e-9);
    Model model = prepare_to_run(scene);
    model.gravity = {0, 0};
    SimulationState state = starting_state(model, 1);
    Random random(static_cast<std::uint64_t>(k));
    for (std::size_t i = 0; i < state.grains.size(); ++i) {
      state.grains.vx[i] = random.uniform(-0.2, 0.2), state.grains.vy[i] = random.uniform(0, 0.2);
      if (is_3d()) state.grains.vz[i] = random.uniform(-0.2, 0.2);
    }
    Simulation run(model, std::move(state));
    const auto mean_energy = [&run](double from, double to) {
      double energy = 0, looks = 0;
      while (run.time() < from) EXPECT_TRUE(run.step()) << *run.guard().stop_reason();
      for (; run.time() < to; ++looks) {
        EXPECT_TRUE(run.step()) << *run.guard().stop_reason();
        energy += kinetic_energy(run.grains()) + run.field().elastic_energy();
      }
      return energy / looks;
    };
    const double before = mean_energy(0.05, 0.1), drift = mean_energy(0.25, 0.3) / before - 1;
    sum += drift, square += drift * drift;
  }
  const double mean = sum / runs, deviation = std::sqrt(square / runs - mean * mean);
  EXPECT_LT(deviation, 0.01);
  EXPECT_LT(std::abs(mean), 4 * deviation / std::sqrt(runs)) << "a drift one way";
}

}  // namespace
}  // namespace vibrosow
