// How often the interval of replicates by need holds the true mean, and how many runs it takes, over made-up layouts
// whose rates are normal, skewed (log-normal), or clog at times: CSV.
// Usage: replicates_rule LAYOUTS FILE.csv

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "outflow/statistics.hpp"
#include "study/replicates.hpp"

namespace {

using namespace vibrosow;

struct Family {
  std::string name;
  double cv;        // of a run's rate, where the layout does not set it
  double skewed;    // sigma of the logarithm; 0: normal
  double clogging;  // share of runs that clog
};

using Rates = std::vector<std::optional<CountedRate>>;

/// Of mean 1, of so many seeds that counting leaves nothing open.
Rates rates_of(const Family& family, int runs, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  Rates rates;
  for (int k = 0; k < runs; ++k) {
    const double deviate = normal(random), clogs = uniform(random);
    const double rate = family.skewed > 0 ? std::exp(family.skewed * deviate - family.skewed * family.skewed / 2)
                                          : 1 + family.cv * deviate;
    rates.push_back(clogs < family.clogging ? std::nullopt : std::optional(CountedRate{rate, 0}));
  }
  return rates;
}

/// The rounds that a study takes: how many runs are made, and how many count.
struct Rounds {
  int made, used;
  bool reached;
};

Rounds rounds_of(const Rates& rates, const Replicates& wanted) {
  int made = wanted.first();
  const auto so_far = [&] { return Rates(rates.begin(), rates.begin() + made); };
  for (int next = runs_to_go_to(so_far(), wanted); next > made; next = runs_to_go_to(so_far(), wanted)) made = next;
  const auto enough = enough_runs(so_far(), wanted);
  return {made, enough.value_or(made), enough.has_value()};
}

void write_family(std::ostream& out, const Family& family, const Replicates& wanted, int layouts,
                  std::mt19937_64& random) {
  int covered = 0, reached = 0, called_skewed = 0, covered_of_even = 0, even = 0;
  double made = 0, used = 0;
  for (int layout = 0; layout < layouts; ++layout) {
    const auto rates = rates_of(family, wanted.most, random);
    const Rounds rounds = rounds_of(rates, wanted);
    std::vector<double> values;
    for (int k = 0; k < rounds.used; ++k)
      if (const auto& rate = rates[static_cast<std::size_t>(k)]) values.push_back(rate->rate);
    const MeanWithInterval mean = mean_with_interval(values);
    const bool holds = std::abs(mean.mean - 1) <= mean.half_width_95.value_or(0);
    const bool skewed = look_skewed(values);
    covered += holds, reached += rounds.reached, called_skewed += skewed;
    even += !skewed, covered_of_even += !skewed && holds;
    made += rounds.made, used += rounds.used;
  }
  out << fmt::format("{},{:g},{},{},{},{:.1f},{:.1f},{:.1f},{:.1f},{:.1f},{:.1f},{:.2f}\n", family.name,
                     100 * *wanted.interval, wanted.most, layouts, reached, used / layouts, made / layouts,
                     100.0 * covered / layouts, 196 * std::sqrt(covered * (1 - 1.0 * covered / layouts)) / layouts,
                     100.0 * called_skewed / layouts, even ? 100.0 * covered_of_even / even : 0,
                     made / layouts / wanted.most);
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::cerr << "usage: replicates_rule LAYOUTS FILE.csv\n";
    return 2;
  }
  const int layouts = std::atoi(words[1]);
  std::ofstream out(words[2]);
  std::mt19937_64 random(1);
  out << "family,interval_percent,most,layouts,reached,runs_used,runs_made,coverage_percent,coverage_ci95,"
         "called_skewed_percent,coverage_of_others_percent,runs_over_most\n";
  for (const Family& family :
       {Family{"normal CV 3 %", 0.03, 0, 0}, Family{"normal CV 6 %", 0.06, 0, 0},
        Family{"log-normal sigma 0.1", 0, 0.1, 0}, Family{"log-normal sigma 0.5", 0, 0.5, 0},
        Family{"log-normal sigma 1", 0, 1, 0}, Family{"normal CV 3 % one in ten clogs", 0.03, 0, 0.1},
        Family{"normal CV 3 % one in three clogs", 0.03, 0, 0.33}})
    for (const double interval : {0.02, 0.05}) {
      const double scale = family.skewed >= 0.5 ? 5 : 1;  // such scatter is narrowed to 10 and 25 % at best
      write_family(out, family, Replicates{.interval = scale * interval, .most = 100}, layouts, random);
    }
}
