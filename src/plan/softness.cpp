#include "plan/softness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "laws/law.hpp"
#include "plan/derive_model.hpp"
#include "scene/accuracy_level.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

const double half_a_decade = std::sqrt(10);
constexpr int most_halvings = 12;

/// A value of `contact` that lots may have of their own.
double general_value(const Scene& scene, double Contact::*general, std::optional<double> SeedLot::*own) {
  const bool all_their_own =
      std::ranges::all_of(scene.lots, [own](const SeedLot& lot) { return (lot.*own).has_value(); });
  return all_their_own ? *(scene.lots.front().*own) : scene.contact.*general;
}

/// The shell compression of the softest lot.
double softest_shell(const Scene& scene) {
  double softest = 0;
  for (const SeedLot& lot : scene.lots)
    softest = std::max(softest, lot.shell_compression.value_or(scene.contact.shell_compression));
  return softest;
}

bool has_shell(const LawTraits& law) {
  return law.material == LawMaterial::shell;
}

void scale(std::optional<double>& value, double factor) {
  if (value) *value *= factor;
}

/// How much softer makes the shortest contact last so many times as long: it goes with the root of the shell
/// compression, and with the modulus to the power -2/5 (Hertz).
double softness_for(const LawTraits& law, double times_as_long) {
  const double square = times_as_long * times_as_long;
  return has_shell(law) ? square : square * std::sqrt(times_as_long);
}

/// Contact duration of a shell of that compression, s: pi sqrt(eps / g) for eps = (eps / r) r.
double duration_of_shell(double shell_compression, double radius) {
  return std::numbers::pi * std::sqrt(shell_compression * radius / standard_gravity);
}

/// Of a scene without a level: its own, or with Hertz' law that of a shell whose contacts last as long.
double shell_compression_of(const Scene& scene, const LawTraits& law) {
  if (has_shell(law)) return softest_shell(scene);
  const double radius = smallest_radius(scene.lots);
  const double times = contact_duration_as_written(scene) / duration_of_shell(1, radius);
  return times * times;
}

double steps_a_contact(const Scene& scene) {
  const Numerics& numerics = scene.numerics;
  return numerics.dt ? contact_duration_as_written(scene) / *numerics.dt : numerics.steps_per_contact;
}

/// Of a level, for that scene.
double softness_at(const AccuracyLevelValues& level, const Scene& scene, const LawTraits& law) {
  if (has_shell(law)) return level.shell_compression * (softness_of(scene, law) / softest_shell(scene));
  const double written = softness_of(scene, law);
  const double wanted = duration_of_shell(level.shell_compression, smallest_radius(scene.lots));
  return std::max(written, written * softness_for(law, wanted / contact_duration_as_written(scene)));
}

}  // namespace

double softness_of(const Scene& scene, const LawTraits& law) {
  return has_shell(law) ? general_value(scene, &Contact::shell_compression, &SeedLot::shell_compression)
                        : 1 / general_value(scene, &Contact::youngs_modulus, &SeedLot::youngs_modulus);
}

void set_softness(Scene& scene, const LawTraits& law, double softness) {
  const double factor = softness / softness_of(scene, law);
  if (has_shell(law)) {
    for (SeedLot& lot : scene.lots) scale(lot.shell_compression, factor);
    scene.contact.shell_compression = softness;
    return;
  }
  for (SeedLot& lot : scene.lots) scale(lot.youngs_modulus, 1 / factor);
  scale(scene.contact.wall_youngs_modulus, 1 / factor);
  scene.contact.youngs_modulus = 1 / softness;
}

bool is_predicted_sound(const Scene& scene) {
  const PredictedOverlap overlap = overlap_as_written(scene);
  const GuardLimits& guard = scene.guard;
  return std::max(overlap.overlap_at_rest, overlap.overlap_at_impact) <=
         std::sqrt(guard.warn_relative_overlap * guard.stop_relative_overlap);
}

Scene resolve_accuracy_level(const Scene& scene) {
  if (scene.numerics.accuracy == AccuracyLevel::as_written) return scene;
  const AccuracyLevelValues& level =
      *std::ranges::find(accuracy_levels, scene.numerics.accuracy, &AccuracyLevelValues::level);
  Scene changed = scene;
  changed.numerics.accuracy = AccuracyLevel::as_written;
  changed.numerics.steps_per_contact =
      std::max(level.steps_per_contact, usual_steps_per_contact(scene.numerics.integrator));
  const LawTraits& law = traits_of(changed.contact.law);
  const double stiffest = has_shell(law) ? 0 : softness_of(changed, law);
  double softness = softness_at(level, changed, law);
  set_softness(changed, law, softness);
  for (int i = 0; i < most_halvings && softness > stiffest && !is_predicted_sound(changed); ++i) {
    softness = std::max(softness / half_a_decade, stiffest);
    set_softness(changed, law, softness);
  }
  return changed;
}

NumericsError numerics_error(const Scene& scene) {
  constexpr double rounding = 1e-9;
  const Scene written = resolve_accuracy_level(scene);
  const double shell = shell_compression_of(written, traits_of(written.contact.law)), steps = steps_a_contact(written);
  const auto error_of = [&, long_grains = has_clumps(scene.lots)](const AccuracyLevelValues& level) {
    return level.error(scene.space, long_grains);
  };
  const auto times_beyond = [&](const AccuracyLevelValues& level) {
    const double times = std::max(shell / level.shell_compression, level.steps_per_contact / steps);
    return times <= 1 + rounding ? 1 : times;
  };
  const AccuracyLevelValues& softest = accuracy_levels.front();
  NumericsError error{error_of(softest) * times_beyond(softest), times_beyond(softest)};
  for (const AccuracyLevelValues& level : accuracy_levels)
    if (times_beyond(level) == 1) error.half_width = std::min(error.half_width, error_of(level));
  return error;
}

}  // namespace vibrosow
