#include "units/quantity.hpp"

#include <fmt/core.h>
#include <udunits2.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <system_error>

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
  static constexpr DimensionFacts mass_per_area{"kg/m2", "a mass per area such as \"180 kg/ha\""};
  static constexpr DimensionFacts number_per_area{"1/m2", "a number per area such as \"280 1/m2\""};
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
    case Dimension::mass_per_area:
      return mass_per_area;
    case Dimension::number_per_area:
      return number_per_area;
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
    errno = 0;
    system_.reset(ut_read_xml(nullptr));
    if (!system_) fail();
  }

  [[noreturn]] static void fail() {
    constexpr const char* variable = "UDUNITS2_XML_PATH";
    const char* const path = std::getenv(variable);
    const std::string given = path != nullptr ? fmt::format(", {} = {}", variable, path) : "";
    throw std::system_error(errno != 0 ? errno : EINVAL, std::generic_category(),
                            fmt::format("the unit database of udunits2 cannot be read{}", given));
  }

  Unit parse(const std::string& text) { return Unit(ut_parse(system_.get(), text.c_str(), UT_UTF8), ut_free); }

  std::mutex mutex_;
  std::unique_ptr<ut_system, decltype(&ut_free_system)> system_{nullptr, ut_free_system};
};

constexpr std::size_t longest_unit = 60;  // characters; udunits2's parser is not asked about longer ones

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Length of the letters (A to Z, a to z, µ) that `text` begins with, in bytes.
std::size_t letters(std::string_view text) {
  constexpr std::string_view micro = "µ";
  std::size_t length = 0;
  while (length < text.size()) {
    const char c = text[length];
    if ((c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z')) {
      ++length;
    } else if (text.substr(length).starts_with(micro)) {
      length += micro.size();
    } else {
      break;
    }
  }
  return length;
}

/// One unit expression: names with an exponent straight after them, joined by / or *. Nothing that udunits2
/// would calculate with: no leading number, no space, no minus, no offset.
bool is_plain_unit(std::string_view unit) {
  if (unit == "%" || unit == "°") return true;
  if (unit.size() > longest_unit) return false;
  for (;;) {
    const std::size_t name = letters(unit);
    if (name == 0) return false;
    unit.remove_prefix(name);
    if (unit.starts_with('^') && (unit.size() < 2 || !is_digit(unit[1]))) return false;
    if (unit.starts_with('^')) unit.remove_prefix(1);
    if (!unit.empty() && unit[0] >= '1' && unit[0] <= '9') unit.remove_prefix(1);
    if (unit.empty()) return true;
    if (unit[0] != '/' && unit[0] != '*') return false;
    unit.remove_prefix(1);
  }
}

bool is_one_of(std::string_view unit, std::initializer_list<std::string_view> units) {
  return std::find(units.begin(), units.end(), unit) != units.end();
}

// udunits2 takes an angle for a plain number, so a name decides where an angle could slip in: rad/s is no
// frequency.
bool names_the_dimension(std::string_view unit, Dimension dimension) {
  switch (dimension) {
    case Dimension::frequency:
      return is_one_of(unit, {"Hz", "kHz", "rpm"});
    case Dimension::angle:
      return is_one_of(unit, {"rad", "mrad", "radian", "radians", "deg", "degree", "degrees", "°"});
    case Dimension::fraction:
      return unit == "%";
    case Dimension::rate:
      return is_one_of(unit, {"1/s", "1/ms"});
    case Dimension::number_per_area:
      return is_one_of(unit, {"1/m2", "1/ha"});
    case Dimension::mass_per_area:
      return is_one_of(unit, {"kg/ha", "g/ha", "kg/m2", "g/m2"});
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

/// `text` for a message, cut where it is long.
std::string shown(std::string_view text) {
  constexpr std::size_t longest = 60;
  return text.size() <= longest ? std::string(text) : fmt::format("{}...", text.substr(0, longest));
}

UnitSize find_unit(const std::string& unit, Dimension dimension) {
  const bool of_a_number = dimension == Dimension::rate || dimension == Dimension::number_per_area;
  const bool reciprocal = of_a_number && names_the_dimension(unit, dimension);
  if (!reciprocal && !is_plain_unit(unit)) {
    throw UnitError(fmt::format("\"{}\" is not a plain unit", shown(unit)));
  }
  if (unit == "rpm" && dimension == Dimension::frequency) return {1, 60};  // udunits2 counts radians: 0.105/s
  const double size =
      names_the_dimension(unit, dimension)
          ? UnitSystem::instance().size(unit == "deg" ? "degree" : unit, std::string(si_unit(dimension)))
          : std::nan("");
  if (!(size > 0)) {
    throw UnitError(fmt::format("wrong unit \"{}\"", unit));
  }
  return exact_size(size);
}

/// A finite number written as in TOML.
double parse_number(std::string_view number) {
  if (number.starts_with('+')) number.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || end != number.data() + number.size() || !std::isfinite(value)) {
    throw UnitError("is too large or too small a number");
  }
  return value;
}

/// "4,0 mm" is nearly right.
void reject_decimal_comma(std::string_view number, std::string_view rest) {
  if (rest.size() < 2 || rest[0] != ',' || !is_digit(rest[1])) return;
  throw UnitError(fmt::format("has a decimal comma; write a decimal point: \"{}.{}\"", number, shown(rest.substr(1))));
}

}  // namespace

std::size_t number_length(std::string_view text) {
  std::size_t at = text.starts_with('+') || text.starts_with('-') ? 1 : 0;
  const auto digits = [&](std::size_t from) {
    std::size_t end = from;
    while (end < text.size() && is_digit(text[end])) ++end;
    return end - from;
  };
  const std::size_t whole = at < text.size() && text[at] == '0' ? 1 : digits(at);
  if (whole == 0) return 0;
  at += whole;
  if (at < text.size() && text[at] == '.' && digits(at + 1) > 0) at += 1 + digits(at + 1);
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    const std::size_t sign = at + 1 < text.size() && (text[at + 1] == '+' || text[at + 1] == '-') ? 1 : 0;
    if (digits(at + 1 + sign) > 0) at += 1 + sign + digits(at + 1 + sign);
  }
  return at;
}

Quantity split_quantity(std::string_view text) {
  const std::string_view number = text.substr(0, number_length(text));
  if (number.empty()) throw UnitError("does not start with a number");
  std::string_view rest = text.substr(number.size());
  reject_decimal_comma(number, rest);
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  return {parse_number(number), std::string(rest)};
}

double in_si(const Quantity& quantity, Dimension dimension) {
  if (quantity.unit.empty()) throw UnitError("has no unit");
  const UnitSize size = find_unit(quantity.unit, dimension);
  const double value = quantity.number * size.times / size.over;
  if (!std::isfinite(value)) throw UnitError("is too large");
  return value;
}

double parse_quantity(std::string_view text, Dimension dimension) {
  try {
    return in_si(split_quantity(text), dimension);
  } catch (const UnitError& error) {
    throw UnitError(fmt::format("\"{}\": {}; expected {}", shown(text), error.what(), expected(dimension)));
  }
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
