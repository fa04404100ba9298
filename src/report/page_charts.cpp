#include "report/page_charts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

constexpr int curve_points = 400;      // of a curve of counts
constexpr double least_error = 0.003;  // %, less is no difference that anybody could measure

std::string quantity_title(const std::string& column) {
  static const std::map<std::string, std::string> titles = {{"rate_g_per_s", "rate, g/s"},
                                                            {"seeds_per_s", "rate, seeds/s"},
                                                            {"mass_g", "mass so far, g"},
                                                            {"seeds", "seeds so far"},
                                                            {"discharged_percent", "discharged, %"}};
  const auto known = titles.find(column);
  return known == titles.end() ? column : known->second;
}

/// The series of a name, which is made where it is new.
ChartSeries& series_of(Chart& chart, const std::string& name) {
  const auto found = std::ranges::find(chart.series, name, &ChartSeries::name);
  if (found != chart.series.end()) return *found;
  chart.series.push_back({name, lot_colour(chart.series.size()), SeriesStyle::points, {}});
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

InputError no_such_chart(const std::string& name, const std::vector<std::string>& names) {
  return InputError(fmt::format("--chart: there is no \"{}\" of this folder, but {}", name, fmt::join(names, ", ")));
}

std::vector<std::string> chart_names(const Json& data) {
  const std::string kind = data.at("kind");
  if (kind == "run") return {"outflow"};
  return {kind == "accuracy" ? "precision" : "fit"};
}

Chart page_chart(const Json& data, const std::string& name) {
  const std::vector<std::string> names = chart_names(data);
  if (std::ranges::find(names, name) == names.end()) throw no_such_chart(name, names);
  if (name == "outflow") return outflow_chart(data);
  if (name == "precision") return precision_chart(data);
  return data.at("of_curves") ? curves_chart(data) : rates_chart(data);
}

}  // namespace vibrosow
