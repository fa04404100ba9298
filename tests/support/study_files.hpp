#pragma once

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "result/run.hpp"
#include "simulation/simulate.hpp"

namespace vibrosow {

/// A directory of its own with a small seeder, seeder.toml, gone at the end of the test.
class StudyFiles {
 public:
  StudyFiles() : directory_(make_directory()) { write("seeder.toml", seeder_text()); }
  ~StudyFiles() { std::filesystem::remove_all(directory_); }
  StudyFiles(const StudyFiles&) = delete;
  StudyFiles& operator=(const StudyFiles&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    auto path = directory_ / name;
    std::ofstream(path) << content;
    return path;
  }
  static std::string seeder_text() {
    return R"([seeds.wheat]
diameter = "4 mm"
mass = "40 mg"
[contact]
shell_compression = 1e-3
friction = 0.3
restitution = 0.5
[tray]
length = "50 cm"
height = "12 cm"
depth = "6 cm"
fill = { count = 40, packing = "layers" }
[tray.holes]
count = 3
width = "16 mm"
span = "36 cm"
[run]
duration = "4 s"
measure_from = "2 s"
)";
  }
  std::filesystem::path seeder() const { return directory_ / "seeder.toml"; }
  std::filesystem::path study(const std::string& content) const {
    return write("study.toml", "base = \"seeder.toml\"\n" + content);
  }

 private:
  static std::filesystem::path make_directory() {
    std::string name = (std::filesystem::temp_directory_path() / "vibrosow-study-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no directory for the test");
    return name;
  }
  std::filesystem::path directory_;
};

/// Sows at once, evenly, and a little more with every random seed: 10 n + seed seeds from hole n in the 4 s of the run.
inline Run quick_run(const Model& model, const SimulationOptions& options) {
  const Scene& scene = model.scene;
  Run run;
  run.random_seed = options.random_seed;
  run.dt = 1e-3;
  run.steps = 4000;
  run.end_time = scene.run.duration;
  run.grain_steps = 4000 * static_cast<std::int64_t>(scene.tray.holes.size());
  for (int hole = 1; hole <= static_cast<int>(scene.tray.holes.size()); ++hole) {
    const int seeds = 10 * hole + static_cast<int>(options.random_seed);
    for (int i = 0; i < seeds; ++i) {
      const double time = 2.0 + 2.0 * (i + 0.5) / seeds;
      run.events.push_back({time, hole, 0, run.balance.counted++, scene.lots[0].mass, 0.1, 0.5});
    }
  }
  std::ranges::stable_sort(run.events, {}, &OutflowEvent::time);
  run.balance.inside = 10 * run.balance.counted;  // nothing has drained
  run.balance.put_in = run.balance.counted + run.balance.inside;
  return run;
}

}  // namespace vibrosow
