// Vessels that turn steadily: drums in 2D and in 3D, and upright rotors.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "scene/input_error.hpp"
#include "simulation/simulate.hpp"
#include "support/bench.hpp"
#include "support/same_bits.hpp"
#include "vessel/vessel_faces.hpp"

namespace vibrosow::turning_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double radius = 2e-3, drum_radius = 0.02, depth = 0.012;

/// A drum of circle and discs, its axis at (drum_radius, drum_radius) of its frame.
Scene drum(Space space, double angular_velocity) {
  Scene scene;
  scene.space = space;
  scene.lots = {{"ball", 2 * radius, 4e-5, Shape::ball, 1}};
  scene.contact.shell_compression = 1e-4;
  scene.contact.seed = scene.contact.wall = {0.5, 0.5};
  scene.contact.friction_model = FrictionModel::spring;
  scene.tray.name = "tray";
  scene.tray.length = scene.tray.height = 2 * drum_radius;
  if (space == Space::three_dimensional) scene.tray.depth = depth;
  scene.tray.box = false;
  WallPiece circle;
  circle.centre = {drum_radius, drum_radius}, circle.radius = drum_radius, circle.to = 2 * pi;
  scene.tray.pieces = {circle};
  scene.tray.motion = TurningMotion{circle.centre, angular_velocity};
  scene.run.duration = 2;
  return scene;
}

struct Ball {
  Eigen::Vector3d at, velocity = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero();
};

SimulationState start_with(const Model& model, const std::vector<Ball>& balls) {
  Grains grains = no_grains(model);
  for (const Ball& ball : balls) {
    if (grains.is_3d)
      grains.add(ball.at, ball.velocity, 0, grains.kinds.front());
    else
      grains.add(ball.at.x(), ball.at.y(), ball.velocity.x(), ball.velocity.y(), 0);
    if (!grains.rotation) continue;
    grains.omega.back() = ball.spin.z();
    if (grains.is_3d) grains.omega_x.back() = ball.spin.x(), grains.omega_y.back() = ball.spin.y();
  }
  return starting_state(model, 1, std::move(grains));
}

/// Layers between z = 2 mm and 10 mm, in the middle of the drum.
std::vector<Ball> heap(double x, double y) {
  std::vector<Ball> balls;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 2; ++k)
        balls.push_back({{x - 0.008 + 0.0045 * i + 1e-4 * j, y - 0.008 + 0.0045 * j, 0.003 + 0.0045 * k + 1e-4 * i}});
  return balls;
}

double distance_from_axis(const Grains& g, std::size_t i) {
  return std::hypot(g.x[i] - drum_radius, g.y[i] - drum_radius);
}

class InADrum : public testing::TestWithParam<Space> {
 protected:
  /// One ball that lies at rest at an angle from the bottom, the way the wall goes there, and turns with `spin`; a
  /// little later.
  static Grains after(const Scene& scene, double angle, double spin) {
    const Model model = prepare_to_run(scene);
    const double arm = drum_radius - radius * (1 - 1e-4 * std::cos(angle));  // pressed in by its weight
    Simulation run(
        model,
        start_with(model, {{{drum_radius + arm * std::sin(angle), drum_radius - arm * std::cos(angle), depth / 2},
                            {0, 0, 0},
                            {0, 0, spin}}}));
    EXPECT_TRUE(run.run_until(1));
    return run.grains();
  }
  static double climbed(const Grains& g) { return std::atan2(g.x[0] - drum_radius, drum_radius - g.y[0]); }
};
INSTANTIATE_TEST_SUITE_P(Turning, InADrum, testing::Values(Space::two_dimensional, Space::three_dimensional));

TEST_P(InADrum, ABallRollsOnTheSpotAtTheBottom) {
  for (const double speed : {3.0, -3.0}) {
    const double spin = speed * drum_radius / radius;  // that of the wall's surface
    const Grains g = after(drum(GetParam(), speed), 0, spin);
    EXPECT_NEAR(climbed(g), 0, 1e-4);
    EXPECT_NEAR(std::hypot(g.vx[0], g.vy[0]), 0, 1e-5);
    EXPECT_NEAR(g.omega[0], spin, 1e-3 * std::abs(spin));
  }
}

