#include "report/page_charts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

constexpr Colour grey{0.45, 0.47, 0.49};
constexpr int curve_points = 400;      // of a curve of counts
constexpr std::size_t most_rows = 40;  // of a ranking
constexpr double least_error = 0.003;  // %, less is no difference that anybody could measure
constexpr double most_overhang = 2;    // an interval ends at the edge beyond so many times the highest value
constexpr const char* not_compared = "not compared";

/// How the name of a column ends that has this unit: "W_per_kg".
std::string suffix_of(const std::string& unit) {
  if (unit == "%") return "percent";
  if (unit.starts_with("1/")) return "per_" + unit.substr(2);
  const std::size_t over = unit.find('/');
  return over == std::string::npos ? unit : unit.substr(0, over) + "_per_" + unit.substr(over + 1);
}

/// "power, W/kg" of power_W_per_kg
std::string title_of(const Json& figure) {
  std::string words = figure.at("name");
  const std::string unit = figure.at("unit");
  if (const std::string end = '_' + suffix_of(unit); words.ends_with(end)) words.resize(words.size() - end.size());
  std::ranges::replace(words, '_', ' ');
  if (words.ends_with(" cv")) words.replace(words.size() - 2, 2, "CV");
  return unit.empty() ? words : fmt::format("{}, {}", words, unit);
}

std::string quantity_title(const std::string& column) {
  static const std::map<std::string, std::string> titles = {{"rate_g_per_s", "rate, g/s"},
                                                            {"seeds_per_s", "rate, seeds/s"},
                                                            {"mass_g", "mass so far, g"},
                                                            {"seeds", "seeds so far"},
                                                            {"discharged_percent", "discharged, %"}};
  const auto known = titles.find(column);
  return known == titles.end() ? column : known->second;
}

/// A layout's mean of a figure, if it has one.
struct LayoutValue {
  const Json* layout;
  double mean;
  std::optional<double> half_width;
  std::optional<ChartInterval> interval() const {
    if (!half_width) return std::nullopt;
    return ChartInterval{mean - *half_width, mean + *half_width};
  }
};

std::optional<LayoutValue> value_of(const Json& layout, const std::string& figure) {
  if (!layout.contains("means")) return std::nullopt;
  const Json& means = layout.at("means");
  if (!means.contains(figure) || means.at(figure).is_null() || means.at(figure).at("mean").is_null())
    return std::nullopt;
  const Json &value = means.at(figure), &half = value.at("half_width");
  return LayoutValue{&layout, value.at("mean"), half.is_null() ? std::nullopt : std::optional<double>(half)};
}

bool is_compared(const Json& layout) {
  return layout.value("compared", layout.at("status") == "ok");
}

/// By what layouts are told apart: their standing, if that was asked for.
std::string group_of(const Json& layout) {
  if (!is_compared(layout)) return not_compared;
  return layout.contains("standing") ? std::string(layout.at("standing")) : "mean";
}

/// The figure that is ranked by; null without one.
const Json* ranking_figure(const Json& data) {
  const Json& figures = data.at("figures");
  const auto first = [&](auto is_it) -> const Json* {
    const auto found = std::ranges::find_if(figures, is_it);
    return found == figures.end() ? nullptr : &*found;
  };
  if (data.at("kind") == "sweep") return first([](const Json& one) { return one.at("name") == "rate_g_per_s"; });
  return first([](const Json& one) { return one.contains("judged") || one.contains("goal"); });
}

std::vector<const Json*> goals_of(const Json& data) {
  std::vector<const Json*> goals;
  for (const Json& figure : data.at("figures"))
    if (figure.contains("goal")) goals.push_back(&figure);
  return goals;
}

/// Standings of one rank have one colour; what has no standing, that of its place.
Colour group_colour(const std::string& group, std::size_t place) {
  static const std::map<std::string, std::size_t> ranks = {
      {"best", 0},  {"on the front", 0}, {"not shown to be worse", 1}, {"may be on the front", 1}, {"undecided", 1},
      {"worse", 3}, {"dominated", 3}};
  if (group == not_compared) return grey;
  const auto known = ranks.find(group);
  return lot_colour(known == ranks.end() ? place : known->second);
}

/// The series of a group, which is made where it is new.
ChartSeries& series_of(Chart& chart, const std::string& group) {
  const auto found = std::ranges::find(chart.series, group, &ChartSeries::name);
  if (found != chart.series.end()) return *found;
  const SeriesStyle style = group == not_compared ? SeriesStyle::hollow_points : SeriesStyle::points;
  chart.series.push_back({group, group_colour(group, chart.series.size()), style, {}});
  return chart.series.back();
}

Chart headed(const Json& data) {
  Chart chart;
  chart.title = data.at("title");
  chart.sentence = data.value("headline", "");
  return chart;
}

