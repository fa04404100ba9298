// How much of the front of three made-up noisy problems is found by equally many runs: by `vibrosow optimise`'s own
// search, a Latin hypercube, and pagmo's NSGA-II and MOEA/D, which have the best of several settings, chosen by the
// answers. What each names as its front by the means that it saw is judged by the true values: the hypervolume over
// that of the true front. Also how often what the search calls on the front or dominated is not. Usage: optimisers
// SEEDS FILE.csv

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <numbers>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/moead.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <string>
#include <vector>

#include "optimise/front_search.hpp"
#include "study/latin_hypercube.hpp"

namespace {

constexpr int first_seed = 1001;  // those below were used when the constants of the search were chosen

using namespace vibrosow;

constexpr int first = 2;  // runs of a layout, at first
using Point = std::vector<std::size_t>;
using Values = std::array<double, 2>;

/// Two goals, each the less the better, and a rate that is to lie in a band.
struct Truth {
  Values goals;
  double rate = 1;
};

struct Problem {
  std::string name;
  std::vector<std::size_t> values;  // of each axis, a continuous one having a thousand
  std::function<Truth(const std::vector<double>& point)> truth;
  Values scatter, reference;  // the reference point of the hypervolume
  double rate_scatter = 0;
  Band band{0.95, 1.05};
};

double share(double x, std::size_t values) {
  return values > 1 ? x / static_cast<double>(values - 1) : 0;
}

Truth zdt1(const std::vector<double>& x) {
  double sum = 0;
  for (std::size_t i = 1; i < x.size(); ++i) sum += share(x[i], 1000);
  const double f = share(x[0], 1000), g = 1 + 9 * sum / static_cast<double>(x.size() - 1);
  return {{f, g * (1 - std::sqrt(f / g))}};
}

/// A whole number of eight and a share of the next; another of seven that should be 3; a last axis that should be 0.4.
Truth mixed(const std::vector<double>& x) {
  const double f = (x[0] + share(x[1], 1000)) / 8;
  const double g = 1 + std::abs(x[2] - 3) / 4 + 2 * std::abs(share(x[3], 1000) - 0.4);
  return {{f, g * (1 - std::pow(f / g, 2))}};
}

/// A tray of 1 to 7 holes of 8 to 14 mm at 5 to 15 Hz and 2 to 8 mm: the power of the drive against the evenness, at a
/// wanted rate. The rate of a hole goes by Beverloo's law of the plane and the peak speed.
Truth sowing(const std::vector<double>& x) {
  const double holes = 1 + x[0], width = 8 + 6 * share(x[1], 1000), frequency = 5 + 10 * share(x[2], 1000);
  const double amplitude = 2 + 6 * share(x[3], 1000), speed = 2 * std::numbers::pi * frequency * amplitude;  // mm/s
  const double rate = 0.0105 * holes * std::pow(width - 4.9, 1.5) * std::pow(speed / 250, 0.8);
  const double power = std::pow(amplitude / 5, 2) * std::pow(frequency / 10, 3);
  const double unevenness = 0.04 + 0.02 * (holes - 1) + 0.25 / (1 + std::pow(speed / 150, 2)) + 0.1 / (width - 7);
  return {{power, 10 * unevenness}, rate};
}

std::vector<Problem> problems() {
  return {{"zdt1", {1000, 1000, 1000, 1000, 1000}, zdt1, {0.05, 0.05}, {1.1, 1.5}},
          {"mixed", {8, 1000, 7, 1000}, mixed, {0.05, 0.05}, {1.1, 1.5}},
          {"sowing", {7, 1000, 1000, 1000}, sowing, {0, 0.15}, {3, 3}, 0.05}};
}

bool is_allowed(const Problem& problem, const Truth& truth) {
  return truth.rate >= problem.band.low && truth.rate <= problem.band.high;
}

bool dominates(const Values& one, const Values& other) {
  return one[0] <= other[0] && one[1] <= other[1] && one != other;
}

/// Area that the points dominate, up to the reference.
double hypervolume(std::vector<Values> points, const Values& reference) {
  std::ranges::sort(points);
  double area = 0, ceiling = reference[1];
  for (const Values& point : points) {
    if (point[0] >= reference[0] || point[1] >= ceiling) continue;
    area += (reference[0] - point[0]) * (ceiling - point[1]);
    ceiling = point[1];
  }
  return area;
}

/// By so many points at random and steps away from the best of them: a search that sees the truth.
double true_hypervolume(const Problem& problem) {
  Random random(12345);
  std::vector<Point> best;
  std::vector<Values> front;
  for (int i = 0; i < 400000; ++i) {
    Point point;
    for (const std::size_t values : problem.values) point.push_back(random.below(values));
    if (!best.empty() && i % 8 != 0) {
      point = best[random.below(best.size())];
      for (std::size_t axis = 0; axis < point.size(); ++axis) {
        const auto values = static_cast<double>(problem.values[axis]);
        const double by = std::round(random.uniform(-1, 1) * values * std::pow(10, -3 * random.uniform()));
        point[axis] = static_cast<std::size_t>(std::clamp(static_cast<double>(point[axis]) + by, 0.0, values - 1));
      }
    }
    const Truth truth = problem.truth(std::vector<double>(point.begin(), point.end()));
    if (!is_allowed(problem, truth)) continue;
    if (std::ranges::any_of(front,
                            [&](const Values& one) { return one == truth.goals || dominates(one, truth.goals); }))
      continue;
    for (std::size_t k = front.size(); k-- > 0;)
      if (dominates(truth.goals, front[k])) {
        front.erase(front.begin() + static_cast<std::ptrdiff_t>(k));
        best.erase(best.begin() + static_cast<std::ptrdiff_t>(k));
      }
    front.push_back(truth.goals);
    best.push_back(point);
  }
  return hypervolume(front, problem.reference);
}

/// Runs of a problem, with chance of their own.
class Runs {
 public:
  Runs(const Problem& problem, std::uint64_t seed) : problem_(problem), random_(seed) {}
  FrontObservation run(const std::vector<double>& point) {
    const Truth truth = problem_.truth(point);
    FrontObservation seen;
    for (std::size_t g = 0; g < 2; ++g) seen.goals.push_back(truth.goals[g] + problem_.scatter[g] * normal());
    if (problem_.rate_scatter > 0) seen.banded = {truth.rate + problem_.rate_scatter * normal()};
    ++count_;
    return seen;
  }
  int count() const { return count_; }

