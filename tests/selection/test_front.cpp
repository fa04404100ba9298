#include "selection/front.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "selection/made_up_systems.hpp"

namespace vibrosow {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

constexpr double endless = std::numeric_limits<double>::infinity();

FrontQuestion two_goals() {
  FrontQuestion question;
  question.goals.resize(2);
  question.first = 3;
  return question;
}

/// So many observations of each system about these means.
Front front_of(const FrontQuestion& question, const std::vector<FrontObservation>& means, int observations,
               double deviation, std::uint64_t seed = 1) {
  Front front(question);
  MadeUpChance chance(seed);
  for (std::size_t i = 0; i < means.size(); ++i) {
    front.add_system();
    for (int r = 0; r < observations; ++r) {
      FrontObservation one = means[i];
      for (double& goal : one.goals) goal += deviation * chance.normal();
      for (double& value : one.banded) value += deviation * chance.normal();
      front.take(i, one);
    }
  }
  return front;
}

const std::vector<FrontObservation> stairs = {{RunEnd::flowed, {1, 3}},
                                              {RunEnd::flowed, {2, 2}},
                                              {RunEnd::flowed, {3, 1}},
                                              {RunEnd::flowed, {3, 3}},
                                              {RunEnd::flowed, {4, 4}}};

TEST(Front, TellsApartWhatChanceCannotConfuse) {
  const Front front = front_of(two_goals(), stairs, 6, 0.05);
  EXPECT_THAT(front.standings(), ElementsAre(FrontStanding::on_front, FrontStanding::on_front, FrontStanding::on_front,
                                             FrontStanding::dominated, FrontStanding::dominated));
  EXPECT_THAT(front.layers(1), ElementsAre(UnorderedElementsAre(0u, 1u, 2u)));
  EXPECT_THAT(front.layers(5), ElementsAre(UnorderedElementsAre(0u, 1u, 2u), ElementsAre(3u), ElementsAre(4u)));
  EXPECT_THAT(front.nearly_on_front(), ElementsAre(true, true, true, false, false));
}

TEST(Front, SaysNothingOfWhatItCan) {
  const Front front = front_of(two_goals(), stairs, 3, 3);
  EXPECT_THAT(front.standings(), testing::Each(FrontStanding::may_be_on_front));
}

/// Of a thousand claims about systems that are a little apart, few are wrong.
TEST(Front, IsSeldomWrong) {
  int wrong = 0, dominated = 0, on_front = 0;
  const std::vector<FrontObservation> near = {{RunEnd::flowed, {1, 1}},
                                              {RunEnd::flowed, {1.1, 0.95}},
                                              {RunEnd::flowed, {1.05, 1.05}},
                                              {RunEnd::flowed, {1.2, 1.2}}};
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const std::vector<FrontStanding> standings = front_of(two_goals(), near, 8, 0.05, seed).standings();
    for (std::size_t i = 0; i < 4; ++i) {
      dominated += standings[i] == FrontStanding::dominated;
      on_front += standings[i] == FrontStanding::on_front;
      wrong += i < 2 ? standings[i] == FrontStanding::dominated : standings[i] == FrontStanding::on_front;
    }
  }
  EXPECT_GT(dominated, 150);
  EXPECT_GT(on_front, 50);
  EXPECT_LE(wrong, 0.05 * (dominated + on_front));
}

TEST(Front, ConstraintsComeFirst) {
  FrontQuestion question = two_goals();
  question.bands = {{0.9, 1.1}, {-endless, 0.5}};
  question.clogging_limit = 0.2;
  std::vector<FrontObservation> means(5, {RunEnd::flowed, {1, 1}, {1, 0.2}});
  means[1].banded[0] = 1.5;
  means[2].banded[1] = 1;
  means[3].goals = {2, 2};
  means[4].goals = {0.5, 0.5};
  Front front = front_of(question, means, 6, 0.01);
  for (int i = 0; i < 20; ++i) front.take(4, {RunEnd::clogged});
  EXPECT_THAT(front.standings(),
              ElementsAre(FrontStanding::on_front, FrontStanding::misses_a_band, FrontStanding::misses_a_band,
                          FrontStanding::dominated, FrontStanding::clogs));
  EXPECT_THAT(front.meets_by_means(), ElementsAre(true, false, false, true, false));
  EXPECT_EQ(front.clogged(4), 20);
  EXPECT_THAT(front.layers(9),
              ElementsAre(ElementsAre(0u), ElementsAre(3u), ElementsAre(2u), ElementsAre(4u), ElementsAre(1u)));
  front.take(0, {RunEnd::failed});
  EXPECT_TRUE(front.has_failed(0));
  EXPECT_EQ(front.standings()[0], FrontStanding::failed);
  EXPECT_THAT(front.layers(1), ElementsAre(ElementsAre(3u)));
  EXPECT_THROW(front.take(1, {RunEnd::flowed, {1}, {}}), std::out_of_range);
}

