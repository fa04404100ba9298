#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "picture/colours.hpp"

namespace vibrosow {

/// How a line is drawn.
struct Stroke {
  Colour colour;
  double width;  // pixels
  bool is_dashed = false;
};

enum class Anchor { start, middle, end };

/// What words look like.
struct Lettering {
  Colour colour;
  double size;  // pixels
  Anchor anchor = Anchor::start;
  bool is_bold = false;
  bool is_upright = false;  // turned, to be read from below
};

/// Draws on one sheet, in pixels from its upper left.
class Pen {
 public:
  using Points = std::vector<std::pair<double, double>>;

  virtual ~Pen() = default;
  Pen() = default;
  Pen(const Pen&) = delete;
  Pen& operator=(const Pen&) = delete;

  virtual void line(const Points& points, const Stroke& stroke) = 0;
  virtual void rectangle(double x, double y, double width, double height, const Colour& colour) = 0;
  virtual void disc(double x, double y, double radius, const Colour& colour, const Stroke& rim) = 0;
  /// `x`, `y`: of its base line, where the lettering's anchor says.
  virtual void words(double x, double y, const std::string& text, const Lettering& lettering) = 0;
  /// The file.
  virtual std::string file() = 0;
};

/// Of a sheet of white paper. `title` and `description` are for those who do not see it.
std::unique_ptr<Pen> png_pen(int width, int height);
std::unique_ptr<Pen> svg_pen(int width, int height, const std::string& title, const std::string& description);

/// Pixels that a text takes.
double width_of(const std::string& text, double size, bool is_bold = false);

}  // namespace vibrosow
