// How often each procedure of src/selection decides rightly, and how many runs it takes, over made-up problems of 60
// layouts: CSV. Beside them Rinott's two-stage procedure, and the fewest runs of each layout that suffice when all are
// run equally often: found by bisection over the same problems, as nobody could who does not know the answers.
// Usage: selection_rules PROBLEMS FILE.csv

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "selection/kim_nelson.hpp"
#include "selection/moments.hpp"
#include "selection/posterior.hpp"
#include "selection/procedure.hpp"
#include "selection/rinott.hpp"

namespace {

using namespace vibrosow;

constexpr std::size_t layouts = 60;
constexpr double margin = 0.05, confidence = 0.95;
constexpr double scatter = 0.1;                          // standard deviation of a run, over the best's mean
constexpr double middle = 1.5, spread = 0.2;             // of random means, which are normal: the best is near 1
constexpr double clogging_limit = 0.05, often = 0.3;     // every third layout clogs so often
constexpr Band band{0.95, 1.05};                         // of rates, which scatter by
constexpr double rate_scatter = 0.03, missed_by = 0.08;  // every third layout's rate is so far from 1
constexpr int first_of_rinott = 10, most = 2000;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }
  double normal() { return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * uniform()); }

 private:
  std::mt19937_64 engine_;
};

struct Family {
  std::string name;
  bool slippage;         // all others are worse than the best by the margin; else means are random
  bool unequal = false;  // deviations from half to twice as large
  double skewed = 0;     // sigma of a shifted log-normal; 0: normal
  bool clogs = false, misses = false;
};

struct Layout {
  double mean = 1, deviation = scatter, clogging = 0, rate = 1;
  bool may_be_taken() const { return clogging < clogging_limit && rate > band.low && rate < band.high; }
  Random random;
  std::vector<Observation> runs{};
};

/// The runs of a problem are there from the first time that they are asked for: every procedure sees the same.
class Problem {
 public:
  Problem(const Family& family, std::uint64_t seed) : family_(family) {
    Random random(seed);
    for (std::size_t i = 0; i < layouts; ++i) {
      Layout layout{.random = Random(seed * 1000 + i)};
      layout.mean = family.slippage ? (i == 0 ? 1 : 1 + margin) : std::max(0.5, middle + spread * random.normal());
      if (family.unequal) layout.deviation *= std::exp2(2 * random.uniform() - 1);
      if (family.clogs && i % 3 == 1) layout.clogging = often;
      if (family.misses && i % 3 == 1) layout.rate += i % 2 == 0 ? missed_by : -missed_by;
      layouts_.push_back(std::move(layout));
    }
  }

  const Observation& run(std::size_t layout, std::size_t number) {
    Layout& of = layouts_[layout];
    while (of.runs.size() <= number) of.runs.push_back(next(of));
    return of.runs[number];
  }

  bool is_right(std::size_t chosen) const {
    double best = std::numeric_limits<double>::infinity();
    for (const Layout& layout : layouts_)
      if (layout.may_be_taken()) best = std::min(best, layout.mean);
    return layouts_[chosen].may_be_taken() && layouts_[chosen].mean <= best * (1 + margin * (1 - 1e-9));
  }

 private:
  Observation next(Layout& of) const {
    const double z = of.random.normal(), clogs = of.random.uniform(), s = family_.skewed;
    if (clogs < of.clogging) return {RunEnd::clogged, 0, 0};
    const double standard =
        s > 0 ? (std::exp(s * z) - std::exp(s * s / 2)) / std::sqrt(std::exp(s * s) * std::expm1(s * s)) : z;
    const double rate = family_.misses ? of.rate + rate_scatter * of.random.normal() : of.rate;
    return {RunEnd::flowed, of.mean + of.deviation * standard, rate};
  }

  const Family& family_;
  std::vector<Layout> layouts_;
};

/// What a rule made of a problem.
struct Outcome {
  bool right;
  double runs;
};

Outcome decide(Procedure& procedure, Problem& problem) {
  std::vector<int> have(layouts, 0);
  for (procedure.request_next_round(); procedure.counts() != have; procedure.request_next_round())
    for (std::size_t i = 0; i < layouts; ++i)
      for (; have[i] < procedure.counts()[i]; ++have[i])
        procedure.take(i, problem.run(i, static_cast<std::size_t>(have[i])));
  double runs = 0;
  for (const int of : have) runs += of;
  const Decision decision = procedure.decision();
  return {decision.is_sure && decision.best && problem.is_right(*decision.best), runs};
}

Question question_of(const Family& family) {
  Question question{.systems = layouts, .margin = margin, .confidence = confidence, .most = most};
  if (family.clogs) question.clogging_limit = clogging_limit;
  if (family.misses) question.band = band;
  return question;
}

/// A layout's runs up to so many that flowed.
struct Seen {
  Moments goal{}, rate{};
  int runs = 0;
  void add(const Observation& run) {
    ++runs;
    if (run.end == RunEnd::flowed) goal.add(run.goal), rate.add(run.rate);
  }
  bool seems_allowed() const {
    return runs - goal.count() < clogging_limit * runs && rate.mean() > band.low && rate.mean() < band.high;
  }
};

