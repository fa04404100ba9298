#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace vibrosow {

/// A distance between two seeds of a row that follow each other, and what it should be; m.
struct Spacing {
  double length, reference;
};

/// Which of them are too short and too long, in parts of the reference (ISO 7256-1:1984: 0.5 and 1.5).
struct SpacingLimits {
  double multiples_below = 0.5;
  double skips_above = 1.5;
  bool operator==(const SpacingLimits&) const = default;
};

/// How evenly seeds follow each other, as a single seed drill is judged (ISO 7256-1:1984; Kachman and Smith 1995,
/// Trans. ASAE 38(2):379): here at the hole, not in the furrow, where fall, tube and soil have scattered them.
struct SpacingMetrics {
  std::int64_t spacings = 0;
  double mean = 0;                  // m, of the spacings
  double reference = 0;             // m, mean of the references
  double multiples = 0;             // fraction of spacings up to `multiples_below`: index of multiples
  double skips = 0;                 // fraction beyond `skips_above`: miss index
  double singles = 0;               // fraction of the others: quality of feed
  double deviation = 0;             // m, mean distance from the reference, without sign
  std::optional<double> precision;  // standard deviation of the others, in parts of the reference; none for one
  std::optional<double> cv;         // of all spacings, in parts of their reference; none for one
};

/// None without a spacing. Throws std::invalid_argument for a reference that is not positive, or limits that are not
/// in order.
std::optional<SpacingMetrics> spacing_metrics(const std::vector<Spacing>& spacings, const SpacingLimits& limits = {});

/// The distances over ground of seeds that pass at these times (s, ascending) at a speed (m/s), each beside
/// `reference` (m), or where that is none beside their mean. Empty for fewer than two seeds, or where all come at once.
std::vector<Spacing> spacings_of(const std::vector<double>& times, double speed, std::optional<double> reference = {});

/// Multiples and skips of seeds that come independently of each other, a Poisson stream, whose spacings are
/// exponential: beside their mean 1 - exp(-0.5) = 39 % and exp(-1.5) = 22 %. `reference`: over their mean.
double poisson_multiples(const SpacingLimits& limits = {}, double reference = 1);
double poisson_skips(const SpacingLimits& limits = {}, double reference = 1);

}  // namespace vibrosow
