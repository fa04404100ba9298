#pragma once

#include "input/read_scene.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Says which of plane and space a question to this scene needs.
void print_space_advice(const Scene& scene);

/// Runs a seeder in 2D and in 3D and prints the rates of both and their ratio; an exit code. Throws
/// InputError where one of the two cannot be run.
int run_in_both_spaces(const BothSpaces& scenes);

}  // namespace vibrosow
