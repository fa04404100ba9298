#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <sstream>

#include "grains/random.hpp"

namespace vibrosow {

/// A stream of random numbers for one case of a property.
inline Random any_random() {
  return Random(*rc::gen::resize(100, rc::gen::arbitrary<std::uint64_t>()));
}

/// Checks a property on random cases, the same ones in every run.
template <class Property>
void for_random_cases(int cases, Property property) {
  rc::detail::TestParams params;
  params.seed = 20200211;
  params.maxSuccess = cases;
  params.disableShrinking = true;  // a smaller number that stands for a scene makes no simpler scene
  const auto result = rc::detail::checkTestable(property, rc::detail::TestMetadata{}, params);
  std::ostringstream told;
  rc::detail::printResultMessage(result, told);
  EXPECT_TRUE(result.template is<rc::detail::SuccessResult>()) << told.str();
}

}  // namespace vibrosow
