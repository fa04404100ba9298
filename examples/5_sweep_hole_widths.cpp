// How wide should the holes be? Mean rate of two random seeds for each width.
#include <cstdio>
#include <string>
#include <vibrosow/evaluate.hpp>

int main(int, char** arguments) {
  using namespace vibrosow::api;
  double narrower = 0;
  for (const int width : {10, 12, 14}) {
    const std::string holes = "tray.holes.width=" + std::to_string(width) + " mm";
    const Scene scene = Scene::read(arguments[1], {holes, "run.duration=0.6 s", "run.measure_from=0.3 s"});
    double sum = 0;
    for (const std::uint64_t random_seed : {1, 2}) {
      const Evaluation evaluation = evaluate(scene, random_seed);
      if (!evaluation.finished) return 1;
      sum += evaluation.holes.back().mass_rate;
    }
    std::printf("%d mm: %.2f g/s\n", width, 1e3 * sum / 2);
    if (sum < narrower) return 1;
    narrower = sum;
  }
  return 0;
}
