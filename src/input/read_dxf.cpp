// AutoCAD's exchange format as text: lines in pairs, a group's code and its value.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>
#include <utility>

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

struct Group {
  int code = 0;
  std::string_view value;
  int line = 0;  // of the value
};

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
  return whole ? std::optional(value) : std::nullopt;
}

/// Of flags, whether the first is set.
bool is_odd(double flags) {
  return std::fmod(std::abs(flags), 2) == 1;
}

/// One entity, or a variable of the header: its groups after the one that names it.
struct Record {
  std::string_view name;
  int line;
  std::vector<Group> groups;
};

class Dxf {
 public:
  Dxf(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  DxfDrawing read() {
    if (text_.starts_with("AutoCAD Binary DXF")) fail(1, "is a binary DXF file; save it as text");
    bool any = false;
    std::string_view section;
    for (Group group = next(); !(group.code == 0 && group.value == "EOF"); group = next()) {
      if (group.code == 0 && group.value == "SECTION") {
        section = next().value, any = any || section == "ENTITIES";
      } else if (section == "HEADER" && group.code == 9 && group.value == "$INSUNITS") {
        drawing_.unit = unit(next());
      } else if (section == "TABLES" && group.code == 0 && group.value == "LAYER") {
        note_layer(record(group));
      } else if (section == "ENTITIES" && group.code == 0 && group.value != "ENDSEC") {
        entities_.push_back(record(group));
      } else if (group.code == 0 && group.value == "ENDSEC") {
        section = {};
      }
    }
    if (!any) fail(line_, "has no section ENTITIES: it is no drawing");
    // Layers may be told after what lies on them.
    for (const Record& entity : entities_) add(entity);
    drawing_.left_out = left_out_.lines();
    return std::move(drawing_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", file_, line, message));
  }

  std::string_view next_line() {
    if (at_ >= text_.size()) fail(line_, "ends before its EOF");
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = trimmed(text_.substr(at_, end - at_));
    at_ = end + 1;
    ++line_;
    return line;
  }

  Group next() {
    const std::string_view code = next_line();
    const std::optional<double> number = number_of(code);
    if (!number || std::abs(*number) > 2000 || *number != std::floor(*number))
      fail(line_, fmt::format("\"{}\" is no group's code: not a DXF file", code.substr(0, 40)));
    const std::string_view value = next_line();
    return {static_cast<int>(*number), value, line_};
  }

  /// Up to the next entity, which is left to be read.
  Record record(const Group& name) {
    Record record{name.value, name.line, {}};
    for (;;) {
      const std::size_t at = at_;
      const int line = line_;
      const Group group = next();
      if (group.code == 0) {
        at_ = at, line_ = line;
        return record;
      }
      record.groups.push_back(group);
    }
  }

  double number(const Group& group) const {
    if (const auto value = number_of(group.value)) return *value;
    fail(group.line, fmt::format("\"{}\" is no number", group.value.substr(0, 40)));
  }

  std::optional<double> find(const Record& record, int code) const {
    for (const Group& group : record.groups)
      if (group.code == code) return number(group);
    return std::nullopt;
  }
  double required(const Record& record, int code) const {
    if (const auto value = find(record, code)) return *value;
    fail(record.line, fmt::format("{} has no group {}", record.name, code));
  }
  Point point(const Record& record, int code) const { return {required(record, code), required(record, code + 10)}; }

  /// 0: none is said.
  std::optional<double> unit(const Group& group) const {
    constexpr std::array<std::pair<int, double>, 12> units{{{1, 0.0254},
                                                            {2, 0.3048},
                                                            {4, 1e-3},
                                                            {5, 1e-2},
                                                            {6, 1},
                                                            {8, 2.54e-8},
                                                            {9, 2.54e-5},
                                                            {10, 0.9144},
                                                            {12, 1e-9},
                                                            {13, 1e-6},
                                                            {14, 0.1},
                                                            {15, 10}}};
    const double code = number(group);
    if (code == 0) return std::nullopt;
    for (const auto& [known, size] : units)
      if (code == known) return size;
    fail(group.line, fmt::format("$INSUNITS: {:g} is no unit of a drawing that can be read", code));
  }

  /// Names of layers are alike in capitals and small letters.
  static std::string layer_key(std::string_view name) {
    std::string key(name);
    for (char& c : key)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return key;
  }

  /// A layer is off where its colour's number is below zero, and frozen where the first of its flags is set.
  void note_layer(const Record& layer) {
    const bool off = find(layer, 62).value_or(1) < 0;
    const bool frozen = is_odd(find(layer, 70).value_or(0));
    if (off || frozen) hidden_layers_[layer_key(text(layer, 2))] = frozen ? "frozen" : "switched off";
  }

  static std::string_view text(const Record& record, int code) {
    for (const Group& group : record.groups)
      if (group.code == code) return group.value;
    return "";
  }

  /// Why nobody sees an entity in the drawing; "": it is seen.
  std::string hidden(const Record& entity) const {
    const std::string layer(text(entity, 8));
    const auto found = hidden_layers_.find(layer_key(layer));
    if (found != hidden_layers_.end())
      return fmt::format(" on the layer {}, which is {}", printable(layer), found->second);
    if (find(entity, 60).value_or(0) == 1) return ", invisible";
    if (find(entity, 67).value_or(0) == 1) return " of a sheet (paper space)";
    return "";
  }

  void add(const Record& entity) {
    constexpr std::array beside = {"TEXT",   "MTEXT",       "ATTDEF", "TOLERANCE", "DIMENSION",
                                   "LEADER", "MULTILEADER", "HATCH",  "POINT",     "VIEWPORT"};
    constexpr std::array of_another = {"VERTEX", "ATTRIB", "SEQEND"};  // of the POLYLINE or INSERT before them
    if (std::ranges::find(of_another, entity.name) != of_another.end()) return;
    const std::string why = hidden(entity);
    if (!why.empty() || std::ranges::find(beside, entity.name) != beside.end())
      return left_out_.add(printable(entity.name) + why);
    const std::string layer = printable(text(entity, 8));
    std::vector<std::string>& layers = drawing_.layers;
    if (!layer.empty() && std::ranges::find(layers, layer) == layers.end()) layers.push_back(layer);
    if (entity.name == "LINE") {
      drawing_.pieces.push_back(line(entity));
    } else if (entity.name == "LWPOLYLINE" || entity.name == "ARC" || entity.name == "CIRCLE") {
      std::vector<WallPiece> pieces;
      entity.name == "LWPOLYLINE" ? add_polyline(entity, pieces) : pieces.push_back(arc(entity));
      const bool mirror = is_from_behind(entity);
      for (const WallPiece& piece : pieces) drawing_.pieces.push_back(mirror ? mirrored(piece) : piece);
    } else {
      fail(entity.line,
           fmt::format("{} cannot be read; LINE, LWPOLYLINE, ARC and CIRCLE can (explode it)", entity.name));
    }
  }

  /// What is flat lies in a plane of its own, of which 210, 220 and 230 are the normal; that from behind has its x to
  /// the left (DXF Reference, "arbitrary axis algorithm").
  bool is_from_behind(const Record& entity) const {
    constexpr double straight = 1e-6;
    const double x = find(entity, 210).value_or(0), y = find(entity, 220).value_or(0),
                 z = find(entity, 230).value_or(1);
    if (!(std::abs(z) > 0 && std::abs(x) + std::abs(y) <= straight * std::abs(z)))
      fail(entity.line, fmt::format("{}: lies in another plane than the drawing's x and y", entity.name));
    return z < 0;
  }

  static WallPiece mirrored(WallPiece piece) {
    for (Point* point : {&piece.a, &piece.b, &piece.centre}) point->x() = -point->x();
    if (piece.radius == 0 || piece.to - piece.from >= 2 * std::numbers::pi * (1 - 1e-12)) return piece;
    piece.from = std::numbers::pi - std::exchange(piece.to, std::numbers::pi - piece.from);
    return piece;
  }

  /// Its ends are the drawing's own, whatever its normal.
  WallPiece line(const Record& entity) const {
    constexpr double level = 1e-3;
    const WallPiece piece = line_piece(point(entity, 10), point(entity, 11));
    const double z = find(entity, 30).value_or(0), other = find(entity, 31).value_or(0);
    if (std::abs(z - other) > level * (piece.b - piece.a).norm())
      fail(entity.line, fmt::format("LINE: leaves the drawing's plane, from z {:g} to {:g}", z, other));
    return piece;
  }

  WallPiece arc(const Record& entity) const {
    WallPiece piece;
    piece.centre = point(entity, 10);
    piece.radius = required(entity, 40);
    if (!(piece.radius > 0)) fail(entity.line, fmt::format("{}: its radius is {:g}", entity.name, piece.radius));
    piece.to = 2 * std::numbers::pi;
    if (entity.name == "CIRCLE") return piece;
    piece.from = required(entity, 50) * degree, piece.to = required(entity, 51) * degree;
    constexpr double most = 100 * 2 * std::numbers::pi;
    if (!(std::abs(piece.from) <= most && std::abs(piece.to) <= most))
      fail(entity.line, "ARC: its angles are no angles");
    while (piece.to <= piece.from) piece.to += 2 * std::numbers::pi;
    while (piece.to - piece.from > 2 * std::numbers::pi * (1 + 1e-12)) piece.to -= 2 * std::numbers::pi;
    return piece;
  }

  /// A vertex is x (10), y (20) and perhaps the bulge (42) of what follows it.
  void add_polyline(const Record& entity, std::vector<WallPiece>& pieces) const {
    struct Vertex {
      Point at;
      double bulge;
    };
    std::vector<Vertex> vertices;
    bool closed = false;
    for (const Group& group : entity.groups) {
      if (group.code == 70) closed = is_odd(number(group));
      if (group.code == 10) vertices.push_back({{number(group), 0}, 0});
      if ((group.code == 20 || group.code == 42) && vertices.empty()) fail(group.line, "LWPOLYLINE: has no x before");
      if (group.code == 20) vertices.back().at.y() = number(group);
      if (group.code == 42) vertices.back().bulge = number(group);
    }
    if (vertices.size() < 2) fail(entity.line, "LWPOLYLINE: has fewer than two points");
    for (std::size_t k = 0; k + (closed ? 0 : 1) < vertices.size(); ++k) {
      const Vertex &from = vertices[k], &to = vertices[(k + 1) % vertices.size()];
      if (from.at != to.at) pieces.push_back(bulge_piece(from.at, to.at, from.bulge));
    }
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  int line_ = 0;  // that was read last
  DxfDrawing drawing_;
  std::vector<Record> entities_;
  std::map<std::string, std::string> hidden_layers_;  // by layer_key, how
  Tally left_out_;
};

}  // namespace

DxfDrawing read_dxf(const std::string& text, const std::string& file) {
  return Dxf(text, file).read();
}

}  // namespace vibrosow
