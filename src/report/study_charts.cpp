#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "report/layout_text.hpp"
#include "report/page_charts.hpp"
#include "report/study_page.hpp"

namespace vibrosow {
namespace {

constexpr Colour grey{0.45, 0.47, 0.49};
constexpr std::size_t most_rows = 40;  // of a ranking
constexpr double most_overhang = 2;    // an interval ends at the edge beyond so many times the highest value

/// How the name of a column ends that has this unit: "W_per_kg".
std::string suffix_of(const std::string& unit) {
  if (unit == "%") return "percent";
  if (unit.starts_with("1/")) return "per_" + unit.substr(2);
  const std::size_t over = unit.find('/');
  return over == std::string::npos ? unit : unit.substr(0, over) + "_per_" + unit.substr(over + 1);
}

/// "power, W/kg" of power_W_per_kg
std::string title_of(const AnswerMetric& metric) {
  std::string words(metric.name);
  const std::string unit(metric.unit), end = '_' + suffix_of(unit);
  if (words.ends_with(end)) words.resize(words.size() - end.size());
  std::ranges::replace(words, '_', ' ');
  if (words.ends_with(" cv")) words.replace(words.size() - 2, 2, "CV");
  return unit.empty() ? words : fmt::format("{}, {}", words, unit);
}

/// A layout's value of a figure, in its unit.
struct LayoutValue {
  const AnsweredLayout* layout;
  double mean;
  std::optional<ChartInterval> interval;
};

std::optional<LayoutValue> value_of(const Answer& answer, const AnsweredLayout& layout, std::size_t metric) {
  if (layout.values.empty() || !layout.values[metric] || !std::isfinite(layout.values[metric]->mean))
    return std::nullopt;
  const double unit = answer.metrics[metric].unit_size, mean = layout.values[metric]->mean / unit;
  LayoutValue value{&layout, mean, std::nullopt};
  if (const auto half_width = layout.values[metric]->half_width_95)
    value.interval = ChartInterval{mean - *half_width / unit, mean + *half_width / unit};
  return value;
}

std::vector<std::size_t> goals_of(const Answer& answer) {
  std::vector<std::size_t> goals;
  for (std::size_t k = 0; k < answer.metrics.size(); ++k)
    if (answer.metrics[k].is_goal) goals.push_back(k);
  return goals;
}

/// Standings that are told apart by colour: what is surely good, what may be, what is worse, what is not compared; of a
/// sweep none is.
enum class Group { mean, first, alike, worse, not_compared };

Group group_of(LayoutStanding standing) {
  using enum LayoutStanding;
  if (!is_compared(standing)) return Group::not_compared;
  switch (standing) {
    case best:
    case on_front:
      return Group::first;
    case not_shown_worse:
    case undecided:
    case may_be_on_front:
      return Group::alike;
    case worse:
    case dominated:
      return Group::worse;
    default:
      return Group::mean;
  }
}

std::string series_name(LayoutStanding standing) {
  const Group group = group_of(standing);
  if (group == Group::not_compared) return "not compared";
  return group == Group::mean ? "mean" : std::string(name_of(standing));
}

Colour colour_of(Group group) {
  if (group == Group::not_compared) return grey;
  return lot_colour(group == Group::worse ? 3 : group == Group::alike ? 1 : 0);
}

/// The series of a standing, which is made where it is new.
ChartSeries& series_of(Chart& chart, LayoutStanding standing) {
  const std::string name = series_name(standing);
  const auto found = std::ranges::find(chart.series, name, &ChartSeries::name);
  if (found != chart.series.end()) return *found;
  const Group group = group_of(standing);
  const SeriesStyle style = group == Group::not_compared ? SeriesStyle::hollow_points : SeriesStyle::points;
  chart.series.push_back({name, colour_of(group), style, {}});
  return chart.series.back();
}

Chart headed(const StudyPage& page) {
  Chart chart;
  chart.title = page.answer.study->title;
  chart.sentence = page.headline;
  return chart;
}

/// Those that have the figure: the compared ones first, in its order.
std::vector<LayoutValue> ranked(const Answer& answer, std::size_t metric) {
  std::vector<LayoutValue> rows;
  for (const AnsweredLayout& layout : answer.layouts)
    if (const auto value = value_of(answer, layout, metric)) rows.push_back(*value);
  const double sign = answer.metrics[metric].wanted == Wanted::low ? 1 : -1;
  std::ranges::stable_sort(
      rows, {}, [&](const LayoutValue& row) { return std::pair(!is_compared(row.layout->standing), sign * row.mean); });
  return rows;
}

std::string row_name(const Answer& answer, const AnsweredLayout& of) {
  const Layout& layout = answer.study->layouts[of.layout];
  const std::string text = described(*answer.study, layout);
  return text.empty() ? fmt::format("{}", layout.number) : fmt::format("{}: {}", layout.number, text);
}

Chart ranking_chart(const StudyPage& page) {
  const Answer& answer = page.answer;
  const std::vector<std::size_t> goals = goals_of(answer);
  std::vector<LayoutValue> rows;
  if (!goals.empty()) rows = ranked(answer, goals.front());
  if (rows.empty()) throw InputError("--chart ranking: no layout has a value to be ranked by");
  Chart chart = headed(page);
  if (rows.size() > most_rows) {
    chart.sentence += fmt::format(" Shown: the first {} of {}.", most_rows, rows.size());
    rows.resize(most_rows);
  }
  double highest = 0, reach = 0, least = 0;
  for (const LayoutValue& row : rows) {
    highest = std::max(highest, row.mean), reach = std::max(reach, row.interval ? row.interval->high : row.mean);
    least = std::min(least, row.mean);
  }
  const double end = highest > 0 ? std::min(reach, most_overhang * highest) : reach;
  chart.x = {.title = title_of(answer.metrics[goals.front()]) + " (bars: 95 % intervals)",
             .range = ChartInterval{least, end > least ? 1.03 * end : least + 1}};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    chart.y.rows.push_back(row_name(answer, *rows[k].layout));
    series_of(chart, rows[k].layout->standing)
        .points.push_back({rows[k].mean, static_cast<double>(k), rows[k].interval});
  }
  if (rows.front().interval && is_compared(rows.front().layout->standing))
    chart.shades.push_back({"interval of the first", *rows.front().interval});
  return chart;
}

/// Of the first two goals.
Chart front_chart(const StudyPage& page) {
  const Answer& answer = page.answer;
  const std::vector<std::size_t> goals = goals_of(answer);
  Chart chart = headed(page);
  chart.x.title = title_of(answer.metrics[goals[0]]) + " (bars: 95 % intervals)";
  chart.y.title = title_of(answer.metrics[goals[1]]);
  for (const AnsweredLayout& layout : answer.layouts) {
    const auto x = value_of(answer, layout, goals[0]), y = value_of(answer, layout, goals[1]);
    if (!x || !y) continue;
    ChartPoint point{x->mean, y->mean};
    if (layout.is_named) {
      point.of_x = x->interval, point.of_y = y->interval;
      point.label = fmt::format("{}", answer.study->layouts[layout.layout].number);
    }
    series_of(chart, layout.standing).points.push_back(std::move(point));
  }
  return chart;
}

}  // namespace

std::vector<std::string> chart_names(const StudyPage& page) {
  if (page.answer.kind == AnswerKind::search && goals_of(page.answer).size() > 1) return {"front", "ranking"};
  return {"ranking"};
}

Chart study_chart(const StudyPage& page, const std::string& name) {
  const std::vector<std::string> names = chart_names(page);
  if (std::ranges::find(names, name) == names.end()) throw no_such_chart(name, names);
  return name == "front" ? front_chart(page) : ranking_chart(page);
}

}  // namespace vibrosow
