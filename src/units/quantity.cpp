#include "units/quantity.hpp"

#include <fmt/core.h>
#include <udunits2.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <regex>

namespace vibrosow {
namespace {

struct DimensionFacts {
  std::string_view si;  // for people and for udunits2
  std::string_view expected;
};

const DimensionFacts& facts(Dimension dimension) {
  static constexpr DimensionFacts length{"m", "a length such as \"8 mm\""};
  static constexpr DimensionFacts time{"s", "a time such as \"10 s\""};
  static constexpr DimensionFacts frequency{"Hz", "a frequency in Hz, kHz or rpm such as \"9 Hz\""};
  static constexpr DimensionFacts mass{"kg", "a mass such as \"0.2 g\""};
  static constexpr DimensionFacts mass_rate{"kg/s", "a mass per time such as \"3 g/s\""};
  static constexpr DimensionFacts speed{"m/s", "a speed such as \"20 mm/s\""};
  static constexpr DimensionFacts angle{"rad", "an angle in degree or rad such as \"10 degree\""};
  static constexpr DimensionFacts density{"kg/m3", "a density such as \"1300 kg/m3\""};
  static constexpr DimensionFacts force{"N", "a force such as \"0.2 mN\""};
  static constexpr DimensionFacts pressure{"Pa", "a pressure such as \"5e4 MPa\""};
  static constexpr DimensionFacts rate{"1/s", "a rate such as \"2.1e4 1/s\""};
  static constexpr DimensionFacts fraction{"1", "a fraction in % such as \"70 %\""};
  switch (dimension) {
    case Dimension::length:
      return length;
    case Dimension::time:
      return time;
    case Dimension::frequency:
      return frequency;
    case Dimension::mass:
      return mass;
    case Dimension::mass_rate:
      return mass_rate;
    case Dimension::speed:
      return speed;
    case Dimension::angle:
      return angle;
    case Dimension::density:
      return density;
    case Dimension::force:
      return force;
    case Dimension::pressure:
      return pressure;
    case Dimension::rate:
      return rate;
    case Dimension::fraction:
      break;
  }
  return fraction;
}

using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;
using Converter = std::unique_ptr<cv_converter, decltype(&cv_free)>;

/// The one udunits2 system of the program. Its parser keeps global state, so all use is under one mutex.
class UnitSystem {
 public:
  static UnitSystem& instance() {
    static UnitSystem system;
    return system;
  }

  /// Size of `unit` in `si`, or NaN when it is unknown or measures something else.
  double size(const std::string& unit, const std::string& si) {
    const std::lock_guard lock(mutex_);
    const Unit wanted = parse(si);
    const Unit given = parse(unit);
    if (!wanted || !given) return std::nan("");
    // A ratio, because ut_are_convertible alone also calls a unit and its reciprocal convertible: 5 Hz would
    // be 0.2 s.
    const Unit ratio(ut_divide(given.get(), wanted.get()), ut_free);
    const Unit one(ut_get_dimensionless_unit_one(system_.get()), ut_free);
    if (!ratio || ut_are_convertible(ratio.get(), one.get()) == 0) return std::nan("");
    const Converter converter(ut_get_converter(ratio.get(), one.get()), cv_free);
    return converter ? cv_convert_double(converter.get(), 1.0) : std::nan("");
  }

 private:
  UnitSystem() {
    ut_set_error_message_handler(ut_ignore);
    system_.reset(ut_read_xml(nullptr));
    if (!system_) throw std::runtime_error("the unit database of udunits2 cannot be read");
  }

  Unit parse(const std::string& text) { return Unit(ut_parse(system_.get(), text.c_str(), UT_UTF8), ut_free); }

