#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "optimise/goal.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Runs of a layout that goals may ask for: as it is, and with its drive or its fill a little other.
enum class Variant { as_it_is, faster, slower, less_fill };

/// By how much.
inline constexpr double frequency_change = 0.05, fill_change = 0.2;

/// The scene of a variant. Throws InputError, which names the goal that asks for it, where the tray is not shaken by
/// one harmonic motion, or has no fill to take from.
Scene variant_of(Scene scene, Variant variant);

/// One of several goals that layouts are compared by.
struct FrontGoal {
  enum class Kind { metric, rate_error, power, frequency_sensitivity, fill_sensitivity };
  Kind kind;
  std::string_view name;    // what a user says: "power"
  std::string_view words;   // in a sentence: "rate error"
  std::string_view column;  // with its unit: "power_W_per_kg"
  std::string_view unit;    // empty for a plain number
  double unit_size;         // of that unit, in SI
  std::string_view description;
  const Goal* metric = nullptr;     // of a run, its mean over runs
  std::vector<Variant> asks_for{};  // beside the layout as it is
};

/// Those of `decide`, and rate_error, power, frequency_sensitivity, fill_sensitivity.
const std::vector<FrontGoal>& front_goals();

/// Reads "unevenness,power": at least one, none twice. Throws InputError with the list for a name that is none.
std::vector<const FrontGoal*> read_front_goals(const std::vector<std::string>& names);

/// The greatest power of the drive over the mass that it shakes, W/kg: (2 pi f)^3 A^2 / 2, by Newton's second law for
/// x = A sin(2 pi f t), whose force over mass times speed is A^2 w^3 sin(2 w t) / 2. Of a tray on springs tuned to its
/// frequency the drive gives a part of it, which is the same for every layout. Throws InputError unless the tray is
/// shaken by one harmonic motion.
double drive_power(const Scene& scene);

}  // namespace vibrosow
