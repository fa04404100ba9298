// The force phase of a run beside a bare kernel that does the same work: both for the narrow list of the published tray
// at 0.3 s (stiff shells, friction by springs, rotation, damping), and of the same in 3D with 5000 balls, in one
// program, round by round. The bare kernels are written out for that one case, with no law, effect or list to choose;
// they are the yardstick, not a part of the program. CSV on stdout, a row per scene.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "compute/compress.hpp"
#include "contact/kernels.hpp"
#include "contact/pair_forces.hpp"
#include "plan/step_plan.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {
namespace {

Scene tray(Space space) {
  const bool is_3d = space == Space::three_dimensional;
  Scene scene;
  scene.space = space;
  scene.lots = {{"grain", 8e-3, 0.6e-3, is_3d ? Shape::ball : Shape::disc, 1.0}};
  scene.contact.shell_compression = 1e-4;
  scene.contact.friction_model = FrictionModel::spring;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.tray.name = "tray";
  scene.tray.length = is_3d ? 0.2 : 0.5, scene.tray.height = 0.45;
  if (is_3d) scene.tray.depth = 0.12;
  scene.tray.fill = Fill{is_3d ? 5000 : 2400, Packing::layers, 1e-3, false};
  scene.tray.motion = HarmonicMotion{0, 0.01, 9, 0};
  scene.guard.stop_relative_overlap = 100;
  scene.run.duration = 2;
  return scene;
}

struct Bare {
  double reach, stiffness, dashpot, friction, tangential, tangential_dashpot, dt;
};

/// Forces, torques and spring lengths of all pairs; returns the contacts.
long bare_kernel(const Bare& c, const Grains& g, const PairList& list, ContactHistories& histories, Forces& forces) {
  constexpr int block = 256;
  unsigned char touches[block + 16];
  int entry[block + 16];
  std::array<int, block> places;
  std::iota(places.begin(), places.end(), 0);
  double px[block], py[block], turn[block], slip[block];
  const double *x = g.x.data(), *y = g.y.data(), *vx = g.vx.data(), *vy = g.vy.data(), *omega = g.omega.data();
  long contacts = 0;
  for (std::size_t from = 0; from < list.size(); from += block) {
    const int *a = list.grain.data() + from, *b = list.partner.data() + from;
    const int count = static_cast<int>(std::min<std::size_t>(block, list.size() - from));
    double* old_slip = histories.slip.data() + from;
    const double reach2 = c.reach * c.reach;
#pragma omp simd
    for (int k = 0; k < count; ++k) {
      const double dx = x[b[k]] - x[a[k]], dy = y[b[k]] - y[a[k]];
      touches[k] = dx * dx + dy * dy < reach2 ? 1 : 0;
    }
    const int touching = compress(touches, count, Kept<int>{places.data(), entry});
#pragma omp simd
    for (int k = 0; k < touching; ++k) {
      const int e = entry[k], i = a[e], j = b[e];
      const double dx = x[j] - x[i], dy = y[j] - y[i], distance = std::sqrt(dx * dx + dy * dy), per = 1 / distance;
      const double nx = dx * per, ny = dy * per, overlap = c.reach - distance;
      const double ux = vx[i] - vx[j], uy = vy[i] - vy[j], arm = 0.5 * (c.reach - overlap);
      const double normal = std::max(0.0, c.stiffness * overlap + c.dashpot * (ux * nx + uy * ny));
      const double speed = uy * nx - ux * ny + arm * (omega[i] + omega[j]);
      const double stretched = old_slip[e] + c.dt * speed;
      const double limit = c.friction * normal, pull = c.tangential * stretched;
      const double held = std::min(limit, std::max(-limit, pull));
      const double force = std::min(limit, std::max(-limit, held + c.tangential_dashpot * speed));
      slip[k] = held != pull ? held / c.tangential : stretched;
      px[k] = normal * nx - force * ny, py[k] = normal * ny + force * nx, turn[k] = arm * force;
    }
    for (int k = 0; k < touching; ++k) {
      const std::size_t e = static_cast<std::size_t>(entry[k]);
      const std::size_t i = static_cast<std::size_t>(a[e]), j = static_cast<std::size_t>(b[e]);
      forces[i].fx -= px[k], forces[i].fy -= py[k], forces[i].torque -= turn[k];
      forces[j].fx += px[k], forces[j].fy += py[k], forces[j].torque -= turn[k];
      old_slip[e] = slip[k];
    }
    contacts += touching;
  }
  return contacts;
}

/// Put in line for certain: else the compiler does not see one loop.
struct Three {
  double x, y, z;
};
[[gnu::always_inline]] inline Three operator+(Three a, Three b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[gnu::always_inline]] inline Three operator-(Three a, Three b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline Three operator*(double c, Three a) {
  return {c * a.x, c * a.y, c * a.z};
}
[[gnu::always_inline]] inline double dot(Three a, Three b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[gnu::always_inline]] inline Three cross(Three a, Three b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The same in 3D: springs of all pairs, touching or not, lie side by side, four numbers each.
long bare_kernel_3d(const Bare& c, const Grains& g, const PairList& list, std::vector<double>& records,
                    Forces3d& sums) {
  constexpr int block = 256;
  unsigned char touches[block + 16];
  int entry[block + 16];
  std::array<int, block> places;
  std::iota(places.begin(), places.end(), 0);
  double px[block], py[block], pz[block], tx[block], ty[block], tz[block], kept[3][block];
  const double *x = g.x.data(), *y = g.y.data(), *z = g.z.data(), *vx = g.vx.data(), *vy = g.vy.data(),
               *vz = g.vz.data(), *wx = g.omega_x.data(), *wy = g.omega_y.data(), *wz = g.omega.data();
  long contacts = 0;
  for (std::size_t from = 0; from < list.size(); from += block) {
    const int *a = list.grain.data() + from, *b = list.partner.data() + from;
    const int count = static_cast<int>(std::min<std::size_t>(block, list.size() - from));
    double* old = records.data() + 4 * from;
    const double reach2 = c.reach * c.reach;
#pragma omp simd
    for (int k = 0; k < count; ++k) {
      const int i = a[k], j = b[k];
      const double dx = x[j] - x[i], dy = y[j] - y[i], dz = z[j] - z[i];
      touches[k] = dx * dx + dy * dy + dz * dz < reach2 ? 1 : 0;
    }
    const int touching = compress(touches, count, Kept<int>{places.data(), entry});
    const auto work_out = [&](int k) __attribute__((always_inline)) {
      const int e = entry[k], i = a[e], j = b[e];
      const Three apart{x[j] - x[i], y[j] - y[i], z[j] - z[i]};
      const double distance = std::sqrt(dot(apart, apart)), overlap = c.reach - distance, arm = 0.5 * distance;
      const double per_distance = 1 / distance;
      const Three n = per_distance * apart, u{vx[i] - vx[j], vy[i] - vy[j], vz[i] - vz[j]};
      const Three spins{wx[i] + wx[j], wy[i] + wy[j], wz[i] + wz[j]};
      const double approach = dot(u, n), angle = 0.5 * c.dt * dot(spins, n);
      const Three passing = u - approach * n, speed = passing + arm * cross(spins, n);
      const double normal = std::max(0.0, c.stiffness * overlap + c.dashpot * approach);
      // Springs turn with the pair: with the normal, and about it by half the sum of the spins.
      const Three before{old[4 * e], old[4 * e + 1], old[4 * e + 2]};
      const Three over = before - dot(before, n) * (n + 0.5 * c.dt * per_distance * passing);
      Three slip = (1 - 0.5 * angle * angle) * over + angle * cross(n, over) + c.dt * speed;
      const double limit = c.friction * normal;
      const Three pull = c.tangential * slip;
      const double share = std::min(1.0, limit / std::sqrt(dot(pull, pull)));
      slip = share * slip;
      Three force = share * pull + c.tangential_dashpot * speed;
      force = std::min(1.0, limit / std::sqrt(dot(force, force))) * force;
      const Three push = normal * n + force, torque = arm * cross(n, force);
      px[k] = push.x, py[k] = push.y, pz[k] = push.z, tx[k] = torque.x, ty[k] = torque.y, tz[k] = torque.z;
      kept[0][k] = slip.x, kept[1][k] = slip.y, kept[2][k] = slip.z;
    };
#pragma omp simd
    for (int k = 0; k < touching; ++k) work_out(k);
    for (int k = 0; k < touching; ++k) {
      const std::size_t i = static_cast<std::size_t>(a[entry[k]]), j = static_cast<std::size_t>(b[entry[k]]);
      GrainVector &on_i = sums.forces[i], &on_j = sums.forces[j], &turn_i = sums.torques[i], &turn_j = sums.torques[j];
      on_i.x -= px[k], on_i.y -= py[k], on_i.z -= pz[k], turn_i.x -= tx[k], turn_i.y -= ty[k], turn_i.z -= tz[k];
      on_j.x += px[k], on_j.y += py[k], on_j.z += pz[k], turn_j.x -= tx[k], turn_j.y -= ty[k], turn_j.z -= tz[k];
      for (int m = 0; m < 3; ++m) old[4 * entry[k] + m] = kept[m][k];
    }
    contacts += touching;
  }
  return contacts;
}

template <class Work>
double seconds(Work work) {
  const auto from = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
}

Bare bare_of(const Model& model, const GrainKind& kind) {
  const SurfaceParameters& surface = model.contacts.pairs.front();
  const double stiffness = 0.5 / kind.compliance;
  const double dashpot = 2 * surface.damping_ratio * std::sqrt(0.5 * stiffness / kind.inverse_mass);
  return {2 * kind.radius,
          stiffness,
          dashpot,
          surface.friction,
          surface.tangential_ratio * stiffness,
          surface.tangential_damping * dashpot,
          model.step.dt};
}

/// A state, and what both kernels are given of it.
class Given {
 protected:
  Given(const Model& model, const SimulationState& state) : model_(model), state_(state) {}

  const Model& model_;
  const SimulationState& state_;
  const Grains& grains_ = state_.grains;
  const PairList& list_ = state_.contacts.pairs;
  const Bare constants_ = bare_of(model_, grains_.kinds.front());
  const ContactStep advance_{.trial = constants_.dt, .commit = constants_.dt};
};

/// Both kernels on it, each with histories and sums of its own.
class Plane : Given {
 public:
  Plane(const Model& model, const SimulationState& state) : Given(model, state) {}

  long ours() {
    ContactStatistics statistics;
    foreign_.clear();
    add_pair_forces(kernel_, surfaces_of(grains_), at_, list_, {0, static_cast<int>(list_.size())}, model_.contacts,
                    advance_, histories_, {0, 0}, forces_, foreign_, statistics);
    return statistics.contacts;
  }
  long bare() { return bare_kernel(constants_, grains_, list_, bare_histories_, bare_forces_); }
  /// Largest difference between the sums of both, over the largest force.
  double difference() const {
    double most = 0, largest = 0;
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      most = std::max({most, std::abs(forces_[i].fx), std::abs(forces_[i].fy)});
      largest =
          std::max({largest, std::abs(forces_[i].fx - bare_forces_[i].fx), std::abs(forces_[i].fy - bare_forces_[i].fy),
                    std::abs(forces_[i].torque - bare_forces_[i].torque) / constants_.reach});
    }
    return largest / most;
  }

 private:
  const Motion at_{grains_.x.data(),  grains_.y.data(),     grains_.vx.data(),
                   grains_.vy.data(), grains_.omega.data(), grains_.x.data()};
  const PairKernel kernel_ = model_.kernels->vectors[static_cast<std::size_t>(best_instruction_set())].pair;
  ContactHistories histories_ = state_.contacts.pair_histories, bare_histories_ = histories_;
  Forces forces_ = Forces(grains_.size()), bare_forces_ = forces_;
  std::vector<ForeignForce> foreign_;
};

/// The same in 3D.
class Balls3d : Given {
 public:
  Balls3d(const Model& model, const SimulationState& state) : Given(model, state) {
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      places_.push_back({grains_.x[i], grains_.y[i], grains_.z[i], 0});
      motions_.push_back({{grains_.vx[i], grains_.vy[i], grains_.vz[i], 0},
                          {grains_.omega_x[i], grains_.omega_y[i], grains_.omega[i], 0}});
    }
    sums_.forces.resize(grains_.size()), sums_.torques.resize(grains_.size());
    bare_sums_ = sums_;
    const std::size_t length = histories_.kinds.record_length();
    bare_records_.resize(length * list_.size());
    for (std::size_t k = 0; k < list_.size(); ++k)
      if (histories_.has_history(k)) std::copy_n(histories_.record(k), length, &bare_records_[length * k]);
  }

  long ours() {
    const Motion3d at{places_.data(), places_.data(), motions_.data()};
    const int size = static_cast<int>(list_.size());
    result_.forces = sums_.forces.data(), result_.torques = sums_.torques.data(), result_.first_own = 0;
    long contacts = 0;
    for (int from = 0; from < size; from += pair_block_size) {
      kernel_(surfaces_of(grains_), at, list_, {from, std::min(from + pair_block_size, size)}, model_.contacts,
              advance_, histories_, result_);
      contacts += result_.contacts;
    }
    return contacts;
  }
  long bare() { return bare_kernel_3d(constants_, grains_, list_, bare_records_, bare_sums_); }
  double difference() const {
    double most = 0, largest = 0;
    const auto far = [](const GrainVector& a, const GrainVector& b) {
      return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
    };
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      most = std::max(most, far(sums_.forces[i], {}));
      largest = std::max({largest, far(sums_.forces[i], bare_sums_.forces[i]),
                          far(sums_.torques[i], bare_sums_.torques[i]) / constants_.reach});
    }
    return largest / most;
  }

