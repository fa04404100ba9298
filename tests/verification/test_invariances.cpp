// What must not matter, in 2D and in 3D: left and right, front and back, which way the lab's axes point, the
// unit of mass, where the lab's origin is, which grain has which number.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>

#include "scene/clump_shape.hpp"
#include "scene/make_clump.hpp"
#include "support/bench.hpp"
#include "support/same_bits.hpp"
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

/// Four unlike balls: no mirror image of such a clump is the clump turned.
std::vector<ClumpDisc> one_handed() {
  return {{0, 0, 4e-3}, {4e-3, 1e-3, 2.5e-3}, {-2e-3, 4e-3, 2e-3, 1e-3}, {0, 2e-3, 2.5e-3, 3e-3}};
}

HarmonicMotion& motion_of(Scene& scene) {
  return std::get<HarmonicMotion>(*scene.tray.motion);
}

/// In 3D the floor is smaller, so that as many grains lie in layers, and oblong, so that along and across differ.
/// The walls' distances from x = 0 and z = 0 stay between two powers of two while the tray swings: opposite walls are
/// then rounded alike.
void put_3d(Scene& scene, const Case& c, Plan plan) {
  scene.space = Space::three_dimensional;
  scene.lots[1].shape = Shape::ball;
  if (c.rolling != Rolling::none) scene.contact.seed.twisting_friction = scene.contact.wall.twisting_friction = 0.05;
  Vessel& tray = scene.tray;
  tray.plan = plan;
  tray.length = plan == Plan::round ? 0.03125 : 0.046875, tray.depth = plan == Plan::round ? 0.03125 : 0.0234375;
  tray.origin.x() = -0.5 * tray.length, tray.front = -0.5 * *tray.depth;
  tray.holes = {
      {.centre = 0.5 * tray.length, .width = 0.01171875, .shape = HoleShape::round, .across = 0.5 * *tray.depth}};
  tray.height = 0.2;
  // It sets out from rest: poured balls touch the walls to within a last bit, which must not decide on a hard push.
  motion_of(scene).across = 0.5, motion_of(scene).ramp = 0.02;
}

Scene scene_of(const Case& c, Space space, Plan plan = Plan::rectangle) {
  Scene scene;
  scene.lots = {{"big", 8e-3, 6e-4, Shape::ball, 0.6}, {"small", 5e-3, 1.5e-4, Shape::disc, 0.4}};
  if (c.clumps) make_clump(scene.lots[0], space == Space::two_dimensional ? dipole(5e-3, 3e-3) : one_handed(), space);
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
  if (space == Space::three_dimensional) put_3d(scene, c, plan);
  return scene;
}

/// Cohesion starts with a jump at touch, which a last bit can move to another step: rounding is then no small matter.
Scene without_cohesion(Scene scene) {
  scene.contact.seed.cohesion = scene.contact.wall.cohesion = 0;
  return scene;
}

Grains run_from(const Scene& scene, const Grains& start, const Eigen::Vector2d& up = Eigen::Vector2d::UnitY()) {
  Model model = with_step(prepare(scene), 1e-5);
  model.gravity = -standard_gravity * up;
  Simulation run(model, starting_state(model, 1, start));
  run.steps(3000);  // 0.03 s
  EXPECT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
  EXPECT_GT(run.statistics().contacts, 5000);
  return run.grains();
}

Grains start_of(const Scene& scene) {
  return starting_state(prepare(scene), 11).grains;
}

/// The lab seen in other axes: what was at p is at axes p + shift. Where they are a mirror's, clumps change into mirror
/// images of themselves: `own` is the mirror of their own axes, and what is left of `axes` turns them.
struct View {
  std::string name;
  std::function<Scene(Scene)> scene;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(), own = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // m
  Plan plan = Plan::rectangle;                      // of the tray that is looked at

