#include "cli/drawn_chart.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "cli/adaptive_study.hpp"
#include "cli/console.hpp"
#include "cli/report_study.hpp"
#include "report/kept_page.hpp"
#include "report/page.hpp"
#include "report/page_charts.hpp"
#include "report/study_page.hpp"
#include "scene/input_error.hpp"
#include "storage/study_plan.hpp"
#include "study/planned_study.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

/// By the runs that are kept.
Chart chart_of_study(const fs::path& folder, const std::string& name, int jobs) {
  const StudyPlan plan = read_plan(folder.string());
  StudyRuns runs(cases_of(folder.string()));
  if (const auto asked = adaptive_study(plan)) {
    RoundExecutor rounds(runs, std::nullopt, jobs, true);
    if (!asked->run_to_decision(rounds)) complain("warning: runs are missing");
    return study_chart(asked->page({}), name);
  }
  const PlannedStudy planned = study_of_plan(plan);
  const StudyResult result = answer_of_kept(planned, runs.kept(), jobs);
  warn_of_lacking_runs(planned, result, folder, jobs);
  return study_chart(study_page(result, plan.random_seed), name);
}

}  // namespace

Chart drawn_chart(const fs::path& folder, const std::string& name, int jobs) {
  try {
    if (const auto kept = kept_page_data(folder)) return page_chart(*kept, name);
  } catch (const nlohmann::json::exception&) {
    throw InputError(
        fmt::format("{}: was not written by this version of vibrosow", (folder / page_data_name).string()));
  }
  return chart_of_study(folder, name, jobs);
}

}  // namespace vibrosow
