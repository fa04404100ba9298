#pragma once

#include "laws/law.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// How soft a scene's seeds are by `law`, its own: shell compression, or one over Young's modulus (1/Pa). The
/// contact's, or, where every lot has its own, the first lot's.
double softness_of(const Scene& scene, const LawTraits& law);

/// Lots and walls with a softness of their own are softened alike.
void set_softness(Scene& scene, const LawTraits& law, double softness);

/// Whether the overlaps predicted for the scene as it is written, the largest of any seed, stay clear of the guard's
/// stop: below the geometric mean of its warning and its stop, 16 % of the radius unless set otherwise.
bool is_predicted_sound(const Scene& scene);

/// The scene with softness and steps of its accuracy level written out, and no level any more; without a level the
/// scene itself. The level's softness is made stiffer where it is not predicted sound, and with
/// Hertz' law never stiffer than written, since a modulus is the material's.
Scene resolve_accuracy_level(const Scene& scene);

/// What softness and step may do to a scene's rates.
struct NumericsError {
  double half_width = 0;    // of the 95 %, over the rate
  double times_beyond = 1;  // how many times softer than the softest level it is, or its steps longer; 1 within
};

/// That of the most accurate level (scene/accuracy_level.hpp) which is no stiffer and has no more steps a contact than
/// the scene, of long grains where any lot is of clumps. Beyond the softest level its error, as many times as large: of
/// what errs, overlap and step go with the first power, and the duration of contacts with less. With Hertz' law
/// softness is that of a shell whose contacts last as long.
NumericsError numerics_error(const Scene& scene);

}  // namespace vibrosow
