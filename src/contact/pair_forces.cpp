#include "contact/pair_forces.hpp"

#include <cmath>

namespace vibrosow {
namespace {

template <class Sum>
void clear(std::vector<Sum>& sums, GrainRange grains) {
  if (sums.empty() || grains.to <= grains.from) return;
  std::fill(sums.begin() + grains.from, sums.begin() + grains.to, Sum{});
}

void add(const std::array<double, 3>& what, GrainVector& sum) {
  sum.x += what[0], sum.y += what[1], sum.z += what[2];
}

}  // namespace

void add_metrics(const LawMetrics& metrics, ContactStatistics& statistics) {
  statistics.slip_raised += std::llround(metrics.slip_raised);
  statistics.max_relative_overlap = std::max(statistics.max_relative_overlap, metrics.max_relative_overlap);
}

void resize(Forces& sums, std::size_t grains, bool /*rotation*/) {
  sums.resize(grains);
}
void resize(Forces3d& sums, std::size_t grains, bool rotation) {
  sums.forces.resize(grains), sums.torques.resize(rotation ? grains : 0);
}

void begin_with_zero(Forces& sums, GrainRange grains) {
  clear(sums, grains);
}
void begin_with_zero(Forces3d& sums, GrainRange grains) {
  clear(sums.forces, grains), clear(sums.torques, grains);
}

void add_foreign(const std::vector<ForeignForce>& foreign, Forces& sums) {
  for (const ForeignForce& force : foreign) {
    GrainForce& sum = sums[static_cast<std::size_t>(force.grain)];
    sum.fx += force.fx, sum.fy += force.fy, sum.torque += force.torque;
  }
}
void add_foreign(const std::vector<ForeignForce3d>& foreign, Forces3d& sums) {
  for (const ForeignForce3d& one : foreign) {
    const std::size_t i = static_cast<std::size_t>(one.grain);
    add(one.force, sums.forces[i]);
    if (!sums.torques.empty()) add(one.torque, sums.torques[i]);
  }
}

PairResult result_in(Forces& sums, int first_own) {
  PairResult result;
  result.forces = sums.data(), result.first_own = first_own;
  return result;
}
PairResult3d result_in(Forces3d& sums, int first_own) {
  PairResult3d result;
  result.forces = sums.forces.data(), result.torques = sums.torques.data(), result.first_own = first_own;
  return result;
}

}  // namespace vibrosow
