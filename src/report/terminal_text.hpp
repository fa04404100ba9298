#pragma once

#include <string>
#include <string_view>

#include "outflow/unevenness.hpp"
#include "scene/measuring_window.hpp"

namespace vibrosow {

inline constexpr std::size_t terminal_columns = 80;

/// Text in lines of at most 80 columns, cut at spaces, each indented by `indent` spaces and ended. Only a word that is
/// longer stands out.
std::string wrapped(std::string_view text, std::size_t indent = 0);

/// The same beside a label: the first line begins with it, the others are indented as far.
std::string wrapped_beside(std::string_view label, std::string_view text);

/// `value` to so many significant digits, with an exponent only beyond a million: "11110", not "1.111e+04".
std::string to_digits(double value, int digits);

/// A fraction in percent to two significant digits, without the sign: "4.6".
std::string two_digit_percent(double fraction);

/// What stands beside every rate of the whole tray and of the ground: how the plane comes to it; empty in 3D.
std::string_view of_plane(Space space);

/// "12 % (9.3 to 16 %)", or "up to 8 %, if any".
std::string unevenness_text(const Unevenness& unevenness);

/// The same of one run; `what`: "hole" or "row".
std::string unevenness_sentence(const Unevenness& unevenness, std::string_view what);

/// What a run is measured over, beside what was written: "measured from 1.06 s (not from 1 s) to 4 s: 27 whole periods
/// of the drive".
std::string window_sentence(const MeasuringWindow& window, double written_from);

}  // namespace vibrosow
