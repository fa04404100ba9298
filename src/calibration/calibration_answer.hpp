#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "outflow/doubts.hpp"

namespace vibrosow {

enum class RangeEdge { none, lower, upper };
/// "lower" or "upper"; empty for none.
std::string name_of(RangeEdge edge);

/// A fitted key, or the depth factor, with what is known of it.
struct FittedNumber {
  std::string name, unit;           // of the key's column
  std::optional<double> low, high;  // of the prior; none: anywhere
  FittedValue value;
  RangeEdge edge = RangeEdge::none;  // that its interval touches, where the table says something of it
  std::vector<std::string> not_told_apart_from{};
};

/// What a calibration says, and what speaks against it. Refers to what it is of.
struct CalibrationAnswer {
  const CalibrationTask& task;
  const CalibrationDesign& design;
  const std::vector<ReducedRun>& runs;
  const Calibration& calibration;
  std::vector<FittedNumber> numbers{};  // the keys, then the depth factor: what a FittedPair counts
  std::size_t runs_used = 0;
  std::vector<SharedDoubt> doubts{};    // serious ones first
  bool is_fitted = true;                // false: the best point misses the table by more than three times its noise
  bool lots_have_own_contacts = false;  // several lots, each with the model of its crop: no one file holds them
  bool gives_a_contact = true;          // a contact model may be made of it: no doubt about it would go on in that
};

/// Name of the depth factor, where it is fitted.
inline constexpr const char* depth_factor_name = "depth_factor";

CalibrationAnswer answer_of(const CalibrationTask& task, const CalibrationDesign& design,
                            const std::vector<ReducedRun>& runs, const Calibration& calibration);

}  // namespace vibrosow
