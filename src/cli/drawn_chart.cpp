#include "cli/drawn_chart.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "cli/asked_study.hpp"
#include "cli/console.hpp"
#include "cli/report_study.hpp"
#include "design/planned_study.hpp"
#include "report/kept_page.hpp"
#include "report/page.hpp"
#include "report/page_charts.hpp"
#include "report/sweep_page.hpp"
#include "scene/input_error.hpp"
#include "storage/study_plan.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

/// What the page of a study shows, by the runs that are kept.
std::string data_of_study(const fs::path& folder, int jobs) {
  const StudyPlan plan = read_plan(folder.string());
  StudyRuns runs(cases_of(folder.string()));
  if (const auto asked = asked_study(plan)) {
    RoundsOfRuns rounds(runs, std::nullopt, jobs, true);
    if (!asked->lead(rounds)) complain("warning: runs are missing");
    return asked->page_data({}, {});
  }
  const PlannedStudy planned = study_of_plan(plan);
  return sweep_page_data(answer_of_kept(planned, kept_in(runs), jobs), plan.random_seed);
}

}  // namespace

Chart drawn_chart(const fs::path& folder, const std::string& name, int jobs) {
  try {
    const auto kept = kept_page_data(folder);
    return page_chart(kept ? *kept : nlohmann::ordered_json::parse(data_of_study(folder, jobs)), name);
  } catch (const nlohmann::json::exception&) {
    throw InputError(
        fmt::format("{}: was not written by this version of vibrosow", (folder / page_data_name).string()));
  }
}

}  // namespace vibrosow
