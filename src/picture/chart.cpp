#include "picture/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <utility>

#include "picture/pen.hpp"
#include "picture/ticks.hpp"

namespace vibrosow {
namespace {

constexpr Colour grey{0.38, 0.40, 0.42}, grid_grey{0.88, 0.89, 0.90}, shade_grey{0.945, 0.945, 0.93};
constexpr double height_of_plot = 0.48;  // over the width of the picture
constexpr double most_of_rows = 0.34;    // of that width, for the names of rows

/// Broken at spaces where it would be wider.
std::vector<std::string> wrapped_words(const std::string& text, double size, double width) {
  std::vector<std::string> lines;
  std::string line, word;
  const auto end_word = [&] {
    const std::string longer = line.empty() ? word : line + ' ' + word;
    if (!line.empty() && width_of(longer, size) > width)
      lines.push_back(std::exchange(line, word));
    else
      line = longer;
    word.clear();
  };
  for (const char c : text) c == ' ' ? end_word() : word.push_back(c);
  end_word();
  if (!line.empty()) lines.push_back(line);
  return lines;
}

/// Its beginning and an ellipsis where it would be wider.
std::string shortened_words(const std::string& text, double size, double width, bool is_bold = false) {
  if (width_of(text, size, is_bold) <= width) return text;
  std::string begin = text;
  const auto is_inside = [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
  };  // of a character of UTF-8
  while (!begin.empty() && width_of(begin + "…", size, is_bold) > width) {
    while (begin.size() > 1 && is_inside(begin.back())) begin.pop_back();
    begin.pop_back();
  }
  return begin + "…";
}

/// One axis: from values to pixels.
class Scale {
 public:
  Scale(const ChartAxis& axis, const std::vector<double>& values) : is_logarithmic_(axis.is_logarithmic) {
    if (!axis.rows.empty()) {
      ticks_ = {static_cast<double>(axis.rows.size()) - 0.5, -0.5, std::vector<double>(axis.rows.size())};
      std::iota(ticks_.at.begin(), ticks_.at.end(), 0.0);
      return;
    }
    std::vector<double> shown;
    if (axis.range)
      shown = {axis.range->low, axis.range->high};
    else
      std::ranges::copy_if(values, std::back_inserter(shown), [&](double value) { return can_show(value); });
    if (shown.empty()) shown = {is_logarithmic_ ? 1.0 : 0.0, is_logarithmic_ ? 10.0 : 1.0};
    const double low = std::ranges::min(shown), high = std::ranges::max(shown);
    ticks_ = is_logarithmic_ ? logarithmic_ticks(low, high) : linear_ticks(low, high);
    if (axis.range && !is_logarithmic_) {  // as it was asked for
      ticks_.low = low, ticks_.high = high;
      std::erase_if(ticks_.at,
                    [&](double at) { return at < low - 1e-9 * (high - low) || at > high + 1e-9 * (high - low); });
    }
  }

  void lay(double from, double to) { from_ = from, to_ = to; }
  bool can_show(double value) const { return std::isfinite(value) && (!is_logarithmic_ || value > 0); }
  /// Pixels; of what lies beyond, or cannot be shown, the end.
  double at(double value) const {
    const double share = (mapped(value) - mapped(ticks_.low)) / (mapped(ticks_.high) - mapped(ticks_.low));
    return from_ + std::clamp(std::isfinite(share) ? share : 0.0, 0.0, 1.0) * (to_ - from_);
  }
  double low() const { return ticks_.low; }
  const std::vector<double>& ticks() const { return ticks_.at; }

 private:
  double mapped(double value) const {
    if (!is_logarithmic_) return value;
    return std::log10(std::max(value, ticks_.low));
  }

  bool is_logarithmic_;
  Ticks ticks_{};
  double from_ = 0, to_ = 1;
};

std::vector<double> values_of(const Chart& chart, double ChartPoint::*part,
                              std::optional<ChartInterval> ChartPoint::*interval) {
  std::vector<double> values;
  for (const ChartSeries& series : chart.series)
    for (const ChartPoint& point : series.points) {
      values.push_back(point.*part);
      if (point.*interval) values.insert(values.end(), {(point.*interval)->low, (point.*interval)->high});
    }
  return values;
}

class Layout {
 public:
  Layout(const Chart& chart, int width)
      : chart_(chart),
        width_(width),
        letter_(std::max(10.0, width / 72.0)),
        x_(chart.x, values_of(chart, &ChartPoint::x, &ChartPoint::of_x)),
        y_(chart.y, values_of(chart, &ChartPoint::y, &ChartPoint::of_y)) {
    for (const double tick : y_.ticks()) tick_words_.push_back(y_words(tick));
    sentence_ = wrapped_words(chart.sentence, letter_, width_ - 2 * letter_);
    const double top = letter_ * (3.4 + 1.45 * static_cast<double>(sentence_.size()) + (sentence_.empty() ? 0 : 0.6));
    double widest = 0;
    for (const std::string& words : tick_words_) widest = std::max(widest, width_of(words, letter_));
    const double left = letter_ * (1 + (chart.y.title.empty() ? 0 : 2.0) + 0.8) + widest;
    const auto rows = static_cast<double>(chart.y.rows.size());
    const double plot = rows > 0 ? 1.9 * letter_ * rows : height_of_plot * width_;
    left_ = left, right_ = width_ - 2.2 * letter_, top_ = top, bottom_ = top + plot;
    x_.lay(left_, right_), y_.lay(bottom_, top_);
    lay_legend();
    height_ = static_cast<int>(std::ceil(legend_.empty() ? bottom_ + 4.2 * letter_ : legend_.back().y + letter_));
  }

