#include "selection/kim_nelson.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vibrosow {
namespace {

constexpr double share_of_constraints = 0.2;  // of the error

}  // namespace

KimNelson::KimNelson(const Question& question) : question_(question), systems_(question.systems) {
  if (question_.systems < 2) throw std::invalid_argument("a decision is between two systems at least");
  const double error = 1 - question_.confidence;
  const auto others = static_cast<double>(question_.systems - 1);
  const int constraints = (question_.band ? 1 : 0) + (question_.clogging_limit ? 1 : 0);
  selection_error_ = (constraints > 0 ? 1 - share_of_constraints : 1) * error / others;
  error_of_left_out_ = share_of_constraints * error / 2 / std::max(constraints, 1);
  error_of_taken_ = error_of_left_out_ / static_cast<double>(question_.systems);
  for (System& system : systems_) {
    if (question_.band)
      system.rate.emplace(question_.band->low, question_.band->high, first_observations, error_of_taken_,
                          error_of_left_out_);
    if (question_.clogging_limit)
      system.clogging.emplace(*question_.clogging_limit, error_of_taken_, error_of_left_out_);
  }
  pairs_.assign(question_.systems * (question_.systems - 1) / 2, Pair{SideTest(first_observations, selection_error_)});
}

KimNelson::Pair& KimNelson::pair(std::size_t lower, std::size_t higher) {
  return pairs_[higher * (higher - 1) / 2 + lower];
}

const KimNelson::Pair& KimNelson::pair(std::size_t lower, std::size_t higher) const {
  return pairs_[higher * (higher - 1) / 2 + lower];
}

void KimNelson::take(std::size_t index, const Observation& observation) {
  System& system = systems_.at(index);
  if (observation.end == RunEnd::failed) system.stage = Stage::failed;
  const bool flowed = observation.end == RunEnd::flowed;
  system.goals.push_back(flowed ? observation.goal : std::numeric_limits<double>::quiet_NaN());
  if (flowed) system.mean.add(observation.goal);
  if (flowed && system.rate) system.rate->add(observation.rate);
  if (system.clogging) system.clogging->add(!flowed);
}

bool KimNelson::is_feasible(const System& system) const {
  return (!system.rate || system.rate->verdict() == BandTest::Verdict::inside) &&
         (!system.clogging || system.clogging->verdict() == ShareTest::Verdict::less);
}

bool KimNelson::is_behind(std::size_t system, std::size_t other) const {
  using Side = SideTest::Side;
  return system < other ? pair(system, other).test.side() == Side::above
                        : pair(other, system).test.side() == Side::below;
}

bool KimNelson::rests(std::size_t system) const {
  for (std::size_t other = 0; other < systems_.size(); ++other)
    if (other != system && systems_[other].stage == Stage::contending && is_behind(system, other)) return true;
  return false;
}

std::vector<std::size_t> KimNelson::contending() const {
  std::vector<std::size_t> those;
  for (std::size_t i = 0; i < systems_.size(); ++i)
    if (systems_[i].stage == Stage::contending) those.push_back(i);
  return those;
}

/// Those contending that no other is ahead of; were each behind another, the one of the least mean.
std::vector<std::size_t> KimNelson::awake() const {
  const std::vector<std::size_t> all = contending();
  std::vector<std::size_t> those;
  for (const std::size_t i : all)
    if (!rests(i)) those.push_back(i);
  if (those.empty())
    if (const auto least = least_of(all)) those.push_back(*least);
  return those;
}

std::optional<std::size_t> KimNelson::least_of(const std::vector<std::size_t>& systems) const {
  std::optional<std::size_t> least;
  for (const std::size_t i : systems)
    if (systems_[i].mean.count() > 0 && (!least || systems_[i].mean.mean() < systems_[*least].mean.mean())) least = i;
  return least;
}

void KimNelson::judge_constraints() {
  for (System& system : systems_) {
    if (system.stage != Stage::contending) continue;
    const bool clogs = system.clogging && system.clogging->verdict() == ShareTest::Verdict::much;
    if (clogs || system.mean.count() == 0) system.stage = Stage::clogs;
    if (system.rate && system.rate->verdict() == BandTest::Verdict::outside) system.stage = Stage::misses_the_rate;
  }
}

