#include "cli/sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "cli/console.hpp"
#include "cli/drill_table.hpp"
#include "report/answer_doubts.hpp"
#include "report/expected_report.hpp"
#include "report/layout_text.hpp"
#include "report/sweep_report.hpp"
#include "report/terminal_text.hpp"
#include "scene/spaces.hpp"

namespace vibrosow {
namespace {

std::string mean_text(const MetricMeans& metrics, std::string_view name) {
  const Metric& metric = metric_named(name);
  return with_interval(metrics[metric], metric.unit_size);
}

/// "12.1 (9.3-16)", or "< 6.2" where it is not told from equal holes.
std::string unevenness_cell(const MetricMeans& metrics) {
  const auto text = [&](std::string_view name) {
    const Metric& metric = metric_named(name);
    return metrics[metric] ? to_digits(metrics[metric]->mean / metric.unit_size, 2) : "";
  };
  const std::string high = text("unevenness_cv_percent_high"), cv = mean_text(metrics, "unevenness_cv_percent");
  if (high.empty()) return "";
  if (cv.empty()) return fmt::format("< {}", high);
  return fmt::format("{} ({}-{})", to_digits(metrics["unevenness_cv_percent"]->mean * 100, 3),
                     text("unevenness_cv_percent_low"), high);
}

/// What the table shows of a layout, but for its name; each column is as wide as its longest cell.
using Cells = std::array<std::string, 4>;
const Cells heads = {"g/s", "seeds/s", "raw CV", "CV, %"};

Cells cells_of(const MetricMeans& metrics) {
  return {mean_text(metrics, "rate_g_per_s"), mean_text(metrics, "seeds_per_s"), mean_text(metrics, "raw_cv_percent"),
          unevenness_cell(metrics)};
}

/// A line of the table: a name longer than what the cells leave has lines of its own.
std::string line_of(const std::string& number, const std::string& name, const Cells& cells,
                    const std::array<std::size_t, 4>& widths) {
  const std::string label = fmt::format("{:>3} ", number);
  const std::size_t room =
      terminal_columns - label.size() - std::accumulate(widths.begin(), widths.end(), widths.size());
  const bool fits = name.size() <= room;
  std::string text = fits ? label : wrapped_beside(label, name) + std::string(label.size(), ' ');
  text += fmt::format("{:<{}}", fits ? name : "", room);
  for (std::size_t k = 0; k < cells.size(); ++k) text += fmt::format(" {:>{}}", cells[k], widths[k]);
  return text + '\n';
}

/// Whether its rates of the tray are a slice's.
bool is_slice_of_a_tray(const Scene& scene) {
  return scene.space == Space::two_dimensional && slices_of_tray(scene);
}

void print_remarks(const StudyResult& result, std::size_t layout) {
  const LayoutResult& of = result.layouts[layout];
  const auto scene = result.study.layouts[layout].scene;
  const std::string_view beside = scene && result.study.scenes[*scene].space == Space::two_dimensional ? " (2D)" : "";
  const MetricMeans& metrics = of.metrics;
  if (metrics["tray_rate_g_per_s"])
    print_text(wrapped(fmt::format("tray{}, times {}: {} g/s, {} g/min, {} seeds/s", beside,
                                   mean_text(metrics, "depth_factor"), mean_text(metrics, "tray_rate_g_per_s"),
                                   mean_text(metrics, "tray_rate_g_per_min"), mean_text(metrics, "tray_seeds_per_s")),
                       4));
  if (of.misfit_percent) print("    misfit {} %\n", with_interval(of.misfit_percent, 1));
  if (!of.rows.empty()) print_text(wrapped(sown_sentence(of.rows, beside), 4));
  if (const std::string note = layout_note(of); !note.empty()) print_text(wrapped(note, 4));
}

void print_layouts(const StudyResult& result) {
  std::vector<Cells> rows;
  std::array<std::size_t, 4> widths{};
  for (const LayoutResult& layout : result.layouts) rows.push_back(cells_of(layout.metrics));
  for (std::size_t k = 0; k < widths.size(); ++k) {
    widths[k] = heads[k].size();
    for (const Cells& row : rows) widths[k] = std::max(widths[k], row[k].size());
  }
  print_text(line_of("", "layout", heads, widths));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    print_text(line_of(std::to_string(i + 1), described(result.study, result.study.layouts[i]), rows[i], widths));
    print_remarks(result, i);
  }
}

}  // namespace

void print_sweep_table(const StudyResult& result) {
  const Answer answer = answer_of(result, 1);
  print("{}\n", wrapped(result.study.title));
  if (const std::string doubts = doubts_paragraph(doubts_about(answer)); !doubts.empty()) print("{}\n", doubts);
  print_layouts(result);
  const bool uneven = std::ranges::any_of(
      result.layouts, [](const LayoutResult& one) { return one.metrics["raw_cv_percent"].has_value(); });
  if (uneven)
    print("\n{}", wrapped("CV between the holes, %: raw, and the unevenness (without chance) with its 95 % interval; "
                          "\"<\": no difference beyond chance"));
  if (std::ranges::any_of(result.study.scenes, is_slice_of_a_tray))
    print("\n{}", wrapped("2D: a slice's rate times the depth of the tray; its holes are slots from front to back"));
  if (const std::string expected = expected_paragraph(answer); !expected.empty()) print("\n{}", expected);
  print_trade(result);
  if (!result.comparison) return;
  if (result.study.measured->scale == MeasuredScale::free && result.comparison->scale)
    print("\nscale fitted to the measured outflow: {:.4g}\n", *result.comparison->scale);
  if (!result.comparison->misfit_percent) return;
  const std::size_t compared = compared_series(*result.study.measured),
                    all = result.study.measured->table.series.size();
  print("misfit over {}: {:.3g} %\n", compared == all ? "all rows" : fmt::format("{} of the {} series", compared, all),
        *result.comparison->misfit_percent);
}

}  // namespace vibrosow