 private:
  double normal() {
    const double uniform = std::max(random_.uniform(), 0x1p-53);
    return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * uniform);
  }
  const Problem& problem_;
  Random random_;
  int count_ = 0;
};

FrontQuestion question_of(const Problem& problem) {
  FrontQuestion question;
  for (const double scatter : problem.scatter) question.goals.push_back({std::nullopt, scatter == 0});
  if (problem.rate_scatter > 0) question.bands = {problem.band};
  question.first = first;
  return question;
}

std::vector<double> place_of(const Point& point) {
  return {point.begin(), point.end()};
}

/// Share of the true front's hypervolume that points reach, which must be allowed in truth.
double reached(const Problem& problem, const std::vector<std::vector<double>>& points, double whole) {
  std::vector<Values> values;
  for (const std::vector<double>& point : points)
    if (const Truth truth = problem.truth(point); is_allowed(problem, truth)) values.push_back(truth.goals);
  return hypervolume(values, problem.reference) / whole;
}

struct Outcome {
  double reached = 0;
  int on_front = 0, wrongly_on_front = 0, dominated = 0, wrongly_dominated = 0;
};

std::vector<std::vector<double>> named_front(const Front& front, const std::vector<Point>& points) {
  std::vector<std::vector<double>> named;
  const auto layers = front.layers(1);
  if (layers.empty()) return named;
  for (const std::size_t i : layers.front()) named.push_back(place_of(points[i]));
  return named;
}

/// Among the points that were tried.
void count_claims(const Problem& problem, const FrontSearch& search, Outcome& outcome) {
  const std::vector<FrontStanding> standings = search.front().standings();
  std::vector<Truth> truths;
  for (const Point& point : search.points()) truths.push_back(problem.truth(place_of(point)));
  for (std::size_t i = 0; i < truths.size(); ++i) {
    const bool is_dominated = std::ranges::any_of(truths, [&](const Truth& other) {
      return is_allowed(problem, other) && dominates(other.goals, truths[i].goals);
    });
    const bool is_on_front = !is_dominated && is_allowed(problem, truths[i]);
    outcome.on_front += standings[i] == FrontStanding::on_front;
    outcome.wrongly_on_front += standings[i] == FrontStanding::on_front && !is_on_front;
    outcome.dominated += standings[i] == FrontStanding::dominated;
    outcome.wrongly_dominated += standings[i] == FrontStanding::dominated && !is_dominated;
  }
}

