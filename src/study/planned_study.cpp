#include "study/planned_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "input/override.hpp"
#include "plan/model.hpp"
#include "plan/predicted_grains.hpp"
#include "scene/input_error.hpp"
#include "storage/case_file.hpp"
#include "study/run_in_parallel.hpp"

namespace vibrosow {
namespace {

Study study_in(const std::filesystem::path& file, const std::vector<std::string>& sets,
               const std::shared_ptr<SourceFiles>& files) {
  std::vector<Override> overrides;
  for (const std::string& set : sets) overrides.push_back(parse_override(set));
  return read_study(file, overrides, files);
}

/// Calls `visit(layout, model)` once for each scene of a study, by the first layout that has it.
template <class Visit>
void for_each_scene(const Study& study, Visit visit) {
  std::vector<bool> visited(study.scenes.size());
  for (const Layout& layout : study.layouts) {
    if (!layout.scene || visited[*layout.scene]) continue;
    visited[*layout.scene] = true;
    visit(layout, prepare(study.scenes[*layout.scene]));  // at its accuracy: as it is run
  }
}

/// Names of the runs of a scene.
std::vector<std::string> names_of_runs(const Scene& scene, std::uint64_t first_random_seed, int replicates) {
  const std::string json = untitled_json(scene);
  std::vector<std::string> names;
  for (int i = 0; i < replicates; ++i)
    names.push_back(case_name(case_identity(json, first_random_seed + static_cast<std::uint64_t>(i))));
  return names;
}

/// By layout, then random seed; what each costs by `cost_of`.
template <class CostOf>
std::vector<PlannedRun> planned_runs(const Study& study, std::uint64_t first_random_seed,
                                     const std::vector<int>& replicates, CostOf cost_of) {
  std::vector<PlannedRun> runs;
  for_each_scene(study, [&](const Layout& layout, const Model& model) {
    const double cost = cost_of(model);
    std::uint64_t seed = first_random_seed;
    for (std::string& name : names_of_runs(model.scene, first_random_seed, replicates[*layout.scene]))
      runs.push_back({std::move(name), layout.number, seed++, cost});
  });
  return runs;
}

std::vector<PlannedRun> planned_runs(const Study& study, std::uint64_t first_random_seed,
                                     const std::vector<int>& replicates) {
  return planned_runs(study, first_random_seed, replicates,
                      [](const Model& model) { return predicted_grain_steps(model.scene, model.step.dt); });
}

/// Whether the runs of a plan are what this program makes of its study, whatever they cost.
bool is_of_this_program(const PlannedStudy& planned) {
  const auto runs =
      planned_runs(planned.study, planned.plan.random_seed, replicates_in(planned), [](const Model&) { return 0.0; });
  return std::ranges::equal(runs, planned.plan.runs, [](const PlannedRun& a, const PlannedRun& b) {
    return a.name == b.name && a.layout == b.layout && a.random_seed == b.random_seed;
  });
}

/// By scene, and as the plan has them by random seed.
std::vector<std::vector<const PlannedRun*>> runs_by_scene(const PlannedStudy& planned) {
  std::vector<std::vector<const PlannedRun*>> runs(planned.study.scenes.size());
  for (const PlannedRun& run : planned.plan.runs)
    if (const auto index = static_cast<std::size_t>(run.layout) - 1; index < planned.study.layouts.size())
      if (const auto scene = planned.study.layouts[index].scene) runs[*scene].push_back(&run);
  return runs;
}

}  // namespace

PlannedStudy plan_study(const std::filesystem::path& file, const std::vector<std::string>& sets,
                        std::uint64_t first_random_seed, const std::shared_ptr<SourceFiles>& files) {
  PlannedStudy planned{study_in(file, sets, files), {}};
  planned.plan = {name_in_plan(file, file), sets, first_random_seed, files->planned_texts(file),
                  planned_runs(planned.study, first_random_seed,
                               std::vector<int>(planned.study.scenes.size(), planned.study.replicates.first()))};
  return planned;
}

std::vector<int> replicates_in(const PlannedStudy& planned) {
  std::vector<int> replicates;
  for (const auto& runs : runs_by_scene(planned)) replicates.push_back(static_cast<int>(runs.size()));
  return replicates;
}

StudyResult answer_of_kept(const PlannedStudy& planned, const KeptRuns& kept, int jobs, const OnRuns& on_runs) {
  const std::vector<WantedOfRuns> wanted = wanted_of_runs(planned.study);
  const std::vector<std::vector<const PlannedRun*>> of_scenes = runs_by_scene(planned);
  const auto evaluation = [&](std::size_t scene, const PlannedRun& of) {
    const std::optional<Run> run = kept(of.name);
    return run ? reduced(planned.study.scenes[scene], *run, wanted[scene].curves, wanted[scene].drills)
               : Evaluation{.random_seed = of.random_seed};
  };
  const auto read = [&](std::size_t from, std::size_t to) {
    std::vector<std::vector<Evaluation>> runs;
    std::vector<std::pair<std::size_t, std::size_t>> all;  // scene, and which of its runs
    for (std::size_t scene = from; scene < to; ++scene) {
      runs.emplace_back(of_scenes[scene].size());
      for (std::size_t k = 0; k < of_scenes[scene].size(); ++k) all.emplace_back(scene, k);
    }
    run_in_parallel(jobs, all.size(), [&](std::size_t i) {
      const auto [scene, k] = all[i];
      runs[scene - from][k] = evaluation(scene, *of_scenes[scene][k]);
    });
    return runs;
  };
  StudyResult result = answer_of(planned.study, read, on_runs);
  if (const auto knowledge = knowledge_for(result.study)) expect_rates(result, *knowledge);
  return result;
}

std::optional<PlannedStudy> next_round(const PlannedStudy& planned, const KeptRuns& kept, int jobs) {
  if (!planned.study.replicates.interval) return std::nullopt;
  const StudyResult result = answer_of_kept(planned, kept, jobs);
  const std::vector<int> before = replicates_in(planned);
  std::vector<int> replicates = before;
  for (std::size_t scene = 0; scene < replicates.size(); ++scene)
    if (static_cast<int>(result.runs[scene].size()) == replicates[scene])  // else some were more than enough
      replicates[scene] = runs_to_go_to(rates_of(result.runs[scene]), planned.study.replicates);
  if (replicates == before) return std::nullopt;
  PlannedStudy next = planned;
  next.plan.runs = planned_runs(planned.study, planned.plan.random_seed, replicates);
  return next;
}

PlannedStudy study_of_plan(const StudyPlan& plan) {
  if (std::holds_alternative<OptimiseQuestion>(plan.question))
    throw InputError(fmt::format(
        "{}: vibrosow optimise chooses its layouts as it goes; only the same command again makes their runs",
        plan.study));
  PlannedStudy again{study_in(path_of_planned(plan.study), plan.sets, SourceFiles::of_plan(plan.files)), plan};
  if (!is_of_this_program(again))
    throw InputError(fmt::format(
        "{}: the plan was made by another version of the program, or of the models shipped with it; sweep or submit it "
        "again, which makes a new plan",
        plan.study));
  return again;
}

std::vector<WantedRun> wanted_runs(const PlannedStudy& planned, const std::vector<std::size_t>& which) {
  std::vector<WantedRun> wanted;
  for (const std::size_t k : which) {
    const PlannedRun& run = planned.plan.runs[k];
    const Layout& layout = planned.study.layouts[static_cast<std::size_t>(run.layout) - 1];
    wanted.push_back(
        {&planned.study.scenes[layout.scene.value()], run.random_seed, run.name, run.grain_steps, run.layout});
  }
  return wanted;
}

std::vector<WantedRun> wanted_runs(const PlannedStudy& planned) {
  std::vector<std::size_t> all(planned.plan.runs.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return wanted_runs(planned, all);
}

}  // namespace vibrosow