  Grains of(Grains g) const {
    const double handed = own.determinant();  // spins and turns are the other way round in a mirror
    const Eigen::Matrix3d turn = axes * own;
    const Eigen::Quaterniond q(turn);
    for (std::size_t i = 0; i < g.size(); ++i) {
      const Eigen::Vector3d at = axes * place_of(g, i) + shift, velocity = axes * velocity_of(g, i);
      set_turning(g, i, handed * (axes * turning_of(g, i)));
      g.x[i] = at.x(), g.y[i] = at.y(), g.vx[i] = velocity.x(), g.vy[i] = velocity.y();
      if (g.is_3d) g.z[i] = at.z(), g.vz[i] = velocity.z();
      if (!g.oriented) continue;
      if (!g.is_3d) {
        g.angle[i] = handed * g.angle[i] + std::atan2(turn(1, 0), turn(0, 0));
        continue;
      }
      const Orientation was = g.orientation(i);
      const Eigen::Vector3d mirrored = handed * (own * Eigen::Vector3d(was.x, was.y, was.z));
      g.set_orientation(
          i, Orientation{q.w(), q.x(), q.y(), q.z()} * Orientation{was.w, mirrored.x(), mirrored.y(), mirrored.z()});
    }
    return g;
  }
  /// Of any grain's place along any axis, m.
  double largest_difference(const Grains& seen_straight, const Grains& seen_so) const {
    double largest = 0;
    for (std::size_t i = 0; i < seen_straight.size(); ++i)
      largest = std::max(
          largest,
          (axes.transpose() * (place_of(seen_so, i) - shift) - place_of(seen_straight, i)).cwiseAbs().maxCoeff());
    return largest;
  }
};

Scene mirrored_along(Scene scene) {
  motion_of(scene).amplitude *= -1, motion_of(scene).across *= -1;
  for (SeedLot& lot : scene.lots)
    for (ClumpDisc& disc : lot.discs) disc.x = -disc.x;
  return scene;
}
Scene mirrored_across(Scene scene) {
  motion_of(scene).across *= -1;
  for (SeedLot& lot : scene.lots)
    for (ClumpDisc& disc : lot.discs) disc.z = -disc.z;
  return scene;
}

std::vector<View> mirrors(Space space) {
  const Eigen::Matrix3d along = Eigen::Vector3d(-1, 1, 1).asDiagonal(), across = Eigen::Vector3d(1, 1, -1).asDiagonal();
  std::vector<View> views = {{"mirror about x = 0", mirrored_along, along, along}};
  if (space == Space::three_dimensional) views.push_back({"mirror about z = 0", mirrored_across, across, across});
  return views;
}

constexpr double tilt = 0.4, turn = 0.7;  // rad

/// The tray leans and everything with it, the weight as well.
Scene leaning(Scene scene) {
  scene.tray.tilt = tilt;
  scene.tray.origin = Eigen::Rotation2Dd(tilt) * scene.tray.origin;
  motion_of(scene).direction += tilt;
  return scene;
}
/// Along and across change places, which is a mirror too.
Scene with_x_and_z_swapped(Scene scene) {
  Vessel& tray = scene.tray;
  std::swap(tray.length, *tray.depth), std::swap(tray.origin.x(), tray.front);
  for (Hole& hole : tray.holes) std::swap(hole.centre, hole.across);
  motion_of(scene).across = std::numbers::pi / 2 - motion_of(scene).across;
  for (SeedLot& lot : scene.lots)
    for (ClumpDisc& disc : lot.discs) disc.x = -disc.x;
  return scene;
}
/// A round tray about its own axis, which is the lab's.
Scene turned_upright(Scene scene) {
  motion_of(scene).across += turn;
  return scene;
}

std::vector<View> turns(Space space) {
  const Eigen::Matrix3d lean = Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  std::vector<View> views = {{"leaning by 0.4 rad, with its weight", leaning, lean}};
  Eigen::Matrix3d swap;
  swap << 0, 0, 1, 0, 1, 0, 1, 0, 0;
  const Eigen::Matrix3d mirror = Eigen::Vector3d(-1, 1, 1).asDiagonal();
  if (space == Space::three_dimensional) views.push_back({"x and z swapped", with_x_and_z_swapped, swap, mirror});
  return views;
}

View upright_turn() {
  View view{"a round tray turned by 0.7 rad", turned_upright};
  view.axes = Eigen::AngleAxisd(-turn, Eigen::Vector3d::UnitY()).toRotationMatrix();
  view.plan = Plan::round;
  return view;
}

View shift(Space space) {
  View view{"shift by 0.3 m", nullptr};
  view.shift.x() = 0.3;
  if (space == Space::three_dimensional)
    view.name = "shift by 0.5 m along, 0.25 m up and 2 m across", view.shift = {0.5, 0.25, 2};
  view.scene = [by = view.shift](Scene scene) {
    scene.tray.origin += by.head<2>(), scene.tray.front += by.z();
    return scene;
  };
  return view;
}

class Invariance : public testing::TestWithParam<Space> {
 protected:
  static void SetUpTestSuite() {
    for (const Space space : both_spaces)
      reports_[space].emplace(report_in(space, "invariances"),
                              "largest difference of any grain's place after 0.03 s in a shaken tray of 60 grains",
                              std::vector<std::string>{"change", "case", "largest_difference_m"});
  }
  static void TearDownTestSuite() { reports_.clear(); }
  static void tell(const std::string& change, const std::string& name, double difference) {
    reports_[GetParam()]->add(change, name, difference);
  }

