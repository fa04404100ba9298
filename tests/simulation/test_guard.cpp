// The guard: it stops a run before a wrong number is written, says which grain, where, when and what to change, and
// counts what it let pass.
#include <gmock/gmock.h>

#include <cmath>
#include <regex>

#include "simulation/simulation.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

using testing::HasSubstr;

class GuardIn : public testing::TestWithParam<Space> {
 protected:
  static bool is_3d() { return GetParam() == Space::three_dimensional; }
};
INSTANTIATE_TEST_SUITE_P(Spaces, GuardIn, testing::ValuesIn(both_spaces), named_by_space);

TEST_P(GuardIn, WhatIsNotANumberIsNeverCounted) {
  Bench bench(GetParam());
  bench.gravity = {0, -standard_gravity};
  bench.scene.tray.holes = {{.centre = 0.5, .width = 0.1, .across = 0.5, .across_length = 0.1}};
  bench.place(0.5, -0.005, 0, -0.1);
  Simulation& run = bench.start(1e-5);
  run.steps(3);
  run.grains().y[0] = std::nan("");
  run.steps(300);
  ASSERT_TRUE(run.guard().stop_reason());
  EXPECT_THAT(*run.guard().stop_reason(), HasSubstr("not a number"));
  EXPECT_EQ(run.result().events.size(), 0u);
  EXPECT_EQ(run.result().balance.counted, 0);
}

/// A few grains at rest on the floor, of a run of so many steps.
struct Resting {
  static constexpr double dt = 1e-5;  // s
  Scene scene;

  Resting(Space space, int steps) : scene(Bench(space).scene) {
    scene.contact.seed = scene.contact.wall = {0.3, 0.5};
    scene.numerics.dt = dt;
    scene.tray.fill = Fill{3, Packing::layers, 0, false};
    scene.tray.motion = HarmonicMotion{0, 5e-3, 10, 0};  // so that there is some energy in play
    scene.run.duration = steps * dt;
  }
  std::unique_ptr<Simulation> start() const { return std::make_unique<Simulation>(prepare(scene), 1); }
};

/// Energy from nowhere, as a step that is too long makes it.
void make_energy(Simulation& run) {
  for (double& speed : run.grains().vx) speed += 0.5;
}

TEST_P(GuardIn, NothingIsRecordedNorLookedAtOnceItHasStopped) {
  Resting resting(GetParam(), 1000);
  resting.scene.record = Record{{99.5 * Resting::dt}, 0.01};
  const auto run = resting.start();
  int looks = 0;
  run->watch(100 * Resting::dt, [&](Simulation&) { ++looks; });
  run->steps(50);
  make_energy(*run);
  run->steps(100);
  ASSERT_TRUE(run->guard().stop_reason());
  EXPECT_THAT(*run->guard().stop_reason(), HasSubstr("numerics made"));
  EXPECT_EQ(run->result().snapshots.size(), 0u);
  EXPECT_EQ(looks, 0) << "a checkpoint is such a look";
}

TEST_P(GuardIn, TheAccountIsTakenAtTheVeryEnd) {
  const auto run = Resting(GetParam(), 150).start();
  run->run_until(1);
  ASSERT_TRUE(run->at_end());
  EXPECT_EQ(run->result().energy.kinetic, kinetic_energy(run->grains()));
  EXPECT_EQ(run->result().energy.potential, potential_energy(run->grains(), run->model().gravity));

  const auto other = Resting(GetParam(), 150).start();
  other->steps(120);
  make_energy(*other);
  other->run_until(1);
  EXPECT_TRUE(other->guard().stop_reason()) << "energy that was made after the last whole hundred of steps";
}