Chart outflow_chart(const Json& data) {
  Chart chart = headed(data);
  const double end = data.at("end_time_s");
  chart.x = {.title = "time, s", .range = ChartInterval{0, end > 0 ? end : 1}};
  chart.y.title = "seeds so far";
  const Json &times = data.at("events").at("time_s"), &of_hole = data.at("events").at("hole");
  for (const Json& hole : data.at("holes")) {
    ChartSeries series{
        fmt::format("hole {}", hole.at("hole").get<int>()), lot_colour(chart.series.size()), SeriesStyle::line, {}};
    std::size_t event = 0;
    int counted = 0;
    for (int k = 0; k <= curve_points; ++k) {
      const double until = end * k / curve_points;
      for (; event < times.size() && (times[event] <= until || k == curve_points); ++event)
        counted += of_hole.at(event) == hole.at("hole") ? 1 : 0;
      series.points.push_back({until, static_cast<double>(counted)});
    }
    chart.series.push_back(std::move(series));
  }
  const Json& window = data.at("window_s");
  chart.shades.push_back({"measured", {window.at(0), window.at(1)}});
  return chart;
}

/// Those that have the figure: the ok ones first, in its order.
std::vector<LayoutValue> ranked(const Json& data, const Json& figure) {
  std::vector<LayoutValue> rows;
  for (const Json& layout : data.at("layouts"))
    if (const auto value = value_of(layout, figure.at("name"))) rows.push_back(*value);
  const double sign = figure.value("wanted", "high") == "low" ? 1 : -1;
  std::ranges::stable_sort(
      rows, {}, [&](const LayoutValue& row) { return std::pair(!is_compared(*row.layout), sign * row.mean); });
  return rows;
}

std::string row_name(const Json& layout) {
  const int number = layout.at("number");
  const std::string described = layout.at("described");
  return described.empty() ? fmt::format("{}", number) : fmt::format("{}: {}", number, described);
}

Chart ranking_chart(const Json& data) {
  const Json* figure = ranking_figure(data);
  std::vector<LayoutValue> rows;
  if (figure) rows = ranked(data, *figure);
  if (rows.empty()) throw InputError("--chart ranking: no layout has a value to be ranked by");
  Chart chart = headed(data);
  if (rows.size() > most_rows) {
    chart.sentence += fmt::format(" Shown: the first {} of {}.", most_rows, rows.size());
    rows.resize(most_rows);
  }
  double highest = 0, reach = 0, least = 0;
  for (const LayoutValue& row : rows) {
    const double half = row.half_width.value_or(0);
    highest = std::max(highest, row.mean), reach = std::max(reach, row.mean + half);
    least = std::min(least, row.mean);
  }
  const double end = highest > 0 ? std::min(reach, most_overhang * highest) : reach;
  chart.x = {.title = title_of(*figure) + " (bars: 95 % intervals)",
             .range = ChartInterval{least, end > least ? 1.03 * end : least + 1}};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    chart.y.rows.push_back(row_name(*rows[k].layout));
    series_of(chart, group_of(*rows[k].layout))
        .points.push_back({rows[k].mean, static_cast<double>(k), rows[k].interval()});
  }
  if (const auto first = rows.front().interval(); first && is_compared(*rows.front().layout))
    chart.shades.push_back({"interval of the first", *first});
  return chart;
}

Chart front_chart(const Json& data) {
  const std::vector<const Json*> goals = goals_of(data);
  Chart chart = headed(data);
  chart.x.title = title_of(*goals[0]) + " (bars: 95 % intervals)", chart.y.title = title_of(*goals[1]);
  for (const Json& layout : data.at("layouts")) {
    const auto x = value_of(layout, goals[0]->at("name")), y = value_of(layout, goals[1]->at("name"));
    if (!x || !y) continue;
    ChartPoint point{x->mean, y->mean};
    if (layout.at("standing") == "on the front" || layout.at("first_by_means")) {
      point.of_x = x->interval(), point.of_y = y->interval();
      point.label = fmt::format("{}", layout.at("number").get<int>());
    }
    series_of(chart, group_of(layout)).points.push_back(std::move(point));
  }
  return chart;
}