  /// What differs where rounding does, which chaos lets grow: 1e-15 m at first, some 1e-10 m after 0.03 s.
  static void expect_nearly_the_same(const std::vector<View>& views) {
    for (const Case& c : cases()) {
      const Scene scene = without_cohesion(scene_of(c, GetParam(), views.front().plan));
      const Grains start = start_of(scene), straight = run_from(scene, start);
      for (const View& view : views) {
        const Eigen::Vector3d up = view.axes * Eigen::Vector3d::UnitY();
        const Grains so = run_from(view.scene(scene), view.of(start), up.head<2>());
        ASSERT_EQ(so.size(), straight.size());
        const double difference = view.largest_difference(straight, so);
        EXPECT_LT(difference, 1e-10) << view.name << ": " << c.name;
        tell(view.name, c.name, difference);
      }
    }
  }

 private:
  static inline std::map<Space, std::optional<VerificationReport>> reports_;
};
INSTANTIATE_TEST_SUITE_P(Spaces, Invariance, testing::ValuesIn(both_spaces), named_by_space);

TEST_P(Invariance, UnderAMirror) {
  for (const View& view : mirrors(GetParam()))
    for (const Case& c : cases()) {
      SCOPED_TRACE(view.name + ": " + c.name);
      Scene scene = scene_of(c, GetParam());
      if (GetParam() == Space::three_dimensional) scene.tray.holes.clear();  // a face counts from one of its corners
      const Grains start = start_of(scene);
      const Grains a = run_from(scene, start), b = run_from(view.scene(scene), view.of(start));
      tell(view.name, c.name, view.largest_difference(a, b));
      // The forces of three walls on one ball are summed in the walls' order. Poured clumps leave balls in corners.
      if (c.clumps && GetParam() == Space::three_dimensional)
        EXPECT_LT(view.largest_difference(a, b), 1e-10);
      else
        EXPECT_EQ(bits(view.of(a)), bits(b));
    }
}

TEST_P(Invariance, UnderTwiceTheMass) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Scene scene = scene_of(c, GetParam());
    Scene doubled = scene;
    for (SeedLot& lot : doubled.lots) lot.mass *= 2;
    doubled.contact.drag *= 2;
    doubled.contact.youngs_modulus *= 2;
    doubled.contact.seed.cohesion *= 2;
    doubled.contact.wall.cohesion *= 2;
    const Grains a = run_from(scene, start_of(scene)), b = run_from(doubled, start_of(doubled));
    tell("all masses twice, with drag, modulus and cohesion", c.name, View{}.largest_difference(a, b));
    EXPECT_EQ(bits(a), bits(b));
  }
}

TEST_P(Invariance, UnderAShift) {
  expect_nearly_the_same({shift(GetParam())});
}

TEST_P(Invariance, UnderATurn) {
  expect_nearly_the_same(turns(GetParam()));
  if (GetParam() == Space::three_dimensional) expect_nearly_the_same({upright_turn()});
}

// Places on a face, and so its edges and the rims of its holes, are counted from one of its corners, and rounded.
TEST_P(Invariance, UnderAMirrorWithEdges) {
  std::vector<View> views = mirrors(GetParam());
  for (View& view : views) view.name += ", with holes";
  expect_nearly_the_same(views);
}

Grains numbered_backwards(const Grains& g) {
  Grains other = g;
  other.remove_flagged(std::vector<char>(g.size(), 1));
  for (std::size_t k = g.size(); k-- > 0;) {
    Turn turned;
    if (g.oriented && g.is_3d) turned.orientation = g.orientation(k);
    if (g.oriented && !g.is_3d) turned.angle = g.angle[k];
    other.add(place_of(g, k), velocity_of(g, k), g.lot[k], g.kind(k), turned);
    set_turning(other, other.size() - 1, turning_of(g, k));
  }
  return other;
}

TEST_P(Invariance, UnderOtherNumbers) {
  for (const Case& c : cases()) {
    const Scene scene = without_cohesion(scene_of(c, GetParam()));
    const Grains start = start_of(scene);
    const Grains a = run_from(scene, start);
    const Grains b = numbered_backwards(run_from(scene, numbered_backwards(start)));
    const double difference = View{}.largest_difference(a, b);
    EXPECT_LT(difference, 1e-10) << c.name;
    tell("numbered backwards", c.name, difference);
  }
}

}  // namespace
}  // namespace vibrosow
