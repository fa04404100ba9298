#pragma once

#include <optional>
#include <string>
#include <vector>

#include "picture/colours.hpp"

namespace vibrosow {

struct ChartInterval {
  double low, high;
};

struct ChartPoint {
  double x, y;
  std::optional<ChartInterval> of_x{}, of_y{};  // drawn as bars
  std::string label{};                          // beside it
};

enum class SeriesStyle { points, hollow_points, line };

struct ChartSeries {
  std::string name;  // in the legend; empty: it is not there
  Colour colour;
  SeriesStyle style = SeriesStyle::points;
  std::vector<ChartPoint> points;
};

/// What a line or a shade is for stands in the legend.
struct ChartLine {
  std::string name;
  double from_x, from_y, to_x, to_y;
};
struct ChartShade {
  std::string name;
  ChartInterval of_x;
};

struct ChartAxis {
  std::string title{};  // with its unit
  bool is_logarithmic = false;
  std::optional<ChartInterval> range{};  // what it shows at least; values beyond it are drawn at its ends
  std::vector<std::string> rows{};       // of the y axis: names of y = 0, 1, .. from the top, in place of numbers
};

/// Figures over one another, with all that is written on them.
struct Chart {
  std::string title;
  std::string sentence{};  // what it says
  ChartAxis x{}, y{};
  std::vector<ChartSeries> series{};
  std::vector<ChartLine> lines{};    // dashed
  std::vector<ChartShade> shades{};  // behind all
};

/// A chart as PNG, or as SVG whose words are text; `width` in pixels. Numbers that are not finite, and of a logarithmic
/// axis those not above 0, are left out. Same chart: the same bytes, with one version of cairo and of the fonts.
std::string chart_png(const Chart& chart, int width);
std::string chart_svg(const Chart& chart, int width);

}  // namespace vibrosow