Chart precision_chart(const Json& data) {
  Chart chart = headed(data);
  std::vector<std::string> sentences;
  for (const Json& one : data.at("headlines")) sentences.push_back(one);
  chart.sentence = fmt::format("{}", fmt::join(sentences, " "));
  const double within = data.at("within_percent");
  ChartInterval times{INFINITY, 0}, sizes{within, within};
  for (const Json& level : data.at("levels")) {
    if (level.at("error").is_null() || !level.contains("cpu_s") || level.at("cpu_s").is_null()) continue;
    const Json& error = level.at("error");
    ChartPoint point{level.at("cpu_s"), std::max(least_error, std::abs(error.at("percent").get<double>()))};
    if (!error.at("band").is_null()) {
      const double size = std::abs(error.at("percent").get<double>()), band = error.at("band");
      point.of_y = ChartInterval{size - band, size + band};
      sizes.high = std::max(sizes.high, size + band);
    }
    const int number = level.at("number");
    point.label = level.at("chosen") ? fmt::format("{} (recommended)", number) : fmt::format("{}", number);
    times = {std::min(times.low, point.x), std::max(times.high, point.x)};
    sizes = {std::min(sizes.low, point.y), std::max(sizes.high, point.y)};
    series_of(chart, level.at("scheme")).points.push_back(std::move(point));
  }
  if (chart.series.empty()) throw InputError("--chart precision: no setting has both an error and a time");
  chart.x = {.title = "CPU time of a run, s", .is_logarithmic = true, .range = times};
  chart.y = {.title = "error of the rate, % (bars: 95 %)", .is_logarithmic = true, .range = sizes};
  chart.lines.push_back({fmt::format("an error of {:g} %", within), 0, within, INFINITY, within});
  return chart;
}

/// Held out values are hollow, and named once.
void add_held_out(Chart& chart, std::vector<ChartPoint> points, const Colour& colour) {
  if (points.empty()) return;
  const std::string name = "held out: predicted, not fitted";
  const bool is_named = std::ranges::count(chart.series, name, &ChartSeries::name) > 0;
  chart.series.push_back({is_named ? "" : name, colour, SeriesStyle::hollow_points, std::move(points)});
}

Chart curves_chart(const Json& data) {
  Chart chart = headed(data);
  chart.x.title = "time, s", chart.y.title = quantity_title(data.at("quantity"));
  std::size_t curves = 0;
  for (const Json& one : data.at("series")) {
    const Colour colour = lot_colour(curves++);
    const std::string conditions = one.at("conditions"), hole = one.at("hole");
    const std::string of = fmt::format("hole {}{}{}", hole, conditions.empty() ? "" : ", ", conditions);
    ChartSeries fitted{of + ", fitted", colour, SeriesStyle::line, {}},
        measured{of + ", measured", colour, SeriesStyle::points, {}};
    std::vector<ChartPoint> held_out;
    for (const Json& value : one.at("values")) {
      const double time = value.at("time_s");
      fitted.points.push_back({time, value.at("predicted")});
      (value.at("held_out") ? held_out : measured.points).push_back({time, value.at("measured")});
    }
    chart.series.push_back(std::move(fitted)), chart.series.push_back(std::move(measured));
    add_held_out(chart, std::move(held_out), colour);
  }
  return chart;
}

Chart rates_chart(const Json& data) {
  Chart chart = headed(data);
  const std::string title = quantity_title(data.at("quantity"));
  chart.x.title = "measured " + title, chart.y.title = "predicted " + title;
  ChartSeries fitted{"fitted, with the 95 % interval of such a measurement", lot_colour(1), SeriesStyle::points, {}};
  std::vector<ChartPoint> held_out;
  double highest = 0;
  for (const Json& one : data.at("series"))
    for (const Json& value : one.at("values")) {
      const ChartPoint point{
          value.at("measured"), value.at("predicted"), {}, ChartInterval{value.at("low"), value.at("high")}};
      highest = std::max({highest, point.x, point.of_y->high});
      (value.at("held_out") ? held_out : fitted.points).push_back(point);
    }
  chart.series.push_back(std::move(fitted));
  add_held_out(chart, std::move(held_out), lot_colour(1));
  const double end = highest > 0 ? 1.05 * highest : 1;
  chart.x.range = chart.y.range = ChartInterval{0, end};
  chart.lines.push_back({"where the two agree", 0, 0, end, end});
  return chart;
}

}  // namespace

std::vector<std::string> chart_names(const Json& data) {
  const std::string kind = data.at("kind");
  if (kind == "run") return {"outflow"};
  if (kind == "accuracy") return {"precision"};
  if (kind == "calibration") return {"fit"};
  if (kind == "front" && goals_of(data).size() > 1) return {"front", "ranking"};
  return {"ranking"};
}

Chart page_chart(const Json& data, const std::string& name) {
  const std::vector<std::string> names = chart_names(data);
  if (std::ranges::find(names, name) == names.end())
    throw InputError(fmt::format("--chart: there is no \"{}\" of this folder, but {}", name, fmt::join(names, ", ")));
  if (name == "outflow") return outflow_chart(data);
  if (name == "front") return front_chart(data);
  if (name == "precision") return precision_chart(data);
  if (name == "fit") return data.at("of_curves") ? curves_chart(data) : rates_chart(data);
  return ranking_chart(data);
}

}  // namespace vibrosow
