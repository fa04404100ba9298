#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "outflow/outflow.hpp"
#include "outflow/statistics.hpp"

namespace vibrosow {

/// What figures are taken from: a run; or of replicates the first, with what the seeds of all say of the holes.
struct MetricSource {
  const Outflow& outflow;
  std::optional<double> raw_cv{};          // of the seeds of all; none for a run alone
  std::optional<Unevenness> unevenness{};  // likewise
};

/// A number that a run gives. The one place that says what it is called, in which unit it is stated and how it is
/// taken: tables, CSV files and their documentation ask here.
struct Metric {
  std::string_view name;                             // of its column, with its unit: "rate_g_per_s"
  std::string_view heading;                          // of its column on a screen: "g/s"
  std::string_view unit;                             // "g/s"; empty for a plain number
  double unit_size;                                  // of that unit, in SI
  std::string_view description;                      // a clause without a full stop
  std::optional<double> (*of)(const MetricSource&);  // SI; none where it is undefined
  enum class Kind {
    mean,    // of replicates: their mean with its interval
    rate,    // the same, of seeds that were counted, so that a run gives it to one of them
    pooled,  // of replicates: taken once from the seeds of all together
  };
  Kind kind = Kind::mean;
  bool is_pooled() const { return kind == Kind::pooled; }
};

/// All figures of a run, in the order of sweep.csv.
std::span<const Metric> metrics();

/// The figure of a name; throws std::invalid_argument for a name that is none.
const Metric& metric_named(std::string_view name);

/// Every figure over the finished replicates of a scene: its mean with Student's t interval over those that have a
/// finite value, in SI. None where no replicate has one.
class MetricMeans {
 public:
  MetricMeans() = default;
  explicit MetricMeans(const std::vector<const Outflow*>& replicates);
  /// Throws std::invalid_argument for a name that is no figure.
  const std::optional<MeanWithInterval>& operator[](std::string_view name) const { return (*this)[metric_named(name)]; }
  const std::optional<MeanWithInterval>& operator[](const Metric& metric) const;

 private:
  std::vector<std::optional<MeanWithInterval>> means_ = std::vector<std::optional<MeanWithInterval>>(metrics().size());
};

}  // namespace vibrosow
