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
Scene at_its_accuracy(const Scene& scene);

}  // namespace vibrosow
