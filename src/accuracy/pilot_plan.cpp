#include "accuracy/pilot_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace vibrosow {
namespace {

constexpr int most_pilots = 500;
constexpr double nothing = std::numeric_limits<double>::infinity();

struct PilotPlan {
  double badness = nothing;  // cost, or percent
  std::vector<int> pilots;
};

/// Pilots for one setting, added one by one.
class Path {
 public:
  Path(const PilotBasis& basis, std::size_t setting)
      : basis_(basis),
        setting_(setting),
        gradient_(basis.fit.gradient_of(setting)),
        covariance_(basis.fit.covariance()),
        pilots_(basis.costs.size(), 0) {}

  double spent() const { return spent_; }
  const std::vector<int>& pilots() const { return pilots_; }

  double band() const { return basis_.fit.band_with(setting_, covariance_); }
  double bias_bound() const { return std::abs(basis_.fit.error(setting_).percent) + band(); }

  /// Cost of all runs that bring the error below `percent`; infinite where none do.
  double cost_within(double percent) const {
    const double left = percent - bias_bound();
    if (!(left > 0)) return nothing;
    const double wanted = std::ceil(std::pow(basis_.half_width_of_run / left, 2));
    return spent_ + std::max(0.0, wanted - runs_made()) * basis_.costs[setting_];
  }

  /// Error bound, percent, when what is left of a budget goes into the answer; infinite where it is overdrawn.
  double error_for(double budget) const {
    const double runs = runs_made() + std::floor(std::max(-1.0, budget - spent_) / basis_.costs[setting_]);
    return spent_ <= budget && runs >= 1 ? bias_bound() + basis_.half_width_of_run / std::sqrt(runs) : nothing;
  }

  /// The run that narrows the band most for its cost.
  void add_one() {
    std::size_t best = 0;
    double most = -1;
    for (std::size_t i = 0; i < basis_.costs.size(); ++i) {
      if (!(basis_.costs[i] > 0)) continue;
      const Eigen::VectorXd row = basis_.fit.row_of(i), along = covariance_ * row;
      const double gain = std::pow(gradient_.dot(along), 2) / (1 + row.dot(along)) / basis_.costs[i];
      if (gain > most) most = gain, best = i;
    }
    const Eigen::VectorXd row = basis_.fit.row_of(best), along = covariance_ * row;
    covariance_ -= along * along.transpose() / (1 + row.dot(along));  // Sherman & Morrison
    spent_ += basis_.costs[best];
    ++pilots_[best];
  }

 private:
  double runs_made() const { return basis_.made[setting_] + pilots_[setting_]; }

  const PilotBasis& basis_;
  std::size_t setting_;
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd covariance_;
  std::vector<int> pilots_;
  double spent_ = 0;
};

/// Whether a setting might be shown to be within `percent` were its error as small as its band allows.
bool may_be_within(const PilotBasis& basis, std::size_t setting, double percent) {
  if (!(basis.costs[setting] > 0)) return false;
  const RateError error = basis.fit.error(setting);
  const double least = std::max(0.0, std::abs(error.percent) - error.band);
  Path path(basis, setting);
  for (int pilots = 0; pilots < most_pilots; ++pilots) path.add_one();
  const double left = percent - least - path.band();
  return left > 0 && std::pow(basis.half_width_of_run / left, 2) <= most_replicates;
}

}  // namespace

std::vector<int> plan_pilots(const PilotBasis& basis, const PromiseGoal& goal) {
  PilotPlan best{nothing, std::vector<int>(basis.costs.size(), 0)};
  for (std::size_t setting = 0; setting < basis.costs.size(); ++setting) {
    if (!(basis.costs[setting] > 0)) continue;
    Path path(basis, setting);
    for (int pilots = 0; pilots <= most_pilots; ++pilots) {
      const double badness = goal.cpu_time ? path.error_for(*goal.cpu_time) : path.cost_within(*goal.within_percent);
      if (badness < best.badness) best = {badness, path.pilots()};
      if (path.spent() > (goal.cpu_time ? *goal.cpu_time : best.badness)) break;
      path.add_one();
    }
  }
  return best.pilots;
}

std::vector<int> plan_further_pilots(const PilotBasis& basis, double percent, double spent) {
  std::optional<std::size_t> best;
  const auto size = [&](std::size_t setting) { return std::abs(basis.fit.error(setting).percent); };
  for (std::size_t setting = 0; setting < basis.costs.size(); ++setting)
    if (may_be_within(basis, setting, percent) && (!best || size(setting) < size(*best))) best = setting;
  if (!best) return std::vector<int>(basis.costs.size(), 0);
  Path path(basis, *best);
  for (int pilots = 0; pilots < most_pilots && path.spent() < spent; ++pilots) path.add_one();
  return path.pilots();
}

}  // namespace vibrosow
