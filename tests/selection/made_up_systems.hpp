#pragma once

#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "selection/procedure.hpp"

namespace vibrosow {

/// Uniform and normal numbers, the same with every standard library.
class MadeUpChance {
 public:
  explicit MadeUpChance(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }
  double normal() { return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * uniform()); }

 private:
  std::mt19937_64 engine_;
};

struct MadeUpSystem {
  double mean = 1, deviation = 0.1, clogging = 0, rate = 1, rate_deviation = 0.01;
};

/// Observations of systems: the r-th of a system is the same whenever it is asked for.
class MadeUpSystems {
 public:
  MadeUpSystems(std::vector<MadeUpSystem> systems, std::uint64_t seed) : systems_(std::move(systems)) {
    for (std::size_t i = 0; i < systems_.size(); ++i) chances_.emplace_back(1000 * seed + i);
    made_.resize(systems_.size());
  }

  Observation operator()(std::size_t system, int number) {
    const MadeUpSystem& of = systems_[system];
    while (static_cast<int>(made_[system].size()) <= number) {
      MadeUpChance& chance = chances_[system];
      const bool clogs = chance.uniform() < of.clogging;
      const double goal = of.mean + of.deviation * chance.normal();
      const double rate = of.rate + of.rate_deviation * chance.normal();
      made_[system].push_back({clogs ? RunEnd::clogged : RunEnd::flowed, goal, rate});
    }
    return made_[system][static_cast<std::size_t>(number)];
  }

 private:
  std::vector<MadeUpSystem> systems_;
  std::vector<MadeUpChance> chances_;
  std::vector<std::vector<Observation>> made_;
};

using Observe = std::function<Observation(std::size_t system, int number)>;

/// Leads a procedure to its end, or through so many rounds; how many observations each system has then.
inline std::vector<int> lead(Procedure& procedure, std::size_t systems, const Observe& observe, int rounds = 100000,
                             bool backwards = false) {
  std::vector<int> have(systems, 0);
  for (int round = 0; round < rounds; ++round) {
    procedure.request_next_round();
    const std::vector<int>& wanted = procedure.counts();
    if (wanted == have) break;
    for (std::size_t k = 0; k < systems; ++k) {
      const std::size_t i = backwards ? systems - 1 - k : k;
      for (; have[i] < wanted[i]; ++have[i]) procedure.take(i, observe(i, have[i]));
    }
  }
  return have;
}

inline int sum(const std::vector<int>& counts) {
  int whole = 0;
  for (const int count : counts) whole += count;
  return whole;
}

/// Six values of a mean and a standard error of it. The first two are equal, and so say nothing of others' variances.
inline std::vector<double> six_about(double mean, double standard_error) {
  const double off = standard_error * std::sqrt(6 * 5 / 4.0);  // four times its square over five, over six
  return {mean, mean, mean + off, mean - off, mean + off, mean - off};
}

/// Student's t of so many degrees of freedom that leaves `error` above it.
inline double student_above(double degrees_of_freedom, double error) {
  return quantile(complement(boost::math::students_t(degrees_of_freedom), error));
}

/// One system of mean 1, the others worse by 5 %, scattering by 10 %.
inline std::vector<MadeUpSystem> slippage(std::size_t systems) {
  std::vector<MadeUpSystem> made(systems, MadeUpSystem{1.05});
  made[systems / 2].mean = 1;
  return made;
}

}  // namespace vibrosow
