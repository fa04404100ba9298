#pragma once

#include <string>

#include "simulation/simulation.hpp"

namespace vibrosow {

/// The contacts of this moment with their normal forces, grains as places in the list of all grains: the bytes of a
/// frame's contacts in docs/reference/recording-format.md, before they are packed.
std::string contact_bytes(Simulation& simulation);

}  // namespace vibrosow