Outcome by_search(const Problem& problem, int budget, std::uint64_t seed, double whole, bool is_hypercube_alone) {
  FrontSearchOptions options;
  options.values = problem.values;
  options.question = question_of(problem);
  options.budget = budget;
  if (is_hypercube_alone) options.first_points = static_cast<std::size_t>(budget / first);
  FrontSearch search(options);
  Runs runs(problem, seed);
  std::vector<int> have;
  for (search.request_next_round(); search.counts() != have; search.request_next_round()) {
    const std::vector<int>& wanted = search.counts();
    have.resize(wanted.size(), 0);
    for (std::size_t i = 0; i < wanted.size(); ++i)
      for (; have[i] < wanted[i]; ++have[i]) search.take(i, runs.run(place_of(search.points()[i])));
  }
  Outcome outcome;
  outcome.reached = reached(problem, named_front(search.front(), search.points()), whole);
  count_claims(problem, search, outcome);
  return outcome;
}

/// What pagmo sees: the mean of some runs of a point, with a penalty for what lies outside of the band.
struct Seen {
  const Problem* problem = nullptr;
  std::shared_ptr<Runs> runs;
  int runs_of_a_point = 1;
  bool knows_whole_numbers = true;  // MOEA/D knows none: they are rounded
  std::shared_ptr<std::vector<std::pair<std::vector<double>, std::vector<double>>>> all;

  std::vector<double> fitness(const std::vector<double>& x) const {
    std::vector<double> place = ordered(x, false), mean(2, 0);
    for (std::size_t axis = 0; axis < place.size(); ++axis)
      if (is_whole(problem->values[axis])) place[axis] = std::round(place[axis]);
    double rate = 0;
    for (int i = 0; i < runs_of_a_point; ++i) {
      const FrontObservation seen = runs->run(place);
      for (std::size_t g = 0; g < 2; ++g) mean[g] += seen.goals[g] / runs_of_a_point;
      rate += (seen.banded.empty() ? 1 : seen.banded[0]) / runs_of_a_point;
    }
    const double outside = std::max({0.0, problem->band.low - rate, rate - problem->band.high});
    for (double& goal : mean) goal += outside > 0 ? 10 + 100 * outside : 0;
    all->push_back({place, mean});
    return mean;
  }
  std::pair<std::vector<double>, std::vector<double>> get_bounds() const {
    std::vector<double> high;
    for (const std::size_t values : problem->values) high.push_back(static_cast<double>(values - 1));
    return {std::vector<double>(high.size(), 0), ordered(high, true)};
  }
  std::vector<double>::size_type get_nobj() const { return 2; }
  std::vector<double>::size_type get_nix() const {
    return knows_whole_numbers ? static_cast<std::size_t>(std::ranges::count_if(problem->values, is_whole)) : 0;
  }
  pagmo::thread_safety get_thread_safety() const { return pagmo::thread_safety::none; }

  static bool is_whole(std::size_t values) { return values < 1000; }
  /// pagmo has whole numbers last.
  std::vector<double> ordered(const std::vector<double>& x, bool to_pagmo) const {
    std::vector<double> other(x.size());
    std::size_t k = 0;
    for (const bool whole : {false, true})
      for (std::size_t axis = 0; axis < x.size(); ++axis)
        if (is_whole(problem->values[axis]) == whole) {
          (to_pagmo ? other[k] : other[axis]) = to_pagmo ? x[axis] : x[k];
          ++k;
        }
    return other;
  }
};

struct Setting {
  std::string algorithm;
  unsigned population;
  int runs_of_a_point;
};

/// The front is of all points that were tried, or of the last population: the better of the two.
double by_pagmo(const Problem& problem, const Setting& setting, int budget, std::uint64_t seed, double whole) {
  Seen seen{&problem, std::make_shared<Runs>(problem, seed), setting.runs_of_a_point, setting.algorithm == "nsga2",
            std::make_shared<std::vector<std::pair<std::vector<double>, std::vector<double>>>>()};
  const auto chance = static_cast<unsigned>(seed);
  pagmo::population population(pagmo::problem(seen), setting.population, chance);
  const int points = budget / setting.runs_of_a_point;
  const unsigned generations = static_cast<unsigned>(points) / setting.population - 1;
  pagmo::algorithm algorithm =
      setting.algorithm == "nsga2"
          ? pagmo::algorithm(
                pagmo::nsga2(generations, 0.95, 10, 1.0 / static_cast<double>(problem.values.size()), 50, chance))
          : pagmo::algorithm(pagmo::moead(generations, "grid", "tchebycheff", std::min(20U, setting.population - 1), 1,
                                          0.5, 20, 0.9, 2, true, chance));
  population = algorithm.evolve(population);
  const auto front_of = [&](const std::vector<std::pair<std::vector<double>, std::vector<double>>>& all) {
    std::vector<std::vector<double>> front;
    for (const auto& [place, mean] : all)
      if (std::ranges::none_of(all, [&](const auto& other) {
            return dominates({other.second[0], other.second[1]}, {mean[0], mean[1]});
          }))
        front.push_back(place);
    return reached(problem, front, whole);
  };
  std::vector<std::pair<std::vector<double>, std::vector<double>>> last;
  for (std::size_t i = 0; i < population.size(); ++i)
    last.push_back({seen.ordered(population.get_x()[i], false), population.get_f()[i]});
  return std::max(front_of(*seen.all), front_of(last));
}

