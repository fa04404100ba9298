// The paths and basic shapes of SVG 1.1, chapters 7 to 9.
#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

#include "input/drawing_paths.hpp"
#include "input/read_drawing.hpp"
#include "portable_math/functions.hpp"
#include "scene/input_error.hpp"
#include "scene/printable.hpp"
#include "scene/si_units.hpp"
#include "scene/trimmed.hpp"

namespace vibrosow {
namespace {

using Point = Eigen::Vector2d;
using std::numbers::pi;

/// x' = a x + c y + e, y' = b x + d y + f.
struct Affine {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

  Point operator()(const Point& p) const { return {a * p.x() + c * p.y() + e, b * p.x() + d * p.y() + f}; }
  Affine then_inner(const Affine& i) const {
    return {a * i.a + c * i.b, b * i.a + d * i.b,     a * i.c + c * i.d,
            b * i.c + d * i.d, a * i.e + c * i.f + e, b * i.e + d * i.f + f};
  }
  double turning() const { return a * d - b * c; }
  /// Circles stay circles.
  bool is_similar() const {
    const double size = a * a + b * b, slack = 1e-9 * size;
    return std::abs(size - (c * c + d * d)) <= slack && std::abs(a * c + b * d) <= slack;
  }
};

/// Numbers and letters of an attribute, one by one.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : text_(text) {}

  bool at_end() { return skip(), text_.empty(); }
  bool at_letter() {
    skip();
    return !text_.empty() && ((text_[0] >= 'a' && text_[0] <= 'z') || (text_[0] >= 'A' && text_[0] <= 'Z'));
  }
  char letter() {
    skip();
    const char first = text_.empty() ? '\0' : text_[0];
    if (first != '\0') text_.remove_prefix(1);
    return first;
  }
  std::optional<double> number() {
    skip();
    if (text_.starts_with('+')) text_.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return value;
  }
  /// 0 or 1, which may stand without a space before what follows.
  std::optional<bool> flag() {
    skip();
    if (text_.empty() || (text_[0] != '0' && text_[0] != '1')) return std::nullopt;
    return letter() == '1';
  }
  /// The word up to a bracket.
  std::string_view word() {
    skip();
    const std::size_t end = std::min(text_.find('('), text_.size());
    const std::string_view word = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    return word.substr(0, std::min(word.find_last_not_of(" \t\r\n") + 1, word.size()));
  }
  std::string_view rest() const { return text_; }

 private:
  void skip() {
    const std::size_t from = text_.find_first_not_of(" \t\r\n,");
    text_.remove_prefix(from == std::string_view::npos ? text_.size() : from);
  }
  std::string_view text_;
};

/// What comes before a sign; it and the sign are taken off.
std::string_view taken_to(std::string_view& rest, char sign) {
  const std::size_t end = std::min(rest.find(sign), rest.size());
  const std::string_view before = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return trimmed(before);
}

/// The last value of a property among declarations such as "fill: none; display: none !important".
std::string_view declared(std::string_view declarations, std::string_view name) {
  std::string_view found;
  while (!declarations.empty()) {
    std::string_view value = taken_to(declarations, ';');
    if (taken_to(value, ':') == name) found = taken_to(value, '!');
  }
  return found;
}

/// Rules of style sheets whose selectors are an element's name, ".class", "#id" or "*".
class StyleRules {
 public:
  /// What is wrong with a sheet: another selector, or a rule for some media alone; "": all rules were added.
  std::string add(std::string text) {
    for (std::size_t at; (at = text.find("/*")) != std::string::npos;)
      text.erase(at, std::min(text.find("*/", at + 2), text.size()) + 2 - at);
    for (std::string_view rest = text; !trimmed(rest).empty();) {
      std::string_view selectors = taken_to(rest, '{');
      const std::string declarations(taken_to(rest, '}'));
      const bool font = selectors == "@font-face";
      while (!selectors.empty() && !font) {
        const std::string selector(taken_to(selectors, ','));
        constexpr std::string_view signs = " \t\r\n>+~:[@.#*";
        if (selector.empty() || (selector != "*" && selector.find_first_of(signs, 1) != std::string::npos) ||
            selector[0] == '@' || selector[0] == ':' || selector[0] == '[')
          return fmt::format("\"{}\" is no name, .class or #id: such a rule is not read; put it into the shapes",
                             printable(selector));
        if (rules_.size() == most_rules) return fmt::format("has more than {} rules", most_rules);
        rules_.push_back({selector, declarations});
      }
    }
    return "";
  }

