#include "input/lengths.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "input/wording.hpp"

namespace vibrosow {

std::string millimetres(double length) {
  return fmt::format("{:g} mm", std::round(length * 1e9) / 1e6);
}

double rounded(double length) {
  return std::round(length * 1e12) / 1e12;
}

double largest_mean_diameter(const std::vector<SeedLot>& lots) {
  return std::max_element(lots.begin(), lots.end(),
                          [](const SeedLot& a, const SeedLot& b) { return a.diameter < b.diameter; })
      ->diameter;
}

double read_width(const Table& table, const std::string& key, const TomlValue& value, double diameter) {
  static constexpr std::string_view expected_width = "a length such as \"16 mm\" or \"3 diameters\"";
  const std::string shown_value = shortened(toml_text(value));
  const auto* text = value.get<std::string>();
  const auto* typed = value.get<Quantity>();
  if (text == nullptr && typed == nullptr)
    table.fail_to_read(key, fmt::format("must be {}, in quotes, not {}", expected_width, shown_value));
  double width = 0;
  try {
    const Quantity quantity = typed != nullptr ? *typed : split_quantity(*text);
    const bool counted = quantity.unit == "diameters" || quantity.unit == "diameter";
    width = rounded(counted ? quantity.number * diameter : in_si(quantity, Dimension::length));
  } catch (const UnitError& error) {
    table.fail_to_read(key,
                       fmt::format("{} is not a {}; expected {}: {}", shown_value, key, expected_width, error.what()));
  }
  if (!(width >= shortest && width <= longest)) {
    table.fail(key, fmt::format("{} is out of range, which is from 0.001 mm to 100 m", shown_value));
  }
  return width;
}

}  // namespace vibrosow
