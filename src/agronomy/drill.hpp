#pragma once

#include <optional>
#include <vector>

#include "agronomy/sowing_rate.hpp"
#include "agronomy/spacings.hpp"

namespace vibrosow {

/// What a tray's holes sow: the rows that they feed, and how fast. It changes no run; it is what a run is read for.
struct Drill {
  RowPace pace;
  std::vector<int> hole_to_row;  // of each hole of the tray the row it feeds, 1..; of one that feeds several, the first
  int rows_per_hole = 1;         // neighbouring rows that share what a hole gives, taken as equal parts
  std::optional<double> reference_spacing{};  // m, of seeds in a row; none: the row's own mean
  SpacingLimits limits{};
  double cv_limit = 0.05;  // between rows, up to which a setting is one to sow with
  bool operator==(const Drill&) const = default;

  /// How many rows have a stream of seeds of their own: those that share a hole have one between them.
  int streams() const;
  int rows() const { return streams() * rows_per_hole; }
  /// The stream of a hole, 0.. ; both count from 0.
  std::size_t stream_of(std::size_t hole) const;
};

}  // namespace vibrosow
