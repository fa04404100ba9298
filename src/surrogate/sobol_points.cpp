#include "surrogate/sobol_points.hpp"

#include <boost/random/sobol.hpp>
#include <stdexcept>

namespace vibrosow {

Eigen::MatrixXd sobol_points(Eigen::Index count, Eigen::Index dimensions) {
  if (dimensions < 1) throw std::invalid_argument("Sobol's sequence needs a dimension");
  boost::random::sobol sequence(static_cast<std::size_t>(dimensions));  // begins after its zero
  Eigen::MatrixXd points(count, dimensions);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index d = 0; d < dimensions; ++d)
      points(i, d) = (static_cast<double>(sequence() >> 11) + 0.5) * 0x1p-53;
  return points;
}

}  // namespace vibrosow
