#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "agronomy/seed_contact.hpp"

namespace vibrosow {

/// A round hole in the thin floor of a tray that is shaken to and fro, in units of which the seeds' size falls out: d
/// is the diameter of the ball of a seed's volume.
struct HoleConditions {
  double aspect = 1;      // how many times a seed is as long as wide
  double width = 0;       // of the hole, over d
  double peak_speed = 0;  // of the tray, over sqrt(g d)
  double depth = 0;       // of the bed, over d
};

/// What runs of one hole under such conditions gave; times in sqrt(d / g).
struct HoleRecord {
  HoleConditions at;
  double amplitude = 0;  // of the tray, over d
  SeedContact contact;
  int runs = 0;
  double seeds = 0;                  // counted, of all runs and their holes
  double outflow = 0;                // seeds of a hole in sqrt(d / g)
  double half_width_95 = 0;          // of its 95 % interval
  std::optional<double> dispersion;  // of a hole's counts: variance over mean, 1 where seeds come at random
  double longest_pause = 0;          // of any of the holes
  double stood_still = 0;            // share of the holes that once let nothing through for `long_pause`
  double watched = 0;                // of all holes together
};

/// What `HoleRecord::stood_still` calls standing still, sqrt(d / g).
inline constexpr double long_pause = 10;

/// From the least to the most; both ends belong to it.
struct Span {
  double least = 0, most = 0;
  bool holds(double value) const { return value >= least && value <= most; }
  double nearest(double value) const { return std::clamp(value, least, most); }
  Span with(double value) const { return {std::min(least, value), std::max(most, value)}; }
};

/// An outflow between the table's places; what was seen of the holes is of the worst of the places around.
struct HoleEstimate {
  double outflow = 0;                // seeds of a hole in sqrt(d / g)
  double chance = 0;                 // half width of its 95 % interval over it, from those of the places around
  double stood_still = 0;            // share of the holes
  double watched = 0;                // of all holes together, sqrt(d / g)
  std::optional<double> dispersion;  // of a hole's counts
};

/// Outflow of one hole, looked up: of balls (aspect 1) on one grid of widths, speeds and depths, of longer seeds on
/// grids of their own, which may be coarser and end earlier. Between the places of the grid of balls outflow^(2/5) is
/// linear in the width (Beverloo et al. 1961: the outflow goes as (width - k d)^(5/2)), in the logarithm of the speed
/// and in the depth. Longer seeds let through a factor of what balls do, whose logarithm is linear in the same, and in
/// the aspect between two shapes. Nothing is told of what lies outside.
class HoleTable {
 public:
  /// Throws std::invalid_argument without balls, where a shape's places are no whole grid of at least two widths,
  /// speeds and depths within that of balls, an outflow is not positive, or amplitudes or contacts differ.
  explicit HoleTable(std::vector<HoleRecord> records);

  const std::vector<HoleRecord>& records() const { return records_; }
  /// Of the table's seeds.
  Span aspects() const;
  /// Where the table tells of seeds of this aspect, which it has; throws std::invalid_argument for one that it has not.
  Span widths(double aspect) const { return span(aspect, 0); }
  Span peak_speeds(double aspect) const { return span(aspect, 1); }
  Span depths(double aspect) const { return span(aspect, 2); }
  /// Speeds within `limits` between which the outflow of such seeds bends nowhere, ascending; those limits that the
  /// table has are among them.
  std::vector<double> speed_steps(double aspect, const Span& limits) const;
  /// Of the tray, over d: the same in all records.
  double amplitude() const { return records_.front().amplitude; }
  /// Of its seeds: the same in all records.
  const SeedContact& contact() const { return records_.front().contact; }

  /// The table of seeds whose every outflow is so many times as much.
  HoleTable times(const ContactFactor& factor) const;
  /// What it was multiplied by in all.
  const ContactFactor& multiplied_by() const { return multiplied_by_; }

  /// None outside the table.
  std::optional<HoleEstimate> at(const HoleConditions& conditions) const;
  /// The peak speed from `from` to `to`, between which the outflow passes this one, at which it is this one. Of
  /// `conditions` the others count; they lie within the table.
  double peak_speed_giving(double outflow, HoleConditions conditions, double from, double to) const;

  /// By how much the logarithm of the outflow grows with that of the width and of the peak speed, over a hundredth to
  /// either side as far as the table goes. The conditions lie within it.
  struct Slopes {
    double width, peak_speed;
  };
  Slopes slopes(const HoleConditions& conditions) const;

  /// By how much the factor between longer seeds and balls varies from setting to setting of one hole: standard
  /// deviation of its logarithm over speeds and depths, without what chance makes of it; root mean square over shapes
  /// and widths of `least_width` d and more; 0 of balls alone. It stands for what a seed's error varies by.
  double factor_spread(double least_width) const;

  /// Half width, over the outflow, of the band that holds 95 % of the interpolation's errors for holes of this width
  /// and speed: 1.96 times the root mean square of what is missed, summed over widths, speeds, for longer seeds those
  /// of the factor, and between two shapes the aspect, as independent. What is missed is told by leaving places out,
  /// those of the two widths and speeds around: each is foretold from its two neighbours, and a quarter of the
  /// difference counts, since a bend f'' is missed by f'' h^2 / 2 across two gaps h and by f'' h^2 / 8 at most within
  /// one. An axis of two places tells nothing.
  double interpolation_error(double aspect, double width, double peak_speed) const;

 private:
  struct Grid {
    std::array<std::vector<double>, 3> axes;  // widths, speeds, depths; ascending
    std::vector<std::size_t> records;         // of each place, depth fastest, in `records_`
    std::vector<double> values;               // of each place: of balls outflow^(2/5), else the factor's logarithm
    bool of_balls = true;
    std::size_t place(const std::array<std::size_t, 3>& at) const {
      return (at[0] * axes[1].size() + at[1]) * axes[2].size() + at[2];
    }
  };
  struct Share {
    std::size_t index;  // of a place of a grid, or of a shape
    double weight;      // above 0; those of all sum to 1
  };

  void check() const;
  Grid grid_of(double aspect) const;
  double factor(const HoleRecord& record) const;
  std::vector<Share> shapes_around(double aspect) const;
  Span span(double aspect, std::size_t axis) const;
  void add_balls(const std::vector<Share>& places, double weight, std::vector<double>& slopes) const;
  double chance(const std::vector<double>& slopes) const;
  void allow_for(const Grid& grid, const std::vector<Share>& places, HoleEstimate& estimate) const;
  static std::vector<Share> places_around(const Grid& grid, const HoleConditions& conditions);
  static double value(const Grid& grid, const std::vector<Share>& places);
  static std::vector<double> left_out(const Grid& grid, std::size_t axis, double width, double peak_speed);
  static std::pair<std::size_t, std::size_t> range_around(const std::vector<double>& steps, double value, bool inner);
  std::vector<double> shapes_left_out(double width, double peak_speed) const;
  static std::vector<std::size_t> places_beside(const Grid& grid, double width, double peak_speed);

  std::vector<HoleRecord> records_;
  std::vector<double> shapes_;  // aspects, ascending; the first is that of balls
  std::vector<Grid> grids_;     // of each
  ContactFactor multiplied_by_;
};

}  // namespace vibrosow
