#pragma once

#include <string>
#include <string_view>

#include "outflow/evenness.hpp"

namespace vibrosow {

inline constexpr std::size_t terminal_columns = 80;

/// Text in lines of at most 80 columns, cut at spaces, each indented by `indent` spaces and ended. Only a word that is
/// longer stands out.
std::string wrapped(std::string_view text, std::size_t indent = 0);

/// The same beside a label: the first line begins with it, the others are indented as far.
std::string wrapped_beside(std::string_view label, std::string_view text);

/// `value` to so many significant digits, with an exponent only beyond a million: "11110", not "1.111e+04".
std::string to_digits(double value, int digits);

/// What is known of how far holes or rows differ: "between holes: CV 12.1 %, 95 % interval 9.3 to 16 % (..)".
std::string evenness_sentence(const Evenness& even, std::string_view between);

}  // namespace vibrosow
