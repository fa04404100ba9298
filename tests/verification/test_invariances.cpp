// What must not matter: left and right, the unit of mass, where the lab's origin is, which grain has which number.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/clump_shape.hpp"
#include "support/bench.hpp"
#include "verification/tables.hpp"

namespace vibrosow {
namespace {

/// Every effect of the contacts, in a shaken tray that lies evenly about x = 0.
struct Case {
  std::string name;
  Law law;
  FrictionModel model;
  Rolling rolling;
  bool clumps = false;
};

std::vector<Case> cases() {
  return {{"elastic_shell sliding", Law::elastic_shell, FrictionModel::sliding, Rolling::none},
          {"elastic_shell spring", Law::elastic_shell, FrictionModel::spring, Rolling::spring},
          {"hertz sliding", Law::hertz, FrictionModel::sliding, Rolling::constant_torque},
          {"hertz spring", Law::hertz, FrictionModel::spring, Rolling::spring},
          {"hertz_viscous sliding", Law::hertz_viscous, FrictionModel::sliding, Rolling::none},
          {"clumps spring", Law::elastic_shell, FrictionModel::spring, Rolling::none, true}};
}

Scene scene_of(const Case& c) {
  Scene scene;
  scene.lots = {{"big", 8e-3, 6e-4, Shape::ball, 0.6}, {"small", 5e-3, 1.5e-4, Shape::disc, 0.4}};
  if (c.clumps) {
    SeedLot& lot = scene.lots[0];
    lot.shape = Shape::clump;
    lot.discs = dipole(5e-3, 3e-3);
    lot.diameter = 2 * holding_radius(lot.discs);
    lot.gyration2 = plate_of(lot.discs).gyration2;
  }
  Contact& contact = scene.contact;
  contact.law = c.law;
  contact.shell_compression = 1e-3;
  contact.youngs_modulus = 1e7;
  contact.damping_rate = 500;
  contact.slip_speed = 0.1;  // within friction's limit of the step, beyond which rounding grows like an instability
  contact.seed = contact.wall = {0.4, 0.6, c.rolling == Rolling::none ? 0 : 0.1, 2e-4};
  contact.friction_model = c.model;
  contact.rolling = c.rolling;
  contact.drag = 1e-4;
  scene.tray.name = "tray";
  scene.tray.origin = {-0.0625, 0};
  scene.tray.length = 0.125;
  scene.tray.height = 0.1;
  scene.tray.holes = {{0.0625, 0.03125}};
  scene.tray.fill = Fill{60, Packing::poured, 1e-3, false};
  scene.tray.motion = HarmonicMotion{0, 4e-3, 12, 0};
  scene.run.duration = 1;
  return scene;
}

/// Cohesion starts with a jump at touch, which a last bit can move to another step: rounding is then no small matter.
Scene without_cohesion(Scene scene) {
  scene.contact.seed.cohesion = scene.contact.wall.cohesion = 0;
  return scene;
}

Grains run_from(const Scene& scene, const Grains& start) {
  const Model model = with_step(prepare(scene), 1e-5);
  Simulation run(model, starting_state(model, 1, start));
  run.steps(5000);  // 0.05 s
  EXPECT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
  EXPECT_GT(run.statistics().contacts, 5000);
  return run.grains();
}

Grains start_of(const Scene& scene) {
  return starting_state(prepare(scene), 11).grains;
}

double largest_difference(const Grains& a, const Grains& b, double shift_x = 0, double mirror = 1) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max({largest, std::abs(mirror * b.x[i] - shift_x - a.x[i]), std::abs(b.y[i] - a.y[i])});
  return largest;
}

class Invariance : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    report_.emplace("invariances", "largest difference of any grain's place after 0.05 s in a shaken tray of 60 grains",
                    std::vector<std::string>{"change", "case", "largest_difference_m"});
  }
  static void TearDownTestSuite() { report_.reset(); }
  static void tell(const std::string& change, const std::string& name, double difference) {
    report_->add(change, name, difference);
  }

 private:
  static inline std::optional<VerificationReport> report_;
};

/// The scene as a mirror at x = 0 shows it, and its grains.
Scene mirror(Scene scene) {
  if (scene.tray.motion) std::get<HarmonicMotion>(*scene.tray.motion).amplitude *= -1;
  for (SeedLot& lot : scene.lots)
    for (ClumpDisc& disc : lot.discs) disc.x = -disc.x;
  return scene;
}
Grains mirror(Grains grains) {
  for (std::vector<double>* array : {&grains.x, &grains.vx, &grains.omega, &grains.angle})
    for (double& value : *array) value = -value;
  return grains;
}

TEST_F(Invariance, UnderAMirror) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Scene scene = scene_of(c);
    const Grains start = start_of(scene);
    const Grains a = run_from(scene, start), b = run_from(mirror(scene), mirror(start));
    tell("mirror about x = 0", c.name, largest_difference(a, b, 0, -1));
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(b.x[i], -a.x[i]) << i;
      ASSERT_EQ(b.y[i], a.y[i]) << i;
      ASSERT_EQ(b.vx[i], -a.vx[i]) << i;
      ASSERT_EQ(b.omega[i], -a.omega[i]) << i;
    }
  }
}

TEST_F(Invariance, UnderTwiceTheMass) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Scene scene = scene_of(c);
    Scene doubled = scene;
    for (SeedLot& lot : doubled.lots) lot.mass *= 2;
    doubled.contact.drag *= 2;
    doubled.contact.youngs_modulus *= 2;
    doubled.contact.seed.cohesion *= 2;
    doubled.contact.wall.cohesion *= 2;
    const Grains a = run_from(scene, start_of(scene)), b = run_from(doubled, start_of(doubled));
    tell("all masses twice, with drag, modulus and cohesion", c.name, largest_difference(a, b));
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(b.x[i], a.x[i]) << i;
      ASSERT_EQ(b.y[i], a.y[i]) << i;
      ASSERT_EQ(b.vx[i], a.vx[i]) << i;
      ASSERT_EQ(b.omega[i], a.omega[i]) << i;
    }
  }
}

TEST_F(Invariance, UnderAShift) {
  for (const Case& c : cases()) {
    const Scene scene = without_cohesion(scene_of(c));
    const double shift = 0.3;
    Scene shifted = scene;
    shifted.tray.origin.x() += shift;
    const Grains start = start_of(scene);
    Grains other = start;
    for (double& x : other.x) x += shift;
    const double difference = largest_difference(run_from(scene, start), run_from(shifted, other), shift);
    EXPECT_LT(difference, 1e-10) << c.name;
    tell("shift by 0.3 m", c.name, difference);
  }
}

TEST_F(Invariance, UnderOtherNumbers) {
  for (const Case& c : cases()) {
    const Scene scene = without_cohesion(scene_of(c));
    const Grains start = start_of(scene);
    Grains other(start.kinds, start.polydisperse, start.rotation, start.oriented);
    for (std::size_t k = start.size(); k-- > 0;)
      other.add(start.x[k], start.y[k], start.vx[k], start.vy[k], start.lot[k], start.kind(k),
                start.oriented ? start.angle[k] : 0);
    const Grains a = run_from(scene, start), b = run_from(scene, other);
    double difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const std::size_t j = a.size() - 1 - i;
      difference = std::max({difference, std::abs(a.x[i] - b.x[j]), std::abs(a.y[i] - b.y[j])});
    }
    EXPECT_LT(difference, 1e-10) << c.name;
    tell("numbered backwards", c.name, difference);
  }
}

}  // namespace
}  // namespace vibrosow
