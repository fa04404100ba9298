// A few grains in cases that break a discrete-element code, in 2D and in 3D: each must stay bounded, or be
// stopped with a reason.
#include <cmath>
#include <functional>

#include "stability/bounds.hpp"

namespace vibrosow {
namespace {

class HardImpact : public testing::TestWithParam<Setting> {};
INSTANTIATE_TEST_SUITE_P(Stability, HardImpact, testing::ValuesIn(settings()), named_by_setting);

class HardImpact3d : public HardImpact {};
INSTANTIATE_TEST_SUITE_P(Stability, HardImpact3d, testing::ValuesIn(settings_3d()), named_by_setting);
class UnsoftenedHertz : public HardImpact {};
INSTANTIATE_TEST_SUITE_P(Stability, UnsoftenedHertz, testing::ValuesIn(settings_where([](const Setting& setting) {
                           return setting.law != Law::elastic_shell;
                         })),
                         named_by_setting);

/// Laws that keep the energy of an impact.
std::vector<Setting> elastic_settings() {
  return settings_where([](const Setting& setting) { return setting.law != Law::hertz_viscous; });
}
class ElasticImpact : public testing::TestWithParam<Setting> {};
INSTANTIATE_TEST_SUITE_P(Stability, ElasticImpact, testing::ValuesIn(elastic_settings()), named_by_setting);

constexpr double z = std::numbers::pi / 20;  // omega dt of one shell on a wall, at 20 steps a contact

/// Mean relative gain of energy of RK2 in an impact. Two edges that push at once are twice as stiff.
double mean_gain(const Setting& setting, int at_once = 1) {
  const double phase = z * std::sqrt(at_once);
  return (setting.law == Law::hertz ? 1.4 : 1) * std::numbers::pi / 4 * phase * phase * phase;
}

/// Relative change of energy in one elastic impact: under all schemes the kink at touch and parting gives up to 0.23
/// z^2 of either sign, and RK2 its mean gain on top.
double largest_change(const Setting& setting, int at_once) {
  const double kink = 0.23 * at_once * z * z;
  return setting.scheme == Integrator::rk2_midpoint ? kink + mean_gain(setting, at_once) : kink;
}

struct Changes {
  double largest = 0, mean = 0;  // of energy, relative, in one throw
};

/// Something to throw an elastic grain at many times, aimed differently for every part of 1.
struct Target {
  std::string name;
  double speed;  // m/s
  std::function<void(Bench& bench, double part)> aim;
  int at_once = 1;  // how many walls push at once with much of their force in common
};

Changes throw_at(const Setting& setting, const Target& target, int throws) {
  Changes changes;
  for (int k = 0; k < throws; ++k) {
    Bench bench = setting.bench();
    target.aim(bench, static_cast<double>(k) / throws);
    Simulation& run = bench.start(contact_time(setting, bench, target.speed) / 20);
    const double before = total_energy(run, bench.gravity);
    while (run.statistics().contacts == 0 && run.time() < 1 && run.step()) {
    }
    EXPECT_GT(run.statistics().contacts, 0);
    for (std::int64_t seen = -1; seen != run.statistics().contacts;) {
      seen = run.statistics().contacts;
      run.steps(3);
    }
    const double change = total_energy(run, bench.gravity) / before - 1;
    changes.largest = std::max(changes.largest, std::abs(change));
    changes.mean += change / throws;
  }
  return changes;
}

/// m; from head-on to grazing at an edge.
double aside(double part) {
  return -0.2 * Bench::radius + 1.19 * Bench::radius * part;
}

std::vector<Target> targets(Space space) {
  if (space == Space::two_dimensional)
    return {{"hole's edge", 0.2,
             [](Bench& bench, double part) {
               bench.scene.tray.holes = {{0.5, 0.1}};
               bench.place(0.45 + aside(part), 0.02, 0, -0.2);
             }},
            {"corner", 0.3, [](Bench& bench, double part) {  // an impact on each wall: they share the energy
               const double angle = 0.05 + 1.45 * part;
               bench.place(0.02, 0.02, -0.3 * std::cos(angle), -0.3 * std::sin(angle));
             }}};
  const auto around = [](double part) {  // many times
    return Eigen::Vector3d(std::cos(71 * part), 0, std::sin(71 * part));
  };
  return {{"rim", 0.2,
           [=](Bench& bench, double part) {
             bench.scene.tray.holes = {{.centre = 0.5, .width = 0.1, .shape = HoleShape::round, .across = 0.5}};
             const Eigen::Vector3d outwards = around(part), along(-outwards.z(), 0, outwards.x());
             bench.place(Eigen::Vector3d(0.5, 0.02, 0.5) + (0.05 - aside(part)) * outwards,
                         0.05 * along - 0.19 * Eigen::Vector3d::UnitY());
           }},
          {"slot's corner", 0.2,
           [=](Bench& bench, double part) {
             bench.scene.tray.holes = {{.centre = 0.5, .width = 0.1, .across = 0.5, .across_length = 0.1}};
             bench.place({0.45 + aside(part), 0.02, 0.45 + aside(std::fmod(7 * part, 1))}, {0.01, -0.19, -0.02});
           },
           2},
          {"corner", 0.3,
           [=](Bench& bench, double part) {
             const double angle = 0.05 + 1.45 * part, height = 0.05 + 1.45 * std::fmod(7 * part, 1);
             bench.place({0.02, 0.02, 0.02},
                         -0.3 * Eigen::Vector3d(std::cos(height) * std::cos(angle), std::sin(height),
                                                std::cos(height) * std::sin(angle)));
           }},
          {"wall's edge", 0.2,
           [=](Bench& bench, double part) {
             bench.scene.tray.height = 0.1;
             bench.place({(2 * part - 1) * 0.99 * Bench::radius, 0.12, 0.5}, {0, -0.19, 0.05});
           }},
          {"walls' corner", 0.2,
           [=](Bench& bench, double part) {
             bench.scene.tray.height = 0.1;
             bench.place(Eigen::Vector3d(0, 0.12, 0) + part * 0.99 * Bench::radius * around(part), {0, -0.2, 0});
           },
           2}};
}

TEST_P(ElasticImpact, OnEdgesAndInCornersKeepsItsEnergy) {
  for (const Target& target : targets(GetParam().space)) {
    SCOPED_TRACE(target.name);
    const Changes changes = throw_at(GetParam(), target, GetParam().is_3d() ? 80 : 200);
    const Bounds bounds("elastic impact: " + target.name, GetParam(), GetParam().bench().scene.contact);
    bounds.at_most("relative change of energy", changes.largest, largest_change(GetParam(), target.at_once));
    bounds.at_most("its mean, either way", std::abs(changes.mean), mean_gain(GetParam(), target.at_once));
  }
}

/// Of one impact with 20 steps a contact, relative to its energy: what is the same in every one, and the root mean
/// square of what differs with the moment of touch (reports/verification/order.csv, at 25 steps, twice that of speed).
struct ErrorOfImpact {
  double mean, scatter;
};
ErrorOfImpact error_of_impact(const Setting& setting) {
  const bool shell = setting.law == Law::elastic_shell;
  switch (setting.scheme) {
    case Integrator::velocity_verlet:
      return {0, shell ? 2 * 7.35e-5 * std::pow(1.25, 3) : 2 * 1.73e-4 * std::pow(1.25, 2.5)};
    case Integrator::rk2_midpoint:
      return {mean_gain(setting), 0};
    default:
      return {0, shell ? 2 * 7.02e-4 * std::pow(1.25, 2) : 2 * 3.44e-4 * std::pow(1.25, 2.5)};
  }
}

// An impact concerns the energy of two among all grains.
TEST_P(ElasticImpact, OfAGasDriftsAsItsImpactsDo) {
  Bench bench = GetParam().bench();
  const bool is_3d = GetParam().is_3d(), verlet = GetParam().scheme == Integrator::velocity_verlet;
  const int grains = is_3d ? 27 : 64;
  if (is_3d) {
    bench.scene.tray.length = 0.05, bench.scene.tray.depth = 0.05;
    for (int k = 0; k < grains; ++k)
      bench.place({0.008 + 0.016 * (k % 3), 0.008 + 0.016 * (k / 3 % 3), 0.008 + 0.016 * (k / 9)},
                  {0.3 * std::sin(1.7 * k), -0.3 * std::cos(2.3 * k), 0.3 * std::sin(2.9 * k + 1)});
  } else {
    bench.scene.tray.length = 0.1;
    for (int k = 0; k < grains; ++k)
      bench.place(0.006 + 0.0125 * (k % 8), 0.006 + 0.0115 * (k / 8), 0.3 * std::sin(1.7 * k),
                  -0.3 * std::cos(2.3 * k) * (k % 2));
  }
  bench.gravity = {0, -standard_gravity};  // the box has no lid: its walls are 1 m high
  Simulation& run = bench.start(contact_time(GetParam(), bench, 0.5) / 20);
  const double before = total_energy(run, bench.gravity);
  run.steps(verlet ? (is_3d ? 1000000 : 300000) : (is_3d ? 30000 : 10000));
  ASSERT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
  const double evaluations = GetParam().scheme == Integrator::rk2_midpoint ? 40 : 20;
  const double impacts = static_cast<double>(run.statistics().contacts) / evaluations;
  const ErrorOfImpact error = error_of_impact(GetParam());
  const double bound = 2.0 / grains * (error.mean * impacts + 3 * error.scatter * std::sqrt(impacts));
  const double drift = std::log(total_energy(run, bench.gravity) / before);
  EXPECT_GT(impacts, 20 * grains);
  const Bounds bounds("elastic gas", GetParam(), bench.scene.contact);
  bounds.at_most("drift of its log energy, either way", std::abs(drift), bound);
  bounds.just("grains inside", static_cast<double>(run.result().balance.inside), grains);
}

Eigen::Vector3d centre_of_mass(const Grains& g) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < g.size(); ++i) sum += place_of(g, i) / static_cast<double>(g.size());
  return sum;
}