  std::mutex mutex_;
  std::unique_ptr<ut_system, decltype(&ut_free_system)> system_{nullptr, ut_free_system};
};

// One unit expression: names with an exponent straight after them, joined by / or *. Nothing that udunits2
// would calculate with: no leading number, no space, no minus, no offset.
const std::regex& plain_unit() {
  static const std::regex pattern(R"((?:[A-Za-z]|µ)+(?:\^?[1-9])?(?:[/*](?:[A-Za-z]|µ)+(?:\^?[1-9])?)*|%|°)");
  return pattern;
}

// udunits2 takes an angle for a plain number, so a name decides where an angle could slip in: rad/s is no
// frequency.
bool names_the_dimension(const std::string& unit, Dimension dimension) {
  static const std::regex frequency("k?Hz|rpm"), angle("m?rad|radians?|degrees?|°"), fraction("%"), rate("1/m?s");
  switch (dimension) {
    case Dimension::frequency:
      return std::regex_match(unit, frequency);
    case Dimension::angle:
      return std::regex_match(unit, angle);
    case Dimension::fraction:
      return std::regex_match(unit, fraction);
    case Dimension::rate:
      return std::regex_match(unit, rate);
    default:
      return unit != "d";  // a day to udunits2, a diameter to most who would write it here
  }
}

/// A unit as a fraction of integers where it is one, so that "8 mm" is exactly 8/1000.
struct UnitSize {
  double times = 1, over = 1;
};

UnitSize exact_size(double size) {
  const auto near_integer = [](double value) {
    return value >= 1 && value < 1e15 && std::abs(value - std::round(value)) <= 1e-12 * value;
  };
  if (near_integer(size)) return {std::round(size), 1};
  if (near_integer(1 / size)) return {1, std::round(1 / size)};
  return {size, 1};
}

UnitSize find_unit(const std::string& unit, Dimension dimension) {
  const bool reciprocal = dimension == Dimension::rate && names_the_dimension(unit, dimension);
  if (!reciprocal && !std::regex_match(unit, plain_unit())) {
    throw UnitError(fmt::format("\"{}\" is not a plain unit; expected {}", unit, expected(dimension)));
  }
  if (unit == "rpm" && dimension == Dimension::frequency) return {1, 60};  // udunits2 counts radians: 0.105/s
  const double size = names_the_dimension(unit, dimension)
                          ? UnitSystem::instance().size(unit, std::string(si_unit(dimension)))
                          : std::nan("");
  if (!(size > 0)) {
    throw UnitError(fmt::format("wrong unit \"{}\"; expected {}", unit, expected(dimension)));
  }
  return exact_size(size);
}

/// A finite number written as in TOML.
double parse_number(std::string_view text, std::string_view quantity, Dimension dimension) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    throw UnitError(
        fmt::format("\"{}\" is too large or too small a number; expected {}", quantity, expected(dimension)));
  }
  return value;
}

}  // namespace

double parse_quantity(std::string_view text, Dimension dimension) {
  static const std::regex number_then_unit(R"(([+-]?(?:0|[1-9][0-9]*)(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?)( *)(.*))");
  const std::string whole(text);
  std::smatch part;
  if (!std::regex_match(whole, part, number_then_unit)) {
    throw UnitError(fmt::format("\"{}\" does not start with a number; expected {}", whole, expected(dimension)));
  }
  const std::string unit = part[3];
  if (unit.empty()) throw UnitError(fmt::format("\"{}\" has no unit; expected {}", whole, expected(dimension)));
  const double number = parse_number(part[1].str(), whole, dimension);
  UnitSize size;
  try {
    size = find_unit(unit, dimension);
  } catch (const UnitError& error) {
    throw UnitError(fmt::format("\"{}\": {}", whole, error.what()));
  }
  const double value = number * size.times / size.over;
  if (!std::isfinite(value)) {
    throw UnitError(fmt::format("\"{}\" is too large; expected {}", whole, expected(dimension)));
  }
  return value;
}

std::string_view si_unit(Dimension dimension) {
  return facts(dimension).si;
}

std::string_view expected(Dimension dimension) {
  return facts(dimension).expected;
}

double unit_size(std::string_view unit, Dimension dimension) {
  const UnitSize size = find_unit(std::string(unit), dimension);
  return size.times / size.over;
}

}  // namespace vibrosow
