#pragma once

#include <optional>
#include <vector>

namespace vibrosow {

// All four take one simulated for each measured value, in the same unit. None when there are no values, one
// of them is not a finite number, or the result is undefined (a measured rate of zero; nothing simulated to
// scale; a measured curve that never leaves zero). Throws std::invalid_argument for different lengths.

/// 100 RMS((sim scale - meas) / meas) over rows of rates.
std::optional<double> rate_misfit_percent(const std::vector<double>& simulated, const std::vector<double>& measured,
                                          double scale = 1);

/// The scale that makes `rate_misfit_percent` least: sum(a) / sum(a^2) with a = sim / meas.
std::optional<double> best_rate_scale(const std::vector<double>& simulated, const std::vector<double>& measured);

/// 100 RMS(sim scale - meas) / max(meas) over the times of a curve.
std::optional<double> curve_misfit_percent(const std::vector<double>& simulated, const std::vector<double>& measured,
                                           double scale = 1);

/// The scale that makes `curve_misfit_percent` least: sum(sim meas) / sum(sim^2).
std::optional<double> best_curve_scale(const std::vector<double>& simulated, const std::vector<double>& measured);

}  // namespace vibrosow
