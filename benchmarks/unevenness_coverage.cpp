// How often the 95 % interval of the unevenness holds the truth, and how often holes are told from equal ones, over
// made-up studies of holes that let out 200 seeds a replicate: CSV. Counts are normal, rounded, and swing together by
// 2 %; a single replicate is told by five blocks of it.
// Usage: unevenness_coverage STUDIES

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>
#include <vector>

#include "outflow/unevenness.hpp"

namespace {

using namespace vibrosow;

struct Cell {
  int holes, replicates;
  double dispersion;  // variance of a count over its mean
  double cv;
};

std::vector<std::vector<std::int64_t>> counts_of(const Cell& cell, std::mt19937_64& random) {
  constexpr double of_replicate = 200, swing = 0.02;
  constexpr int blocks = 5;
  const int parts = cell.replicates == 1 ? blocks : cell.replicates;
  const double of_part = cell.replicates == 1 ? of_replicate / blocks : of_replicate;
  // Evenly apart, with the standard deviation 1.
  const double middle = 0.5 * (cell.holes - 1), spread = std::sqrt(cell.holes * (cell.holes + 1) / 12.0);
  std::normal_distribution<double> normal;
  std::vector<std::vector<std::int64_t>> counts;
  for (int part = 0; part < parts; ++part) {
    const double mean = of_part * (1 + swing * normal(random));
    std::vector<std::int64_t>& of_holes = counts.emplace_back();
    for (int hole = 0; hole < cell.holes; ++hole) {
      const double drawn =
          mean * (1 + cell.cv * (hole - middle) / spread) + std::sqrt(cell.dispersion * of_part) * normal(random);
      of_holes.push_back(std::max<std::int64_t>(0, std::llround(drawn)));
    }
  }
  return counts;
}

}  // namespace

int main(int argc, char** argv) {
  const int studies = argc > 1 ? std::atoi(argv[1]) : 2000;
  std::mt19937_64 random(1);
  std::cout << "holes,replicates,variance_over_mean,cv_percent,studies,held_percent,told_percent,mean_high_percent\n";
  for (const int holes : {2, 5})
    for (const int replicates : {1, 2, 3, 8})
      for (const double dispersion : {0.1, 0.3, 1.0, 3.0})
        for (const double cv : {0.0, 0.03, 0.06, 0.15}) {
          const Cell cell{holes, replicates, dispersion, cv};
          int held = 0, told = 0;
          double high = 0;
          for (int k = 0; k < studies; ++k) {
            const auto found = unevenness(counts_of(cell, random));
            if (!found) continue;
            held += found->low <= cv && cv <= found->high, told += found->cv.has_value();
            high += found->high / studies;
          }
          std::cout << fmt::format("{},{},{:g},{:g},{},{:.4g},{:.4g},{:.3g}\n", holes, replicates, dispersion, 100 * cv,
                                   studies, 100.0 * held / studies, 100.0 * told / studies, 100 * high);
        }
}
