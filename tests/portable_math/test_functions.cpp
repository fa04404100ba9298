#include "portable_math/functions.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "support/bit_hash.hpp"

namespace vibrosow {
namespace {

using namespace boost::multiprecision;
/// Enough bits for the sine of 1e22, whose argument takes 74 before the point.
using Exact = number<cpp_bin_float<240, digit_base_2, void, int, -20000, 20000>, et_off>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();
constexpr double smallest = std::numeric_limits<double>::denorm_min();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Distance of a result from the exact one, in units of the last place of the exact one.
double ulps(double result, const Exact& exact) {
  const double rounded = exact.convert_to<double>();
  if (std::isinf(rounded) || std::isinf(result)) return result == rounded ? 0 : infinity;
  if (std::isnan(result)) return infinity;
  int exponent = 0;
  std::frexp(rounded, &exponent);
  const double unit = std::max(std::ldexp(1.0, exponent - 53), smallest);
  return Exact(abs(Exact(result) - exact) / unit).convert_to<double>();
}

struct Interval {
  double from, to;
};

/// Half of them even over the interval, half over its orders of magnitude; always its ends.
std::vector<double> arguments(const Interval& in, int count) {
  std::mt19937_64 random(20261122);
  const auto uniform = [&random](double from, double to) {
    return from + (to - from) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  std::vector<double> values{in.from, in.to};
  for (int i = 0; i < count; ++i) values.push_back(uniform(in.from, in.to));
  for (int i = 0; i < count; ++i) {
    const double end = i % 2 == 0 ? in.from : in.to;
    const double value = std::copysign(std::exp2(uniform(-1074, std::log2(std::max(std::abs(end), smallest)))), end);
    if (value >= in.from && value <= in.to) values.push_back(value);
  }
  return values;
}

struct OneArgument {
  std::string name;
  std::function<double(double)> function;
  std::function<Exact(const Exact&)> exact;
  std::vector<Interval> intervals;
  double most_ulps = 1;
  friend void PrintTo(const OneArgument& one, std::ostream* out) { *out << one.name; }
};

#define EXACT(name) [](const Exact& x) { return Exact(name(x)); }

std::vector<OneArgument> functions_of_one() {
  using namespace portable_math;
  const std::vector<Interval> angles = {{-10, 10}, {-1e5, 1e5}, {0, 1e22}};
  const auto sine = [](double x) { return portable_math::sine_cosine(x).sine; };
  const auto cosine = [](double x) { return portable_math::sine_cosine(x).cosine; };
  const auto error = [](const Exact& x) { return Exact(boost::math::erfc(x)); };
  return {{"sin", portable_math::sin, EXACT(sin), angles},
          {"cos", portable_math::cos, EXACT(cos), angles},
          {"tan", portable_math::tan, EXACT(tan), angles},
          {"sine_cosine.sine", sine, EXACT(sin), angles},
          {"sine_cosine.cosine", cosine, EXACT(cos), angles},
          {"asin", portable_math::asin, EXACT(asin), {{-1, 1}}},
          {"acos", portable_math::acos, EXACT(acos), {{-1, 1}, {0.999, 1}, {-1, -0.999}}},
          {"exp", portable_math::exp, EXACT(exp), {{-1, 1}, {-746, 710}, {-745, -700}}},
          {"log", portable_math::log, EXACT(log), {{smallest, largest}, {0.5, 2}}},
          {"log1p", portable_math::log1p, EXACT(log1p), {{-0.999, 2}, {0, 1e300}}},
          {"cbrt", portable_math::cbrt, EXACT(cbrt), {{-8, 8}, {-largest, largest}}},
          {"acosh", portable_math::acosh, EXACT(acosh), {{1, 2}, {1, 1e150}}},
          {"erfc", portable_math::erfc, error, {{-6, 6}, {6, 26}}, 1.5}};
}

class Elementary : public testing::TestWithParam<OneArgument> {};

TEST_P(Elementary, IsWithinItsUlpsOfTheExactValue) {
  constexpr int count = 1000;
  const OneArgument& one = GetParam();
  for (const Interval& interval : one.intervals)
    for (const double x : arguments(interval, count))
      EXPECT_LE(ulps(one.function(x), one.exact(Exact(x))), one.most_ulps) << one.name << "(" << x << ")";
}

INSTANTIATE_TEST_SUITE_P(Functions, Elementary, testing::ValuesIn(functions_of_one()), [](const auto& test) {
  std::string name = test.param.name;
  std::ranges::replace(name, '.', '_');
  return name;
});

TEST(ElementaryOfTwo, AreWithinAnUlpOfTheExactValue) {
  const std::vector<double> some = arguments({-3, 3}, 300), wide = arguments({-1e150, 1e150}, 100);
  const auto each_pair = [](const std::vector<double>& values, const auto& check) {
    for (std::size_t i = 0; i < values.size(); ++i) check(values[i], values[(7 * i + 3) % values.size()]);
  };
  for (const std::vector<double>& values : {some, wide}) {
    each_pair(values, [](double x, double y) {
      EXPECT_LE(ulps(portable_math::hypot(x, y), sqrt(Exact(x) * x + Exact(y) * y)), 1) << x << " " << y;
      if (x != 0 || y != 0) {
        EXPECT_LE(ulps(portable_math::atan2(y, x), atan2(Exact(y), Exact(x))), 1) << y << " " << x;
      }
      const double base = std::abs(x);
      if (base > 0) {
        EXPECT_LE(ulps(portable_math::pow(base, y), pow(Exact(base), Exact(y))), 1) << base << " " << y;
      }
    });
  }
  for (const double base : {-3.0, -0.1, 0.7, 1.5, 10.0})
    for (const double exponent : {-3.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0})
      EXPECT_LE(ulps(portable_math::pow(base, exponent), pow(Exact(base), static_cast<int>(exponent))), 1);
}

/// Equal in value and sign of zero, or both not a number.
void expect_same(double result, double expected, const std::string& call) {
  if (std::isnan(expected)) {
    EXPECT_TRUE(std::isnan(result)) << call << " gave " << result;
  } else {
    EXPECT_TRUE(result == expected && std::signbit(result) == std::signbit(expected))
        << call << " gave " << result << ", expected " << expected;
  }
}

TEST(Elementary, PowersToWholeNumbersAreProducts) {
  for (const double base : {-3.1, 0.0, 0.7, 1e-80, infinity}) {
    EXPECT_EQ(portable_math::pow(base, 0), 1);
    EXPECT_EQ(portable_math::pow(base, 1), base);
    EXPECT_EQ(portable_math::pow(base, 4), base * base * base * base);
  }
}

TEST(Elementary, WhatIsLevelStaysLevel) {
  EXPECT_EQ(portable_math::sin(0), 0);
  EXPECT_EQ(portable_math::cos(0), 1);
  EXPECT_EQ(portable_math::sine_cosine(0).sine, 0);
  EXPECT_EQ(portable_math::sine_cosine(0).cosine, 1);
}

TEST(Elementary, MirrorsToTheBit) {
  for (const double x : arguments({0, 1e5}, 500)) {
    const auto [sine, cosine] = portable_math::sine_cosine(x);
    EXPECT_EQ(portable_math::sin(-x), -portable_math::sin(x));
    EXPECT_EQ(portable_math::cos(-x), portable_math::cos(x));
    EXPECT_EQ(portable_math::sine_cosine(-x).sine, -sine);
    EXPECT_EQ(portable_math::sine_cosine(-x).cosine, cosine);
    EXPECT_EQ(portable_math::tan(-x), -portable_math::tan(x));
  }
}

TEST(Elementary, SpecialArgumentsGiveWhatTheStandardSays) {
  const std::array special = {0.0, -0.0, 1.0, -1.0, 2.0, infinity, -infinity, not_a_number};
  struct Pair {
    const char* name;
    double (*ours)(double);
    double (*standard)(double);
  };
  // The standard's results here are exact, but for those of 1, -1 and 2.
  const std::array pairs = {
      Pair{"sin", portable_math::sin, std::sin},    Pair{"cos", portable_math::cos, std::cos},
      Pair{"tan", portable_math::tan, std::tan},    Pair{"asin", portable_math::asin, std::asin},
      Pair{"acos", portable_math::acos, std::acos}, Pair{"exp", portable_math::exp, std::exp},
      Pair{"log", portable_math::log, std::log},    Pair{"log1p", portable_math::log1p, std::log1p},
      Pair{"cbrt", portable_math::cbrt, std::cbrt}, Pair{"acosh", portable_math::acosh, std::acosh},
      Pair{"erfc", portable_math::erfc, std::erfc}};
  for (const Pair& pair : pairs) {
    for (const double x : special) {
      const double expected = pair.standard(x);
      const std::string call = fmt::format("{}({})", pair.name, x);
      if (std::isfinite(x) && std::isfinite(expected) && x != 0) {
        EXPECT_NEAR(pair.ours(x), expected, 4e-16 * std::abs(expected)) << call;
      } else if (x == 0 && (pair.name == std::string("acos"))) {
        EXPECT_DOUBLE_EQ(pair.ours(x), std::numbers::pi / 2) << call;
      } else {
        expect_same(pair.ours(x), expected, call);
      }
    }
  }
}

TEST(Elementary, SpecialPairsGiveWhatTheStandardSays) {
  const std::array special = {0.0, -0.0, 1.0, -1.0, 2.0, -2.0, 0.5, 3.0, infinity, -infinity, not_a_number};
  for (const double x : special) {
    for (const double y : special) {
      const std::string pair = fmt::format("({}, {})", x, y);
      const auto same_where_exact = [&](double result, double expected, const char* name) {
        if (std::isfinite(expected) && expected != 0) {
          EXPECT_NEAR(result, expected, 4e-16 * std::abs(expected)) << name << pair;
        } else {
          expect_same(result, expected, name + pair);
        }
      };
      same_where_exact(portable_math::pow(x, y), std::pow(x, y), "pow");
      same_where_exact(portable_math::hypot(x, y), std::hypot(x, y), "hypot");
      same_where_exact(portable_math::atan2(x, y), std::atan2(x, y), "atan2");
    }
  }
}

/// Arguments made by division alone, which is exact by IEEE.
TEST(Elementary, GivesTheSameBitsOnEveryMachine) {
  BitHash hash;
  for (int i = -2000; i <= 2000; ++i) {
    const double x = i / 127.0, part = i / 2000.0, positive = (i + 2001) / 97.0;
    const auto [sine, cosine] = portable_math::sine_cosine(x);
    for (const double value :
         {portable_math::sin(x), portable_math::cos(x), portable_math::tan(x), sine, cosine, portable_math::asin(part),
          portable_math::acos(part), portable_math::atan2(x, part), portable_math::exp(x), portable_math::log(positive),
          portable_math::log1p(positive), portable_math::pow(positive, x), portable_math::cbrt(x),
          portable_math::acosh(1 + positive), portable_math::hypot(x, part), portable_math::erfc(x)})
      hash.add(value);
  }
  EXPECT_EQ(hash.value(), 0x4478bfb53f7f1bf3U) << std::hex << hash.value();
}

}  // namespace
}  // namespace vibrosow
