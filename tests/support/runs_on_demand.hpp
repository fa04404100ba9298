#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "plan/softness.hpp"
#include "scene/input_error.hpp"
#include "study/study_runs.hpp"

namespace vibrosow {

/// As if these runs were kept: each is made when it is asked for. One that is interrupted is not there. The scenes must
/// outlive it.
inline KeptRuns runs_on_demand(const std::vector<WantedRun>& wanted, const Simulator& simulator) {
  std::map<std::string, WantedRun> by_name;
  for (const WantedRun& run : wanted) by_name.emplace(run.name, run);
  return [by_name = std::move(by_name), simulator](const std::string& name) -> std::optional<Run> {
    const auto found = by_name.find(name);
    if (found == by_name.end()) return std::nullopt;
    SimulationOptions options;
    options.random_seed = found->second.random_seed;
    Run run;
    try {
      run = simulator(prepare_to_run(*found->second.scene), options);
    } catch (const InputError& error) {
      run.status = RunStatus::refused, run.stop_reason = error.what();
    }
    run.random_seed = options.random_seed;
    return run.status == RunStatus::interrupted ? std::nullopt : std::optional(std::move(run));
  };
}

}  // namespace vibrosow
