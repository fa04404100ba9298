#include "units/quantity.hpp"

#include <fmt/core.h>
#include <udunits2.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <mutex>
#include <span>
#include <system_error>

namespace vibrosow {
namespace {

/// A unit as people write it, after `canonical`, and as udunits2 knows it where that differs.
struct NamedUnit {
  std::string_view name, meaning = {};
};
using Units = std::span<const NamedUnit>;

// What the trade writes. A US bushel and an international acre in SI, since udunits2 has neither exactly.
constexpr NamedUnit length_units[] = {{"mm"},   {"cm"},     {"m"},          {"dm"}, {"um"},   {"micron"}, {"in"},
                                      {"inch"}, {"inches"}, {"\"", "inch"}, {"ft"}, {"foot"}, {"feet"},   {"microns"}};
constexpr NamedUnit time_units[] = {{"s"},      {"ms"},      {"us"},   {"ns"},     {"sec"},
                                    {"second"}, {"seconds"}, {"min"},  {"minute"}, {"minutes"},
                                    {"h"},      {"hr"},      {"hour"}, {"hours"},  {"hrs", "hour"}};
// udunits2 counts radians in rpm.
constexpr NamedUnit frequency_units[] = {{"Hz"}, {"kHz"}, {"rpm", "1/min"}, {"1/min"}, {"r/min", "1/min"}};
constexpr NamedUnit mass_units[] = {{"g"}, {"kg"}, {"mg"}, {"ug"}, {"t"}, {"lb"}, {"lbs", "lb"}, {"oz", "lb/16"}};
constexpr NamedUnit seed_mass_units[] = {{"g"}, {"mg"}, {"ug"}, {"kg"}};
constexpr NamedUnit mass_rate_units[] = {{"g/s"},
                                         {"kg/s"},
                                         {"mg/s"},
                                         {"g/min"},
                                         {"kg/min"},
                                         {"mg/min"},
                                         {"g/h"},
                                         {"kg/h"},
                                         {"t/h"},
                                         {"lb/s"},
                                         {"lb/min"},
                                         {"lb/h"},
                                         {"oz/s", "lb/16/s"},
                                         {"oz/min", "lb/16/min"},
                                         {"lbs/min", "lb/min"},
                                         {"lbs/h", "lb/h"}};
constexpr NamedUnit drag_units[] = {{"g/s"}, {"kg/s"}, {"mg/s"}, {"N*s/m"}, {"mN*s/m"}, {"uN*s/m"}};
constexpr NamedUnit speed_units[] = {{"mm/s"}, {"cm/s"}, {"m/s"}, {"um/s"}, {"m/min"}, {"in/s"}, {"ft/s"}};
constexpr NamedUnit travel_speed_units[] = {
    {"km/h"}, {"kmh", "km/h"}, {"kph", "km/h"}, {"mph", "international_mile/h"}, {"mi/h", "international_mile/h"},
    {"m/s"},  {"m/min"},       {"ft/min"}};
constexpr NamedUnit angle_units[] = {{"degree"}, {"degrees"}, {"deg", "degree"}, {"°", "degree"},
                                     {"rad"},    {"mrad"},    {"radian"},        {"radians"}};
constexpr NamedUnit density_units[] = {{"kg/m3"}, {"g/cm3"},  {"g/cc", "g/cm3"}, {"kg/dm3"}, {"kg/l"},
                                       {"g/ml"},  {"mg/mm3"}, {"t/m3"},          {"lb/ft3"}};
constexpr NamedUnit bulk_density_units[] = {{"kg/m3"},
                                            {"g/cm3"},
                                            {"g/cc", "g/cm3"},
                                            {"kg/dm3"},
                                            {"kg/l"},
                                            {"g/l"},
                                            {"g/ml"},
                                            {"t/m3"},
                                            {"kg/hl"},
                                            {"lb/ft3"},
                                            {"lb/bu", "lb/(0.03523907016688 m3)"},
                                            {"lbs/bu", "lb/(0.03523907016688 m3)"}};
constexpr NamedUnit force_units[] = {{"mN"}, {"N"}, {"uN"}, {"nN"}, {"kN"}};
constexpr NamedUnit pressure_units[] = {{"MPa"}, {"Pa"}, {"kPa"}, {"GPa"}, {"N/mm2"}, {"N/m2"}, {"bar"}, {"psi"}};
constexpr NamedUnit rate_units[] = {{"1/s"}, {"1/ms"}, {"1/min"}};
constexpr NamedUnit seed_rate_units[] = {
    {"1/s"}, {"1/ms"}, {"1/min"}, {"1/h"}, {"seeds/s", "1/s"}, {"seeds/min", "1/min"}, {"seeds/h", "1/h"}};
constexpr NamedUnit mass_per_area_units[] = {{"kg/ha"},
                                             {"g/ha"},
                                             {"t/ha"},
                                             {"kg/m2"},
                                             {"g/m2"},
                                             {"mg/m2"},
                                             {"lb/ac", "lb/(4046.8564224 m2)"},
                                             {"lbs/ac", "lb/(4046.8564224 m2)"},
                                             {"lb/acre", "lb/(4046.8564224 m2)"},
                                             {"lbs/acre", "lb/(4046.8564224 m2)"}};
constexpr NamedUnit seeds_per_area_units[] = {{"seeds/m2", "1/m2"},
                                              {"1/m2"},
                                              {"1/ha"},
                                              {"seeds/ha", "1/ha"},
                                              {"seeds/ft2", "1/ft2"},
                                              {"1/ft2"},
                                              {"seeds/ac", "1/(4046.8564224 m2)"},
                                              {"1/ac", "1/(4046.8564224 m2)"},
                                              {"seeds/acre", "1/(4046.8564224 m2)"},
                                              {"1/acre", "1/(4046.8564224 m2)"}};
constexpr NamedUnit plants_per_area_units[] = {{"plants/m2", "1/m2"},
                                               {"1/m2"},
                                               {"1/ha"},
                                               {"plants/ha", "1/ha"},
                                               {"plants/ft2", "1/ft2"},
                                               {"1/ft2"},
                                               {"plants/ac", "1/(4046.8564224 m2)"},
                                               {"1/ac", "1/(4046.8564224 m2)"},
                                               {"plants/acre", "1/(4046.8564224 m2)"},
                                               {"1/acre", "1/(4046.8564224 m2)"}};
constexpr NamedUnit fraction_units[] = {{"%"}, {"percent", "%"}};

struct DimensionFacts {
  std::string_view si;             // for people and for udunits2
  std::string_view kind, example;  // for people
  Units units;
};

DimensionFacts facts(Dimension dimension) {
  switch (dimension) {
    case Dimension::length:
      return {"m", "a length", "8 mm", length_units};
    case Dimension::time:
      return {"s", "a time", "10 s", time_units};
    case Dimension::frequency:
      return {"Hz", "a frequency in Hz, kHz or rpm", "9 Hz", frequency_units};
    case Dimension::mass:
      return {"kg", "a mass", "0.2 g", mass_units};
    case Dimension::seed_mass:
      return {"kg", "a mass in g or mg", "45 mg", seed_mass_units};
    case Dimension::mass_rate:
      return {"kg/s", "a mass per time", "3 g/s", mass_rate_units};
    case Dimension::drag:
      return {"kg/s", "a force per speed", "3 g/s", drag_units};
    case Dimension::speed:
      return {"m/s", "a speed", "20 mm/s", speed_units};
    case Dimension::travel_speed:
      return {"m/s", "a speed", "8 km/h", travel_speed_units};
    case Dimension::angle:
      return {"rad", "an angle in degree or rad", "10 degree", angle_units};
    case Dimension::density:
      return {"kg/m3", "a density", "1300 kg/m3", density_units};
    case Dimension::bulk_density:
      return {"kg/m3", "a bulk density", "780 kg/m3", bulk_density_units};
    case Dimension::force:
      return {"N", "a force", "0.2 mN", force_units};
    case Dimension::pressure:
      return {"Pa", "a pressure", "5e4 MPa", pressure_units};
    case Dimension::rate:
      return {"1/s", "a rate", "2.1e4 1/s", rate_units};
    case Dimension::seed_rate:
      return {"1/s", "seeds per time", "200 1/s", seed_rate_units};
    case Dimension::mass_per_area:
      return {"kg/m2", "a mass per area", "180 kg/ha", mass_per_area_units};
    case Dimension::seeds_per_area:
      return {"1/m2", "seeds per area", "350 seeds/m2", seeds_per_area_units};
    case Dimension::plants_per_area:
      return {"1/m2", "plants per area", "280 plants/m2", plants_per_area_units};
    case Dimension::fraction:
      break;
  }
  return {"1", "a fraction in %", "70 %", fraction_units};
}

/// What was likely meant by a unit that a dimension does not take.
struct Trap {
  std::string_view unit;
  Dimension of;
  std::string_view word;
};

constexpr std::string_view grains = "is the grain of the imperial system, 64.8 mg; a gram is g";
constexpr std::string_view not_of_seeds = "is not what seeds are weighed in; write g or mg";
constexpr std::string_view test_weight =
    "is of a test weight, of poured seeds with the air between them: that is a bulk_density, and a density is of the "
    "seed itself";
constexpr std::string_view bushels = "counts bushels, whose mass differs by the crop; write lb/ac";
constexpr std::string_view are = "is of an are or a year; write ha or ac";
constexpr std::string_view cycles = "counts cycles; write 1/s";
constexpr std::string_view not_seeds = "counts plants, not seeds";
constexpr std::string_view not_plants = "counts seeds, not plants";
constexpr Trap traps[] = {
    {"gr", Dimension::mass, grains},
    {"gr", Dimension::seed_mass, grains},
    {"grain", Dimension::mass, grains},
    {"grain", Dimension::seed_mass, grains},
    {"grains", Dimension::mass, grains},
    {"grains", Dimension::seed_mass, grains},
    {"gr/s", Dimension::mass_rate, grains},
    {"gr/min", Dimension::mass_rate, grains},
    {"gr/s", Dimension::drag, grains},
    {"lb", Dimension::seed_mass, not_of_seeds},
    {"oz", Dimension::seed_mass, not_of_seeds},
    {"ton", Dimension::mass, "is 907 kg, 1016 kg or a tonne; write t for 1000 kg"},
    {"kg/hl", Dimension::density, test_weight},
    {"lb/bu", Dimension::density, test_weight},
    {"lbs/bu", Dimension::density, test_weight},
    {"g/l", Dimension::density, test_weight},
    {"bu/ac", Dimension::mass_per_area, bushels},
    {"bu/acre", Dimension::mass_per_area, bushels},
    {"kg/a", Dimension::mass_per_area, are},
    {"lb/a", Dimension::mass_per_area, are},
    {"mPa", Dimension::pressure, "is a thousandth of a pascal; a million is MPa"},
    {"d", Dimension::time, "is a day; write h"},
    {"d", Dimension::length, "is a day, or a diameter where diameters are taken"},
    {"m", Dimension::time, "is a metre; a minute is min"},
    {"rad/s", Dimension::frequency, "counts radians, 2 pi a turn; write Hz or rpm"},
    {"1/s", Dimension::frequency, "does not say of what; write Hz"},
    {"Hz", Dimension::rate, cycles},
    {"Hz", Dimension::seed_rate, cycles},
    {"plants/m2", Dimension::seeds_per_area, not_seeds},
    {"plants/ha", Dimension::seeds_per_area, not_seeds},
    {"seeds/m2", Dimension::plants_per_area, not_plants},
    {"seeds/ha", Dimension::plants_per_area, not_plants},
};

std::string_view word_for(std::string_view unit, Dimension dimension) {
  const auto found =
      std::ranges::find_if(traps, [&](const Trap& trap) { return trap.unit == unit && trap.of == dimension; });
  return found == std::end(traps) ? std::string_view() : found->word;
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

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// What other keyboards and word processors write for a minus, a space and a few signs of units.
void write_plainly(std::string& text) {
  struct Sign {
    std::string_view written, plain;
  };
  static constexpr Sign signs[] = {{"\u2212", "-"}, {"\u207b", "-"},  {"\u00a0", " "}, {"\u202f", " "}, {"\u2009", " "},
                                   {"\u00b5", "u"}, {"\u03bc", "u"},  {"\u00ba", "°"}, {"\u02da", "°"}, {"\u00b9", "1"},
                                   {"\u00b2", "2"}, {"\u00b3", "3"},  {"\u00b7", "*"}, {"\u22c5", "*"}, {"\u2044", "/"},
                                   {"\u2215", "/"}, {"\u2033", "\""}, {"\u201d", "\""}};
  for (const Sign& sign : signs) replace_all(text, sign.written, sign.plain);
}

/// "kg m-3" and "kg*m-3" as "kg/m3".
std::string with_quotients(const std::string& unit) {
  std::string result;
  for (std::size_t at = 0; at < unit.size(); ++at) {
    const bool joins = unit[at] == ' ' || unit[at] == '*';
    std::size_t end = at + 1;
    while (joins && end < unit.size() && is_letter(unit[end])) ++end;
    if (!joins || end == at + 1 || end + 1 >= unit.size() || unit[end] != '-' || !is_digit(unit[end + 1])) {
      result += unit[at];
      continue;
    }
    result += '/' + unit.substr(at + 1, end - at - 1);
    if (unit[end + 1] != '1') result += unit[end + 1];
    at = end + 1;
  }
  return result;
}

/// One way of writing a unit out of several: "kg/m^3", "kg / m³" and "kg·m⁻³" are "kg/m3", "kg/L" is "kg/l".
std::string canonical(std::string unit) {
  write_plainly(unit);
  for (std::size_t at = unit.find('^'); at != std::string::npos; at = unit.find('^', at + 1))
    if (at + 1 < unit.size() && (is_digit(unit[at + 1]) || unit[at + 1] == '-')) unit.erase(at, 1);
  for (const char* sign : {"/", "*"})
    for (const std::string& spaced : {std::string(" ") + sign, std::string(sign) + " "})
      replace_all(unit, spaced, sign);
  unit = with_quotients(unit);
  if (unit.ends_with("/L")) unit.back() = 'l';
  if (unit.ends_with("/hL") || unit.ends_with("/mL")) unit.back() = 'l';
  return unit;
}

const NamedUnit* named(const std::string& canonical_unit, Dimension dimension) {
  const Units units = facts(dimension).units;
  const auto found = std::ranges::find(units, canonical_unit, &NamedUnit::name);
  return found == units.end() ? nullptr : &*found;
}

/// "hz" is meant as "Hz": the one unit of the dimension that differs by its capitals alone, if there is one.
std::string_view with_other_capitals(std::string_view unit, Dimension dimension) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  for (const NamedUnit& known : facts(dimension).units)
    if (std::ranges::equal(known.name, unit, {}, small, small)) return known.name;
  return {};
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

constexpr std::size_t longest_unit = 60;  // bytes; no unit is longer

[[noreturn]] void refuse_unit(const std::string& unit, Dimension dimension) {
  const std::string plain = unit.size() <= longest_unit ? canonical(unit) : "";
  if (const auto word = word_for(plain, dimension); !word.empty())
    throw UnitError(fmt::format("wrong unit \"{}\": {}", unit, word));
  if (const auto meant = with_other_capitals(plain, dimension); !meant.empty())
    throw UnitError(fmt::format("wrong unit \"{}\": capitals count; write {}", unit, meant));
  throw UnitError(fmt::format("wrong unit \"{}\"", shown(unit)));
}

UnitSize find_unit(const std::string& unit, Dimension dimension) {
  const NamedUnit* known = unit.size() <= longest_unit ? named(canonical(unit), dimension) : nullptr;
  if (known == nullptr) refuse_unit(unit, dimension);
  const std::string_view meaning = known->meaning.empty() ? known->name : known->meaning;
  return exact_size(UnitSystem::instance().size(std::string(meaning), std::string(si_unit(dimension))));
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

/// What stands at the front of `rest` as ",200" and ",000" do in "1,200,000 kg", of a sign between thousands; "": none.
std::string_view groups_of_thousands(std::string_view number, std::string_view rest) {
  if (number.starts_with('-') || number.starts_with('+')) number.remove_prefix(1);
  if (number.empty() || number.size() > 3 || number[0] == '0' || !std::ranges::all_of(number, is_digit)) return {};
  const auto is_group = [&](std::size_t at) {
    return at + 4 <= rest.size() && rest[at] == rest[0] && std::ranges::all_of(rest.substr(at + 1, 3), is_digit) &&
           (at + 4 == rest.size() || !is_digit(rest[at + 4]));
  };
  std::size_t end = 0;
  while (is_group(end)) end += 4;
  return rest.substr(0, end);
}

/// "4,0 mm" is nearly right, "1,200 kg" may be two things.
void reject_commas(std::string_view number, std::string_view rest) {
  constexpr std::string_view signs = ",' ";  // between thousands; the first is a decimal comma too
  if (rest.size() < 2 || signs.find(rest[0]) == std::string_view::npos || !is_digit(rest[1])) return;
  const std::string_view groups = groups_of_thousands(number, rest), after = rest.substr(groups.size());
  std::string whole(number);
  std::ranges::copy_if(groups, std::back_inserter(whole), is_digit);
  if (groups.size() == 4 && rest[0] == ',' && !after.starts_with('.'))
    throw UnitError(
        fmt::format("has a comma, which may part thousands or be a decimal comma; write \"{0}{2}\" or "
                    "\"{1}.{3}\"",
                    whole, number, shown(after), shown(rest.substr(1))));
  if (!groups.empty()) throw UnitError(fmt::format("parts thousands; write \"{}{}\"", whole, shown(after)));
  if (rest[0] != ',') return;
  std::erase(whole, '.');  // "1.200,5"
  throw UnitError(fmt::format("has a decimal comma; write a decimal point: \"{}.{}\"", whole, shown(rest.substr(1))));
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

std::pair<std::size_t, std::size_t> find_plus_minus(std::string_view text) {
  for (const std::string_view sign : {"+-", "\u00b1", "+/-"})
    if (const auto at = text.find(sign); at != std::string_view::npos) return {at, sign.size()};
  return {std::string_view::npos, 0};
}

Quantity split_quantity(std::string_view text) {
  std::string plain(text);
  write_plainly(plain);
  const std::string_view number = std::string_view(plain).substr(0, number_length(plain));
  if (number.empty()) throw UnitError("does not start with a number");
  std::string_view rest = std::string_view(plain).substr(number.size());
  reject_commas(number, rest);
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  rest = rest.substr(0, rest.find_last_not_of(' ') + 1);
  return {parse_number(number), std::string(rest)};
}

double in_si(const Quantity& quantity, Dimension dimension) {
  if (quantity.unit.empty()) throw UnitError("has no unit");
  const UnitSize size = find_unit(quantity.unit, dimension);
  const double value = quantity.number * size.times / size.over;
  if (!std::isfinite(value)) throw UnitError("is too large");
  return value;
}

double parse_quantity(std::string_view text, Dimension dimension, std::string_view example) {
  try {
    return in_si(split_quantity(text), dimension);
  } catch (const UnitError& error) {
    throw UnitError(fmt::format("\"{}\": {}; expected {}", shown(text), error.what(), expected(dimension, example)));
  }
}

bool is_unit_of(const std::string& unit, Dimension dimension) {
  return unit.size() <= longest_unit && named(canonical(unit), dimension) != nullptr;
}

std::vector<std::string_view> units_of(Dimension dimension) {
  std::vector<std::string_view> names;
  for (const NamedUnit& unit : facts(dimension).units) names.push_back(unit.name);
  return names;
}

std::string_view si_unit(Dimension dimension) {
  return facts(dimension).si;
}

std::string expected(Dimension dimension, std::string_view example) {
  const DimensionFacts of = facts(dimension);
  return fmt::format("{} such as \"{}\"", of.kind, example.empty() ? of.example : example);
}

double unit_size(std::string_view unit, Dimension dimension) {
  const UnitSize size = find_unit(std::string(unit), dimension);
  return size.times / size.over;
}

}  // namespace vibrosow
