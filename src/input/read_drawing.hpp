#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/table.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// A vessel's pieces out of a drawing: `file`, a .dxf or .svg beside the file that names it; `unit`, how long one unit
/// of the drawing is, where it does not say so itself; `scale`, a factor; `at`, where its zero lies in the vessel;
/// `tolerance` of what is drawn as lines. Ends of lines that lie within a micrometre of another end are put onto it,
/// lines shorter than that are left out. Throws InputError for a drawing that cannot be read, with its line, and for
/// keys as elsewhere.
std::vector<WallPiece> read_drawing(Table& table);

/// The lines and arcs of a DXF file's entities LINE, LWPOLYLINE, ARC and CIRCLE, in its own units; words and measures
/// are left out. `unit` (m): what $INSUNITS says. Throws InputError "FILE:LINE: .." for other entities and what is no
/// DXF file.
struct DxfDrawing {
  std::vector<WallPiece> pieces;
  std::optional<double> unit;
};
DxfDrawing read_dxf(const std::string& text, const std::string& file);

/// How an SVG drawing is read.
struct SvgScale {
  std::optional<double> unit;  // m, of a user unit; none: the drawing's own
  double scale = 1;
  double tolerance;  // m, of curves
};

/// The lines of an SVG file's paths and shapes in m, its zero at the lower left of its view, y up. Circular arcs stay
/// arcs, other curves become lines. Throws InputError "FILE:LINE: ..".
std::vector<WallPiece> read_svg(const std::string& text, const std::string& file, const SvgScale& scale);

}  // namespace vibrosow