TEST(Front, ExactGoalsAndDistances) {
  FrontQuestion question = two_goals();
  question.goals[0].is_exact = true;
  question.goals[1].nearest_to = 10;
  Front front(question);
  MadeUpChance chance(7);
  const std::vector<std::array<double, 2>> means = {{1, 12}, {2, 9.9}, {2, 14}, {3, 8}};
  for (std::size_t i = 0; i < means.size(); ++i) {
    front.add_system();
    for (int r = 0; r < 5; ++r) front.take(i, {RunEnd::flowed, {means[i][0], means[i][1] + 0.05 * chance.normal()}});
  }
  EXPECT_THAT(front.standings(), ElementsAre(FrontStanding::on_front, FrontStanding::on_front, FrontStanding::dominated,
                                             FrontStanding::dominated));
}

/// Six observations of each system, which know of their own variance alone: the standard error of a goal's mean is 1,
/// of a banded figure's 2, by five degrees of freedom; of a difference ten.
struct KnownSystem {
  std::vector<double> goals, banded{};
};

Front front_of_six(FrontQuestion question, const std::vector<KnownSystem>& systems) {
  question.first = 2;
  Front front(question);
  for (std::size_t i = 0; i < systems.size(); ++i) {
    front.add_system();
    for (std::size_t r = 0; r < 6; ++r) {
      FrontObservation one;
      for (const double mean : systems[i].goals) one.goals.push_back(six_about(mean, 1)[r]);
      for (const double mean : systems[i].banded) one.banded.push_back(six_about(mean, 2)[r]);
      front.take(i, one);
    }
  }
  return front;
}

FrontQuestion goals_of(std::size_t count) {
  FrontQuestion question;
  question.goals.resize(count);
  return question;
}

/// Of a system, when another figure of it is a hair to either side of where it is just sure.
constexpr double hair = 1e-3;

/// A mean difference of t standard errors, a hair less and a hair more.
std::array<FrontStanding, 2> about(double t, const std::function<FrontStanding(double)>& standing_at) {
  return {standing_at(t - hair), standing_at(t + hair)};
}

TEST(Front, SharesItsErrorAmongPairsOfWhatDominates) {
  for (const std::size_t systems : {2U, 3U, 6U}) {
    const double t = std::sqrt(2.0) * student_above(10, 0.05 / static_cast<double>(systems - 1));
    const auto standing = [&](double behind) {
      std::vector<KnownSystem> all(systems, {{1000}});
      all[0].goals = {0}, all[1].goals = {behind};
      return front_of_six(goals_of(1), all).standings()[1];
    };
    EXPECT_THAT(about(t, standing), ElementsAre(FrontStanding::may_be_on_front, FrontStanding::dominated)) << systems;
  }
}

TEST(Front, SharesItsErrorAmongTheGoalsOfWhatIsOnIt) {
  for (const std::size_t goals : {1U, 2U, 4U}) {
    const double t = std::sqrt(2.0) * student_above(10, 0.05 / static_cast<double>(goals));
    const auto standing = [&](double ahead) {
      std::vector<KnownSystem> two(2, {std::vector<double>(goals, 0)});
      two[1].goals[0] = ahead;
      return front_of_six(goals_of(goals), two).standings()[0];
    };
    EXPECT_THAT(about(t, standing), ElementsAre(FrontStanding::may_be_on_front, FrontStanding::on_front)) << goals;
  }
}

