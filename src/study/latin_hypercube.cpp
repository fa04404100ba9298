#include "study/latin_hypercube.hpp"

#include <numeric>
#include <utility>

#include "grains/random.hpp"

namespace vibrosow {

std::vector<std::vector<double>> latin_hypercube(std::size_t points, std::size_t axes, std::uint64_t random_seed) {
  Random random(random_seed);
  std::vector<std::vector<double>> cube(points, std::vector<double>(axes));
  std::vector<std::size_t> parts(points);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    std::iota(parts.begin(), parts.end(), std::size_t{0});
    for (std::size_t k = points; k > 1; --k) std::swap(parts[k - 1], parts[random.below(k)]);
    for (std::size_t k = 0; k < points; ++k)
      cube[k][axis] = (static_cast<double>(parts[k]) + random.uniform()) / static_cast<double>(points);
  }
  return cube;
}

}  // namespace vibrosow
