#include "design/kept_runs.hpp"

#include "scene/input_error.hpp"
#include "storage/case_file.hpp"

namespace vibrosow {

KeptRuns::KeptRuns(const std::filesystem::path& own, const std::vector<std::filesystem::path>& others)
    : folders_{CaseFolder(own)} {
  for (const std::filesystem::path& other : others) folders_.emplace_back(other);
}

Simulator KeptRuns::around(const Simulator& simulator) {
  return [this, simulator](const Model& model, const SimulationOptions& options) {
    return run(simulator, model, options);
  };
}

Run KeptRuns::run(const Simulator& simulator, const Model& model, const SimulationOptions& options) {
  const std::string identity = case_identity(model.scene, options.random_seed);
  for (const CaseFolder& folder : folders_)
    if (std::optional<Run> kept = folder.find(identity)) {
      if (&folder != &folders_.front()) keep(identity, *kept);
      ++taken_;
      return std::move(*kept);
    }
  Run made = simulator(model, options);
  if (made.status != RunStatus::interrupted) keep(identity, made);
  return made;
}

void KeptRuns::keep(const std::string& identity, const Run& run) {
  try {
    folders_.front().keep(identity, run);
  } catch (const InputError& error) {
    const std::lock_guard lock(mutex_);
    if (not_kept_.empty()) not_kept_ = error.what();
  }
}

std::string KeptRuns::not_kept() const {
  const std::lock_guard lock(mutex_);
  return not_kept_;
}

}  // namespace vibrosow
