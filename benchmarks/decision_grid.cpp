// What a full grid, equally many runs of every layout, takes to name the layout that a decision named as surely as it
// did: grids are drawn, with replacement, from the runs that are kept. CSV: grids of more and more runs, up to the
// first that is as sure. Usage: decision_grid STUDY DECISION.json FOLDER...

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "grains/random.hpp"
#include "optimise/decide.hpp"
#include "outflow/metrics.hpp"
#include "scene/input_error.hpp"
#include "storage/case_file.hpp"
#include "storage/case_folder.hpp"
#include "study/planned_study.hpp"

namespace {

using namespace vibrosow;

constexpr int drawn_grids = 2000, most_replicates = 400;

struct Asked {
  const Goal* goal;
  WantedRate rate;
  double confidence_percent;
  int answer;                 // number of a layout
  std::uint64_t random_seed;  // of the first run of each
};

/// What is compared of one run.
struct RunMetrics {
  double goal, rate;
};

struct KeptLayout {
  int number;
  std::vector<RunMetrics> runs;
  double grain_steps = 0;  // of a run, mean
};

Asked read_asked(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file + ": cannot be read");
  const auto json = nlohmann::json::parse(in);
  const Metric& rate = metric_named(json.at("rate").at("figure").get<std::string>());
  const auto end_of_band = [&](const char* key) { return json.at("rate").at(key).get<double>() * rate.unit_size; };
  return {&goal_named(json.at("goal").at("name").get<std::string>()),
          {rate.name == "tray_seeds_per_s", end_of_band("low"), end_of_band("high")},
          json.at("confidence_percent"),
          json.at("best"),
          json.at("random_seed")};
}

/// Runs of a scene by random seed, up to the first that no folder has; none where one has no such figure.
KeptLayout kept_layout(const Layout& layout, const Scene& scene, const std::deque<CaseFolder>& folders,
                       const Asked& asked) {
  KeptLayout kept{layout.number, {}};
  for (std::uint64_t random_seed = asked.random_seed;; ++random_seed) {
    std::optional<Run> run;
    for (const CaseFolder& folder : folders)
      if (!run) run = folder.find(case_identity(scene, random_seed));
    if (!run) return kept;
    const Evaluation evaluation = reduced(scene, *run);
    const auto goal = asked.goal->of(evaluation.outflow), rate = rate_as_wanted(asked.rate, evaluation.outflow);
    if (!goal || !rate || !evaluation.finished() || evaluation.outside_the_model) return {layout.number, {}};
    kept.runs.push_back({*goal, *rate});
    kept.grain_steps +=
        (static_cast<double>(evaluation.grain_steps) - kept.grain_steps) / static_cast<double>(kept.runs.size());
  }
}

/// Of one drawn grid: the layout of the least mean goal among those whose mean rate lies in the band; 0: none does.
int answer_of_grid(const std::vector<KeptLayout>& layouts, const WantedRate& band, int replicates, Random& random) {
  int answer = 0;
  double least = HUGE_VAL;
  for (const KeptLayout& layout : layouts) {
    double goal = 0, rate = 0;
    for (int i = 0; i < replicates; ++i) {
      const RunMetrics& run = layout.runs[random.below(layout.runs.size())];
      goal += run.goal / replicates;
      rate += run.rate / replicates;
    }
    if (rate < band.low || rate > band.high || goal >= least) continue;
    least = goal;
    answer = layout.number;
  }
  return answer;
}

double right_percent(const std::vector<KeptLayout>& layouts, const Asked& asked, int replicates) {
  Random random(static_cast<std::uint64_t>(replicates));
  int right = 0;
  for (int grid = 0; grid < drawn_grids; ++grid)
    right += answer_of_grid(layouts, asked.rate, replicates, random) == asked.answer;
  return 100.0 * right / drawn_grids;
}

void print_grids(const std::string& study_file, const std::string& decision, const std::vector<std::string>& paths) {
  const Asked asked = read_asked(decision);
  const Study study = plan_study(study_file, {}, asked.random_seed).study;
  std::deque<CaseFolder> folders;
  for (const std::string& path : paths) folders.emplace_back(cases_of(path));
  std::vector<KeptLayout> layouts;
  for (const Layout& layout : study.layouts) {
    if (!layout.scene) continue;
    KeptLayout kept = kept_layout(layout, study.scenes[*layout.scene], folders, asked);
    if (!kept.runs.empty()) layouts.push_back(std::move(kept));
  }
  double grain_steps = 0;  // of one run of each
  for (const KeptLayout& layout : layouts) grain_steps += layout.grain_steps;
  fmt::print("replicates,runs,grain_steps,right_percent,confidence_percent\n");
  double right = 0;
  for (int replicates = 2; replicates <= most_replicates && right < asked.confidence_percent; ++replicates) {
    right = right_percent(layouts, asked, replicates);
    fmt::print("{},{},{:.4g},{:.3g},{:g}\n", replicates, replicates * static_cast<int>(layouts.size()),
               replicates * grain_steps, right, asked.confidence_percent);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "usage: decision_grid STUDY DECISION.json FOLDER...\n";
    return 2;
  }
  try {
    print_grids(argv[1], argv[2], {argv + 3, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
