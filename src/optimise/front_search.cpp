#include "optimise/front_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "portable_math/functions.hpp"
#include "study/latin_hypercube.hpp"

namespace vibrosow {
namespace {

constexpr int new_points_a_round = 4;
constexpr std::size_t least_leading = 6;               // below which the next layers lead as well
constexpr std::size_t most_seen = 250;                 // points that a fit goes through: the best
constexpr double last_share = 0.25;                    // of the budget, in which no new points come
constexpr double shortest_step = 0.01, longest = 0.3;  // of an axis
constexpr double chance_of_a_stranger = 0.2;           // of a candidate that is near no other
constexpr int candidates = 200;                        // for a new point
constexpr double sum_beside_largest = 0.05;            // of the weighted goals, as in ParEGO
constexpr double cost_of_a_miss = 3;                   // by a band's half width, in ranges of a goal

}  // namespace

FrontSearch::FrontSearch(FrontSearchOptions options)
    : options_(std::move(options)),
      front_(options_.question),
      fits_(options_.question.goals.size() + options_.question.bands.size(), SmoothFit(options_.values.size())) {
  if (options_.values.empty() || std::ranges::find(options_.values, std::size_t{0}) != options_.values.end())
    throw std::invalid_argument("a space has an axis at least, and each axis a value");
  if (options_.question.first < 2) throw std::invalid_argument("a point begins with two observations at least");
}

int FrontSearch::left() const {
  return options_.budget - std::accumulate(counts_.begin(), counts_.end(), 0);
}

bool FrontSearch::add(Point point) {
  if (!known_.insert(point).second) return false;
  points_.push_back(std::move(point));
  counts_.push_back(options_.question.first);
  front_.add_system();
  return true;
}

void FrontSearch::leave_out(std::size_t point) {
  front_.take(point, {RunEnd::failed});
  counts_.at(point) = front_.observations(point);
}

FrontSearch::Point FrontSearch::random_point() {
  Point point;
  for (const std::size_t values : options_.values) point.push_back(random_.below(values));
  return point;
}

void FrontSearch::begin() {
  const auto most = static_cast<std::size_t>(std::max(1, left() / options_.question.first));
  for (const std::vector<double>& place :
       latin_hypercube(std::min(options_.first_points, most), options_.values.size())) {
    Point point;
    for (std::size_t axis = 0; axis < place.size(); ++axis)
      point.push_back(static_cast<std::size_t>(place[axis] * static_cast<double>(options_.values[axis])));
    add(std::move(point));
  }
}

/// What would step beyond an end stays there: the best is often at one.
FrontSearch::Point FrontSearch::near(const std::vector<std::size_t>& leading) {
  const Point &one = points_[leading[random_.below(leading.size())]],
              &other = points_[leading[random_.below(leading.size())]];
  const double step = shortest_step * portable_math::pow(longest / shortest_step, random_.uniform());
  const std::size_t certain = random_.below(one.size());
  Point point;
  for (std::size_t axis = 0; axis < one.size(); ++axis) {
    const auto last = static_cast<double>(options_.values[axis] - 1);
    auto value = static_cast<double>((random_.uniform() < 0.5 ? one : other)[axis]);
    if (axis == certain || random_.uniform() * static_cast<double>(one.size()) < 1) {
      const double by = random_.uniform(-1, 1) * step * (last + 1);
      value += std::abs(by) < 1 ? std::copysign(1.0, by) : std::round(by);
      value = std::clamp(value, 0.0, last);
    }
    point.push_back(static_cast<std::size_t>(value));
  }
  return point;
}

std::vector<double> FrontSearch::place_of(const Point& point) const {
  std::vector<double> place;
  for (std::size_t axis = 0; axis < point.size(); ++axis)
    place.push_back((static_cast<double>(point[axis]) + 0.5) / static_cast<double>(options_.values[axis]));
  return place;
}

void FrontSearch::fit(const std::vector<std::size_t>& best) {
  std::vector<std::vector<SeenValue>> seen(fits_.size());
  for (const std::size_t point : best) {
    const std::vector<KnownMean> known = front_.known(point);
    for (std::size_t f = 0; f < known.size(); ++f)
      if (known[f].count > 0) seen[f].push_back({place_of(points_[point]), known[f].mean, known[f].error_squared()});
  }
  for (std::size_t f = 0; f < seen.size(); ++f)
    if (seen[f].size() > 1) fits_[f].fit(std::move(seen[f]));
}

/// Of each goal, among those that lead.
std::vector<Band> FrontSearch::ranges_of(const std::vector<std::size_t>& leading) const {
  std::vector<Band> ranges(options_.question.goals.size(), Band{HUGE_VAL, -HUGE_VAL});
  for (const std::size_t point : leading) {
    const std::vector<KnownMean> known = front_.known(point);
    for (std::size_t g = 0; g < ranges.size(); ++g) {
      const double value = options_.question.goals[g].of(known[g].mean);
      ranges[g] = {std::min(ranges[g].low, value), std::max(ranges[g].high, value)};
    }
  }
  return ranges;
}

/// The largest weighted goal, as it may well be: a standard deviation better than is predicted.
double FrontSearch::cost_of(const Point& point, const std::vector<double>& weights,
                            const std::vector<Band>& ranges) const {
  const std::vector<double> place = place_of(point);
  double largest = -HUGE_VAL, sum = 0, missed = 0;
  for (std::size_t f = 0; f < fits_.size(); ++f) {
    const SmoothFit::Prediction seen = fits_[f].at(place);
    if (f < ranges.size()) {
      const double range = ranges[f].high - ranges[f].low;
      const double value = options_.question.goals[f].of(seen.mean) - seen.deviation;
      const double cost = weights[f] * (value - ranges[f].low) / (range > 0 ? range : 1);
      largest = std::max(largest, cost);
      sum += cost;
    } else {
      missed += options_.question.bands[f - ranges.size()].outside_by(seen.mean);
    }
  }
  return largest + sum_beside_largest * sum + cost_of_a_miss * missed;
}

bool FrontSearch::propose_one(const std::vector<std::size_t>& leading, const std::vector<Band>& ranges) {
  std::vector<double> weights;
  double sum = 0;
  for (std::size_t g = 0; g < ranges.size(); ++g)
    sum += weights.emplace_back(-portable_math::log(1 - random_.uniform()));
  for (double& weight : weights) weight /= sum;  // all shares are equally likely
  Point best;
  double least = HUGE_VAL;
  for (int i = 0; i < candidates; ++i) {
    Point point = leading.empty() || random_.uniform() < chance_of_a_stranger ? random_point() : near(leading);
    if (known_.contains(point)) continue;
    const double cost = leading.empty() ? 0 : cost_of(point, weights, ranges);
    if (best.empty() || cost < least) best = std::move(point), least = cost;
  }
  return !best.empty() && add(std::move(best));
}

/// Gives how many observations it asks for.
int FrontSearch::propose(int observations) {
  const std::vector<std::vector<std::size_t>> layers = front_.layers(most_seen);
  std::vector<std::size_t> best, leading;
  for (const std::vector<std::size_t>& layer : layers) {
    if (leading.size() < least_leading) leading.insert(leading.end(), layer.begin(), layer.end());
    best.insert(best.end(), layer.begin(), layer.end());
  }
  std::erase_if(leading, [&](std::size_t point) { return front_.known(point).front().count == 0; });
  best.resize(std::min(best.size(), most_seen));
  fit(best);
  const std::vector<Band> ranges = ranges_of(leading);
  int asked = 0;
  while (asked + options_.question.first <= observations && propose_one(leading, ranges))
    asked += options_.question.first;
  return asked;
}

int FrontSearch::resolve(int observations) {
  const std::vector<bool> nearly = front_.nearly_on_front();
  int asked = 0;
  for (; asked < observations; ++asked) {
    std::size_t fewest = nearly.size();
    for (std::size_t i = 0; i < nearly.size(); ++i)
      if (nearly[i] && counts_[i] < options_.most && (fewest == nearly.size() || counts_[i] < counts_[fewest]))
        fewest = i;
    if (fewest == nearly.size()) break;
    ++counts_[fewest];
  }
  return asked;
}

void FrontSearch::request_next_round() {
  for (std::size_t i = 0; i < counts_.size(); ++i)
    if (front_.observations(i) < counts_[i]) return;
  if (points_.empty()) {
    begin();
    return;
  }
  const int of_new = new_points_a_round * options_.question.first;
  const bool is_late = left() <= last_share * options_.budget;
  const int asked = resolve(std::min(left(), is_late ? of_new : of_new / 2));
  if (!is_late || asked == 0) propose(std::min(left(), of_new));
}

}  // namespace vibrosow