void see(Seen& seen, Problem& problem, std::size_t layout, double flowing) {
  while (seen.goal.count() < flowing) seen.add(problem.run(layout, static_cast<std::size_t>(seen.runs)));
}

/// The least mean of those that seem to meet the constraints.
std::optional<std::size_t> least_of(const std::vector<Seen>& seen) {
  std::optional<std::size_t> least;
  for (std::size_t i = 0; i < layouts; ++i)
    if (seen[i].seems_allowed() && (!least || seen[i].goal.mean() < seen[*least].goal.mean())) least = i;
  return least;
}

Outcome outcome_of(const std::vector<Seen>& seen, const Problem& problem) {
  double runs = 0;
  for (const Seen& one : seen) runs += one.runs;
  const auto least = least_of(seen);
  return {least && problem.is_right(*least), runs};
}

Outcome by_rinott(Problem& problem, double h) {
  std::vector<Seen> seen(layouts);
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < layouts; ++i) {
    see(seen[i], problem, i, first_of_rinott);
    best = std::min(best, seen[i].goal.mean());
  }
  for (std::size_t i = 0; i < layouts; ++i)
    see(seen[i], problem, i, rinott_observations(h, seen[i].goal.variance(), margin * best, first_of_rinott));
  return outcome_of(seen, problem);
}

Outcome by_equal_runs(Problem& problem, int runs) {
  std::vector<Seen> seen(layouts);
  for (std::size_t i = 0; i < layouts; ++i)
    while (seen[i].runs < runs) seen[i].add(problem.run(i, static_cast<std::size_t>(seen[i].runs)));
  return outcome_of(seen, problem);
}

struct Tally {
  int right = 0;
  double runs = 0;  // of a problem
};

Tally tally(std::vector<Problem>& problems, const std::function<Outcome(Problem&)>& rule) {
  Tally sum;
  for (Problem& problem : problems) {
    const Outcome outcome = rule(problem);
    sum.right += outcome.right;
    sum.runs += outcome.runs / static_cast<double>(problems.size());
  }
  return sum;
}

/// With the fewest runs of each layout that are right as often as wanted, up to `most`.
Tally smallest_equal(std::vector<Problem>& problems) {
  const auto with = [&](int runs) { return tally(problems, [&](Problem& one) { return by_equal_runs(one, runs); }); };
  const auto is_enough = [&](const Tally& of) { return of.right >= confidence * static_cast<double>(problems.size()); };
  int low = 0, high = 8;
  while (!is_enough(with(high)) && high < most) low = high, high *= 2;
  while (high - low > 1) (is_enough(with((low + high) / 2)) ? high : low) = (low + high) / 2;
  return with(high);
}

void write_family(std::ostream& out, const Family& family, int count, double h) {
  std::vector<Problem> problems;
  for (int i = 0; i < count; ++i) problems.emplace_back(family, static_cast<std::uint64_t>(i + 1));
  const Question question = question_of(family);
  const Tally rinott = tally(problems, [&](Problem& one) { return by_rinott(one, h); });
  const Tally equal = smallest_equal(problems);
  const auto line = [&](const std::string& rule, const Tally& of) {
    using Binomial = boost::math::binomial_distribution<>;
    out << fmt::format("{},{},{},{:.1f},{:.1f},{:.1f},{:.0f},{:.3f},{:.3f}\n", family.name, rule, count,
                       100.0 * of.right / count, 100 * Binomial::find_lower_bound_on_p(count, of.right, 0.025),
                       100 * Binomial::find_upper_bound_on_p(count, of.right, 0.025), of.runs, of.runs / rinott.runs,
                       of.runs / equal.runs);
    out.flush();
  };
  line("guaranteed", tally(problems, [&](Problem& one) {
         KimNelson procedure(question);
         return decide(procedure, one);
       }));
  line("posterior", tally(problems, [&](Problem& one) {
         Posterior procedure(question);
         return decide(procedure, one);
       }));
  line("rinott", rinott);
  line("smallest equal", equal);
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::cerr << "usage: selection_rules PROBLEMS FILE.csv\n";
    return 2;
  }
  const int problems = std::atoi(words[1]);
  std::ofstream out(words[2]);
  out << "family,rule,problems,right_percent,right_low,right_high,runs,runs_over_rinott,runs_over_smallest_equal\n";
  const double h = rinott_h(layouts, first_of_rinott, confidence);
  for (const bool slippage : {false, true})
    for (const Family& kind :
         {Family{"equal", slippage}, Family{"unequal", slippage, true}, Family{"skewed", slippage, false, 0.8},
          Family{"clogs", slippage, false, 0, true}, Family{"rates", slippage, false, 0, false, true}}) {
      Family family = kind;
      family.name = (slippage ? "slippage " : "random ") + kind.name;
      write_family(out, family, problems, h);
    }
}