  /// Of ids before that of classes before that of names; of alike the last.
  std::string_view property(std::string_view element, std::string_view id, std::string_view classes,
                            std::string_view name) const {
    std::string_view found;
    int rank = -1;
    for (const Rule& rule : rules_) {
      const int of_rule = rank_of(rule.selector, element, id, classes);
      const std::string_view value =
          of_rule < std::max(rank, 0) ? std::string_view() : declared(rule.declarations, name);
      if (!value.empty()) found = value, rank = of_rule;
    }
    return found;
  }

 private:
  static constexpr std::size_t most_rules = 500;  // each shape is compared with each
  struct Rule {
    std::string selector, declarations;
  };

  /// How closely a selector says an element; -1: it does not.
  static int rank_of(std::string_view selector, std::string_view element, std::string_view id,
                     std::string_view classes) {
    const std::string_view word = selector.substr(1);
    if (selector == "*") return 0;
    if (selector[0] == '#') return word == id ? 3 : -1;
    if (selector[0] != '.') return selector == element ? 1 : -1;
    while (!(classes = trimmed(classes)).empty()) {
      const std::size_t end = std::min(classes.find_first_of(" \t\r\n"), classes.size());
      if (classes.substr(0, end) == word) return 2;
      classes.remove_prefix(end);
    }
    return -1;
  }

  std::vector<Rule> rules_;
};

class Svg {
 public:
  Svg(const std::string& file, const SvgScale& scale) : file_(file), scale_(scale) {}

  DrawnPieces read(const std::string& text) {
    tinyxml2::XMLDocument document;
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS)
      fail(document.ErrorLineNum(), fmt::format("is no XML: {}", document.ErrorIDToName(document.ErrorID())));
    const tinyxml2::XMLElement* root = document.RootElement();
    if (!root) fail(1, "is no SVG drawing");  // a comment alone
    if (name_of(*root) != "svg") fail(root->GetLineNum(), "is no SVG drawing");
    for (const tinyxml2::XMLNode* node = document.FirstChild(); node; node = node->NextSibling())
      if (node->ToDeclaration() && std::string_view(node->Value()).starts_with("xml-stylesheet"))
        fail(node->GetLineNum(), "has a style sheet in another file, which is not read");
    add_rules(*root);
    add_children(*root, view(*root), seen(*root, {}));
    return {std::move(pieces_), {}, left_out_.lines()};
  }

 private:
  using Element = tinyxml2::XMLElement;

  [[noreturn]] void fail(int line, const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", file_, line, message));
  }
  [[noreturn]] void fail(const Element& element, const std::string& message) const {
    fail(element.GetLineNum(), fmt::format("{}: {}", element.Name(), message));
  }

  /// Of all style sheets in it, before any shape is looked at.
  void add_rules(const Element& parent) {
    for (const Element* child = parent.FirstChildElement(); child; child = child->NextSiblingElement()) {
      add_rules(*child);
      if (name_of(*child) != "style") continue;
      for (const tinyxml2::XMLNode* text = child->FirstChild(); text; text = text->NextSibling())
        if (const std::string wrong = text->ToText() ? rules_.add(text->Value()) : ""; !wrong.empty())
          fail(*child, wrong);
    }
  }

  /// Without the prefix of a namespace.
  static std::string_view name_of(const Element& element) {
    const std::string_view name = element.Name();
    return name.starts_with("svg:") ? name.substr(4) : name;
  }

  double number(const Element& element, const char* name, std::optional<double> otherwise) const {
    const char* text = element.Attribute(name);
    if (!text && otherwise) return *otherwise;
    if (!text) fail(element, fmt::format("{} is missing", name));
    Tokens tokens(text);
    const std::optional<double> value = tokens.number();
    if (!value || !(tokens.at_end() || tokens.rest() == "px"))
      fail(element, fmt::format("{}: \"{}\" is no number", name, text));
    return *value;
  }

  /// A length with its unit, m; none without a unit that is a length.
  std::optional<double> length(const Element& root, const char* name) const {
    const char* text = root.Attribute(name);
    if (!text) return std::nullopt;
    Tokens tokens(text);
    const std::optional<double> value = tokens.number();
    constexpr std::array<std::pair<std::string_view, double>, 6> units{
        {{"mm", 1e-3}, {"cm", 1e-2}, {"in", 0.0254}, {"pt", 0.0254 / 72}, {"pc", 0.0254 / 6}, {"m", 1}}};
    for (const auto& [unit, size] : units)
      if (value && tokens.rest() == unit) return *value * size;
    return std::nullopt;
  }