/// Grains that overlap at the start, the guard told to bear it: what they fly apart with is no more than what their
/// springs held, and what they were pushed by they push.
void expect_to_part(const std::string& name, const Setting& setting, Bench& bench, double dt) {
  bench.scene.guard.stop_relative_overlap = 100;
  bench.scene.contact.seed = {0.3, 0.5};
  Simulation& run = bench.start(dt);
  run.field().evaluate(0, {});
  const double stored = run.field().elastic_energy();
  const Eigen::Vector3d centre = centre_of_mass(run.grains());
  double most = 0;
  while (run.time() < 500 * dt) {
    ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
    most = std::max(most, kinetic_energy(run.grains()));
  }
  EXPECT_GT(stored, 0);
  const Bounds bounds(name, setting, bench.scene.contact);
  bounds.at_most("largest kinetic energy", most, stored, "J");
  bounds.at_least("largest kinetic energy", most, 0.05 * stored, "J");
  const Grains& g = run.grains();
  bounds.at_most("way of the centre of mass", (centre_of_mass(g) - centre).norm(), 1e-12, "m");
  double nearest = 1;
  for (std::size_t i = 0; i < g.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, (place_of(g, i) - place_of(g, j)).norm());
  bounds.at_least("distance of the nearest two", nearest, 2 * Bench::radius, "m");
}

