// Contacts of balls in 3D against those of the plane, and carried round by their balls.
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "contact/kernels.hpp"
#include "laws/law.hpp"

namespace vibrosow {
namespace {

constexpr double radius = 4e-3, mass = 6e-4, inverse_inertia = 1 / (0.4 * mass * radius * radius);
constexpr double compression = 1e-4;

struct Ball {
  Eigen::Vector3d x = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero(), omega = Eigen::Vector3d::Zero();
};
struct Load {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
};
using Balls = std::array<Ball, 2>;
using Loads = std::array<Load, 2>;

ContactParameters parameters(double friction) {
  SurfaceParameters surface{.friction = friction,
                            .inverse_slip_speed = 1 / 0.02,
                            .damping_ratio = 0.2,
                            .damping_rate = 1e3,
                            .tangential_ratio = 14.0 / 17,
                            .tangential_damping = 0.5,
                            .rolling_friction = 0.1,
                            .rolling_damping = 0.3};
  ContactParameters made;
  made.pairs = {surface}, made.walls = {surface};
  return made;
}

GrainSurfaces surfaces_of_balls(Law law) {
  const LawTraits& traits = traits_of(law);
  const double compliance = traits.compliance({.radius = radius,
                                               .weight = mass * standard_gravity,
                                               .shell_compression = compression,
                                               .youngs_modulus = 1e7,
                                               .poisson_ratio = 0.3});
  GrainSurfaces grains{};
  grains.equal = {radius, compliance, 1 / mass, inverse_inertia, 1 / radius, 0};
  return grains;
}

/// The last contact of two balls, in 3D or in the plane z = 0, with its history.
class Contact2 {
 public:
  Contact2(Law law, const EffectSet& effects, bool is_3d, double friction = 0.4)
      : kernels_(kernels_for(law, effects)),
        is_3d_(is_3d),
        parameters_(parameters(friction)),
        grains_(surfaces_of_balls(law)) {
    list_.add(1, 0);
    histories_.resize(1, {effects.tangential_spring, effects.rolling == Rolling::spring, is_3d});
  }

  Loads loads(const Balls& balls, const ContactStep& advance) {
    return is_3d_ ? space(balls, advance) : plane(balls, advance);
  }
  ContactHistories& histories() { return histories_; }

 private:
  Loads plane(const Balls& b, const ContactStep& advance) {
    const auto pair = [&b](auto of) { return std::array{of(b[0]), of(b[1])}; };
    const auto x = pair([](const Ball&p) { return p.x.x(); }), y = pair([](const Ball&p) { return p.x.y(); });
    const auto vx = pair([](const Ball&p) { return p.v.x(); }), vy = pair([](const Ball&p) { return p.v.y(); });
    const auto omega = pair([](const Ball& p) { return p.omega.z(); });
    std::array<GrainForce, 2> sums{};
    PairResult result;
    result.forces = sums.data(), result.first_own = 0;
    kernels_.vectors[set_].pair(grains_, {x.data(), y.data(), vx.data(), vy.data(), omega.data(), x.data()}, list_,
                                {0, 1}, parameters_, advance, histories_, result);
    Loads loads;
    for (std::size_t k = 0; k < 2; ++k) loads[k] = {{sums[k].fx, sums[k].fy, 0}, {0, 0, sums[k].torque}};
    return loads;
  }
  Loads space(const Balls& b, const ContactStep& advance) {
    const auto row = [](const Eigen::Vector3d& a) { return GrainVector{a.x(), a.y(), a.z(), 0}; };
    const std::array<GrainVector, 2> places{row(b[0].x), row(b[1].x)};
    const std::array<BallMotion, 2> motions{BallMotion{row(b[0].v), row(b[0].omega)},
                                            BallMotion{row(b[1].v), row(b[1].omega)}};
    std::array<GrainVector, 2> forces{}, torques{};
    PairResult3d result;
    result.forces = forces.data(), result.torques = torques.data(), result.first_own = 0;
    const Motion3d at{places.data(), places.data(), motions.data()};
    kernels_.vectors_3d[set_].pair(grains_, at, list_, {0, 1}, parameters_, advance, histories_, result);
    Loads loads;
    for (std::size_t k = 0; k < 2; ++k)
      loads[k] = {{forces[k].x, forces[k].y, forces[k].z}, {torques[k].x, torques[k].y, torques[k].z}};
    return loads;
  }