TEST_P(InADrum, WithRollingResistanceItStaysWhereTheTangentIsItsCoefficient) {
  // Torque about the point of contact: the weight's, m g r sin(angle), holds the rolling one, mu m g cos(angle) r.
  for (const double speed : {3.0, -3.0}) {
    Scene scene = drum(GetParam(), speed);
    scene.contact.rolling = Rolling::spring;
    scene.contact.wall.rolling_friction = 0.1;
    const double angle = std::copysign(std::atan(0.1), speed), spin = speed * drum_radius / radius;
    const Grains g = after(scene, angle, spin);
    EXPECT_NEAR(climbed(g), angle, 2e-3);
    EXPECT_NEAR(g.omega[0], spin, 1e-2 * std::abs(spin));
  }
}

TEST_P(InADrum, WhatDoesNotRollSlidesWhereTheTangentIsItsFriction) {
  Scene scene = drum(GetParam(), 3);
  scene.contact.rotation = false;
  EXPECT_NEAR(climbed(after(scene, std::atan(0.5), 0)), std::atan(0.5), 2e-3);
}

TEST_P(InADrum, FasterThanGravityItGoesRoundWithTheWall) {
  // A ball that does not turn goes as fast as the wall's surface; v^2 over its own circle's radius is 3 g.
  const double own_circle = drum_radius - radius, velocity = std::sqrt(3 * standard_gravity * own_circle);
  Scene scene = drum(GetParam(), velocity / drum_radius);
  scene.contact.rotation = false, scene.contact.wall.friction = 2;
  const Model model = prepare_to_run(scene);
  Simulation run(model, start_with(model, {{{drum_radius, radius, depth / 2}, {velocity, 0, 0}}}));
  EXPECT_TRUE(run.run_until(pi * own_circle / velocity));  // half round: it is at the top
  EXPECT_NEAR(run.grains().y[0], 2 * drum_radius - radius, 2e-5);
  EXPECT_NEAR(run.grains().x[0], drum_radius, 0.02 * drum_radius);
  EXPECT_NEAR(run.grains().vx[0], -velocity, 0.01 * velocity);
}

TEST_P(InADrum, NoSeedIsSpilledHoweverItIsTurned) {
  // The frame's zero lies below the drum at first, or in its middle: half of the drum is then below the line y = 0.
  for (const double zero : {0.0, drum_radius}) {
    Scene scene = drum(GetParam(), 12);
    scene.tray.pieces[0].centre -= Eigen::Vector2d(zero, zero);
    scene.tray.origin = {zero, zero};
    std::get<TurningMotion>(*scene.tray.motion).pivot = scene.tray.pieces[0].centre;
    scene.run.count_below = 1e-3;
    const Model model = prepare_to_run(scene);
    std::vector<Ball> balls = heap(drum_radius, drum_radius);
    if (GetParam() == Space::two_dimensional)
      std::erase_if(balls, [](const Ball& ball) { return ball.at.z() > 0.005; });
    Simulation run(model, start_with(model, balls));
    EXPECT_TRUE(run.run_until(0.7));
    const vibrosow::Run result = run.result();
    EXPECT_EQ(result.balance.inside, std::ssize(balls));
    EXPECT_EQ(result.balance.spilled + result.balance.lost + result.balance.counted, 0);
    EXPECT_THAT(result.warnings, testing::IsEmpty());
    for (std::size_t i = 0; i < balls.size(); ++i)
      EXPECT_LT(distance_from_axis(run.grains(), i), drum_radius - 0.95 * radius);
  }
}

TEST_P(InADrum, WhatFallsPastItIsSpilledOnce) {
  Scene scene = drum(GetParam(), 12);
  scene.run.count_below = 1e-3;
  const Model model = prepare_to_run(scene);
  Simulation run(model, start_with(model, {{{-0.01, 0.03, depth / 2}}, {{drum_radius, radius, depth / 2}}}));
  EXPECT_TRUE(run.run_until(0.5));
  EXPECT_EQ(run.result().balance.spilled, 1);
  EXPECT_EQ(run.result().balance.inside, 1);
  ASSERT_EQ(run.result().events.size(), 1u);
  EXPECT_EQ(run.result().events[0].hole, 0);
}