  /// From user units to m: the view's lower left becomes the zero, y goes up.
  Affine view(const Element& root) const {
    double x = 0, y = 0, width = 0, height = 0;
    const std::optional<double> wide = length(root, "width"), high = length(root, "height");
    if (const char* box = root.Attribute("viewBox")) {
      Tokens tokens(box);
      for (double* value : {&x, &y, &width, &height}) {
        const std::optional<double> read = tokens.number();
        if (!read) fail(root, fmt::format("viewBox: \"{}\" is not four numbers", box));
        *value = *read;
      }
      if (!(width > 0 && height > 0)) fail(root, "viewBox: has no width or height");
    } else {
      const bool plain = root.Attribute("height") && !high;
      if (!plain) fail(root, "has no viewBox: how long is its unit?");
      height = number(root, "height", std::nullopt);
    }
    const double unit = scale_.scale * unit_of(root, wide, high, width, height);
    return {unit, 0, 0, -unit, -unit * x, unit * (y + height)};
  }

  double unit_of(const Element& root, const std::optional<double>& wide, const std::optional<double>& high,
                 double width, double height) const {
    std::optional<double> own;
    if (high && height > 0) own = *high / height;
    if (wide && width > 0) own = *wide / width;
    if (high && wide && std::abs(*wide / width - *high / height) > 1e-3 * *own)
      fail(root, "width and height stretch the viewBox");
    if (!own && !scale_.unit)
      fail(root, "its width has no unit such as mm: pieces.unit has to say how long a user unit is");
    if (own && scale_.unit && std::abs(*own - *scale_.unit) > 1e-9 * *own)
      fail(root, fmt::format("a user unit is {:g} mm long, which pieces.unit contradicts", 1e3 * *own));
    return own ? *own : *scale_.unit;
  }

  Affine transformed(const Element& element, Affine outer) const {
    const char* text = element.Attribute("transform");
    if (!text) return outer;
    const std::string_view all = text;
    Tokens tokens(all);
    while (!tokens.at_end()) {
      const std::string_view word = tokens.word();
      std::vector<double> v;
      while (const auto value = tokens.number()) v.push_back(*value);
      if (tokens.letter() != ')') fail(element, fmt::format("transform: \"{}\" cannot be read", all));
      outer = outer.then_inner(transform(element, word, v));
    }
    return outer;
  }

  Affine transform(const Element& element, std::string_view word, const std::vector<double>& v) const {
    const std::size_t n = v.size();
    if (word == "matrix" && n == 6) return {v[0], v[1], v[2], v[3], v[4], v[5]};
    if (word == "translate" && (n == 1 || n == 2)) return {1, 0, 0, 1, v[0], n == 2 ? v[1] : 0};
    if (word == "scale" && (n == 1 || n == 2)) return {v[0], 0, 0, n == 2 ? v[1] : v[0], 0, 0};
    if (word == "rotate" && (n == 1 || n == 3)) {
      const auto [sine, cosine] = portable_math::sine_cosine(v[0] * degree);
      const Affine turn{cosine, sine, -sine, cosine, 0, 0};
      if (n == 1) return turn;
      return Affine{1, 0, 0, 1, v[1], v[2]}.then_inner(turn).then_inner({1, 0, 0, 1, -v[1], -v[2]});
    }
    if (word == "skewX" && n == 1) return {1, 0, portable_math::tan(v[0] * degree), 1, 0, 0};
    if (word == "skewY" && n == 1) return {1, portable_math::tan(v[0] * degree), 0, 1, 0, 0};
    fail(element, fmt::format("transform: {} with {} numbers cannot be read", word, n));
  }

  /// Of an element's style sheets, style and attributes.
  std::string_view property(const Element& element, std::string_view name) const {
    const char* style = element.Attribute("style");
    std::string_view found = declared(style ? style : "", name);
    if (found.empty())
      found = rules_.property(name_of(element), attribute(element, "id"), attribute(element, "class"), name);
    return found.empty() ? attribute(element, name) : found;
  }
  static std::string_view attribute(const Element& element, std::string_view name) {
    const char* text = element.Attribute(std::string(name).c_str());
    return text ? trimmed(text) : std::string_view();
  }

