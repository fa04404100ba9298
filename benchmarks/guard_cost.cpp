// What the guard costs, beside the steps that it watches: CSV on stdout, a row per scene. The published tray, closed
// (2400 discs, stiff shells, springs), and the same in 3D with 5000 balls, from 0.2 s on. Turns of 100 steps with
// the guard's looks (after each step, and the account of energy once) and without them start from one state, so that
// they do the same work but for the guard's; one follows the other, now this and now that first, by the CPU's clock.
// The cost is the median of the ratios of 1000 such pairs, with its 95 % interval. The account is also timed alone.
// Apart from it, in both kinds of turn, is the look for the fastest grain in the loop over the grains: that column is
// the time of such a loop alone. The largest overlap is a maximum in the kernels, which cannot be taken out.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

#include "simulation/simulation.hpp"

namespace vibrosow {
namespace {

constexpr int steps_of_a_turn = 100, pairs = 1000;

Scene tray(Space space) {
  Scene scene;
  scene.space = space;
  const bool is_3d = space == Space::three_dimensional;
  scene.lots = {{"grain", 8e-3, 0.6e-3, is_3d ? Shape::ball : Shape::disc, 1}};
  scene.contact.shell_compression = 1e-4;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.contact.friction_model = FrictionModel::spring;
  scene.tray.name = "tray";
  scene.tray.length = is_3d ? 0.2 : 0.5, scene.tray.height = 0.45;
  if (is_3d) scene.tray.depth = 0.12;
  scene.tray.fill = Fill{is_3d ? 5000 : 2400, Packing::layers, 1e-3, false};
  scene.tray.motion = HarmonicMotion{0, 0.01, 9, 0};
  scene.guard.stop_relative_overlap = 100;
  scene.run.duration = 1;
  return scene;
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Work>
double time_of(Work work) {
  const double from = cpu_seconds();
  work();
  return cpu_seconds() - from;
}

/// The state of a tray at 0.2 s.
SimulationState shaken(const Model& model) {
  Simulation simulation(model, 1);
  simulation.run_until(0.2);
  return simulation.state();
}

/// Goes on from a state by itself.
class Turn {
 public:
  Turn(const Model& model, const SimulationState& from) : model_(model), state_(from) { step(false); }

  const SimulationState& state() const { return state_; }
  double step_many(bool watched) {  // s of the CPU
    return time_of([&] {
      for (int k = 0; k < steps_of_a_turn; ++k) step(watched);
      if (watched) watch_energy();
    });
  }
  void watch_energy() { guard_.watch_energy(s_, account_); }
  void look_for_the_fastest() {
    const Grains& g = state_.grains;
    bool any = false;
    for (int k = 0; k < steps_of_a_turn; ++k)
      any |= g.is_3d ? execution_.loops_3d().any_faster(g.size(), g.vx.data(), g.vy.data(), g.vz.data(), s_.fastest)
                     : execution_.loops().any_faster(g.size(), g.vx.data(), g.vy.data(), s_.fastest);
    if (any) s_.too_fast = true;
  }

 private:
  void step(bool watched) {
    s_.too_fast = false;
    advance_(s_);
    ++state_.step;
    state_.time = static_cast<double>(state_.step) * s_.dt;
    if (watched) guard_.watch_step(s_);
  }

  const Model& model_;
  SimulationState state_;
  Execution execution_{best_instruction_set(), 1};
  ForceField field_{model_, state_, {}, execution_};
  Integration s_{.model = model_,
                 .state = state_,
                 .field = field_,
                 .execution = execution_,
                 .grains = state_.grains,
                 .kept = state_.integrator,
                 .dt = model_.step.dt,
                 .drag = 0,
                 .fastest = longest_stride_in_radii * model_.smallest_radius / model_.step.dt};
  Guard guard_{model_, state_.guard};
  EnergyAccount account_;
  StepFunction advance_ = step_function(model_.scene.numerics.integrator);
};

void report(const std::string& name, Space space) {
  const Model model = prepare(tray(space));
  SimulationState state = shaken(model);
  std::vector<double> ratios, of_a_step;
  double fastest = 0, accounts = 0, unwatched = 0;
  for (int pair = 0; pair < pairs; ++pair) {
    double with = 0, without = 0;
    SimulationState after = state;
    for (const bool watched : {pair % 2 == 0, pair % 2 != 0}) {
      Turn turn(model, state);
      (watched ? with : without) = turn.step_many(watched);
      if (watched) continue;
      fastest += time_of([&] { turn.look_for_the_fastest(); });
      accounts += time_of([&] { turn.watch_energy(); });
      after = turn.state();
    }
    state = after;
    ratios.push_back(with / without - 1);
    of_a_step.push_back(without / steps_of_a_turn);
    unwatched += without;
  }
  std::ranges::sort(ratios), std::ranges::sort(of_a_step);
  // Order statistics that hold the median between them with 95 %.
  const std::size_t aside = static_cast<std::size_t>(std::ceil(0.98 * std::sqrt(pairs)));
  fmt::print("{},{},{:.1f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f}\n", name, state.grains.size(), 1e6 * of_a_step[pairs / 2],
             100 * ratios[pairs / 2], 100 * ratios[pairs / 2 - aside], 100 * ratios[pairs / 2 + aside],
             100 * accounts / unwatched, 100 * fastest / unwatched);
}

}  // namespace
}  // namespace vibrosow

int main() {
  fmt::print("scene,grains,step_us,guard_percent,least_95,most_95,account_percent,look_for_the_fastest_percent\n");
  vibrosow::report("tray in the plane", vibrosow::Space::two_dimensional);
  vibrosow::report("tray in space", vibrosow::Space::three_dimensional);
}
