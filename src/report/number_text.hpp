#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vibrosow {

// Numbers as people read them, the same on a terminal as in the pages (web/report/format.mjs,
// tests/report/numbers.json).

/// `value` to so many significant digits, from ten thousand on with its thousands apart, without an exponent below a
/// trillion: "0.0457", "12 300". "-" for what is not a number.
std::string number_text(double value, int digits = 3);

/// "19.2 +- 3.8", "12 350 +- 250": the half width to two digits, and the mean to the same place. Without one: the mean
/// to three digits.
std::string interval_text(double mean, const std::optional<double>& half_width, std::string_view plus_minus = "+-");

/// A large count to three digits: "92 900", "18.6 million", "1.2 billion".
std::string count_text(double count);

/// Seconds in the unit that suits them: "35 µs", "4.2 ms", "1.5 s".
std::string time_text(double seconds);

}  // namespace vibrosow
