#include "picture/chart.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace vibrosow {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Chart two_settings() {
  Chart chart;
  chart.title = "Trays";
  chart.sentence = "Two settings were tried.";
  chart.x = {.title = "time, s"};
  chart.y = {.title = "rate, g/s"};
  chart.series = {{"first", lot_colour(0), SeriesStyle::points, {{1, 2, {}, ChartInterval{1.5, 2.5}, "a"}, {3, 4}}},
                  {"second", lot_colour(1), SeriesStyle::line, {{0, 0}, {4, 5}}}};
  chart.lines = {{"wanted", 0, 3, 4, 3}};
  chart.shades = {{"measured", {1, 4}}};
  return chart;
}

std::size_t times_in(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Chart, AllItsWordsAreTextOfTheSvg) {
  const std::string svg = chart_svg(two_settings(), 800);
  for (const char* words : {"Trays", "Two settings were tried.", "time, s", "rate, g/s", "first", "second", "wanted",
                            "measured", "a", "0", "1", "4", "5"})
    EXPECT_THAT(svg, HasSubstr(std::string(">") + words + "<")) << words;
  EXPECT_EQ(times_in(svg, "<circle"), 2U + 1U);  // and in the legend
  EXPECT_EQ(svg, chart_svg(two_settings(), 800));
}

TEST(Chart, PngIsOneOfTheWidth) {
  const std::string png = chart_png(two_settings(), 640);
  EXPECT_THAT(png, StartsWith("\x89PNG"));
  EXPECT_EQ(png.substr(16, 4), std::string("\0\0\x02\x80", 4));
  EXPECT_EQ(png, chart_png(two_settings(), 640));
}

TEST(Chart, HostileWordsStayText) {
  const std::string hostile = "</text><script>alert(1)</script>&\"\x01";
  Chart chart = two_settings();
  chart.title = chart.sentence = chart.x.title = chart.y.title = chart.series[0].name = hostile;
  chart.series[0].points[0].label = chart.lines[0].name = chart.shades[0].name = hostile;
  chart.y.rows = {hostile, "b", "c", "d", "e"};
  const std::string svg = chart_svg(chart, 4000);
  EXPECT_THAT(svg, Not(HasSubstr("<script")));
  EXPECT_THAT(svg, HasSubstr("&lt;script&gt;"));
  EXPECT_EQ(times_in(svg, "\x01"), 0U);
  EXPECT_EQ(times_in(svg, "</text>"), times_in(svg, "<text"));
  EXPECT_NO_THROW(chart_png(chart, 4000));
}

TEST(Chart, RowsStandInTheirOrderAndLongNamesAreCut) {
  Chart chart;
  chart.y.rows = {"layout 7", std::string(500, 'x')};
  chart.series = {{"mean", lot_colour(0), SeriesStyle::points, {{1, 0}, {2, 1}}}};
  const std::string svg = chart_svg(chart, 640);
  EXPECT_THAT(svg, HasSubstr("x…<"));
  EXPECT_THAT(svg, Not(HasSubstr(chart.y.rows[1])));
  EXPECT_LT(svg.find("layout 7"), svg.find("x…<"));
}

TEST(Chart, WhatCannotBeShownIsLeftOut) {
  Chart chart;
  const double none = std::numeric_limits<double>::quiet_NaN();
  chart.x.is_logarithmic = chart.y.is_logarithmic = true;
  chart.series = {{"",
                   lot_colour(0),
                   SeriesStyle::points,
                   {{0, 1}, {1, -1}, {none, 1}, {1, INFINITY}, {2, 3, {}, ChartInterval{-1, 4}}}}};
  const std::string svg = chart_svg(chart, 640);
  EXPECT_EQ(times_in(svg, "<circle"), 1U);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(Chart, OfNothingIsAFrame) {
  EXPECT_THAT(chart_svg({}, 640), StartsWith("<svg"));
  EXPECT_THAT(chart_png({}, 160), StartsWith("\x89PNG"));
}

}  // namespace
}  // namespace vibrosow
