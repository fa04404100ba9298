// Fills a sweep's folder with made-up runs, as many as a study has: what a study of that size costs beside its
// simulation. Usage: many_cases STUDY FOLDER [SEEDS_A_RUN]

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <random>

#include "scene/input_error.hpp"
#include "study/planned_study.hpp"

namespace {

using namespace vibrosow;

/// Seeds that leave at random times.
Run made_up(const Model& model, const SimulationOptions& options, int seeds) {
  const Scene& scene = model.scene;
  Run run;
  run.random_seed = options.random_seed;
  run.dt = model.step.dt, run.steps = model.step.steps, run.end_time = scene.run.duration;
  std::mt19937_64 random(options.random_seed);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  double time = 0;
  for (int k = 0; k < seeds; ++k) {
    time += 2 * number() * scene.run.duration / seeds;
    const int hole = 1 + static_cast<int>(random() % scene.tray.holes.size());
    run.events.push_back(
        {std::min(time, scene.run.duration), hole, 0, k, scene.lots[0].mass, number() * 0.1, number()});
  }
  run.balance.put_in = run.balance.counted = seeds;
  return run;
}

int fill(const std::string& study, const std::string& folder, int seeds) {
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  const PlannedStudy planned = plan_study(study, {}, 1);
  freeze_plan(folder, planned.plan);
  const double planning = seconds();
  StudyRuns runs(cases_of(folder));
  const std::vector<WantedRun> wanted = wanted_runs(planned);
  constexpr std::size_t at_a_time = 40960;  // as a bundle; its runs are packed at its end
  BatchOptions options;
  options.jobs = 1;
  for (std::size_t from = 0; from < wanted.size(); from += at_a_time) {
    const auto first = wanted.begin() + static_cast<std::ptrdiff_t>(from);
    const auto count = std::min(at_a_time, wanted.size() - from);
    runs.make(
        {first, first + static_cast<std::ptrdiff_t>(count)},
        [&](const Model& model, const SimulationOptions& simulation) { return made_up(model, simulation, seeds); },
        options);
  }
  std::cout << fmt::format("{},{:.3g},{:.3g}\n", wanted.size(), planning, seconds() - planning);
  return 0;
}

}  // namespace

int main(int count, char** words) {
  if (count < 3) {
    std::cerr << "usage: many_cases STUDY FOLDER [SEEDS_A_RUN]\n";
    return 2;
  }
  try {
    return fill(words[1], words[2], count > 3 ? std::atoi(words[3]) : 60);
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
