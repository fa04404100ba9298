#pragma once

#include "compute/instruction_set.hpp"

namespace vibrosow {

/// Grains side by side in memory.
struct Places {
  int count;
  const int* grain;         // numbers
  const double *x, *y, *r;  // m
};

/// Writes the numbers above `after` of the grains nearer than `reach` + r (m) to (x, y), in order, to `near`, which has
/// 16 places to spare, and returns how many.
using NearPlaces = int (*)(const Places& places, int after, double x, double y, double reach, int* near);

/// The same of balls in 3D, with their heights z (m) beside a plan of x and y.
using NearPlaces3d = int (*)(const Places& places, const double* heights, int after, double x, double y, double z,
                             double reach, int* near);
NearPlaces3d near_places_3d(InstructionSet set);

/// Compiled for one instruction set. Throws std::logic_error where it is not available.
NearPlaces near_places(InstructionSet set);

}  // namespace vibrosow