struct Interval {
  double mean, half;
};

Interval interval_of(const std::vector<double>& values) {
  Moments moments;
  for (const double value : values) moments.add(value);
  const double t = quantile(boost::math::students_t(moments.count() - 1.0), 0.975);
  return {moments.mean(), t * std::sqrt(moments.variance() / moments.count())};
}

void write_problem(std::ostream& out, const Problem& problem, int budget, int seeds) {
  const double whole = true_hypervolume(problem);
  std::vector<double> ours;
  Outcome sum;
  for (int seed = first_seed; seed < first_seed + seeds; ++seed) {
    const Outcome outcome = by_search(problem, budget, static_cast<std::uint64_t>(seed), whole, false);
    ours.push_back(outcome.reached);
    sum.on_front += outcome.on_front, sum.wrongly_on_front += outcome.wrongly_on_front;
    sum.dominated += outcome.dominated, sum.wrongly_dominated += outcome.wrongly_dominated;
  }
  const auto line = [&](const std::string& name, const std::string& setting, const std::vector<double>& values,
                        const std::string& claims) {
    std::vector<double> ahead;
    for (std::size_t i = 0; i < values.size(); ++i) ahead.push_back(ours[i] - values[i]);
    const Interval of = interval_of(values), difference = interval_of(ahead);
    out << fmt::format("{},{},{},{},{},{:.2f},{:.2f},{:.3f},", problem.name, budget, name, setting, seeds,
                       100 * of.mean, 100 * of.half, of.mean / interval_of(ours).mean);
    out << fmt::format("{:.2f},{:.2f},{}\n", 100 * difference.mean, 100 * difference.half, claims);
    out.flush();
  };
  line("vibrosow", "", ours,
       fmt::format("{},{},{},{}", sum.on_front, sum.wrongly_on_front, sum.dominated, sum.wrongly_dominated));
  std::vector<double> hypercube;
  for (int seed = first_seed; seed < first_seed + seeds; ++seed)
    hypercube.push_back(by_search(problem, budget, static_cast<std::uint64_t>(seed), whole, true).reached);
  line("latin hypercube", "", hypercube, ",,,");
  for (const char* const algorithm : {"nsga2", "moead"}) {
    std::vector<double> best;
    std::string with;
    for (const unsigned population : {12U, 20U, 40U})
      for (const int runs : {1, 2, 4}) {
        const Setting setting{algorithm, population, runs};
        if (budget / runs < 2 * static_cast<int>(population)) continue;
        std::vector<double> values;
        for (int seed = first_seed; seed < first_seed + seeds; ++seed)
          values.push_back(by_pagmo(problem, setting, budget, static_cast<std::uint64_t>(seed), whole));
        if (best.empty() || interval_of(values).mean > interval_of(best).mean) {
          best = values;
          with = fmt::format("{} points of {} runs", population, runs);
        }
      }
    line(fmt::format("pagmo {}", algorithm), with, best, ",,,");
  }
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::cerr << "usage: optimisers SEEDS FILE.csv\n";
    return 2;
  }
  const int seeds = std::atoi(words[1]);
  if (seeds < 2) {
    std::cerr << "an interval takes two seeds\n";
    return 2;
  }
  std::ofstream out(words[2]);
  out << "problem,runs,optimiser,setting,seeds,reached_percent,reached_ci95,over_vibrosow,vibrosow_ahead_percent,ahead_"
         "ci95,"
         "on_front,wrongly_on_front,dominated,wrongly_dominated\n";
  for (const int budget : {300, 1000})
    for (const Problem& problem : problems()) write_problem(out, problem, budget, seeds);
}
