// Holds the gates of a tray shut, opens the middle one at 1 s, and prints each seed as it leaves.
#include <cstdio>
#include <vibrosow/simulation.hpp>

int main(int, char** arguments) {
  using namespace vibrosow::api;
  const Scene scene = Scene::read(arguments[1], {"run.duration=1.2 s", "tray.holes.open_at=1 h"});
  Simulation simulation(scene);

  std::size_t seen = 0;
  bool open = false;
  for (Status status = Status::running; status == Status::running;) {
    status = simulation.advance_to(simulation.time() + 0.01);
    if (!open && simulation.time() >= 1) {
      simulation.open_gate(3);
      open = true;
    }
    for (const Event& event : simulation.events_since(seen)) {
      std::printf("%.4f s: a seed leaves hole %d at %.2f m/s\n", event.time, event.hole, event.speed);
      if (event.time < 1 || event.hole != 3) return 1;
      ++seen;
    }
  }
  const Balance balance = simulation.result().balance;
  return seen > 0 && seen == static_cast<std::size_t>(balance.counted + balance.spilled) ? 0 : 1;
}
