#pragma once

#include <array>
#include <optional>
#include <vector>

namespace vibrosow {

/// Standard deviations of a normal in the half width of its 95 %.
inline constexpr double normal_95 = 1.959964;

/// By how much measured rates differ from rates that were predicted without fitting: ln(measured / predicted) over
/// materials. The error of a new material is Student's t about zero, with as many degrees of freedom as there are
/// materials: a bias is told, not taken out.
struct ModelError {
  double scale = 0;        // root mean square of the logarithms
  int materials = 0;       // 0: the model is taken to be right
  double mean_factor = 1;  // measured over predicted, geometric mean
};

/// Throws std::invalid_argument for none, or one that is not finite.
ModelError model_error(const std::vector<double>& log_ratios);

/// What a predicted rate errs by, in four parts that are independent of each other: standard deviations of
/// ln(true rate / predicted rate). The model's part is Student's and `setting` together, the others are normal.
struct PredictionError {
  double chance = 0;     // so many seeds were counted
  double numerics = 0;   // softness and step; between the places of a table
  double tolerance = 0;  // what is built is not what was drawn
  ModelError model{};    // one of the seed, at all settings alike
  double setting = 0;    // what the model errs by at this setting more or less than at others
};

/// What a predicted rate is multiplied by to have the ends of a range.
struct FactorRange {
  double low = 1, high = 1;
};

/// The range that holds the true rate in 95 % of cases.
FactorRange expected_range(const PredictionError& error);

/// One part alone, as the half width of its 95 %: of the rate itself, (high - low) / 2 of `expected_range`.
double half_width_of_normal(double deviation);
double half_width_of_model(const PredictionError& error);

/// The deviation of a normal whose half width is this: the inverse of `half_width_of_normal`.
double deviation_of_half_width(double half_width);

/// Where a tray is set to: coordinates in which settings one apart in any have nothing in common of what is their own.
using SettingPlace = std::array<double, 3>;

/// What two settings have in common of what is their own: 1 of the same, falling to 0 as between the places of a table
/// that is linear in between.
double common_share(const SettingPlace& a, const SettingPlace& b);

/// A rate that was weighed beside what was predicted at the same setting.
struct Weighing {
  SettingPlace setting{};
  double log_ratio = 0;      // ln(weighed / predicted)
  double deviation = 0;      // of the weighing, of its logarithm
  double own_deviation = 0;  // of the prediction at this setting, from chance and interpolation
};

/// What weighings say of predictions at other settings of the same seed and tray:
///   ln(truth / predicted) = F + s(setting)
/// F is one for the seed and the tray as it is built: the model's error, the tolerance and the numerics; s is the
/// setting's own, normal: `PredictionError::setting`, and chance and interpolation of its prediction; settings near
/// each other have a share of it in common. A weighing adds its own error. Student's t is a normal whose variance is
/// drawn, so all is a mixture of normals.
class WeighedRates {
 public:
  /// `error.chance` is left out: each prediction has its own.
  WeighedRates(const PredictionError& error, std::vector<Weighing> weighings);

  /// The range of a prediction, and its middle (median), as factors of what was predicted. Without a setting: of one
  /// that is far from all that were weighed.
  struct Answer {
    double middle = 1;
    FactorRange range{};
  };
  /// `tolerance`: of holes that are drilled anew, its deviation, in the place of that of the holes that were weighed.
  Answer at(double own_deviation, const std::optional<SettingPlace>& setting = std::nullopt,
            const std::optional<double>& tolerance = std::nullopt) const;

  /// Of each weighing: how likely one so far off, or further, is by all the others; small where it contradicts them.
  std::vector<double> surprise() const;

 private:
  struct Normal {
    double weight, mean, deviation;
  };
  std::vector<Normal> mixture(const std::vector<Weighing>& weighings, double own_deviation,
                              const std::optional<SettingPlace>& setting, const std::optional<double>& tolerance) const;

  double tolerance_, numerics_;    // variances
  std::vector<double> variances_;  // of the model, of equal probability
  double setting_spread_;
  std::vector<Weighing> weighings_;
};

}  // namespace vibrosow
