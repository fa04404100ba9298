#pragma once

#include <cstddef>

#include "compute/instruction_set.hpp"
#include "contact/contact_list.hpp"
#include "loops/grain_force.hpp"
#include "loops/grain_loops.hpp"
#include "loops/loops_3d.hpp"

namespace vibrosow {

/// A plate for vector instructions. A place p lies `direction` . p + `spare` along the normal over it, and as far along
/// its two sides. Other faces have zeros: nothing lies over them.
struct PlateRows {
  GrainVector normal{}, e1{}, e2{};
  GrainVector sides{};            // m: the lengths along e1 and e2; zeros where it is round
  GrainVector holes{1, 0, 1, 0};  // m: from and to along e1, then along e2, of what holds its holes
};

/// How a ball stands to a face: clear of a plate's whole plane, on the side that it came from; over a plate away from
/// edges and holes; or in need of a closer look.
enum class OverPlate : unsigned char { clear, flat, other };

/// Says so of each of `n` candidates, with its height (m) over the plate: where there is none, 0.
using OverPlates = void (*)(std::size_t n, const WallCandidate* candidates, const Coordinates& at, PerGrain radius,
                            const PlateRows* plates, double* height, OverPlate* stands);

/// Compiled for one instruction set. Throws std::logic_error where it is not available.
OverPlates over_plates(InstructionSet set);

}  // namespace vibrosow