 private:
  const PairKernel3d kernel_ = model_.kernels->vectors_3d[static_cast<std::size_t>(best_instruction_set())].pair;
  std::vector<GrainVector> places_;
  std::vector<BallMotion> motions_;
  PairResult3d result_;
  ContactHistories histories_ = state_.contacts.pair_histories;
  std::vector<double> bare_records_;
  Forces3d sums_, bare_sums_;
};

template <class Both>
void compare(const char* name, Space space) {
  const Model model = prepare(tray(space));
  Simulation simulation(model, 1);
  simulation.run_until(0.3);
  Both both(model, simulation.state());
  both.ours(), both.bare();
  if (const double difference = both.difference(); !(difference < 1e-9))
    throw std::runtime_error(
        fmt::format("{}: the bare kernel's forces differ by {:g} of the largest", name, difference));
  constexpr int evaluations = 2000, rounds = 15;
  std::vector<double> ours, bare, ratios;
  double contacts = 0, bare_contacts = 0;
  for (int round = 0; round < rounds; ++round) {
    ours.push_back(seconds([&] {
      for (int k = 0; k < evaluations; ++k) contacts += static_cast<double>(both.ours());
    }));
    bare.push_back(seconds([&] {
      for (int k = 0; k < evaluations; ++k) bare_contacts += static_cast<double>(both.bare());
    }));
    ratios.push_back(bare.back() / ours.back());
  }
  const auto median = [](std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
  };
  const double grains = static_cast<double>(simulation.grains().size()), per_grain = 1e9 / evaluations / grains;
  const double evaluated = evaluations * rounds * grains;
  fmt::print("{},{},{:.2f},{:.3f},{:.3f},{:.2f},{:.2f},{:.3f},{:.3f},{:.3f}\n", name, name_of(best_instruction_set()),
             static_cast<double>(simulation.state().contacts.pairs.size()) / grains, contacts / evaluated,
             bare_contacts / evaluated, median(ours) * per_grain, median(bare) * per_grain, median(ratios),
             *std::ranges::min_element(ratios), *std::ranges::max_element(ratios));
}

}  // namespace
}  // namespace vibrosow

int main() {
  fmt::print(
      "space,instructions,candidates_per_grain,contacts_per_grain,bare_contacts_per_grain,force_phase_ns_per_grain,"
      "bare_ns_per_grain,rate_over_bare_median,least,most\n");
  vibrosow::compare<vibrosow::Plane>("plane", vibrosow::Space::two_dimensional);
  vibrosow::compare<vibrosow::Balls3d>("3d", vibrosow::Space::three_dimensional);
}
