// Cuts a run in two: saves its state half-way, goes on from it with two threads, and comes to the same state.
#include <cstdio>
#include <vibrosow/simulation.hpp>

int main(int, char** arguments) {
  using namespace vibrosow::api;
  const Scene scene = Scene::read(arguments[1], {"run.duration=0.4 s", "run.measure_from=0 s"});
  Simulation undisturbed(scene);
  undisturbed.advance_to(0.2);
  const std::string state = undisturbed.save();
  undisturbed.advance_to(scene.duration());

  Simulation restored = Simulation::restore(scene, state, 2);
  restored.advance_to(scene.duration());
  const bool same = restored.save() == undisturbed.save();
  std::printf("%zu bytes saved at 0.2 s; at the end %s\n", state.size(),
              same ? "the same to the last bit" : "they differ");
  return same ? 0 : 1;
}