/// A fiftieth of the time in which grains fly apart that overlap by `overlap`.
double parting_step(const Setting& setting, const Bench& bench, double overlap) {
  if (setting.law == Law::elastic_shell) return bench.contact_time() / 50;
  const double stiffness = 2.0 / 3 * 2e7 / 0.91 * std::sqrt(0.5 * Bench::radius);
  return std::numbers::pi * std::sqrt(0.5 * Bench::mass / (stiffness * std::sqrt(overlap))) / 50;
}

TEST_P(HardImpact, CoincidentCentresPart) {
  Bench bench = GetParam().bench();
  bench.place(0.5, 0.5).place(0.5, 0.5);
  expect_to_part("coincident centres, borne", GetParam(), bench, parting_step(GetParam(), bench, 2 * Bench::radius));
}

TEST_P(HardImpact, AnOverlappingStartIsRelaxedWithoutAnExplosion) {
  Bench bench = GetParam().bench();
  const double apart = 1.6 * Bench::radius;
  for (int k = 0; k < (GetParam().is_3d() ? 27 : 9); ++k)
    bench.place({0.5 + apart * (k % 3), 0.5 + apart * (k / 3 % 3), 0.5 + apart * (k / 9)});
  expect_to_part("overlapping start that was asked for", GetParam(), bench,
                 parting_step(GetParam(), bench, 0.4 * Bench::radius));
}

TEST_P(HardImpact, CoincidentCentresStopAnOrdinaryRun) {
  Bench bench = GetParam().bench();
  bench.place(0.5, 0.5).place(0.5, 0.5);
  Simulation& run = bench.start(parting_step(GetParam(), bench, 2 * Bench::radius));
  EXPECT_FALSE(run.step());
  Bounds("coincident centres in an ordinary run", GetParam(), bench.scene.contact)
      .stopped(run.guard().stop_reason(), "relative overlap", run.result().balance);
}