TEST_P(InADrum, TheWorkOfAPaddleIsAccountedFor) {
  // Without friction and damping; a paddle from the axis to the wall comes round to the balls.
  Scene scene = drum(GetParam(), -12);
  std::get<TurningMotion>(*scene.tray.motion).ramp = 0.05;
  scene.contact.seed = scene.contact.wall = {0, 1};
  scene.contact.friction_model = FrictionModel::sliding;
  scene.tray.pieces.push_back({{drum_radius, drum_radius}, {2 * drum_radius, drum_radius}});
  const Model model = with_step(prepare(scene), 2e-6);
  Simulation run(model, start_with(model, {{{drum_radius, radius, 0.003}}, {{drum_radius + 0.005, 0.006, 0.0035}}}));
  const double before = kinetic_energy(run.grains()) + potential_energy(run.grains(), model.gravity);
  EXPECT_TRUE(run.run_until(0.25));
  const vibrosow::Run result = run.result();
  ASSERT_GT(std::abs(result.energy.wall_work), 1e-6);
  const double account = result.energy.kinetic + result.energy.potential + result.energy.elastic - before;
  EXPECT_NEAR(account, result.energy.wall_work, 0.01 * std::abs(result.energy.wall_work));
}

TEST_P(InADrum, ACutRunGoesOnToTheSameBits) {
  const Model model = prepare_to_run(drum(GetParam(), 12));
  std::vector<Ball> balls = heap(drum_radius, drum_radius);
  if (GetParam() == Space::two_dimensional) std::erase_if(balls, [](const Ball& ball) { return ball.at.z() > 0.005; });
  expect_a_cut_run_goes_on(model, start_with(model, balls), 0.05, 0.1, 100);
}

TEST_P(InADrum, ItsListsChangeNoBit) {
  const Model model = prepare_to_run(drum(GetParam(), 30));
  std::vector<Ball> balls = heap(drum_radius, drum_radius);
  if (GetParam() == Space::two_dimensional) std::erase_if(balls, [](const Ball& ball) { return ball.at.z() > 0.005; });
  std::vector<std::vector<double>> ends;
  for (const NeighbourMargins margins :
       {NeighbourMargins{}, NeighbourMargins{2, 0.02, 0.5}, NeighbourMargins{4, 3, 4}}) {
    Simulation run(model, start_with(model, balls), ComputeOptions{.margins = margins});
    run.run_until(0.2);
    ends.push_back(bits(run.grains()));
  }
  for (const auto& end : ends) EXPECT_EQ(end, ends.front());
}

TEST_P(InADrum, ItCanNeitherBeginNorEndByHand) {
  const Model model = prepare_to_run(drum(GetParam(), 12));
  Simulation run(model, start_with(model, {}));
  EXPECT_THROW(run.set_motion(0, std::nullopt), std::invalid_argument);
}

TEST(Turning, ADrumIsFilledWithinItsCircle) {
  for (const Packing packing : {Packing::poured, Packing::layers, Packing::hexagonal}) {
    for (const Space space : {Space::two_dimensional, Space::three_dimensional}) {
      Scene scene = drum(space, 3);
      scene.run.duration = 0.1;
      scene.tray.fill = Fill{25, packing};
      const vibrosow::Run run = simulate(scene);
      EXPECT_EQ(run.balance.inside, 25);
      EXPECT_EQ(run.status, RunStatus::finished) << run.stop_reason;
      scene.tray.fill->count = 300;
      EXPECT_THROW(simulate(scene), InputError);
    }
  }
}

TEST(Turning, RainFallsIntoADrumThatTurns) {
  Scene scene = drum(Space::two_dimensional, 12);
  scene.tray.rain = Rain{100, 0.015, 0.025, 0.03, 0, 0.2};
  scene.run.duration = 0.6;
  const vibrosow::Run run = simulate(scene);
  EXPECT_EQ(run.balance.put_in, 20);
  EXPECT_EQ(run.balance.inside, 20);
}