void KimNelson::set_margin() {
  if (margin_) return;
  if (const auto least = least_of(contending())) margin_ = question_.margin * std::abs(systems_[*least].mean.mean());
}

void KimNelson::compare() {
  const std::vector<std::size_t> all = contending();
  for (const std::size_t higher : all)
    for (const std::size_t lower : all) {
      if (lower >= higher) break;
      Pair& two = pair(lower, higher);
      const std::vector<double>&a = systems_[lower].goals, &b = systems_[higher].goals;
      for (; two.seen < std::min(a.size(), b.size()); ++two.seen)
        if (const double difference = a[two.seen] - b[two.seen]; !std::isnan(difference))
          two.test.add(difference, *margin_);
    }
}

/// Those behind a system that meets the constraints are out, all at once.
void KimNelson::leave_behind() {
  const std::vector<std::size_t> all = contending();
  std::vector<std::size_t> out;
  for (const std::size_t i : all)
    if (std::ranges::any_of(
            all, [&](std::size_t other) { return other != i && is_feasible(systems_[other]) && is_behind(i, other); }))
      out.push_back(i);
  if (out.size() == all.size())
    if (const auto least = least_of(all)) std::erase(out, *least);
  for (const std::size_t i : out) systems_[i].stage = Stage::behind;
}

/// Of those with the fewest observations, and of those of which it is open whether they meet the constraints.
void KimNelson::more_of(const std::vector<std::size_t>& systems, std::vector<int>& wanted) const {
  const auto fewest = std::ranges::min(systems, {}, [&](std::size_t i) { return wanted[i]; });
  std::vector<std::size_t> asked;
  for (const std::size_t i : systems)
    if (wanted[i] < question_.most && (wanted[i] == wanted[fewest] || !is_feasible(systems_[i]))) asked.push_back(i);
  if (asked.empty()) return;
  const int count = static_cast<int>(asked.size()), each = (question_.batch + count - 1) / count;
  for (const std::size_t i : asked) wanted[i] = std::min(wanted[i] + each, question_.most);
}

void KimNelson::request_next_round() {
  counts_.clear();
  for (const System& system : systems_) counts_.push_back(static_cast<int>(system.goals.size()));
  // One of each before the others: what fails takes no more.
  for (const int each : {1, std::min(first_observations, question_.most)}) {
    const auto lacks = [&](std::size_t i) { return systems_[i].stage != Stage::failed && counts_[i] < each; };
    bool asks = false;
    for (std::size_t i = 0; i < counts_.size(); ++i)
      if (lacks(i)) counts_[i] = each, asks = true;
    if (asks) return;
  }
  judge_constraints();
  set_margin();
  if (margin_ == 0.0) return;
  if (margin_) compare(), leave_behind();
  const std::vector<std::size_t> all = contending();
  const bool decided = all.empty() || (all.size() == 1 && is_feasible(systems_[all.front()]));
  if (!decided) more_of(awake(), counts_);
}

int KimNelson::least_observations() const {
  return question_.clogging_limit
             ? std::max(first_observations,
                        ShareTest(*question_.clogging_limit, error_of_taken_, error_of_left_out_).least_trials())
             : first_observations;
}

Decision KimNelson::decision() const {
  Decision decision;
  decision.has_margin = margin_ != 0.0;
  const std::vector<std::size_t> all = contending();
  decision.is_sure = decision.has_margin && (all.empty() || (all.size() == 1 && is_feasible(systems_[all.front()])));
  decision.best = least_of(awake());
  const double error = (1 - question_.confidence) / static_cast<double>(systems_.size() - 1);
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    const System& system = systems_[i];
    Standing standing = Standing::undecided;
    if (system.stage == Stage::failed) standing = Standing::failed;
    if (system.stage == Stage::clogs) standing = Standing::clogs;
    if (system.stage == Stage::misses_the_rate) standing = Standing::misses_the_rate;
    if (decision.best == i && decision.is_sure) standing = Standing::best;
    const bool is_compared = system.stage == Stage::behind || (system.stage == Stage::contending && rests(i));
    if (is_compared && decision.best && decision.best != i)
      standing = is_surely_above(system.goals, systems_[*decision.best].goals, error) ? Standing::worse
                 : system.stage == Stage::behind                                      ? Standing::not_shown_worse
                                                                                      : Standing::undecided;
    decision.standings.push_back(standing);
  }
  return decision;
}

}  // namespace vibrosow