  static constexpr std::size_t set_ = 0;  // generic instructions: all give the same bits
  const KernelSet& kernels_;
  bool is_3d_;
  ContactParameters parameters_;
  GrainSurfaces grains_;
  PairList list_;
  ContactHistories histories_;
};

/// Velocity Verlet with predicted velocities, as the simulation has it.
Balls after_impact(Contact2& contact, Balls balls, double dt, int steps) {
  Loads loads = contact.loads(balls, {});
  const auto rates = [](const Load& load) {
    return std::pair<Eigen::Vector3d, Eigen::Vector3d>(load.force / mass, load.torque * inverse_inertia);
  };
  for (int step = 0; step < steps; ++step) {
    for (std::size_t k = 0; k < 2; ++k) {
      const auto [a, alpha] = rates(loads[k]);
      balls[k].x += dt * (balls[k].v + 0.5 * dt * a);
      balls[k].v += dt * a, balls[k].omega += dt * alpha;
    }
    const Loads before = loads;
    loads = contact.loads(balls, {.trial = 0.5 * dt, .commit = dt});
    for (std::size_t k = 0; k < 2; ++k) {
      const auto [a, alpha] = rates(loads[k]);
      const auto [a0, alpha0] = rates(before[k]);
      balls[k].v += 0.5 * dt * (a - a0), balls[k].omega += 0.5 * dt * (alpha - alpha0);
    }
  }
  return balls;
}

EffectSet with_friction(bool spring, Rolling rolling) {
  EffectSet effects{};
  effects.friction = effects.rotation = effects.damping = true;
  effects.tangential_spring = spring;
  effects.rolling = rolling;
  return effects;
}

Balls turned(const Balls& balls, const Eigen::Matrix3d& by) {
  Balls made;
  for (std::size_t k = 0; k < 2; ++k) made[k] = {by * balls[k].x, by * balls[k].v, by * balls[k].omega};
  return made;
}

double difference(const Balls& a, const Balls& b) {
  double largest = 0;
  for (std::size_t k = 0; k < 2; ++k)
    largest = std::max({largest, (a[k].v - b[k].v).norm(), radius * (a[k].omega - b[k].omega).norm()});
  return largest;
}

double uniform(double from, double to) {
  return from + (to - from) * *rc::gen::inRange(0, 1000001) / 1e6;
}
Eigen::Matrix3d random_turn() {
  Eigen::Quaterniond q(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
  return q.norm() > 0.01 ? q.normalized().toRotationMatrix() : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
}

/// Two balls about to meet somewhere off their centres, in the plane z = 0 and spinning about z, at up to 1 m/s.
Balls about_to_meet() {
  const double at = uniform(-1.2, 1.2), speed = uniform(0.05, 1);
  Balls balls;
  balls[0].x = -1.0007 * radius * Eigen::Vector3d(std::cos(at), std::sin(at), 0), balls[1].x = -balls[0].x;
  balls[0].v = {speed, 0, 0}, balls[1].v = {uniform(-0.02, 0), uniform(-0.1, 0.1), 0};
  balls[0].omega.z() = uniform(-100, 100), balls[1].omega.z() = uniform(-100, 100);
  return balls;
}

void expect_like_the_plane(Law law, bool spring, Rolling rolling) {
  const EffectSet effects = with_friction(spring, rolling);
  const Balls start = about_to_meet();
  const Eigen::Matrix3d turn = random_turn();
  Contact2 plane(law, effects, false), space(law, effects, true);
  const double dt = 1e-6;
  const Balls expected = turned(after_impact(plane, start, dt, 4000), turn);
  const double found = difference(after_impact(space, turned(start, turn), dt, 4000), expected);
  RC_LOG() << "difference " << found << " m/s\n";
  // A spring is carried on by a small rotation, to the third order in its angle: the worst of 9000 impacts lay
  // at 3.5e-11.
  RC_ASSERT(found < 1e-10);
}

RC_GTEST_PROP(Kernel3d, AnImpactInAPlaneOfSpaceIsThePlanesShell, ()) {
  expect_like_the_plane(Law::elastic_shell, *rc::gen::arbitrary<bool>(),
                        *rc::gen::element(Rolling::none, Rolling::constant_torque, Rolling::spring));
}
RC_GTEST_PROP(Kernel3d, AnImpactInAPlaneOfSpaceIsThePlanesHertz, ()) {
  expect_like_the_plane(Law::hertz, *rc::gen::arbitrary<bool>(),
                        *rc::gen::element(Rolling::none, Rolling::constant_torque, Rolling::spring));
}
RC_GTEST_PROP(Kernel3d, AnImpactInAPlaneOfSpaceIsThePlanesPaperB, ()) {
  expect_like_the_plane(Law::hertz_viscous, *rc::gen::arbitrary<bool>(), Rolling::none);
}

TEST(Kernel3d, NoForceOrTorqueComesFromNothing) {
  Balls balls;
  balls[0].x = {-0.95 * radius, 0, 0}, balls[1].x = {0.9 * radius, 0.1 * radius, 0.2 * radius};
  balls[0].v = {0.3, -0.2, 0.5}, balls[0].omega = {10, 20, -30}, balls[1].omega = {-5, 7, 11};
  Contact2 contact(Law::elastic_shell, with_friction(true, Rolling::spring), true);
  const Loads loads = contact.loads(balls, {.trial = 1e-5, .commit = 1e-5});
  EXPECT_GT(loads[0].force.norm(), 0);
  EXPECT_EQ(loads[0].force, -loads[1].force);
  const Eigen::Vector3d moment =
      balls[0].x.cross(loads[0].force) + balls[1].x.cross(loads[1].force) + loads[0].torque + loads[1].torque;
  EXPECT_LT(moment.norm(), 1e-12 * radius * loads[0].force.norm());
}

/// Two balls that touch, held by a spring, carried round an axis together `steps` times by `angle` (rad): how far the
/// force is then from where it would have been carried, over its size.
double error_after_turning(const Eigen::Vector3d& axis, double angle, int steps) {
  Contact2 contact(Law::elastic_shell, with_friction(true, Rolling::none), true);
  const double dt = 1;  // s: slow, so that no speed's rounding counts
  Balls start;
  start[0].x = {-0.99 * radius, 0, 0}, start[1].x = {0.99 * radius, 0, 0};
  start[1].v = {0, 1e-5, 1.5e-5};
  contact.loads(start, {.trial = dt, .commit = dt});  // stretches the spring
  const ContactStep still{.trial = dt, .commit = dt};
  start[1].v = Eigen::Vector3d::Zero();
  const Loads held = contact.loads(start, still);
  Balls now;
  Loads loads = held;
  for (int step = 1; step <= steps; ++step) {
    const Eigen::AngleAxisd turn(std::remainder(angle * step, 2 * std::numbers::pi), axis);
    for (std::size_t k = 0; k < 2; ++k) {
      now[k].x = turn * start[k].x, now[k].omega = angle / dt * axis;
      now[k].v = now[k].omega.cross(now[k].x);
    }
    loads = contact.loads(now, still);
  }
  const Eigen::Vector3d expected =
      Eigen::AngleAxisd(std::remainder(angle * steps, 2 * std::numbers::pi), axis) * held[0].force;
  const Eigen::Vector3d tangential =
      held[0].force - held[0].force.dot(Eigen::Vector3d::UnitX()) * Eigen::Vector3d::UnitX();
  return (loads[0].force - expected).norm() / tangential.norm();
}

TEST(Kernel3d, ASpringCarriedRoundAcrossItsNormalErrsByThirdOrder) {
  // Ten turns, of 1e-3 rad a step as a fast ball makes and twice as far.
  const auto error = [](int steps_a_turn) {
    return error_after_turning(Eigen::Vector3d(0, 0.6, 0.8), 2 * std::numbers::pi / steps_a_turn, 10 * steps_a_turn);
  };
  const double coarse = error(3142), fine = error(6283);
  EXPECT_LT(fine, 1e-6);
  EXPECT_NEAR(std::log2(coarse / fine), 3, 0.1);
}

TEST(Kernel3d, ASpringCarriedRoundATiltedAxisErrsBySecondOrder) {
  const Eigen::Vector3d axis = Eigen::Vector3d(0.5, 0.6, 0.8).normalized();
  const double coarse = error_after_turning(axis, 0.02, 100), fine = error_after_turning(axis, 0.01, 200);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
}

/// Entries of a list one by one, and in blocks: each a pair of balls, of which now these and now those touch.
class ManyContacts {
 public:
  ManyContacts(int pairs, int entries_at_once)
      : entries_at_once_(entries_at_once), places_(2 * static_cast<std::size_t>(pairs)), motions_(places_.size()) {
    for (int k = 0; k < pairs; ++k) list_.add(2 * k + 1, 2 * k);
    histories_.resize(list_.size(), {true, true, true});
  }

  void evaluate(int step) {
    const ContactStep advance{.trial = 1e-5, .commit = 1e-5};
    const int pairs = static_cast<int>(list_.size());
    for (int k = 0; k < pairs; ++k) {
      const bool touches = (7 * k + 3 * step * step) % 5 < 2;
      const double apart = 2 * radius + (touches ? -1e-6 : 1e-6), spin = 3 + 0.1 * k + step;
      const std::size_t even = 2 * static_cast<std::size_t>(k), odd = even + 1;
      places_[even] = {0.1 * k, 0, 0, 0}, places_[odd] = {0.1 * k + 0.8 * apart, 0.6 * apart, 0, 0};
      motions_[even] = {{0.2, -0.01 * k, 0.1 * step, 0}, {spin, 2, -spin, 0}};
      motions_[odd] = {{-0.1, 0.3, 0.02 * k, 0}, {-1, 0.5 * spin, 4, 0}};
    }
    std::vector<GrainVector> forces(places_.size()), torques(places_.size());
    PairResult3d result;
    result.forces = forces.data(), result.torques = torques.data(), result.first_own = 0;
    const Motion3d at{places_.data(), places_.data(), motions_.data()};
    for (int from = 0; from < pairs; from += entries_at_once_)
      kernels_.vectors_3d[0].pair(grains_, at, list_, {from, std::min(from + entries_at_once_, pairs)}, parameters_,
                                  advance, histories_, result);
  }

  std::vector<double> history(std::size_t k) const {
    if (!histories_.has_history(k)) return {};
    return {histories_.record(k), histories_.record(k) + histories_.kinds.record_length()};
  }

 private:
  const KernelSet& kernels_ = kernels_for(Law::hertz, with_friction(true, Rolling::spring));
  const ContactParameters parameters_ = parameters(0.4);
  const GrainSurfaces grains_ = surfaces_of_balls(Law::hertz);
  int entries_at_once_;
  PairList list_;
  ContactHistories histories_;
  std::vector<GrainVector> places_;
  std::vector<BallMotion> motions_;
};

TEST(Kernel3d, EachPairOfABlockKeepsItsOwnHistory) {
  constexpr int pairs = 2 * pair_block_size + 77;
  ManyContacts alone(pairs, 1), in_blocks(pairs, pair_block_size);
  for (int step = 0; step < 6; ++step) {
    alone.evaluate(step), in_blocks.evaluate(step);
    std::size_t touching = 0;
    for (std::size_t k = 0; k < pairs; ++k) {
      ASSERT_EQ(in_blocks.history(k), alone.history(k)) << "pair " << k << " in step " << step;
      touching += alone.history(k).empty() ? 0 : 1;
    }
    EXPECT_NEAR(static_cast<double>(touching), 0.4 * pairs, 2);
  }
}

}  // namespace
}  // namespace vibrosow
