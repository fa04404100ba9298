#include "report/documentation.hpp"

#include <fmt/format.h>

#include "report/accuracy_report.hpp"
#include "report/bench_report.hpp"
#include "report/calibration_report.hpp"
#include "report/decision_report.hpp"
#include "report/front_report.hpp"
#include "report/plan_report.hpp"
#include "report/run_report.hpp"
#include "report/sweep_report.hpp"

namespace vibrosow {
namespace {

constexpr const char* introduction = R"(# What the program writes

Made by `vibrosow help columns > docs/reference/output.md`; a test compares the two.

CSV files have one header row, numbers of six digits, and an empty field where a value is undefined. Rates are of the
2D slice, one seed thick, unless their name says `tray`. A column `X_ci95` is the half width of the 95 % interval of
the mean `X` over replicates (Student's t); it is empty for a single run.
)";

std::string described(const FileText& file) {
  const bool json = file.name.ends_with(".json");
  std::string text = fmt::format("\n### `{}`\n\n{}.\n", file.name, file.description);
  if (!file.columns.empty()) text += fmt::format("\n| {} | unit | meaning |\n|---|---|---|\n", json ? "key" : "column");
  for (const ColumnText& column : file.columns)
    text += fmt::format("| `{}` | {} | {} |\n", column.name, column.unit, column.description);
  return text;
}

std::string chapter(const std::string& command, const std::string& does, const std::vector<FileText>& files) {
  std::string text = fmt::format("\n## `vibrosow {}`: {}\n", command, does);
  for (const FileText& file : files) text += described(file);
  return text;
}

}  // namespace

std::string output_documentation() {
  return introduction + chapter("run", "one run of a seeder", run_file_texts()) +
         chapter("sweep", "every layout of a study", sweep_file_texts()) +
         chapter("decide", "the best layout of a study", decision_file_texts()) +
         chapter("optimise", "the Pareto-optimal layouts of a study's ranges", optimise_file_texts()) +
         chapter("accuracy", "what accuracy costs in time", accuracy_file_texts()) +
         chapter("plan", "layouts that sow a crop at a rate", plan_file_texts()) +
         chapter("bench-sheet", "what to measure", bench_file_texts()) +
         chapter("calibrate", "contacts fitted to measured outflow", calibration_file_texts());
}

}  // namespace vibrosow