TEST_P(GuardIn, ARunWhoseLimitsWereRaisedAndNeededIsOutsideTheModel) {
  const auto outside = [](const Scene& scene, auto do_something) {
    Simulation run(prepare(scene), 1);
    run.steps(50);
    do_something(run);
    run.run_until(scene.run.duration);
    EXPECT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
    return run.result().outside_the_model;
  };
  const auto nothing = [](Simulation&) {};
  const auto hit_the_floor = [](Simulation& run) { run.grains().vy[0] = -1.5; };  // a compression of 8 %
  const Scene ordinary = Resting(GetParam(), 400).scene;
  EXPECT_FALSE(outside(ordinary, nothing));

  Scene tolerant = ordinary;
  tolerant.guard.energy_tolerance = 1e9;
  EXPECT_FALSE(outside(tolerant, nothing));
  EXPECT_TRUE(outside(tolerant, make_energy));

  Scene stop_raised = tolerant;
  stop_raised.guard.stop_relative_overlap = 100;
  EXPECT_FALSE(outside(stop_raised, nothing));
  EXPECT_TRUE(outside(stop_raised, hit_the_floor));
  Scene both_raised = stop_raised;
  both_raised.guard.warn_relative_overlap = 50;
  EXPECT_TRUE(outside(both_raised, hit_the_floor)) << "though it was not to be warned of";

  Scene through = both_raised;
  through.contact.shell_compression = 0.5;
  EXPECT_TRUE(outside(through, [](Simulation& run) { run.grains().vy[0] = -20; }));
}

/// The number that a message gives after "KEY = ".
double advised(const std::string& message, const std::string& key) {
  std::smatch found;
  const bool there = std::regex_search(message, found, std::regex(key + " = ([-+.e0-9]+)"));
  EXPECT_TRUE(there) << key << " is not in: " << message;
  return there ? std::stod(found[1]) : 0;
}

struct LawIn {
  Space space;
  Law law;
};
class GuardOfLaw : public testing::TestWithParam<LawIn> {};
INSTANTIATE_TEST_SUITE_P(Laws, GuardOfLaw,
                         testing::Values(LawIn{Space::two_dimensional, Law::elastic_shell},
                                         LawIn{Space::two_dimensional, Law::hertz},
                                         LawIn{Space::three_dimensional, Law::elastic_shell},
                                         LawIn{Space::three_dimensional, Law::hertz}));

/// Grain 1 of two hits the floor so hard that its relative overlap would pass 0.6.
std::unique_ptr<Bench> hard_hit(const LawIn& in) {
  auto bench = std::make_unique<Bench>(in.space);
  bench->scene.contact.law = in.law;
  bench->scene.contact.shell_compression = 0.01, bench->scene.contact.youngs_modulus = 1e5;
  bench->place(0.2, 0.5).place(0.7, 0.01, 0, -2);
  return bench;
}

TEST_P(GuardOfLaw, ADeepContactIsToldWithItsGrainAndTheStiffnessThatBearsIt) {
  const bool shell = GetParam().law == Law::elastic_shell;
  const auto bench = hard_hit(GetParam());
  Simulation& run = bench->start(1e-6);
  run.steps(20000);
  ASSERT_TRUE(run.guard().stop_reason());
  const std::string reason = *run.guard().stop_reason();
  EXPECT_THAT(reason, HasSubstr("grain 1 (grain) at x 700 mm, y "));
  EXPECT_THAT(reason, HasSubstr("in a wall"));
  EXPECT_THAT(reason, HasSubstr("at 0.00"));  // s

  const auto stiffer = hard_hit(GetParam());
  Contact& contact = stiffer->scene.contact;
  (shell ? contact.shell_compression : contact.youngs_modulus) =
      advised(reason, shell ? "contact.shell_compression" : "contact.youngs_modulus");
  Simulation& again = stiffer->start(1e-6);
  again.steps(20000);
  EXPECT_FALSE(again.guard().stop_reason());
  const double reached = again.result().max_relative_overlap;
  EXPECT_LE(reached, GuardLimits{}.warn_relative_overlap);
  EXPECT_GT(reached, 0.2 * GuardLimits{}.warn_relative_overlap) << "no stiffer than need be";
}

TEST_P(GuardIn, OfALotWithItsOwnStiffnessItsOwnKeyIsNamed) {
  const auto bench = hard_hit({GetParam(), Law::elastic_shell});
  bench->scene.lots[0].shell_compression = 0.02;
  Simulation& run = bench->start(1e-6);
  run.steps(20000);
  EXPECT_LT(advised(run.guard().stop_reason().value_or(""), "seeds.grain.shell_compression"), 0.02);
}

