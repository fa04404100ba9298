#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace vibrosow {

/// What a quantity measures. Each has one SI unit, in which `parse_quantity` answers.
enum class Dimension {
  length,     // m
  time,       // s
  frequency,  // Hz; rpm is 1/60 Hz; rad/s is refused
  mass,       // kg
  mass_rate,  // kg/s
  speed,      // m/s
  angle,      // rad
  density,    // kg/m3
  fraction,   // 1; "70 %" is 0.7
  force,      // N
  pressure,   // Pa, also an elastic modulus
  rate,       // 1/s, of decay or growth: no turns, no cycles, so Hz is refused
};

/// A quantity that cannot be read; the message names the text, and what would be right.
class UnitError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads "8 mm", "9 Hz", "70 %" into SI. The number must be finite and written as in TOML (no thousands sign), the unit
/// is required and must be one unit expression of the wanted dimension: throws UnitError otherwise.
double parse_quantity(std::string_view text, Dimension dimension);

/// The SI unit's usual short name: "m", "Hz", "kg/s", ...
std::string_view si_unit(Dimension dimension);

/// What a message says is expected: "a length such as \"8 mm\"".
std::string_view expected(Dimension dimension);

/// Size of one `unit` in SI: unit_size("mm", Dimension::length) is 0.001. Throws UnitError like parse_quantity.
double unit_size(std::string_view unit, Dimension dimension);

}  // namespace vibrosow
