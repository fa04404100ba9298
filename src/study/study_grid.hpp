#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "input/override.hpp"
#include "input/table.hpp"
#include "units/quantity.hpp"

namespace vibrosow {

inline constexpr std::size_t most_layouts = 100000;

/// Changes that one point of a grid, or one named design, makes.
using Changes = std::vector<Override>;

/// A number as a study writes it: with the unit of the key's column, or plain. Throws std::invalid_argument for what is
/// no number, or has a unit where the key has none.
Quantity quantity_of(const std::string& key, const TomlValue& value);

/// In SI, or the plain number of a key without a unit. Throws UnitError for a unit that does not fit the key.
double value_of(const std::string& key, const Quantity& quantity);

/// Values of {from, to, step}, both ends included, in the unit of `from`. Throws std::invalid_argument or UnitError
/// with what is wrong: a step of zero or the wrong sign, one that does not hit `to`, a unit that does not fit the key.
std::vector<TomlValue> range_values(const std::string& key, const TomlValue& from, const TomlValue& to,
                                    const TomlValue& step);

/// The full grid of a [vary] table, first key slowest. Throws InputError.
std::vector<Changes> read_grid(Table& vary);

/// The space that a [vary] table spans, one axis a key: a list or a range with a step has its values, a range of whole
/// numbers each of them, any other range without a step a continuum.
class VariedSpace {
 public:
  /// How many values a continuum counts for.
  static constexpr std::size_t parts_of_a_continuum = 1000;

  /// Throws InputError.
  explicit VariedSpace(Table& vary);

  std::size_t axes() const { return keys_.size(); }
  /// The key of each axis.
  std::vector<std::string> names() const;
  /// How many values each axis has.
  const std::vector<std::size_t>& values() const { return values_; }
  /// `point`: of each axis the share of the way through its values, in [0, 1).
  Changes at(const std::vector<double>& point) const;

 private:
  std::vector<Override> keys_;
  std::vector<std::function<TomlValue(double share)>> value_at_;
  std::vector<std::size_t> values_;
};

/// Points of the space that a [vary] table spans, a Latin hypercube: each key's values, or equal parts of a range
/// without a step, come equally often. The same file gives the same points. Throws InputError.
std::vector<Changes> read_proposals(Table& vary, std::size_t points);

}  // namespace vibrosow
