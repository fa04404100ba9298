#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vibrosow {

/// What a quantity measures, and in which trade: a dimension takes the units that are used for it there and no others,
/// though they would convert. Each has one SI unit, in which `parse_quantity` answers.
enum class Dimension {
  length,           // m
  time,             // s
  frequency,        // Hz; rpm is 1/60 Hz; rad/s is refused
  mass,             // kg, of what was weighed
  seed_mass,        // kg, of one seed or a thousand: no grains, ounces or pounds
  mass_rate,        // kg/s
  drag,             // kg/s, force per speed
  speed,            // m/s, of seeds and surfaces
  travel_speed,     // m/s, of a drill
  angle,            // rad
  density,          // kg/m3, of a seed itself: no test weights
  bulk_density,     // kg/m3, of poured seeds; "76 kg/hl" is 760, "60 lb/bu" of a US bushel 772.3
  fraction,         // 1; "70 %" is 0.7
  force,            // N
  pressure,         // Pa, also an elastic modulus
  rate,             // 1/s, of decay or growth: no turns, no cycles, so Hz is refused
  seed_rate,        // 1/s, of seeds
  mass_per_area,    // kg/m2; "180 kg/ha" is 0.018
  seeds_per_area,   // 1/m2
  plants_per_area,  // 1/m2
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

/// Where a tolerance begins, "+-", "±" or "+/-", and how many bytes that takes; npos and 0: nowhere.
std::pair<std::size_t, std::size_t> find_plus_minus(std::string_view text);

/// In SI. The unit must be one of the wanted dimension's: throws UnitError otherwise.
double in_si(const Quantity& quantity, Dimension dimension);

/// Reads "8 mm", "9 Hz", "70 %" into SI. The number must be finite and written as in TOML (no thousands sign), the unit
/// is required and must be one of the wanted dimension's (`units_of`): throws UnitError otherwise, with what is
/// expected and the `example`, if not empty. Superscripts, other spaces and signs are read as what they stand for:
/// "µm", "m³", "kg·m⁻³", "−5 °". Like every function here that asks for a unit it throws std::system_error when
/// udunits2 cannot read its database.
double parse_quantity(std::string_view text, Dimension dimension, std::string_view example = {});

/// Whether a unit as written is one of a dimension's.
bool is_unit_of(const std::string& unit, Dimension dimension);

/// The units that a dimension takes, each in one way of writing it.
std::vector<std::string_view> units_of(Dimension dimension);

/// The SI unit's usual short name: "m", "Hz", "kg/s", ...
std::string_view si_unit(Dimension dimension);

/// What a message says is expected: "a length such as \"8 mm\"", with an example of its own where that is not empty.
std::string expected(Dimension dimension, std::string_view example = {});

/// Size of one `unit` in SI: unit_size("mm", Dimension::length) is 0.001. Throws UnitError like parse_quantity.
double unit_size(std::string_view unit, Dimension dimension);

}  // namespace vibrosow
