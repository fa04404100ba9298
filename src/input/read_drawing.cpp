#include "input/read_drawing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "files/whole_file.hpp"
#include "input/lengths.hpp"
#include "portable_math/functions.hpp"
#include "scene/input_error.hpp"
#include "scene/printable.hpp"

namespace vibrosow {
namespace {

using Point = Eigen::Vector2d;

constexpr std::size_t most_pieces = 5000;

Point end_of_arc(const WallPiece& arc, double angle) {
  const auto [sine, cosine] = portable_math::sine_cosine(angle);
  return arc.centre + arc.radius * Point(cosine, sine);
}

/// Drawings state ends twice, and arcs by angles: what is meant to meet does so to the digits of the file.
void join_ends(std::vector<WallPiece>& pieces) {
  std::vector<Point> ends;
  for (const WallPiece& piece : pieces)
    if (piece.radius > 0) ends.push_back(end_of_arc(piece, piece.from)), ends.push_back(end_of_arc(piece, piece.to));
  for (WallPiece& piece : pieces) {
    if (piece.radius > 0) continue;
    for (Point* end : {&piece.a, &piece.b}) {
      const auto other = std::ranges::find_if(ends, [end](const Point& at) { return (at - *end).norm() <= shortest; });
      other == ends.end() ? ends.push_back(*end) : void(*end = *other);
    }
  }
}

bool is_finite_and_near(const WallPiece& piece) {
  for (const Point& at : {piece.a, piece.b, piece.centre})
    if (!(at.cwiseAbs().maxCoeff() <= longest)) return false;
  return piece.radius == 0 || (piece.radius >= shortest && piece.radius <= longest);
}

WallPiece moved(WallPiece piece, double scale, const Point& by) {
  if (piece.radius > 0)
    piece.centre = scale * piece.centre + by, piece.radius *= scale;
  else
    piece.a = scale * piece.a + by, piece.b = scale * piece.b + by;
  return piece;
}

std::optional<double> read_unit(Table& table) {
  const std::optional<std::string> unit = table.text("unit");
  if (!unit) return std::nullopt;
  try {
    return unit_size(*unit, Dimension::length);
  } catch (const UnitError& error) {
    table.fail("unit", error.what());
  }
}

}  // namespace

Drawing read_drawing(Table& table, Vessel& vessel) {
  const std::filesystem::path path = table.directory("file") / table.required_text("file");
  const bool is_svg = has_extension(path, ".svg");
  if (!is_svg && !has_extension(path, ".dxf"))
    table.fail("file", fmt::format("{} is neither a .dxf nor a .svg", path.string()));
  if (!table.files()->has(path)) table.fail("file", fmt::format("there is no file {}", path.string()));
  const std::optional<double> unit = read_unit(table);
  const double scale = table.number("scale", 1e-6, 1e6).value_or(1);
  const double tolerance = table.quantity("tolerance", Dimension::length, shortest, 0.01).value_or(1e-5);
  const std::vector<double> at = table.quantities("at", Dimension::length, -longest, longest);
  if (!at.empty() && at.size() != 2) table.fail("at", "expected a point such as [\"2 cm\", \"5 cm\"]");
  const Point zero = at.empty() ? Point(0, 0) : Point(at[0], at[1]);
  const std::string& text = table.files()->text(path);

  DrawnPieces drawn;
  double size = 1;
  if (is_svg) {
    drawn = read_svg(text, path.string(), {unit, scale, tolerance});
  } else {
    DxfDrawing drawing = read_dxf(text, path.string());
    if (!drawing.unit && !unit)
      table.fail("unit", "is missing, and the drawing's $INSUNITS does not say it; such as \"mm\"");
    if (drawing.unit && unit && *drawing.unit != *unit)
      table.fail("unit",
                 fmt::format("contradicts the drawing, whose $INSUNITS says {} a unit", millimetres(*drawing.unit)));
    size = scale * (unit ? *unit : *drawing.unit);
    drawn = std::move(drawing);
  }
  std::vector<WallPiece>& pieces = drawn.pieces;
  for (WallPiece& piece : pieces) piece = moved(piece, size, zero);
  if (pieces.size() > most_pieces)
    table.fail("file", fmt::format("{} draws {} pieces, more than {}; a larger tolerance makes fewer", path.string(),
                                   pieces.size(), most_pieces));
  join_ends(pieces);
  std::erase_if(pieces,
                [](const WallPiece& piece) { return piece.radius == 0 && (piece.b - piece.a).norm() < shortest; });
  const std::string left_out =
      drawn.left_out.empty() ? "" : fmt::format("; left out: {}", fmt::join(drawn.left_out, ", "));
  if (pieces.empty()) table.fail("file", fmt::format("{} draws no line{}", path.string(), left_out));
  if (!std::ranges::all_of(pieces, is_finite_and_near))
    table.fail("file", fmt::format("{} draws something further than {:g} m away, or a circle of less than {:g} um",
                                   path.string(), longest, 1e6 * shortest));
  Drawing drawing{vessel.name,
                  printable(path.filename().string()),
                  vessel.pieces.size(),
                  pieces.size(),
                  std::move(drawn.layers),
                  std::move(drawn.left_out)};
  vessel.pieces.insert(vessel.pieces.end(), pieces.begin(), pieces.end());
  return drawing;
}

}  // namespace vibrosow