  int height() const { return height_; }

  void draw(Pen& pen) const {
    for (const ChartShade& shade : chart_.shades)
      pen.rectangle(x_.at(shade.of_x.low), top_, x_.at(shade.of_x.high) - x_.at(shade.of_x.low), bottom_ - top_,
                    shade_grey);
    draw_axes(pen);
    for (const ChartLine& line : chart_.lines)
      pen.line({{x_.at(line.from_x), y_.at(line.from_y)}, {x_.at(line.to_x), y_.at(line.to_y)}},
               {grey, line_width(), true});
    for (const ChartSeries& series : chart_.series) draw_series(pen, series);
    draw_labels(pen);
    draw_head(pen);
    draw_legend(pen);
  }

 private:
  struct LegendEntry {
    std::string words;
    std::function<void(Pen&, double x, double y)> sample;
    double x, y;
  };

  double line_width() const { return letter_ / 9; }
  double sample_width() const { return 1.8 * letter_; }

  std::string y_words(double tick) const {
    if (chart_.y.rows.empty()) return fmt::format("{:g}", tick);
    return shortened_words(chart_.y.rows[static_cast<std::size_t>(tick)], letter_, most_of_rows * width_);
  }

  /// From left to right in as many lines as it takes.
  void lay_legend() {
    double x = left_, y = bottom_ + (chart_.x.title.empty() ? 3.2 : 4.9) * letter_;
    const auto add = [&](const std::string& name, std::function<void(Pen&, double, double)> sample) {
      if (name.empty()) return;
      const std::string words = shortened_words(name, letter_, right_ - letter_ - sample_width());
      const double wide = sample_width() + 0.5 * letter_ + width_of(words, letter_);
      if (x > left_ && x + wide > right_) x = left_, y += 1.6 * letter_;
      legend_.push_back({words, std::move(sample), x, y});
      x += wide + 1.6 * letter_;
    };
    for (const ChartSeries& series : chart_.series)
      add(series.name, [this, &series](Pen& pen, double at_x, double at_y) {
        if (is_line(series))
          pen.line({{at_x, at_y}, {at_x + sample_width(), at_y}}, line_of(series));
        else
          draw_point(pen, series, at_x + sample_width() / 2, at_y);
      });
    for (const ChartLine& line : chart_.lines)
      add(line.name, [this](Pen& pen, double at_x, double at_y) {
        pen.line({{at_x, at_y}, {at_x + sample_width(), at_y}}, {grey, line_width(), true});
      });
    for (const ChartShade& shade : chart_.shades)
      add(shade.name, [this](Pen& pen, double at_x, double at_y) {
        pen.rectangle(at_x, at_y - 0.5 * letter_, sample_width(), letter_, shade_grey);
        pen.line({{at_x, at_y - 0.5 * letter_}, {at_x + sample_width(), at_y - 0.5 * letter_}}, {grid_grey, 1});
      });
  }

  void draw_legend(Pen& pen) const {
    for (const LegendEntry& entry : legend_) {
      entry.sample(pen, entry.x, entry.y - 0.35 * letter_);
      pen.words(entry.x + sample_width() + 0.5 * letter_, entry.y, entry.words, {grey, letter_});
    }
  }

