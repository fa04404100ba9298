#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "units/quantity.hpp"

namespace vibrosow {

// Words for messages about what was read.

/// The nearest of `known` by edit distance (Damerau-Levenshtein) when it is near enough to be meant; else the first
/// that holds the word, or that the word holds ("freq" of "frequency").
std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& known);

/// "; did you mean "width"?", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

/// A text of any length, cut to what a message can hold.
std::string shortened(std::string_view text);

/// An SI value in a unit that people read: "8 mm", "30 degree", else in `unit`, one of the dimension's.
std::string shown(double value, Dimension dimension, const std::string& unit);

}  // namespace vibrosow