/// The distance from a wanted value has two sides, each of which may be the wrong one.
TEST(Front, SharesItsErrorAmongTheSidesOfAWantedValue) {
  FrontQuestion question = goals_of(1);
  question.goals[0].nearest_to = 10;
  const auto standing = [&](double ahead) { return front_of_six(question, {{{10}}, {{10 - ahead}}}).standings()[0]; };
  EXPECT_THAT(about(std::sqrt(2.0) * student_above(10, 0.05 / 2), standing),
              ElementsAre(FrontStanding::may_be_on_front, FrontStanding::on_front));
}

TEST(Front, SharesItsErrorAmongTheEndsOfBandsAndClogging) {
  for (const std::size_t bands : {1U, 3U}) {
    FrontQuestion question = goals_of(1);
    question.bands.assign(bands, {-100, 100});
    const double t = student_above(5, 0.05 / static_cast<double>(2 * bands + 1));
    for (const double side : {-1.0, 1.0}) {
      const auto standing = [&](double outside) {
        KnownSystem one{{0}, std::vector<double>(bands, 0)};
        one.banded[bands - 1] = side * (100 + 2 * outside);
        return front_of_six(question, {one}).standings()[0];
      };
      EXPECT_THAT(about(t, standing), ElementsAre(FrontStanding::may_be_on_front, FrontStanding::misses_a_band))
          << bands << ' ' << side;
    }
  }
}

/// What is on the front is in each band with the whole confidence.
TEST(Front, IsInItsBandsByTheWholeError) {
  FrontQuestion question = goals_of(1);
  question.bands = {{-100, 100}};
  for (const double side : {-1.0, 1.0}) {
    const auto standing = [&](double inside) {
      return front_of_six(question, {{{0}, {side * (100 - 2 * inside)}}}).standings()[0];
    };
    EXPECT_THAT(about(student_above(5, 0.05), standing),
                ElementsAre(FrontStanding::may_be_on_front, FrontStanding::on_front))
        << side;
  }
}

/// Of ten runs nine or more clog by chance in 11 of 1024 cases where half of all do.
TEST(Front, ClogsByTheBinomialWithItsShareOfTheError) {
  const auto standing = [&](std::size_t bands, int clogged) {
    FrontQuestion question = goals_of(1);
    question.clogging_limit = 0.5;
    question.bands.assign(bands, {-100, 100});
    Front front(question);
    front.add_system();
    for (int r = 0; r < 10; ++r)
      front.take(0, r < clogged ? FrontObservation{RunEnd::clogged}
                                : FrontObservation{RunEnd::flowed, {1}, std::vector<double>(bands, 0)});
    return front.standings()[0];
  };
  EXPECT_EQ(standing(1, 9), FrontStanding::clogs);            // 0.0107 against 0.05 / 3
  EXPECT_EQ(standing(3, 9), FrontStanding::may_be_on_front);  // against 0.05 / 7
  EXPECT_EQ(standing(0, 8), FrontStanding::may_be_on_front);  // 56 of 1024
}

TEST(Front, IsNearlyOnItByOneStandardErrorOfTheDifference) {
  const auto nearly = [&](double behind) -> bool {
    return front_of_six(goals_of(1), {{{0}}, {{behind}}}).nearly_on_front()[1];
  };
  EXPECT_TRUE(nearly(std::sqrt(2.0) - hair));
  EXPECT_FALSE(nearly(std::sqrt(2.0) + hair));
  FrontQuestion question = goals_of(1);
  question.bands = {{-100, 100}};
  const auto nearly_in = [&](double at) -> bool { return front_of_six(question, {{{0}, {at}}}).nearly_on_front()[0]; };
  EXPECT_TRUE(nearly_in(102 - hair) && nearly_in(-102 + hair));
  EXPECT_FALSE(nearly_in(102 + hair) || nearly_in(-102 - hair));
}

TEST(Band, IsOutsideByShares) {
  EXPECT_EQ((Band{0.9, 1.1}).outside_by(1), 0);
  EXPECT_NEAR((Band{0.9, 1.1}).outside_by(1.3), 2, 1e-12);
  EXPECT_NEAR((Band{-endless, 0.5}).outside_by(1), 1, 1e-12);
}

}  // namespace
}  // namespace vibrosow