TEST_P(GuardIn, TwoGrainsInEachOtherAreBothNamed) {
  Bench bench(GetParam());
  bench.place(0.2, 0.5).place(0.5, 0.5).place(0.503, 0.5);
  Simulation& run = bench.start(1e-5);
  run.step();
  EXPECT_THAT(run.guard().stop_reason().value_or(""), testing::ContainsRegex("grain [12] .* in grain [12];"));
}

TEST_P(GuardIn, AGrainTooFastForItsStepIsToldWithAStepThatBearsIt) {
  const auto reason_of = [](Simulation& run) { return run.guard().stop_reason().value_or(""); };
  Bench fast(GetParam());
  fast.place(0.2, 0.5).place(0.3, 0.5, 50, 0);
  Simulation& run = fast.start(1e-4);
  run.steps(5);
  const std::string told = reason_of(run);
  EXPECT_THAT(told, HasSubstr("grain 1 (grain) at x 30"));
  EXPECT_THAT(told, HasSubstr("moves at 50 m/s"));
  Bench slower(GetParam());
  slower.place(0.2, 0.5).place(0.3, 0.5, 50, 0);
  Simulation& again = slower.start(advised(told, "numerics.dt"));
  again.steps(5);
  EXPECT_EQ(reason_of(again), "");
}

TEST_P(GuardIn, WhatIsNotANumberIsToldWithItsGrain) {
  Bench bench(GetParam());
  bench.place(0.2, 0.5).place(0.5, 0.5);
  Simulation& run = bench.start(1e-5);
  run.grains().vy[1] = std::nan("");
  run.step();
  EXPECT_THAT(run.guard().stop_reason().value_or(""), HasSubstr("the state of grain 1 (grain) at x 500 mm"));
}

TEST_P(GuardIn, AStepThatMakesEnergyIsToldWithOneThatMakesNone) {
  const auto run_with = [](double dt) {
    Bench bench(GetParam());
    bench.scene.numerics.integrator = Integrator::rk2_midpoint;
    bench.scene.guard.stop_relative_overlap = 100;
    bench.gravity = {0, -standard_gravity};
    bench.place(0.5, 0.02);
    Simulation& run = bench.start(dt);
    run.steps(std::llround(0.5 / dt));
    return run.guard().stop_reason().value_or("");
  };
  const std::string reason = run_with(Bench(GetParam()).contact_time() / 3);
  EXPECT_THAT(reason, HasSubstr("the fastest is grain 0 (grain)"));
  EXPECT_EQ(run_with(advised(reason, "numerics.dt")), "");
}

TEST_P(GuardIn, StepsThatItLetPassAreCounted) {
  Bench bench(GetParam());
  bench.place(0.5, 0.006, 0, -1.5);  // 8 % of the radius
  Simulation& run = bench.start(1e-6);
  std::int64_t deep = 0;
  for (int step = 0; step < 6000; ++step) {
    ASSERT_TRUE(run.step());
    deep += Bench::radius - run.grains().y[0] > GuardLimits{}.warn_relative_overlap * Bench::radius ? 1 : 0;
  }
  EXPECT_GT(deep, 100);
  EXPECT_EQ(run.result().let_pass.deep_steps, deep);
  ASSERT_EQ(run.result().warnings.size(), 1u);
  EXPECT_THAT(run.result().warnings[0].text, HasSubstr(std::to_string(deep) + " steps"));
}

TEST_P(GuardIn, AGrainThatWentThroughAWallIsNamed) {
  Bench bench(GetParam());
  bench.scene.contact.shell_compression = 0.5;
  bench.scene.guard.stop_relative_overlap = 0.99;  // it is through before its contact is deeper
  bench.scene.guard.energy_tolerance = 1e9;
  bench.place(0.2, 0.5).place(0.5, 0.0041, 0, -15);
  Simulation& run = bench.start(1e-4);
  run.steps(10);
  const std::string reason = run.guard().stop_reason().value_or("");
  EXPECT_THAT(reason, HasSubstr("grain 1 (grain)"));
  EXPECT_LT(advised(reason, "contact.shell_compression"), 0.5);
}

}  // namespace
}  // namespace vibrosow
