#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/drawing.hpp"
#include "input/table.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// What was drawn: pieces, and for people the layers on which they lie and what was left out.
struct DrawnPieces {
  std::vector<WallPiece> pieces{};
  std::vector<std::string> layers{};    // of pieces, each once
  std::vector<std::string> left_out{};  // "2 TEXT", "1 LINE on the layer NOTES, which is frozen"
};

/// A vessel's pieces out of a drawing: `file`, a .dxf or .svg beside the file that names it; `unit`, how long one unit
/// of the drawing is, where it does not say so itself; `scale`, a factor; `at`, where its zero lies in the vessel;
/// `tolerance` of what is drawn as lines. Ends of lines that lie within a micrometre of another end are put onto it,
/// lines shorter than that are left out. They are added to those of the vessel. Throws InputError for a drawing that
/// cannot be read, with its line, and for keys as elsewhere.
Drawing read_drawing(Table& table, Vessel& vessel);

/// The lines and arcs of a DXF file's entities LINE, LWPOLYLINE, ARC and CIRCLE, in its own units; what is drawn from
/// behind is mirrored, as it is seen. Left out are words and measures, what is invisible, what lies on a layer that is
/// switched off or frozen, and what is of a sheet (paper space). `unit` (m): what $INSUNITS says. Throws InputError
/// "FILE:LINE: .." for other entities, what lies in another plane or leaves that of x and y, and what is no DXF file.
struct DxfDrawing : DrawnPieces {
  std::optional<double> unit{};
};
DxfDrawing read_dxf(const std::string& text, const std::string& file);

/// How an SVG drawing is read.
struct SvgScale {
  std::optional<double> unit;  // m, of a user unit; none: the drawing's own
  double scale = 1;
  double tolerance;  // m, of curves
};

/// The lines of an SVG file's paths and shapes in m, its zero at the lower left of its view, y up. Circular arcs stay
/// arcs, other curves become lines. Left out are text and what nobody sees (display, visibility, opacity 0, neither
/// stroke nor fill), by attributes, style or a style sheet's simple rules. Throws InputError "FILE:LINE: ..", also for
/// what would cut or move shapes and is not read: clip paths, masks, transforms in styles.
DrawnPieces read_svg(const std::string& text, const std::string& file, const SvgScale& scale);

}  // namespace vibrosow
