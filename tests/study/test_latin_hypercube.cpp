#include "study/latin_hypercube.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace vibrosow {
namespace {

using testing::ElementsAre;

TEST(LatinHypercube, EveryPartOfEveryAxisHoldsOnePoint) {
  const auto cube = latin_hypercube(37, 4);
  ASSERT_EQ(cube.size(), 37u);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    std::vector<int> held(37);
    for (const auto& point : cube) ++held.at(static_cast<std::size_t>(std::floor(37 * point.at(axis))));
    EXPECT_THAT(held, testing::Each(1)) << "axis " << axis;
  }
}

TEST(LatinHypercube, AxesAreNotInStepAndSeedsDiffer) {
  const auto cube = latin_hypercube(200, 2);
  double product = 0;
  for (const auto& point : cube) product += (point[0] - 0.5) * (point[1] - 0.5) / 200;
  EXPECT_LT(std::abs(12 * product), 0.2);  // their correlation
  EXPECT_EQ(cube, latin_hypercube(200, 2));
  EXPECT_NE(cube, latin_hypercube(200, 2, 2));
}

TEST(LatinHypercube, SmallestOnes) {
  EXPECT_THAT(latin_hypercube(0, 3), ElementsAre());
  EXPECT_EQ(latin_hypercube(2, 0).size(), 2u);
}

}  // namespace
}  // namespace vibrosow
