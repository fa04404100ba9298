#pragma once

#include <string>
#include <string_view>

#include "plan/model.hpp"
#include "simulation/state.hpp"

namespace vibrosow {

/// A state as bytes, with the scene it belongs to, a version and a checksum; the same bytes on every machine. What is
/// restored from them goes on as the saved one would have, to the last bit.
std::string save(const Model& model, const SimulationState& state);

/// Throws InputError with the reason where the bytes are no checkpoint, damaged, of another version of the program, or
/// of another scene (with the first key in which it differs).
SimulationState restore(const Model& model, std::string_view bytes);

}  // namespace vibrosow
