#include "picture/pen.hpp"

#include <cairo.h>
#include <fmt/format.h>

#include <cmath>
#include <new>
#include <numbers>

#include "picture/cairo_bytes.hpp"
#include "picture/escaped_text.hpp"

namespace vibrosow {
namespace {

constexpr double dash = 3, gap = 2.5;  // of a line's width

/// A sheet of cairo's.
class Sheet {
 public:
  Sheet(int width, int height)
      : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), &cairo_surface_destroy),
        to_(cairo_create(surface_.get()), &cairo_destroy) {
    check_cairo(cairo_status(to_.get()));
  }
  cairo_surface_t* surface() const { return surface_.get(); }
  cairo_t* to() const { return to_.get(); }

 private:
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> to_;
};

void set_font(cairo_t* to, double size, bool is_bold) {
  cairo_select_font_face(to, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(to, size);
}

double advance(cairo_t* to, const std::string& text) {
  cairo_text_extents_t size;
  cairo_text_extents(to, text.c_str(), &size);
  check_cairo(cairo_status(to));
  return size.x_advance;
}

class PngPen : public Pen {
 public:
  PngPen(int width, int height) : sheet_(width, height) {
    set(paper);
    cairo_paint(to());
    cairo_set_line_join(to(), CAIRO_LINE_JOIN_ROUND);
  }

  void line(const Points& points, const Stroke& stroke) override {
    for (const auto& [x, y] : points) cairo_line_to(to(), x, y);
    draw(stroke);
  }

  void rectangle(double x, double y, double width, double height, const Colour& colour) override {
    set(colour);
    cairo_rectangle(to(), x, y, width, height);
    cairo_fill(to());
  }

  void disc(double x, double y, double radius, const Colour& colour, const Stroke& rim) override {
    cairo_new_path(to());
    cairo_arc(to(), x, y, radius, 0, 2 * std::numbers::pi);
    set(colour);
    cairo_fill_preserve(to());
    draw(rim);
  }

  void words(double x, double y, const std::string& text, const Lettering& lettering) override {
    set_font(to(), lettering.size, lettering.is_bold);
    set(lettering.colour);
    const double width = advance(to(), text);
    cairo_save(to());
    cairo_translate(to(), x, y);
    if (lettering.is_upright) cairo_rotate(to(), -std::numbers::pi / 2);
    cairo_move_to(to(),
                  lettering.anchor == Anchor::start ? 0
                  : lettering.anchor == Anchor::end ? -width
                                                    : -width / 2,
                  0);
    cairo_show_text(to(), text.c_str());
    cairo_restore(to());
    cairo_new_path(to());
  }

  std::string file() override {
    check_cairo(cairo_status(to()));
    std::string bytes;
    check_cairo(cairo_surface_write_to_png_stream(sheet_.surface(), append_bytes, &bytes));
    return bytes;
  }

 private:
  cairo_t* to() const { return sheet_.to(); }
  void set(const Colour& colour) { cairo_set_source_rgb(to(), colour.red, colour.green, colour.blue); }
  void draw(const Stroke& stroke) {
    const double dashes[] = {dash * stroke.width, gap * stroke.width};
    cairo_set_dash(to(), dashes, stroke.is_dashed ? 2 : 0, 0);
    cairo_set_line_width(to(), stroke.width);
    set(stroke.colour);
    cairo_stroke(to());
  }

  Sheet sheet_;
};

std::string hex(const Colour& colour) {
  const auto part = [](double of_one) { return std::lround(255 * of_one); };
  return fmt::format("#{:02x}{:02x}{:02x}", part(colour.red), part(colour.green), part(colour.blue));
}

class SvgPen : public Pen {
 public:
  SvgPen(int width, int height, const std::string& title, const std::string& description) {
    text_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" "
        "font-family=\"DejaVu Sans, Verdana, sans-serif\">\n<title>{2}</title>\n<desc>{3}</desc>\n",
        width, height, escaped_text(title), escaped_text(description));
    SvgPen::rectangle(0, 0, width, height, paper);
  }

  void line(const Points& points, const Stroke& stroke) override {
    std::string path;
    for (const auto& [x, y] : points) path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", x, y);
    text_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke-linejoin=\"round\"{}/>\n", path, drawn(stroke));
  }

  void rectangle(double x, double y, double width, double height, const Colour& colour) override {
    text_ += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x, y,
                         width, height, hex(colour));
  }

  void disc(double x, double y, double radius, const Colour& colour, const Stroke& rim) override {
    text_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\"{}/>\n", x, y, radius,
                         hex(colour), drawn(rim));
  }

  void words(double x, double y, const std::string& text, const Lettering& lettering) override {
    const char* anchor = lettering.anchor == Anchor::start ? "start"
                         : lettering.anchor == Anchor::end ? "end"
                                                           : "middle";
    const std::string place = lettering.is_upright
                                  ? fmt::format("transform=\"translate({:.2f} {:.2f}) rotate(-90)\"", x, y)
                                  : fmt::format("x=\"{:.2f}\" y=\"{:.2f}\"", x, y);
    text_ += fmt::format("<text {} font-size=\"{:.2f}\" text-anchor=\"{}\" fill=\"{}\"{}>{}</text>\n", place,
                         lettering.size, anchor, hex(lettering.colour),
                         lettering.is_bold ? " font-weight=\"bold\"" : "", escaped_text(text));
  }

  std::string file() override { return text_ + "</svg>\n"; }

 private:
  static std::string drawn(const Stroke& stroke) {
    return fmt::format(" stroke=\"{}\" stroke-width=\"{:.2f}\"{}", hex(stroke.colour), stroke.width,
                       stroke.is_dashed
                           ? fmt::format(" stroke-dasharray=\"{:.2f} {:.2f}\"", dash * stroke.width, gap * stroke.width)
                           : std::string());
  }

  std::string text_;
};

}  // namespace

std::unique_ptr<Pen> png_pen(int width, int height) {
  return std::make_unique<PngPen>(width, height);
}

std::unique_ptr<Pen> svg_pen(int width, int height, const std::string& title, const std::string& description) {
  return std::make_unique<SvgPen>(width, height, title, description);
}

double width_of(const std::string& text, double size, bool is_bold) {
  const Sheet any(1, 1);
  set_font(any.to(), size, is_bold);
  return advance(any.to(), text);
}

}  // namespace vibrosow
