#include "agronomy/sowing_rate.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string_view>

namespace vibrosow {
namespace {

double positive(std::string_view what, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw std::invalid_argument(fmt::format("{} is {:g}; it must be positive and finite", what, value));
  return value;
}

double rate(std::string_view what, double value) {
  if (!(value >= 0) || !std::isfinite(value))
    throw std::invalid_argument(fmt::format("{} is {:g}; it must be finite and not negative", what, value));
  return value;
}

double fraction(double establishment) {
  if (positive("the establishment", establishment) > 1)
    throw std::invalid_argument(fmt::format("the establishment is {:g}; it is a fraction of 1", establishment));
  return establishment;
}

/// m2/s
double ground_covered(const RowPace& pace) {
  return positive("the row spacing", pace.row_spacing) * positive("the speed", pace.speed);
}

}  // namespace

double row_rate(double sowing_rate, const RowPace& pace) {
  return rate("the sowing rate", sowing_rate) * ground_covered(pace);
}

double sowing_rate(double row_rate, const RowPace& pace) {
  return rate("a row's rate", row_rate) / ground_covered(pace);
}

double speed_for(double sowing_rate, double row_rate, double row_spacing) {
  return positive("a row's rate", row_rate) /
         (positive("the sowing rate", sowing_rate) * positive("the row spacing", row_spacing));
}

double seeds_of_mass(double mass, double seed_mass) {
  return rate("a rate by mass", mass) / positive("a seed's mass", seed_mass);
}

double mass_of_seeds(double seeds, double seed_mass) {
  return rate("a rate by number", seeds) * positive("a seed's mass", seed_mass);
}

double seeds_for_plants(double plants, double establishment) {
  return rate("a number of plants", plants) / fraction(establishment);
}

double plants_of_seeds(double seeds, double establishment) {
  return rate("a number of seeds", seeds) * fraction(establishment);
}

double mean_spacing(double seeds_per_s, double speed) {
  return positive("the speed", speed) / rate("a rate by number", seeds_per_s);
}

}  // namespace vibrosow