/// A wall that a grain flies at, where from and which way.
struct Shot {
  std::string name;
  Eigen::Vector3d from, direction;
  std::vector<WallPiece> pieces{};
};
std::vector<Shot> shots(Space space) {
  std::vector<Shot> all = {{"floor", {0.5, 0.02, 0.5}, {0, -1, 0}}};
  if (space == Space::two_dimensional) return all;
  const WallPiece cone{.a = {0.1, 0.2}, .b = {0.4, 0.6}, .about = Eigen::Vector2d(0.5, 0.5)};
  const WallPiece cylinder{.a = {0.2, 0.2}, .b = {0.2, 0.6}, .about = Eigen::Vector2d(0.5, 0.5)};
  const WallPiece rod{.a = {0.2, 0.2}, .b = {0.2, 0.6}, .about = Eigen::Vector2d(0.5, 0.5), .axis = PieceAxis::along};
  all.push_back({"front", {0.5, 0.5, 0.02}, {0, 0, -1}});
  all.push_back({"edge of floor and front", {0.5, 0.02, 0.02}, Eigen::Vector3d(0, -1, -1).normalized()});
  all.push_back({"corner", {0.02, 0.02, 0.02}, Eigen::Vector3d(-1, -1, -1).normalized()});
  all.push_back({"cone", {0.6, 0.4, 0.6}, Eigen::Vector3d(0.8, -0.6, 0), {cone}});
  all.push_back({"cylinder from outside", {0.5, 0.4, 0.72}, {0, 0, -1}, {cylinder}});
  all.push_back({"rod along", {0.4, 0.72, 0.5}, {0, -1, 0}, {rod}});
  return all;
}

TEST_P(HardImpact, AGrainThatCouldCrossAWallInOneStepIsStoppedNotLost) {
  for (const Shot& shot : shots(GetParam().space))
    for (const double speed : {60.0, 500.0, 1e6, 1e300}) {
      SCOPED_TRACE(testing::Message() << shot.name << " at " << speed << " m/s");
      Bench bench = GetParam().bench();
      bench.scene.tray.pieces = shot.pieces;
      bench.place(shot.from, speed * shot.direction);
      Simulation& run = bench.start(1e-4);
      run.steps(10);
      const Bounds bounds("grain fast enough to cross a wall in one step", GetParam(), bench.scene.contact);
      bounds.stopped(run.guard().stop_reason(), "", run.result().balance);
      bounds.just("grains inside", static_cast<double>(run.result().balance.inside), 1);
    }
}

/// Of the side on which the centre is.
double side_of(const Shot& shot, const Eigen::Vector3d& at) {
  if (shot.name == "floor") return at.y();
  if (shot.name == "front") return at.z();
  if (shot.name == "rod along") return std::hypot(at.y() - 0.5, at.z() - 0.5) - 0.2;
  const double rho = std::hypot(at.x() - 0.5, at.z() - 0.5);
  return shot.name == "cone" ? 0.8 * (0.1 - rho) + 0.6 * (at.y() - 0.2) : rho - 0.2;
}

TEST_P(HardImpact, ADeepHitOnAWallIsStoppedBeforeTheCentreIsThrough) {
  for (const Shot& shot : shots(GetParam().space)) {
    if (shot.name.find("corner") != std::string::npos || shot.name.find("edge") != std::string::npos) continue;
    SCOPED_TRACE(shot.name);
    Bench bench = GetParam().bench();
    bench.scene.contact.shell_compression = 0.1, bench.scene.contact.youngs_modulus = 2e4;
    bench.scene.tray.pieces = shot.pieces;
    bench.place(shot.from, 3 * shot.direction);
    Simulation& run = bench.start(1e-5);
    const double side = side_of(shot, shot.from);
    run.steps(10000);
    const Bounds bounds("deep hit on a wall", GetParam(), bench.scene.contact);
    bounds.stopped(run.guard().stop_reason(), "relative overlap", run.result().balance);
    bounds.at_least("centre before the wall, of its radius",
                    side_of(shot, place_of(run.grains(), 0)) * std::copysign(1, side) / Bench::radius, 0);
  }
}

