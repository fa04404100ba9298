#pragma once

namespace vibrosow {

inline constexpr double kilogram_per_hectare = 1e-4;     // kg/m2
inline constexpr double kilometre_per_hour = 1.0 / 3.6;  // m/s

/// How closely and how fast a row is sown. A row covers `row_spacing` speed of ground in a second.
struct RowPace {
  double row_spacing = 0;  // m, between neighbouring rows
  double speed = 0;        // m/s, of the drill over ground
  bool operator==(const RowPace&) const = default;
};

// A sowing rate is of an area: by mass in kg/m2, by number in 1/m2. A row's rate is of a second: in kg/s, or 1/s. The
// formulas are those of a drill's calibration: rate = what a row gives / (row spacing speed). Every function throws
// std::invalid_argument for a spacing, a speed, a seed's mass or an establishment that is not positive and finite, for
// an establishment above 1, and for a rate that is negative or not finite.

/// What a row is to give (kg/s or 1/s) for a sowing rate (kg/m2 or 1/m2).
double row_rate(double sowing_rate, const RowPace& pace);

/// The sowing rate (kg/m2 or 1/m2) of what a row gives (kg/s or 1/s).
double sowing_rate(double row_rate, const RowPace& pace);

/// The speed (m/s) at which what a row gives is a sowing rate; neither may be zero.
double speed_for(double sowing_rate, double row_rate, double row_spacing);

/// A rate by number of one by mass, in whatever time or area, and the reverse. `seed_mass`: kg, a thousandth of the
/// thousand grain mass.
double seeds_of_mass(double mass, double seed_mass);
double mass_of_seeds(double seeds, double seed_mass);

/// Seeds to sow for plants that are to stand, in whatever area, and the plants that come of seeds. `establishment`:
/// the fraction of seeds that becomes plants, (0, 1]. With `mass_of_seeds`: kg/ha = plants/m2 times thousand grain mass
/// in g over establishment in %, as 280 x 53 / 85 = 175 (Farmers Journal).
double seeds_for_plants(double plants, double establishment);
double plants_of_seeds(double seeds, double establishment);

/// Mean distance (m) of a row's seeds over ground; infinite where none come.
double mean_spacing(double seeds_per_s, double speed);

}  // namespace vibrosow
