// Runs a seeder file and prints what each hole sows.
#include <cstdio>
#include <string>
#include <vibrosow/evaluate.hpp>

int main(int, char** arguments) {
  using namespace vibrosow::api;
  const Scene scene = Scene::read(arguments[1], {"run.duration=0.6 s", "run.measure_from=0.3 s"});
  const Evaluation evaluation = evaluate(scene);
  if (!evaluation.finished) {
    std::printf("%s: %s\n", scene.title().c_str(), evaluation.reason.c_str());
    return 1;
  }
  std::printf("%s\n", scene.title().c_str());
  for (const HoleOutflow& row : evaluation.holes)
    std::printf("%-5s %6.1f seeds/s %6.2f g/s\n", row.hole == all_holes ? "all" : std::to_string(row.hole).c_str(),
                row.seeds_per_s, 1e3 * row.mass_rate);
  return evaluation.balance.lost == 0 && evaluation.holes.back().grains > 0 ? 0 : 1;
}
