#pragma once

#include "simulation/state.hpp"

namespace vibrosow {

/// Whether a state that was read may be one of a model: arrays of one length, indices that exist, numbers that are
/// numbers, no time after the run's end. `fresh` is a state of it without grains. A checksum tells damage, not who
/// wrote the file.
bool is_possible(const Model& model, const SimulationState& fresh, const SimulationState& state);

}  // namespace vibrosow
