#include "cli/drill_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/console.hpp"
#include "input/key_units.hpp"
#include "report/drill_report.hpp"
#include "report/layout_text.hpp"
#include "report/number_text.hpp"
#include "report/terminal_text.hpp"
#include "scene/si_units.hpp"
#include "study/trade.hpp"

namespace vibrosow {
namespace {

std::string text_of(const RowMetrics& row, std::string_view name) {
  const RowMetric& metric = row_metric_named(name);
  const std::optional<double> value = metric.of({row});
  return value ? number_text(*value / metric.unit_size) : "-";
}

void print_row(const RowMetrics& row) {
  print("{:>6} {:>9} {:>9} {:>8} {:>9} {:>9} {:>9} {:>8}\n", row.row > 0 ? fmt::format("{}", row.row) : "all",
        text_of(row, "rate_g_per_min"), text_of(row, "seeds_per_s"), text_of(row, "kg_per_ha"),
        text_of(row, "seeds_per_m2"), text_of(row, "longest_pause_s"), text_of(row, "multiples_percent"),
        text_of(row, "skips_percent"));
}

std::string spacings_sentence(const RowMetrics& all) {
  if (all.without_spacing != NoSpacings::none) return spacings_note(all.without_spacing);
  return fmt::format(
      "multiples and skips are at the hole, not in the furrow: the fall, the tube and the soil add scatter. Seeds that "
      "came independently of each other (Poisson) would have {:.3g} and {:.3g} %",
      100 * all.poisson_multiples.value_or(0), 100 * all.poisson_skips.value_or(0));
}

/// Of pooled or averaged figures: "174 +- 3".
std::string mean_text(const RowMeans& row, std::string_view name) {
  const std::optional<MeanWithInterval>& mean = row[name];
  if (!mean) return "";
  return with_interval(mean, row_metric_named(name).unit_size);
}

/// "5 mm", "9 Hz".
std::string setting_text(const std::string& key, double value) {
  const auto unit = column_unit(key);
  return fmt::format("{} {}", to_digits(to_column_unit(key, value), 4), unit ? unit->unit : "");
}

/// Of layouts that tell nothing; empty where there are none.
std::string unsound_text(const TradeLine& line) {
  return line.unsound == 0 ? ""
                           : fmt::format("runs of {} of the {} settings are missing or doubtful{}", line.unsound,
                                         line.layouts.size(), line.is_slope ? ", or clogged" : "");
}

std::string turn_down_text(const TradeLine& line, double cv_limit) {
  if (!line.not_excluded && line.unsound > 0) return "no turn-down: " + unsound_text(line);
  if (!line.not_excluded)
    return fmt::format("no turn-down: at no setting do all runs flow with a CV between rows of {:.3g} %",
                       100 * cv_limit);
  const auto range = [&](const TurnDown& of) {
    return fmt::format("{:.3g} to 1, {} to {}", of.ratio, setting_text(line.key, of.from),
                       setting_text(line.key, of.to));
  };
  return fmt::format(
      "turn-down {} where the CV between rows may be within {:.3g} %; {}", range(*line.not_excluded), 100 * cv_limit,
      line.shown ? fmt::format("where it is shown to be: {}", range(*line.shown)) : "it is shown to be at no setting");
}

std::string slope_text(const TradeLine& line) {
  if (!line.slope) return "no slope: " + (line.unsound > 0 ? unsound_text(line) : "nothing flows on level ground");
  const SlopeSensitivity& slope = *line.slope;
  constexpr double per_degree = 100 * degree;  // % of a fraction of a radian's change
  const std::string off_line =
      slope.off_line ? fmt::format("; the rates lie within {:.2g} % of that line", 100 * *slope.off_line) : "";
  return fmt::format("slope: {:+.3g}{} % of the rate a degree{}", slope.change * per_degree,
                     slope.half_width ? fmt::format(" +- {:.2g}", *slope.half_width * per_degree) : "", off_line);
}

}  // namespace

std::string drill_sentence(const Drill& drill) {
  return fmt::format("drill: {} row{}, {:.4g} mm apart, at {:.4g} km/h; {}", drill.rows(), drill.rows() == 1 ? "" : "s",
                     drill.pace.row_spacing * 1e3, drill.pace.speed / kilometre_per_hour,
                     drill.rows_per_hole > 1 ? fmt::format("{} rows share a hole, in equal parts", drill.rows_per_hole)
                     : drill.rows() == static_cast<int>(drill.hole_to_row.size()) ? "each hole feeds a row"
                                                                                  : "several holes feed a row");
}

void print_drill(const DrillMetrics& metrics, Space space) {
  print("\n{}", wrapped(fmt::format("{}{}", drill_sentence(metrics.drill), of_plane(space))));
  print("{:>6} {:>9} {:>9} {:>8} {:>9} {:>9} {:>9} {:>8}\n", "row", "g/min", "seeds/s", "kg/ha", "seeds/m2", "pause s",
        "multipl %", "skips %");
  for (const RowMetrics& row : metrics.rows) print_row(row);
  const RowMetrics& all = metrics.all();
  if (all.between)
    if (const auto unevenness = unevenness_of({&*all.between}))
      print_text(wrapped(unevenness_sentence(*unevenness, "row")));
  print_text(wrapped(spacings_sentence(all)));
}

std::string sown_sentence(const std::vector<RowMeans>& rows, std::string_view beside) {
  const RowMeans& all = rows.back();
  std::vector<std::string> parts;
  parts.push_back(all["kg_per_ha"] ? fmt::format("sown: {} kg/ha, {} seeds/m2{}", mean_text(all, "kg_per_ha"),
                                                 mean_text(all, "seeds_per_m2"), beside)
                                   : std::string("sown: no rate without tray.depth"));
  if (all["raw_cv_percent"])
    parts.push_back(fmt::format("between rows raw CV {} %, of which chance {} %", mean_text(all, "raw_cv_percent"),
                                mean_text(all, "chance_cv_percent")));
  if (all["multiples_percent"])
    parts.push_back(fmt::format("at the hole multiples {} %, skips {} %", mean_text(all, "multiples_percent"),
                                mean_text(all, "skips_percent")));
  return fmt::format("{}", fmt::join(parts, "; "));
}

void print_trade(const StudyResult& result) {
  const std::vector<TradeLine> lines = trade_lines(result);
  if (!lines.empty()) print("\n");
  for (const TradeLine& line : lines) {
    std::vector<int> numbers;
    for (const std::size_t i : line.layouts) numbers.push_back(result.study.layouts[i].number);
    const double limit = result.study.layouts[line.layouts.front()].drill->cv_limit;
    std::string text = line.is_slope ? slope_text(line) : turn_down_text(line, limit);
    const bool tells_something = line.slope || line.not_excluded;
    if (tells_something && line.unsound > 0) text += "; left out: " + unsound_text(line);
    print_text(wrapped(fmt::format("layouts {}, by {}: {}", fmt::join(numbers, ", "), line.key, text)));
  }
}

}  // namespace vibrosow
