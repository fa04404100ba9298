#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace vibrosow {

/// What a quantity measures. Each has one SI unit, in which `parse_quantity` answers.
enum class Dimension {
  length,           // m
  time,             // s
  frequency,        // Hz; rpm is 1/60 Hz; rad/s is refused
  mass,             // kg
  mass_rate,        // kg/s
  speed,            // m/s
  angle,            // rad
  density,          // kg/m3
  fraction,         // 1; "70 %" is 0.7
  force,            // N
  pressure,         // Pa, also an elastic modulus
  rate,             // 1/s, of decay or growth: no turns, no cycles, so Hz is refused
  mass_per_area,    // kg/m2; "180 kg/ha" is 0.018
  number_per_area,  // 1/m2, of seeds or plants; also 1/ha
};

/// A quantity that cannot be read; the message names the text, and what would be right.
class UnitError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A number and its unit as written: "8 mm" is 8 and "mm".
struct Quantity {
  double number = 0;
  std::string unit;  // "": a plain number
  bool operator==(const Quantity&) const = default;
};

/// How many characters at the front of `text` are a number as TOML writes it (a sign, no leading zero, digits on both
/// sides of a decimal point); 0: none.
std::size_t number_length(std::string_view text);

/// Number and unit of a text; the unit may be empty or wrong. Throws UnitError where the text does not begin with a
/// number, the number is not finite, or a decimal comma follows; the message begins after the text: "does not ..".
Quantity split_quantity(std::string_view text);

/// In SI. The unit must be one unit expression of the wanted dimension: throws UnitError otherwise.
double in_si(const Quantity& quantity, Dimension dimension);

/// Reads "8 mm", "9 Hz", "70 %" into SI. The number must be finite and written as in TOML (no thousands sign), the unit
/// is required and must be one unit expression of the wanted dimension: throws UnitError otherwise. Like every function
/// here that asks for a unit it throws std::system_error when udunits2 cannot read its database.
double parse_quantity(std::string_view text, Dimension dimension);

/// The SI unit's usual short name: "m", "Hz", "kg/s", ...
std::string_view si_unit(Dimension dimension);

/// What a message says is expected: "a length such as \"8 mm\"".
std::string_view expected(Dimension dimension);

/// Size of one `unit` in SI: unit_size("mm", Dimension::length) is 0.001. Throws UnitError like parse_quantity.
double unit_size(std::string_view unit, Dimension dimension);

}  // namespace vibrosow