  /// What cuts shapes off, moves or makes them by a style is not read.
  void check_styles(const Element& element) const {
    for (const std::string_view name : {"clip-path", "mask"})
      if (const auto value = property(element, name); !value.empty() && value != "none")
        fail(element, fmt::format("{}: cannot be read; cut the paths themselves", name));
    for (const std::string_view name : {"transform", "transform-origin",
                                        "translate", "rotate",
                                        "scale",     "offset-path",
                                        "d",         "points",
                                        "x",         "y",
                                        "x1",        "y1",
                                        "x2",        "y2",
                                        "cx",        "cy",
                                        "r",         "rx",
                                        "ry",        "width",
                                        "height"})
      if (property(element, name) != attribute(element, name) ||
          (name == "transform-origin" && element.Attribute("transform-origin")))
        fail(element, fmt::format("style: {}: cannot be read; make it an attribute, or apply it to the path", name));
  }

  /// What is inherited of how a shape is seen: colours, how they cover, and the line's width.
  struct Seen {
    bool visible = true, stroke = true, stroke_covers = true, wide = true, fill = true, fill_covers = true;
  };

  /// With all that is in it.
  bool is_hidden(const Element& element) const {
    return property(element, "display") == "none" || is_zero(property(element, "opacity"));
  }
  static bool is_zero(std::string_view value) {
    Tokens tokens(value);
    return !tokens.at_end() && tokens.number() == 0.0;
  }

  /// Unlike the above, what is in it may be seen again. Where nothing is said of a stroke, a line is meant to be there.
  Seen seen(const Element& element, Seen how) const {
    const auto take = [&](const char* name, bool& is_there, const auto& is_none) {
      const std::string_view value = property(element, name);
      if (!value.empty() && value != "inherit") is_there = !is_none(value);
    };
    const auto colourless = [](std::string_view value) { return value == "none" || value == "transparent"; };
    take("visibility", how.visible, [](std::string_view value) { return value == "hidden" || value == "collapse"; });
    take("stroke", how.stroke, colourless), take("fill", how.fill, colourless);
    take("stroke-opacity", how.stroke_covers, is_zero), take("fill-opacity", how.fill_covers, is_zero);
    take("stroke-width", how.wide, is_zero);
    return how;
  }
  static bool is_seen(const Element& element, const Seen& how) {
    const bool filled = how.fill && how.fill_covers && name_of(element) != "line";
    return how.visible && ((how.stroke && how.stroke_covers && how.wide) || filled);
  }

  static bool is_shape(std::string_view name) {
    constexpr std::array<std::string_view, 7> shapes = {"path", "line",   "polyline", "polygon",
                                                        "rect", "circle", "ellipse"};
    return std::ranges::find(shapes, name) != shapes.end();
  }