TEST(Turning, ADrumIsClosedByDiscsOrEndless) {
  Scene scene = drum(Space::three_dimensional, 12);
  const auto names = [&] {
    std::vector<std::string> found;
    for (const Face& face : vessel_faces(scene.tray)) found.push_back(face.name);
    return found;
  };
  EXPECT_THAT(names(), testing::ElementsAre("tray piece 1", "tray front", "tray back"));
  scene.tray.pieces.push_back({{0.01, 0.01}, {0.01, 0.05}});  // not within the circle: that is a bar, not a drum
  EXPECT_THAT(names(), testing::ElementsAre("tray piece 1", "tray piece 2"));
  scene.tray.pieces.pop_back();
  scene.tray.front_and_back = Sides::periodic;
  EXPECT_THAT(names(), testing::ElementsAre("tray piece 1"));
  scene.tray.front_and_back = Sides::open;
  EXPECT_THAT(names(), testing::ElementsAre("tray piece 1"));
}

TEST(Turning, AnEndlessDrumCarriesItsBallsRound) {
  Scene scene = drum(Space::three_dimensional, 12);
  scene.tray.front_and_back = Sides::periodic;
  scene.tray.depth = 0.024;  // a period needs room
  const Model model = prepare_to_run(scene);
  std::vector<Ball> balls = heap(drum_radius, drum_radius);
  for (std::size_t k = 0; k < balls.size(); ++k) balls[k].velocity.z() = k % 2 == 0 ? 0.3 : -0.3;
  Simulation run(model, start_with(model, balls));
  EXPECT_TRUE(run.run_until(0.5));
  EXPECT_EQ(run.result().balance.inside, std::ssize(balls));
  for (std::size_t i = 0; i < balls.size(); ++i)
    EXPECT_LT(distance_from_axis(run.grains(), i), drum_radius - 0.95 * radius);
}

// About an upright axis: a plate of 5 cm radius with a rim 1 cm high.
constexpr double plate_radius = 0.05;

Scene rotor(double angular_velocity) {
  Scene scene = drum(Space::three_dimensional, 0);
  scene.tray.length = 0.1, scene.tray.height = 0.02, scene.tray.depth = 0.1;
  const auto turned = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    WallPiece piece{a, b};
    piece.about = {plate_radius, plate_radius};
    return piece;
  };
  scene.tray.pieces = {turned({0, 0}, {plate_radius, 0}), turned({plate_radius, 0}, {plate_radius, 0.01})};
  scene.tray.motion = TurningMotion{{plate_radius, plate_radius}, angular_velocity, TurningAxis::upright};
  return scene;
}

/// Carried along with the plate, x towards z, at a distance from its axis.
Ball on_plate(double from_axis, double angular_velocity) {
  const double compression = 1e-4 * radius;  // under its own weight
  return {{plate_radius + from_axis, radius - compression, plate_radius}, {0, 0, angular_velocity * from_axis}};
}

TEST(Turning, FrictionCarriesABallRoundOnAPlateUpToItsLimit) {
  // Centripetal omega^2 r against friction 0.5 g, below and above.
  const double from_axis = 0.03, limit = std::sqrt(0.5 * standard_gravity / from_axis);
  for (const double part : {0.9, 1.1}) {
    const double speed = part * limit;
    Scene scene = rotor(speed);
    scene.contact.rotation = false;
    const Model model = prepare_to_run(scene);
    Simulation run(model, start_with(model, {on_plate(from_axis, speed)}));
    EXPECT_TRUE(run.run_until(1.0));
    const double x = run.grains().x[0] - plate_radius, z = run.grains().z[0] - plate_radius;
    if (part < 1) {
      EXPECT_NEAR(std::hypot(x, z), from_axis, 1e-2 * from_axis);
      const double behind = std::remainder(std::atan2(z, x) - speed * 1.0, 2 * pi);
      EXPECT_NEAR(behind, 0, 0.02);
    } else {
      EXPECT_NEAR(std::hypot(x, z), plate_radius - radius, 1e-5) << "thrown to the rim";
      // Its own turning held, it goes as fast as the rim's surface, which presses it harder than the plate.
      EXPECT_NEAR(std::hypot(run.grains().vx[0], run.grains().vz[0]), speed * plate_radius, 1e-3);
    }
    EXPECT_EQ(run.result().balance.inside, 1);
  }
}

