#include "cli/drawn_chart.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "cli/asked_study.hpp"
#include "cli/console.hpp"
#include "cli/report_study.hpp"
#include "design/planned_study.hpp"
#include "report/page.hpp"
#include "report/page_charts.hpp"
#include "report/sweep_page.hpp"
#include "scene/checked_json.hpp"
#include "scene/input_error.hpp"
#include "storage/atomic_file.hpp"
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
  return sweep_page_data(result_of_kept(planned, runs, jobs), plan.random_seed);
}

}  // namespace

Chart drawn_chart(const fs::path& folder, const std::string& name, int jobs) {
  std::optional<std::string> kept = text_of_file(folder / page_data_name);
  const std::string text = kept ? std::move(*kept) : data_of_study(folder, jobs);
  try {
    return page_chart(parse_json<nlohmann::ordered_json>(text), name);
  } catch (const nlohmann::json::exception&) {
    throw InputError(
        fmt::format("{}: was not written by this version of vibrosow", (folder / page_data_name).string()));
  }
}

}  // namespace vibrosow
