// The force phase of a run beside a bare kernel that does the same work: both for the narrow list of the published tray
// at 0.3 s (stiff shells, friction by springs, rotation, damping), in one program, round by round. The bare kernel is
// written out for that one case, with no law, effect or list to choose; it is the yardstick, not a part of the program.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>

#include "compute/compress.hpp"
#include "contact/kernels.hpp"
#include "contact/pair_forces.hpp"
#include "plan/step_plan.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {
namespace {

Scene published_tray() {
  Scene scene;
  scene.lots = {{"grain", 8e-3, 0.6e-3, Shape::disc, 1.0}};
  scene.contact.shell_compression = 1e-4;
  scene.contact.friction_model = FrictionModel::spring;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.tray.name = "tray";
  scene.tray.length = 0.5;
  scene.tray.height = 0.45;
  scene.tray.fill = Fill{2400, Packing::layers, 1e-3, false};
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
  double px[block], py[block], turn[block], slip[block], slip_speed[block];
  const double *x = g.x.data(), *y = g.y.data(), *vx = g.vx.data(), *vy = g.vy.data(), *omega = g.omega.data();
  long contacts = 0;
  for (std::size_t from = 0; from < list.size(); from += block) {
    const int *a = list.grain.data() + from, *b = list.partner.data() + from;
    const int count = static_cast<int>(std::min<std::size_t>(block, list.size() - from));
    double *old_slip = histories.slip.data() + from, *old_speed = histories.slip_speed.data() + from;
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
      const double stretched = old_slip[e] + 0.5 * c.dt * (old_speed[e] + speed);
      const double limit = c.friction * normal, pull = c.tangential * stretched;
      const double held = std::min(limit, std::max(-limit, pull));
      const double force = std::min(limit, std::max(-limit, held + c.tangential_dashpot * speed));
      slip[k] = held != pull ? held / c.tangential : stretched, slip_speed[k] = speed;
      px[k] = normal * nx - force * ny, py[k] = normal * ny + force * nx, turn[k] = arm * force;
    }
    for (int k = 0; k < touching; ++k) {
      const std::size_t e = static_cast<std::size_t>(entry[k]);
      const std::size_t i = static_cast<std::size_t>(a[e]), j = static_cast<std::size_t>(b[e]);
      forces[i].fx -= px[k], forces[i].fy -= py[k], forces[i].torque -= turn[k];
      forces[j].fx += px[k], forces[j].fy += py[k], forces[j].torque -= turn[k];
      old_slip[e] = slip[k], old_speed[e] = slip_speed[k];
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

void compare() {
  const Model model = prepare(published_tray());
  const double dt = model.step.dt;
  Simulation simulation(model, 1);
  while (simulation.time() < 0.3) simulation.step();
  const Grains& grains = simulation.grains();
  const PairList& list = simulation.state().contacts.pairs;
  const ContactParameters& parameters = model.contacts;
  const SurfaceParameters& surface = parameters.pairs.front();
  const GrainKind& kind = grains.kinds.front();
  const double stiffness = 0.5 / kind.compliance;
  const double dashpot = 2 * surface.damping_ratio * std::sqrt(0.5 * stiffness / kind.inverse_mass);
  const Bare bare{2 * kind.radius,
                  stiffness,
                  dashpot,
                  surface.friction,
                  surface.tangential_ratio * stiffness,
                  surface.tangential_damping * dashpot,
                  dt};
  const Motion at{grains.x.data(),  grains.y.data(),     grains.vx.data(),
                  grains.vy.data(), grains.omega.data(), grains.x.data()};
  ContactHistories histories = simulation.state().contacts.pair_histories, bare_history = histories;
  Forces forces(grains.size());
  std::vector<ForeignForce> foreign;
  ContactStatistics statistics;
  const PairKernel kernel = model.kernels->vectors[static_cast<std::size_t>(best_instruction_set())].pair;
  constexpr int evaluations = 2000, rounds = 15;
  std::vector<double> ours, theirs, ratios;
  long bare_contacts = 0;
  for (int round = 0; round < rounds; ++round) {
    ours.push_back(seconds([&] {
      for (int k = 0; k < evaluations; ++k)
        add_pair_forces(kernel, surfaces_of(grains), at, list, {0, static_cast<int>(list.size())}, parameters,
                        {.trial = dt, .commit = dt, .present = 0.5}, histories, {0, 0}, forces, foreign, statistics);
    }));
    theirs.push_back(seconds([&] {
      for (int k = 0; k < evaluations; ++k) bare_contacts += bare_kernel(bare, grains, list, bare_history, forces);
    }));
    ratios.push_back(theirs.back() / ours.back());
  }
  const auto median = [](std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
  };
  const double per_grain = 1e9 / evaluations / static_cast<double>(grains.size());
  fmt::print(
      "instructions,candidates_per_grain,contacts_per_grain,bare_contacts_per_grain,force_phase_ns_per_grain,"
      "bare_ns_per_grain,rate_over_bare_median,least,most\n");
  const double evaluated = static_cast<double>(evaluations) * rounds * static_cast<double>(grains.size());
  fmt::print("{},{:.2f},{:.3f},{:.3f},{:.2f},{:.2f},{:.3f},{:.3f},{:.3f}\n", name_of(best_instruction_set()),
             static_cast<double>(list.size()) / static_cast<double>(grains.size()),
             static_cast<double>(statistics.contacts) / evaluated, static_cast<double>(bare_contacts) / evaluated,
             median(ours) * per_grain, median(theirs) * per_grain, median(ratios), *std::ranges::min_element(ratios),
             *std::ranges::max_element(ratios));
}

}  // namespace
}  // namespace vibrosow

int main() {
  vibrosow::compare();
}