  void draw_axes(Pen& pen) const {
    const Stroke thin{grid_grey, std::max(1.0, letter_ / 16)};
    for (const double tick : x_.ticks()) {
      pen.line({{x_.at(tick), top_}, {x_.at(tick), bottom_}}, thin);
      pen.words(x_.at(tick), bottom_ + 1.4 * letter_, fmt::format("{:g}", tick), {grey, letter_, Anchor::middle});
    }
    for (std::size_t k = 0; k < tick_words_.size(); ++k) {
      const double y = y_.at(y_.ticks()[k]);
      pen.line({{left_, y}, {right_, y}}, thin);
      pen.words(left_ - 0.6 * letter_, y + 0.36 * letter_, tick_words_[k], {grey, letter_, Anchor::end});
    }
    pen.line({{left_, bottom_}, {right_, bottom_}}, {grey, std::max(1.0, letter_ / 14)});
    pen.words((left_ + right_) / 2, bottom_ + 3.1 * letter_, shortened_words(chart_.x.title, letter_, right_ - left_),
              {ink, letter_, Anchor::middle});
    if (!chart_.y.title.empty())
      pen.words(1.8 * letter_, (top_ + bottom_) / 2, shortened_words(chart_.y.title, letter_, bottom_ - top_),
                {ink, letter_, Anchor::middle, false, true});
  }

  void draw_head(Pen& pen) const {
    const double size = 1.3 * letter_;
    pen.words(letter_, 2.1 * letter_, shortened_words(chart_.title, size, width_ - 2 * letter_, true),
              {ink, size, Anchor::start, true});
    double y = 3.9 * letter_;
    for (const std::string& line : sentence_) pen.words(letter_, y, line, {grey, letter_}), y += 1.45 * letter_;
  }

  static bool is_line(const ChartSeries& series) { return series.style == SeriesStyle::line; }
  Stroke line_of(const ChartSeries& series) const { return {series.colour, 1.4 * line_width()}; }
  void draw_point(Pen& pen, const ChartSeries& series, double x, double y) const {
    const bool hollow = series.style == SeriesStyle::hollow_points;
    pen.disc(x, y, 0.34 * letter_, hollow ? paper : series.colour, {mixed(series.colour, ink, 0.6), line_width()});
  }

  bool can_show(const ChartPoint& point) const { return x_.can_show(point.x) && y_.can_show(point.y); }

  void draw_series(Pen& pen, const ChartSeries& series) const {
    if (is_line(series)) return draw_line(pen, series);
    for (const ChartPoint& point : series.points)
      if (can_show(point)) draw_intervals(pen, series, point);
    for (const ChartPoint& point : series.points)
      if (can_show(point)) draw_point(pen, series, x_.at(point.x), y_.at(point.y));
  }

  void draw_line(Pen& pen, const ChartSeries& series) const {
    Pen::Points points;
    for (const ChartPoint& point : series.points)
      if (can_show(point)) points.emplace_back(x_.at(point.x), y_.at(point.y));
    if (points.size() > 1) pen.line(points, line_of(series));
  }

  /// Bars with ends; an end beyond the axis has none.
  void draw_intervals(Pen& pen, const ChartSeries& series, const ChartPoint& point) const {
    const Stroke stroke{mixed(series.colour, ink, 0.6), line_width()};
    const double x = x_.at(point.x), y = y_.at(point.y), half = 0.28 * letter_;
    if (point.of_x) {
      pen.line({{x_.at(point.of_x->low), y}, {x_.at(point.of_x->high), y}}, stroke);
      for (const double end : {point.of_x->low, point.of_x->high})
        if (shows_end(x_, end)) pen.line({{x_.at(end), y - half}, {x_.at(end), y + half}}, stroke);
    }
    if (point.of_y) {
      pen.line({{x, y_.at(point.of_y->low)}, {x, y_.at(point.of_y->high)}}, stroke);
      for (const double end : {point.of_y->low, point.of_y->high})
        if (shows_end(y_, end)) pen.line({{x - half, y_.at(end)}, {x + half, y_.at(end)}}, stroke);
    }
  }
  static bool shows_end(const Scale& scale, double end) { return scale.can_show(end) && end >= scale.low(); }

  void draw_labels(Pen& pen) const {
    for (const ChartSeries& series : chart_.series)
      for (const ChartPoint& point : series.points)
        if (!point.label.empty() && can_show(point))
          pen.words(x_.at(point.x) + 0.55 * letter_, y_.at(point.y) - 0.4 * letter_, point.label,
                    {ink, 0.85 * letter_});
  }

  const Chart& chart_;
  double width_, letter_;
  Scale x_, y_;
  std::vector<std::string> tick_words_, sentence_;
  double left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;
  std::vector<LegendEntry> legend_;
  int height_ = 0;
};

}  // namespace

std::string chart_png(const Chart& chart, int width) {
  const Layout layout(chart, width);
  const std::unique_ptr<Pen> pen = png_pen(width, layout.height());
  layout.draw(*pen);
  return pen->file();
}

std::string chart_svg(const Chart& chart, int width) {
  const Layout layout(chart, width);
  const std::unique_ptr<Pen> pen = svg_pen(width, layout.height(), chart.title, chart.sentence);
  layout.draw(*pen);
  return pen->file();
}

}  // namespace vibrosow