TEST(Turning, ABallThatRollsOnATurntableCirclesWithTwoSeventhsOfItsSpeed) {
  // Weckesser, Am. J. Phys. 65 (1997) 736: wherever it is set off, its centre goes round a circle with 2/7 omega.
  const double speed = 20;
  Scene scene = rotor(speed);
  scene.contact.wall.friction = 5;
  const Model model = prepare_to_run(scene);
  Ball ball = on_plate(0.01, 0);
  ball.velocity = {0, 0, 0.02};
  // Rolling without slipping: v + spin x (-r y) is the plate's own velocity there, (0, 0, omega x).
  const double slip = speed * 0.01 - 0.02;
  ball.spin = {-slip / radius, 0, 0};
  Simulation run(model, start_with(model, {ball}));
  const double period = 2 * pi / (2.0 / 7 * speed);
  EXPECT_TRUE(run.run_until(period / 2));
  // Its velocity has turned round by half a turn.
  EXPECT_NEAR(run.grains().vz[0], -0.02, 4e-4);
  EXPECT_NEAR(run.grains().vx[0], 0, 4e-4);
  EXPECT_TRUE(run.run_until(period));
  EXPECT_NEAR(run.grains().x[0], plate_radius + 0.01, 1e-4);
  EXPECT_NEAR(run.grains().z[0], plate_radius, 1e-4);
}

TEST(Turning, AHoleCountsWhatItMeetsOnItsWayRound) {
  // A round vessel with a hole 3 cm from its axis; the ball falls to where the hole comes, and at rest there is none.
  for (const double speed : {5.0, -5.0, 0.0}) {
    Scene scene = drum(Space::three_dimensional, 0);
    scene.tray.box = true, scene.tray.pieces.clear(), scene.tray.plan = Plan::round;
    scene.tray.length = 0.1, scene.tray.depth = 0.1;
    Hole hole{0.08, 0.012};
    hole.shape = HoleShape::round, hole.across = 0.05;
    scene.tray.holes = {hole};
    scene.tray.motion = TurningMotion{{0.05, 0.05}, speed, TurningAxis::upright};
    scene.run.count_below = 0.005;
    const double height = 0.02, angle = 5 * std::sqrt(2 * height / standard_gravity);
    const double side = speed < 0 ? -1 : 1;
    const Model model = prepare_to_run(scene);
    Simulation run(
        model, start_with(model, {{{0.05 + 0.03 * std::cos(angle), height, 0.05 + side * 0.03 * std::sin(angle)}}}));
    EXPECT_TRUE(run.run_until(0.15));
    if (speed == 0) {
      EXPECT_EQ(run.result().balance.inside, 1);
      continue;
    }
    ASSERT_EQ(run.result().events.size(), 1u);
    EXPECT_EQ(run.result().events[0].hole, 1);
    EXPECT_NEAR(run.result().events[0].x, 0.08, 1e-4);
    EXPECT_NEAR(run.result().events[0].z, 0.05, 1e-4);
    EXPECT_EQ(run.result().balance.counted, 1);
    EXPECT_EQ(run.result().balance.lost, 0);
  }
}

TEST(Turning, AnUprightRotorNeedsSpace) {
  Scene scene = drum(Space::two_dimensional, 3);
  std::get<TurningMotion>(*scene.tray.motion).axis = TurningAxis::upright;
  EXPECT_THROW(prepare(scene), InputError);
  scene.tray.motion.reset();
  EXPECT_NO_THROW(prepare(scene));
  scene.tray.pieces.push_back({{0, 0}, {0.01, 0}});
  scene.tray.pieces.back().about = {0.01, 0.01};
  EXPECT_THROW(prepare(scene), InputError);
}

}  // namespace
}  // namespace vibrosow::turning_test