  /// Counts the shapes in what nobody sees.
  void leave_out(const Element& element) {
    if (is_shape(name_of(element))) left_out_.add(fmt::format("{}, hidden", name_of(element)));
    for (const Element* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
      leave_out(*child);
  }

  void add_children(const Element& parent, const Affine& outer, const Seen& how) {
    for (const Element* child = parent.FirstChildElement(); child; child = child->NextSiblingElement()) {
      const std::string_view name = name_of(*child);
      const Seen here = seen(*child, how);
      const bool group = name == "g" || name == "a";
      const bool unseen = is_shape(name) ? !is_seen(*child, here) : !group && !here.visible;
      if (is_hidden(*child) || unseen) {
        leave_out(*child);
        continue;
      }
      if (group || is_shape(name)) check_styles(*child);
      group ? add_children(*child, transformed(*child, outer), here) : add(*child, transformed(*child, outer));
    }
  }

  void add(const Element& element, const Affine& to_m) {
    const std::string_view name = name_of(element);
    if (name == "text" || name == "flowRoot") return left_out_.add(std::string(name));
    for (const std::string_view undrawn : {"use", "image", "svg", "switch", "foreignObject"})
      if (name == undrawn) fail(element, "cannot be read; turn it into paths");
    if (name == "path") return add_path(element, to_m);
    if (name == "line")
      return add_line({number(element, "x1", 0), number(element, "y1", 0)},
                      {number(element, "x2", 0), number(element, "y2", 0)}, to_m);
    if (name == "polyline" || name == "polygon") return add_polyline(element, to_m, name == "polygon");
    if (name == "rect") return add_rectangle(element, to_m);
    if (name == "circle" || name == "ellipse") return add_ellipse(element, to_m, name == "circle");
    // What is left draws nothing: defs, metadata, title and the like.
  }

  void add_line(const Point& a, const Point& b, const Affine& to_m) {
    if (a != b) pieces_.push_back(line_piece(to_m(a), to_m(b)));
  }

  void add_polyline(const Element& element, const Affine& to_m, bool closed) {
    const char* text = element.Attribute("points");
    Tokens tokens(text ? text : "");
    std::vector<Point> points;
    while (!tokens.at_end()) {
      const auto x = tokens.number(), y = tokens.number();
      if (!x || !y) fail(element, "points: are not pairs of numbers");
      points.emplace_back(*x, *y);
    }
    for (std::size_t k = 1; k < points.size(); ++k) add_line(points[k - 1], points[k], to_m);
    if (closed && points.size() > 2) add_line(points.back(), points.front(), to_m);
  }

  void add_rectangle(const Element& element, const Affine& to_m) {
    if (element.Attribute("rx") || element.Attribute("ry")) fail(element, "has round corners; turn it into a path");
    const double x = number(element, "x", 0), y = number(element, "y", 0);
    const double width = number(element, "width", std::nullopt), height = number(element, "height", std::nullopt);
    const std::array<Point, 4> corners{{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}};
    for (std::size_t k = 0; k < 4; ++k) add_line(corners[k], corners[(k + 1) % 4], to_m);
  }

  void add_ellipse(const Element& element, const Affine& to_m, bool is_circle) {
    const Point centre(number(element, "cx", 0), number(element, "cy", 0));
    const double rx = number(element, is_circle ? "r" : "rx", std::nullopt);
    const double ry = is_circle ? rx : number(element, "ry", std::nullopt);
    if (!(rx > 0 && ry > 0)) fail(element, "has no radius");
    add_arc(centre, rx, ry, 0, 0, 2 * pi, to_m);
  }

  /// From the parameter `from` by `by` (rad) of the ellipse, whose axes are turned by `tilt`.
  void add_arc(const Point& centre, double rx, double ry, double tilt, double from, double by, const Affine& to_m) {
    const auto [sine, cosine] = portable_math::sine_cosine(tilt);
    const Affine own{cosine * rx, sine * rx, -sine * ry, cosine * ry, centre.x(), centre.y()};  // of the unit circle
    const Affine all = to_m.then_inner(own);
    const auto at = [&](double parameter) {
      const auto [y, x] = portable_math::sine_cosine(parameter);
      return all({x, y});
    };
    if (all.is_similar()) {
      WallPiece arc = arc_piece(all({0, 0}), at(from), at(from + by), (by > 0) == (all.turning() > 0));
      if (std::abs(by) >= 2 * pi) arc.from = 0, arc.to = 2 * pi;
      pieces_.push_back(arc);
      return;
    }
    // The sagitta of a chord is r (1 - cos(half its angle)), at most that of the longer axis.
    const double longest_axis = std::sqrt(all.a * all.a + all.b * all.b + all.c * all.c + all.d * all.d);
    const double step = 2 * portable_math::acos(1 - std::min(1.0, scale_.tolerance / longest_axis));
    const int count = 1 + static_cast<int>(std::min(1e5, std::abs(by) / step));
    constexpr std::size_t most = 200'000;  // a vessel has fewer by far, and a short text may ask for any number
    if (pieces_.size() > most) fail(1, "draws too many pieces; a larger tolerance makes fewer");
    for (int k = 0; k < count; ++k)
      pieces_.push_back(line_piece(at(from + by * k / count), at(from + by * (k + 1) / count)));
  }

  /// SVG 1.1, F.6.5: the centre of an arc of which the ends are known.
  void add_arc_between(const Point& a, const Point& b, double rx, double ry, double tilt, bool large, bool positive,
                       const Affine& to_m) {
    if (a == b) return;
    if (rx == 0 || ry == 0) return add_line(a, b, to_m);
    rx = std::abs(rx), ry = std::abs(ry);
    const auto [sine, cosine] = portable_math::sine_cosine(tilt);
    const Point half = 0.5 * (a - b), middle = 0.5 * (a + b);
    // On the circle of radius 1 that the ellipse becomes.
    Point p((cosine * half.x() + sine * half.y()) / rx, (-sine * half.x() + cosine * half.y()) / ry);
    const double length2 = p.squaredNorm();
    if (length2 > 1) rx *= std::sqrt(length2), ry *= std::sqrt(length2), p /= std::sqrt(length2);
    const double away = std::sqrt(std::max(0.0, 1 / p.squaredNorm() - 1)) * (large == positive ? -1 : 1);
    const Point c(away * p.y(), -away * p.x());
    const Point begin = p - c, end = -p - c;
    const double from = portable_math::atan2(begin.y(), begin.x());
    double by = portable_math::atan2(end.y(), end.x()) - from;
    if (positive && by <= 0) by += 2 * pi;
    if (!positive && by >= 0) by -= 2 * pi;
    const Point centre(cosine * rx * c.x() - sine * ry * c.y() + middle.x(),
                       sine * rx * c.x() + cosine * ry * c.y() + middle.y());
    add_arc(centre, rx, ry, tilt, from, by, to_m);
  }

  /// Where the pen is while a path is read.
  struct Pen {
    Point at{0, 0}, begin{0, 0}, control{0, 0};
    char last = 'M';
  };

  void add_path(const Element& element, const Affine& to_m) {
    const char* text = element.Attribute("d");
    if (!text) return;
    Tokens tokens(text);
    Pen pen;
    char command = '\0';
    while (!tokens.at_end()) {
      if (tokens.at_letter())
        command = tokens.letter();
      else if (command == '\0' || command == 'z' || command == 'Z')
        fail(element, "d: numbers stand where a command is expected");
      add_command(element, command, tokens, pen, to_m);
      if (command == 'M') command = 'L';
      if (command == 'm') command = 'l';
    }
  }

  void add_command(const Element& element, char command, Tokens& tokens, Pen& pen, const Affine& to_m) {
    const bool relative = command >= 'a';
    const char kind = relative ? static_cast<char>(command - 'a' + 'A') : command;
    const auto next = [&] {
      if (const auto value = tokens.number()) return *value;
      fail(element, fmt::format("d: a number is missing after {}", command));
    };
    const auto next_flag = [&] {
      if (const auto value = tokens.flag()) return *value;
      fail(element, "d: an arc's flag is neither 0 nor 1");
    };
    const auto point = [&] {
      const double x = next(), y = next();
      return relative ? Point(pen.at + Point(x, y)) : Point(x, y);
    };
    const auto curve = [&](const Point& b, const Point& c, const Point& d) {
      add_bezier(to_m(pen.at), to_m(b), to_m(c), to_m(d), scale_.tolerance, pieces_);
      pen.at = d;
    };
    const auto line_to = [&](const Point& to) { add_line(pen.at, to, to_m), pen.at = to; };
    const auto mirrored = [&](std::string_view after) {
      return after.find(pen.last) != std::string_view::npos ? Point(2 * pen.at - pen.control) : pen.at;
    };
    const auto quadratic = [&](const Point& control, const Point& to) {
      const Point from = pen.at;
      curve(from + 2.0 / 3 * (control - from), to + 2.0 / 3 * (control - to), to);
      pen.control = control;
    };
    switch (kind) {
      case 'M':
        pen.at = pen.begin = point();
        break;
      case 'L':
        line_to(point());
        break;
      case 'H':
        line_to({next() + (relative ? pen.at.x() : 0), pen.at.y()});
        break;
      case 'V':
        line_to({pen.at.x(), next() + (relative ? pen.at.y() : 0)});
        break;
      case 'Z':
        line_to(pen.begin);
        break;
      case 'C':
      case 'S': {
        const Point b = kind == 'C' ? point() : mirrored("CS");
        const Point c = point(), d = point();
        curve(b, c, d);
        pen.control = c;
        break;
      }
      case 'Q':
      case 'T': {
        const Point control = kind == 'Q' ? point() : mirrored("QT");
        quadratic(control, point());
        break;
      }
      case 'A': {
        const double rx = next(), ry = next(), tilt = next() * degree;
        const bool large = next_flag(), positive = next_flag();
        const Point to = point();
        add_arc_between(pen.at, to, rx, ry, tilt, large, positive, to_m);
        pen.at = to;
        break;
      }
      default:
        fail(element, fmt::format("d: there is no command {}", command));
    }
    pen.last = kind;
  }

  const std::string& file_;
  SvgScale scale_;
  StyleRules rules_;
  std::vector<WallPiece> pieces_;
  Tally left_out_;
};

}  // namespace

DrawnPieces read_svg(const std::string& text, const std::string& file, const SvgScale& scale) {
  return Svg(file, scale).read(text);
}

}  // namespace vibrosow
