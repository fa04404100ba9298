#include "selection/kim_nelson.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <tuple>

#include "selection/made_up_systems.hpp"
#include "selection/sequential_tests.hpp"

namespace vibrosow {
namespace {

Question question_of(std::size_t systems) {
  Question question;
  question.systems = systems;
  question.margin = 0.05;
  return question;
}

TEST(KimNelson, IsRightAsOftenAsItSaysAmongNearTies) {
  int right = 0;
  constexpr int tries = 200;
  constexpr std::size_t systems = 10;
  for (std::uint64_t i = 0; i < tries; ++i) {
    KimNelson procedure(question_of(systems));
    lead(procedure, systems, MadeUpSystems(slippage(systems), i));
    const Decision decision = procedure.decision();
    right += decision.is_sure && decision.best == systems / 2;
  }
  EXPECT_GE(right, 0.95 * tries - 6);
}

TEST(KimNelson, SharesTheErrorOfItsConstraintsAmongThemAndTheSystems) {
  Question question = question_of(4);
  question.clogging_limit = 0.05;
  // A fifth of 0.05, half of it for what is taken wrongly, of four systems: log 800 / log(0.995 / 0.95) = 144.4
  EXPECT_EQ(KimNelson(question).least_observations(), 145);
  question.band = Band{1, 2};
  EXPECT_EQ(KimNelson(question).least_observations(), 160);  // log 1600: 159.4
  question.clogging_limit.reset();
  EXPECT_EQ(KimNelson(question).least_observations(), KimNelson::first_observations);
}

/// Systems that differ by the margin, 1, and by 10 to and fro: the observations until the pair's test has ended.
TEST(KimNelson, SharesTheRestOfItsErrorAmongPairs) {
  const Observe observe = [](std::size_t system, int number) {
    if (system == 0) return Observation{RunEnd::flowed, 20, 1};
    return Observation{RunEnd::flowed, (system == 1 ? 21.0 : 1000.0) + (number % 2 == 0 ? 10 : -10), 1};
  };
  for (const auto& [systems, limit, error] :
       {std::tuple(2U, false, 0.05), std::tuple(2U, true, 0.04), std::tuple(5U, true, 0.01)}) {
    Question question = question_of(systems);
    question.most = 2000;
    if (limit) question.clogging_limit = 0.05;
    SideTest test(KimNelson::first_observations, error);
    int needed = 0;
    for (; test.side() == SideTest::Side::open; ++needed)
      test.add(observe(0, needed).goal - observe(1, needed).goal, question.margin * 20);
    KimNelson procedure(question);
    const std::vector<int> runs = lead(procedure, systems, observe);
    EXPECT_EQ(runs[0], needed + needed % 2) << systems << ' ' << limit;  // two of each at a time
    EXPECT_EQ(procedure.decision().best, 0U);
    EXPECT_TRUE(procedure.decision().is_sure);
  }
}

TEST(KimNelson, LeavesWhatIsPlainlyWorseAfterTheFirstObservations) {
  MadeUpSystems systems({{1.0}, {2.0}, {1.02}, {3.0}}, 5);
  KimNelson procedure(question_of(4));
  const std::vector<int> runs = lead(procedure, 4, std::ref(systems));
  EXPECT_EQ(runs[1], KimNelson::first_observations);
  EXPECT_EQ(runs[3], KimNelson::first_observations);
  EXPECT_GT(runs[0], KimNelson::first_observations);
  EXPECT_EQ(runs[0], runs[2]);
  const Decision decision = procedure.decision();
  ASSERT_TRUE(decision.is_sure);
  EXPECT_EQ(decision.standings[1], Standing::worse);
  EXPECT_EQ(decision.standings[3], Standing::worse);
  EXPECT_EQ(decision.standings[*decision.best], Standing::best);
  EXPECT_EQ(decision.standings[*decision.best == 0 ? 2 : 0], Standing::not_shown_worse);
}

TEST(KimNelson, ConstraintsAreMetByWhatIsTaken) {
  int right = 0;
  constexpr int tries = 100;
  for (std::uint64_t i = 0; i < tries; ++i) {
    Question question = question_of(6);
    question.band = Band{0.95, 1.05};
    question.clogging_limit = 0.05;
    MadeUpSystems systems({{1.0, 0.1, 0.4}, {1.0, 0.1, 0, 1.2}, {1.2}, {1.2, 0.1, 0.4}, {1.3}, {1.0, 0.1, 0, 0.8}}, i);
    KimNelson procedure(question);
    lead(procedure, 6, std::ref(systems));
    const Decision decision = procedure.decision();
    right += decision.is_sure && decision.best == 2u;
    if (i > 0) continue;
    EXPECT_EQ(decision.standings[0], Standing::clogs);
    EXPECT_EQ(decision.standings[1], Standing::misses_the_rate);
    EXPECT_EQ(decision.standings[5], Standing::misses_the_rate);
  }
  EXPECT_GE(right, 0.95 * tries - 4);
}

TEST(KimNelson, WhatRestsGoesOnWhenTheOneBeforeItFails) {
  Question question = question_of(2);
  question.clogging_limit = 0.05;
  MadeUpSystems systems({{1.0, 0.02}, {2.0, 0.02}}, 1);
  // The better one flows at first and clogs later.
  const Observe observe = [&](std::size_t system, int number) {
    Observation one = systems(system, number);
    if (system == 0 && number >= 20) one.end = RunEnd::clogged;
    return one;
  };
  KimNelson procedure(question);
  const std::vector<int> runs = lead(procedure, 2, observe);
  EXPECT_LT(runs[0], 40);
  EXPECT_GT(runs[1], 100);  // as many clean runs as the limit takes
  EXPECT_EQ(procedure.decision().best, 1u);
  EXPECT_EQ(procedure.decision().standings[0], Standing::clogs);
}

TEST(KimNelson, SaysThatNoneMeetsTheConstraints) {
  Question question = question_of(3);
  question.band = Band{1.95, 2.05};
  MadeUpSystems systems({{1.0}, {1.1}, {1.2}}, 1);
  KimNelson procedure(question);
  lead(procedure, 3, std::ref(systems));
  EXPECT_TRUE(procedure.decision().is_sure);
  EXPECT_FALSE(procedure.decision().best);
}

TEST(KimNelson, SaysWhatItCannotResolve) {
  Question question = question_of(2);
  question.margin = 0.001;
  question.most = 40;
  MadeUpSystems systems({{1.0}, {1.0}}, 1);
  KimNelson procedure(question);
  const std::vector<int> runs = lead(procedure, 2, std::ref(systems));
  EXPECT_EQ(runs, (std::vector<int>{40, 40}));
  const Decision decision = procedure.decision();
  EXPECT_FALSE(decision.is_sure);
  EXPECT_EQ(decision.standings, (std::vector<Standing>{Standing::undecided, Standing::undecided}));
}

TEST(KimNelson, AMeanOfZeroHasNoShares) {
  MadeUpSystems systems({{0, 0}, {1}}, 1);
  KimNelson procedure(question_of(2));
  lead(procedure, 2, std::ref(systems));
  EXPECT_FALSE(procedure.decision().has_margin);
  EXPECT_FALSE(procedure.decision().is_sure);
}

TEST(KimNelson, AFailedSystemIsOutAfterOneObservation) {
  MadeUpSystems systems({{1.0}, {2.0}, {3.0}}, 1);
  const Observe observe = [&](std::size_t system, int number) {
    Observation one = systems(system, number);
    if (system == 0) one.end = RunEnd::failed;
    return one;
  };
  KimNelson procedure(question_of(3));
  const std::vector<int> runs = lead(procedure, 3, observe);
  EXPECT_EQ(runs, (std::vector<int>{1, 10, 10}));
  EXPECT_EQ(procedure.decision().best, 1u);
  EXPECT_EQ(procedure.decision().standings[0], Standing::failed);
}

TEST(KimNelson, OneThatNeverFlowsIsOutThoughNoLimitIsSet) {
  MadeUpSystems systems({{1.0, 0.1, 1.0}, {2.0}, {3.0}}, 1);
  KimNelson procedure(question_of(3));
  const std::vector<int> runs = lead(procedure, 3, std::ref(systems));
  EXPECT_EQ(runs[0], KimNelson::first_observations);
  EXPECT_EQ(procedure.decision().best, 1u);
  EXPECT_EQ(procedure.decision().standings[0], Standing::clogs);
}

TEST(KimNelson, OrderAndInterruptionsDoNotShow) {
  Question question = question_of(10);
  question.clogging_limit = 0.1;
  MadeUpSystems systems(slippage(10), 3);
  KimNelson at_once(question), backwards(question), again(question);
  const std::vector<int> runs = lead(at_once, 10, std::ref(systems));
  EXPECT_EQ(lead(backwards, 10, std::ref(systems), 100000, true), runs);
  lead(again, 10, std::ref(systems), 7);  // interrupted; a new one is led again through what is kept
  KimNelson resumed(question);
  EXPECT_EQ(lead(resumed, 10, std::ref(systems)), runs);
  EXPECT_EQ(resumed.decision().best, at_once.decision().best);
  EXPECT_EQ(backwards.decision().standings, at_once.decision().standings);
}

TEST(KimNelson, AsksForABatchAtLeast) {
  Question question = question_of(2);
  question.batch = 6;
  MadeUpSystems systems({{1.0}, {1.01}}, 3);
  KimNelson procedure(question);
  EXPECT_EQ(lead(procedure, 2, std::ref(systems), 3), (std::vector<int>{13, 13}));
}

TEST(KimNelson, RefusesASingleSystem) {
  EXPECT_THROW(KimNelson(question_of(1)), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
