#pragma once

#include "grains/grains.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// The scene whose lab is the mirror image: x becomes -x, left is right. A table of motion that turns its vessel is the
/// mirror at the table's times alone.
Scene mirrored(Scene scene);

/// Grains of a scene where they are in its mirror image; `into` is empty, of that scene.
Grains mirrored(const Grains& grains, Grains into);

}  // namespace vibrosow