/// Grains of paper B and faster ones, as stiff as they are: ten thousand steps of a step that is a fiftieth of a
/// contact.
TEST_P(UnsoftenedHertz, NeitherGainsEnergyNorSinksIn) {
  Bench bench = GetParam().bench();
  constexpr double ball_radius = 0.01, modulus = 5e10, poisson = 0.2;
  bench.hertz_ball(modulus, poisson, 2500, ball_radius);
  bench.scene.contact.law = GetParam().law;
  bench.scene.contact.damping_rate = 2.1e4;  // e = 0.5 at 1 m/s
  bench.scene.contact.seed = bench.scene.contact.wall = {0.47, 0.5};
  bench.scene.contact.friction_model = FrictionModel::spring;
  bench.scene.tray.length = 0.07, bench.scene.tray.depth = 0.07;
  const int balls = GetParam().is_3d() ? 27 : 9;
  for (int k = 0; k < balls; ++k)
    bench.place({0.0115 + 0.0235 * (k % 3), 0.0115 + 0.0235 * (k / 3 % 3), 0.0115 + 0.0235 * (k / 9)},
                {2 * std::sin(1.7 * k), -2 * std::cos(2.3 * k), 2 * std::sin(2.9 * k + 1)});
  const double ball_mass = bench.scene.lots[0].mass, fastest = 2 * std::sqrt(3);
  const double stiffness = 4.0 / 3 * modulus / (1 - poisson * poisson) * std::sqrt(ball_radius);
  const HertzImpact on_wall(ball_mass, stiffness, fastest);
  Simulation& run = bench.start(on_wall.duration / 50);
  const double before = total_energy(run, bench.gravity);
  run.steps(10000);
  ASSERT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
  EXPECT_GT(run.statistics().contacts, balls * 50);
  const Bounds bounds("unsoftened Hertz, 5e10 Pa", GetParam(), bench.scene.contact);
  bounds.at_most("energy at the end", total_energy(run, bench.gravity), 0.9 * before, "J");
  bounds.at_most(made_by_numerics, run.result().energy.made_by_numerics, 0.001 * before, "J");
  bounds.at_most("largest relative overlap", run.result().max_relative_overlap, on_wall.overlap / ball_radius);
}

/// A ball that falls on a hole smaller than itself is pushed by the nearest point of its rim, which jumps to the other
/// side as the ball passes the middle. It ends up there, at the height at which the rim bears it, and jitters by what a
/// push gives it, to and fro, that lasts a step or two too long.
TEST_P(HardImpact3d, ABallOnAHoleSmallerThanItselfComesToRestOverIt) {
  Bench bench = GetParam().bench();
  bench.gravity = {0, -standard_gravity};
  bench.scene.contact.wall = {0.3, 0.5};
  constexpr double r = Bench::radius, hole_radius = 0.75 * r;
  bench.scene.tray.holes = {{.centre = 0.5, .width = 2 * hole_radius, .shape = HoleShape::round, .across = 0.5}};
  bench.place({0.501, 0.006, 0.4995}, {0.02, 0, -0.01});
  const double dt = contact_time(GetParam(), bench, 0.3) / 20;
  Simulation& run = bench.start(dt);
  run.steps(std::llround(0.4 / dt));
  double lowest = r, highest = 0, furthest = 0, squares = 0, looked = 0;
  for (; run.time() < 0.5; ++looked) {
    ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
    const Eigen::Vector3d at = place_of(run.grains(), 0);
    lowest = std::min(lowest, at.y()), highest = std::max(highest, at.y());
    furthest = std::max(furthest, std::hypot(at.x() - 0.5, at.z() - 0.5));
    squares += velocity_of(run.grains(), 0).squaredNorm();
  }
  const double rigid = std::sqrt(r * r - hole_radius * hole_radius);
  const double overlap = GetParam().overlap_at_rest(bench.scene, r / rigid);
  const double height = std::sqrt((r - overlap) * (r - overlap) - hole_radius * hole_radius);
  const double push = standard_gravity * hole_radius / rigid;  // m/s2, towards the middle
  const Bounds bounds("ball at rest on a round hole smaller than itself", GetParam(), bench.scene.contact);
  bounds.at_most("speed", std::sqrt(squares / looked), 2 * push * 2 * dt, "m/s");
  bounds.at_most("way from the middle", furthest, overlap, "m");
  bounds.at_most("height", highest, rigid, "m");
  bounds.at_least("height", lowest, height - (rigid - height), "m");
}

TEST_P(HardImpact, WhatIsNotANumberStopsTheRun) {
  std::vector<std::vector<double> Grains::*> arrays = {&Grains::x, &Grains::y, &Grains::vx, &Grains::vy,
                                                       &Grains::omega};
  if (GetParam().is_3d()) arrays.insert(arrays.end(), {&Grains::z, &Grains::vz, &Grains::omega_x, &Grains::omega_y});
  for (const double height : {0.5, 0.999 * Bench::radius})  // in flight, and on the floor
    for (const auto array : arrays) {
      Bench bench = GetParam().bench();
      bench.scene.contact.wall.friction = 0.3;
      bench.place(0.5, height);
      Simulation& run = bench.start(1e-5);
      (run.grains().*array)[0] = std::nan("");
      run.steps(200);
      Bounds("state that is not a number", GetParam(), bench.scene.contact)
          .stopped(run.guard().stop_reason(), "not a number", run.result().balance);
    }
}

}  // namespace
}  // namespace vibrosow
