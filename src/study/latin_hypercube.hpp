#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vibrosow {

/// Points in the unit cube such that each of `points` equal parts of every axis holds one of them, at a random place in
/// it (McKay, Beckman, Conover 1979, Technometrics 21(2):239-245). [point][axis], in [0, 1). The same for the same
/// numbers on every machine.
std::vector<std::vector<double>> latin_hypercube(std::size_t points, std::size_t axes, std::uint64_t random_seed = 1);

}  // namespace vibrosow
