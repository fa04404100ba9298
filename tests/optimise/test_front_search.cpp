#include "optimise/front_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "selection/made_up_systems.hpp"

namespace vibrosow {
namespace {

FrontSearchOptions options_of(int budget) {
  FrontSearchOptions options;
  options.values = {8, 1000, 3};
  options.question.goals.resize(2);
  options.question.first = 2;
  options.first_points = 10;
  options.budget = budget;
  return options;
}

/// Two goals that pull apart along the first two axes; the third should be 1.
std::vector<double> goals_at(const FrontSearch::Point& point) {
  const double x = static_cast<double>(point[0]) / 7, y = static_cast<double>(point[1]) / 999;
  const double off = std::abs(static_cast<double>(point[2]) - 1);
  return {x + std::abs(y - 0.3) + off, 1 - x + 2 * std::abs(y - 0.3) + off};
}

/// To its end; gives how many observations it took.
int lead(FrontSearch& search, double deviation = 0.02) {
  MadeUpChance chance(3);
  int taken = 0;
  std::vector<int> have;
  for (search.request_next_round(); search.counts() != have; search.request_next_round()) {
    const std::vector<int>& wanted = search.counts();
    have.resize(wanted.size(), 0);
    for (std::size_t i = 0; i < wanted.size(); ++i)
      for (; have[i] < wanted[i]; ++have[i], ++taken) {
        std::vector<double> goals = goals_at(search.points()[i]);
        for (double& goal : goals) goal += deviation * chance.normal();
        search.take(i, {RunEnd::flowed, goals});
      }
  }
  return taken;
}

TEST(FrontSearch, FindsTheFrontOfAMixedSpace) {
  FrontSearch search(options_of(160));
  EXPECT_EQ(lead(search), 160);
  std::vector<bool> found(8, false);  // the front: any first value, the second at 0.3, the third at 1
  for (const FrontSearch::Point& point : search.points())
    found[point[0]] = found[point[0]] || (point[2] == 1 && std::abs(static_cast<double>(point[1]) - 300) < 60);
  EXPECT_GE(std::ranges::count(found, true), 6);
}

TEST(FrontSearch, StaysInItsSpaceAndRepeatsNothing) {
  FrontSearch search(options_of(200)), again(options_of(200));
  lead(search);
  lead(again);
  EXPECT_EQ(search.points(), again.points());
  std::set<FrontSearch::Point> different(search.points().begin(), search.points().end());
  EXPECT_EQ(different.size(), search.points().size());
  for (const FrontSearch::Point& point : search.points()) {
    EXPECT_LT(point[0], 8u);
    EXPECT_LT(point[1], 1000u);
    EXPECT_LT(point[2], 3u);
  }
}

TEST(FrontSearch, EndsWhereThereIsNothingLeftToTry) {
  FrontSearchOptions options = options_of(10000);
  options.values = {2, 1, 2};
  options.most = 5;
  FrontSearch search(options);
  EXPECT_LE(lead(search), 4 * 5);
  EXPECT_EQ(search.points().size(), 4u);
}

TEST(FrontSearch, GoesOnWherePointsCannotBeBuilt) {
  FrontSearch search(options_of(60));
  int rounds = 0;
  search.request_next_round();
  for (std::size_t known = 0; search.points().size() > known && rounds < 100; ++rounds) {
    for (; known < search.points().size(); ++known) search.leave_out(known);
    search.request_next_round();
  }
  EXPECT_LE(search.points().size(), 60u);
  EXPECT_GT(search.points().size(), 30u);
}

TEST(FrontSearch, RefusesWhatIsNoSpace) {
  FrontSearchOptions options = options_of(100);
  options.values = {};
  EXPECT_THROW(FrontSearch{options}, std::invalid_argument);
  options.values = {3, 0};
  EXPECT_THROW(FrontSearch{options}, std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
