#include "input/read_drawing.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "input/drawing_paths.hpp"
#include "input/read_scene.hpp"
#include "input/temporary_file.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using Point = Eigen::Vector2d;
using std::numbers::pi;

std::string dxf(const std::string& entities, const std::string& units = "4") {
  return "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n" + units + "\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities +
         "0\nENDSEC\n0\nEOF\n";
}

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

Point on_arc(const WallPiece& arc, double angle) {
  return arc.centre + arc.radius * Point(std::cos(angle), std::sin(angle));
}

TEST(Dxf, LinesArcsAndCircles) {
  const DxfDrawing drawing = read_dxf(
      dxf("0\nLINE\n8\n0\n10\n1.5\n20\n2\n30\n0\n11\n3\n21\n4\n31\n0\n0\nARC\n10\n5\n20\n5\n40\n2\n50\n270\n51\n90\n"
          "0\nTEXT\n1\nnote\n0\nCIRCLE\n10\n-1\n20\n0\n40\n0.5\n"),
      "a.dxf");
  ASSERT_EQ(drawing.unit, 1e-3);
  ASSERT_EQ(drawing.pieces.size(), 3u);
  EXPECT_EQ(drawing.pieces[0].a, Point(1.5, 2));
  EXPECT_EQ(drawing.pieces[0].b, Point(3, 4));
  EXPECT_LT((on_arc(drawing.pieces[1], drawing.pieces[1].from) - Point(5, 3)).norm(), 1e-12);
  EXPECT_LT((on_arc(drawing.pieces[1], drawing.pieces[1].to) - Point(5, 7)).norm(), 1e-12);
  EXPECT_NEAR(drawing.pieces[1].to - drawing.pieces[1].from, pi, 1e-12);
  EXPECT_DOUBLE_EQ(drawing.pieces[2].to - drawing.pieces[2].from, 2 * pi);
  EXPECT_EQ(read_dxf(dxf("", "0"), "a.dxf").unit, std::nullopt);
  EXPECT_EQ(read_dxf(dxf("", "1"), "a.dxf").unit, 0.0254);
}

/// A drawing whose layers have these flags (group 70) and colours (62).
std::string dxf_with_layers(const std::string& layers, const std::string& entities) {
  return "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n" + layers +
         "0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}
std::string layer(const std::string& name, int flags, int colour) {
  return fmt::format("0\nLAYER\n2\n{}\n70\n{}\n62\n{}\n", name, flags, colour);
}
std::string line_on(const std::string& name, const std::string& groups = "") {
  return "0\nLINE\n8\n" + name + "\n" + groups + "10\n0\n20\n0\n11\n3\n21\n4\n";
}

TEST(Dxf, WhatNobodySeesIsNoWall) {
  const std::string layers =
      layer("WALL", 0, 7) + layer("Notes", 0, -3) + layer("OLD", 1, 7) + layer("LOCKED", 4, 7) + layer("NEW", 2, 7);
  const DxfDrawing drawing = read_dxf(
      dxf_with_layers(layers, line_on("WALL") + line_on("NOTES") + line_on("notes") + line_on("OLD") +
                                  line_on("LOCKED") + line_on("NEW") + line_on("UNKNOWN") + line_on("WALL", "60\n1\n") +
                                  line_on("WALL", "67\n1\n") + line_on("WALL", "60\n0\n67\n0\n") +
                                  "0\nSPLINE\n8\nOLD\n0\nMTEXT\n8\nWALL\n"),
      "a.dxf");
  EXPECT_EQ(drawing.pieces.size(), 5u);
  EXPECT_EQ(drawing.layers, (std::vector<std::string>{"WALL", "LOCKED", "NEW", "UNKNOWN"}));
  EXPECT_EQ(drawing.left_out,
            (std::vector<std::string>{
                "1 LINE of a sheet (paper space)", "1 LINE on the layer NOTES, which is switched off",
                "1 LINE on the layer OLD, which is frozen", "1 LINE on the layer notes, which is switched off",
                "1 LINE, invisible", "1 MTEXT", "1 SPLINE on the layer OLD, which is frozen"}));
}

TEST(Dxf, LayersMayBeToldAfterWhatLiesOnThem) {
  const std::string entities = "0\nSECTION\n2\nENTITIES\n" + line_on("A") + line_on("B") + "0\nENDSEC\n";
  const std::string tables = "0\nSECTION\n2\nTABLES\n" + layer("A", 0, -7) + "0\nENDSEC\n";
  EXPECT_EQ(read_dxf(entities + tables + "0\nEOF\n", "a.dxf").pieces.size(), 1u);
}

TEST(Dxf, WhatBelongsToAnotherEntityGoesWithIt) {
  const DxfDrawing drawing =
      read_dxf(dxf_with_layers(layer("OFF", 0, -7),
                               "0\nINSERT\n8\nOFF\n66\n1\n2\nTITLE\n0\nATTRIB\n8\nW\n1\nhello\n0\nSEQEND\n8\nW\n"
                               "0\nPOLYLINE\n8\n0\n60\n1\n66\n1\n0\nVERTEX\n8\n0\n10\n0\n20\n0\n0\nSEQEND\n8\n0\n" +
                                   line_on("W")),
               "a.dxf");
  EXPECT_EQ(drawing.pieces.size(), 1u);
  EXPECT_EQ(drawing.left_out,
            (std::vector<std::string>{"1 INSERT on the layer OFF, which is switched off", "1 POLYLINE, invisible"}));
  EXPECT_TRUE(error_of([] {
                read_dxf(dxf("0\nPOLYLINE\n66\n1\n0\nVERTEX\n10\n0\n20\n0\n"), "a.dxf");
              }).starts_with("a.dxf:16: POLYLINE cannot be read"));
}

TEST(Dxf, WhatIsDrawnFromBehindIsMirroredAndALineIsNot) {
  const std::string behind = "210\n0\n220\n0\n230\n-1\n";
  const DxfDrawing drawing =
      read_dxf(dxf("0\nARC\n10\n-50\n20\n20\n40\n10\n50\n0\n51\n90\n" + behind + "0\nCIRCLE\n10\n-7\n20\n1\n40\n2\n" +
                   behind + "0\nLWPOLYLINE\n10\n-4\n20\n0\n42\n1\n10\n-4\n20\n2\n" + behind +
                   "0\nLINE\n10\n1\n20\n2\n30\n5\n11\n3\n21\n4\n31\n5\n" + behind),
               "a.dxf");
  ASSERT_EQ(drawing.pieces.size(), 4u);
  const WallPiece& arc = drawing.pieces[0];
  EXPECT_LT((arc.centre - Point(50, 20)).norm(), 1e-12);
  EXPECT_LT((on_arc(arc, arc.from) - Point(50, 30)).norm(), 1e-12) << "anticlockwise";
  EXPECT_LT((on_arc(arc, arc.to) - Point(40, 20)).norm(), 1e-12);
  EXPECT_EQ(drawing.pieces[1].centre, Point(7, 1));
  const WallPiece& half = drawing.pieces[2];  // to the right of its way up; seen from the front to the left
  EXPECT_LT((on_arc(half, 0.5 * (half.from + half.to)) - Point(3, 1)).norm(), 1e-12);
  EXPECT_EQ(drawing.pieces[3].a, Point(1, 2));
  EXPECT_EQ(drawing.pieces[3].b, Point(3, 4));
}

TEST(Dxf, WhatLeavesThePlaneIsRefused) {
  const auto error = [](const std::string& entity) { return error_of([&] { read_dxf(dxf(entity), "a.dxf"); }); };
  EXPECT_EQ(error("0\nARC\n10\n50\n20\n0\n40\n20\n210\n0\n220\n-1\n230\n0\n50\n0\n51\n180\n"),
            "a.dxf:16: ARC: lies in another plane than the drawing's x and y");
  EXPECT_EQ(error("0\nLINE\n10\n50\n20\n0\n30\n0\n11\n50\n21\n0\n31\n80\n"),
            "a.dxf:16: LINE: leaves the drawing's plane, from z 0 to 80");
}

TEST(Dxf, APolylinesBulgesAreArcs) {
  // A slot: two straight sides, closed by half circles of radius 1.
  const DxfDrawing drawing =
      read_dxf(dxf("0\nLWPOLYLINE\n90\n4\n70\n1\n10\n0\n20\n0\n10\n4\n20\n0\n42\n1\n10\n4\n20\n2\n"
                   "10\n0\n20\n2\n42\n1\n"),
               "a.dxf");
  ASSERT_EQ(drawing.pieces.size(), 4u);
  EXPECT_LT((drawing.pieces[1].centre - Point(4, 1)).norm(), 1e-12);
  EXPECT_LT((on_arc(drawing.pieces[1], 0.5 * (drawing.pieces[1].from + drawing.pieces[1].to)) - Point(5, 1)).norm(),
            1e-12);
  EXPECT_LT((on_arc(drawing.pieces[3], 0.5 * (drawing.pieces[3].from + drawing.pieces[3].to)) - Point(-1, 1)).norm(),
            1e-12);
  // A clockwise quarter from (0, 0) to (1, 1) about (1, 0).
  const WallPiece quarter = bulge_piece({0, 0}, {1, 1}, -std::tan(pi / 8));
  EXPECT_LT((quarter.centre - Point(1, 0)).norm(), 1e-12);
  EXPECT_LT((on_arc(quarter, quarter.from) - Point(1, 1)).norm(), 1e-12);
  EXPECT_NEAR(quarter.to - quarter.from, pi / 2, 1e-12);
}

TEST(Dxf, WhatCannotBeReadIsNamedWithItsLine) {
  const auto error = [](const std::string& text) { return error_of([&] { read_dxf(text, "a.dxf"); }); };
  EXPECT_EQ(error(dxf("0\nSPLINE\n70\n1\n")),
            "a.dxf:16: SPLINE cannot be read; LINE, LWPOLYLINE, ARC and CIRCLE can (explode it)");
  for (const std::string entity : {"INSERT", "ELLIPSE", "POLYLINE"})
    EXPECT_THAT(error(dxf("0\n" + entity + "\n8\nfloor\n")), testing::StartsWith("a.dxf:16: " + entity + " cannot be"));
  EXPECT_EQ(error(dxf("0\nLINE\n10\n1\n20\ntwo\n11\n3\n21\n4\n")), "a.dxf:20: \"two\" is no number");
  EXPECT_EQ(error(dxf("0\nLINE\n10\n1\n20\n2\n11\n3\n")), "a.dxf:16: LINE has no group 21");
  EXPECT_EQ(error(dxf("", "99")), "a.dxf:8: $INSUNITS: 99 is no unit of a drawing that can be read");
  EXPECT_EQ(error("hello\nworld\n"), "a.dxf:1: \"hello\" is no group's code: not a DXF file");
  EXPECT_EQ(error("0\nSECTION\n"), "a.dxf:2: ends before its EOF");
  EXPECT_EQ(error("AutoCAD Binary DXF\r\n"), "a.dxf:1: is a binary DXF file; save it as text");
  EXPECT_EQ(error(dxf("0\nARC\n10\n0\n20\n0\n40\n1\n50\n0\n51\n1e300\n")), "a.dxf:16: ARC: its angles are no angles");
}

std::vector<WallPiece> svg(const std::string& shapes, const std::string& attributes = "", double tolerance = 1e-6) {
  return read_svg(fmt::format("<svg width=\"100mm\" height=\"50mm\" viewBox=\"0 0 100 50\" {}>\n{}\n</svg>", attributes,
                              shapes),
                  "a.svg", {std::nullopt, 1, tolerance})
      .pieces;
}

TEST(Svg, APathsLinesInMillimetresWithYUp) {
  const auto pieces = svg("<path d='M10,40 h20 v-10 L 10 30 z m5 0 l1-1'/>");
  ASSERT_EQ(pieces.size(), 5u);
  EXPECT_LT((pieces[0].a - Point(0.010, 0.010)).norm(), 1e-15);
  EXPECT_LT((pieces[1].b - Point(0.030, 0.020)).norm(), 1e-15);
  EXPECT_LT((pieces[3].b - pieces[0].a).norm(), 1e-15) << "closed";
  EXPECT_LT((pieces[4].b - Point(0.016, 0.011)).norm(), 1e-15) << "from where the path began";
}

TEST(Svg, CurvesLieWithinTheTolerance) {
  for (const double tolerance : {1e-4, 1e-6}) {
    // A quarter of a circle of radius 10 mm about (10, 40) mm, to 3e-4 of its radius.
    const auto pieces = svg("<path d='M20 40 C20 34.4772 15.5228 30 10 30'/>", "", tolerance);
    EXPECT_GT(pieces.size(), tolerance < 1e-5 ? 20u : 3u);
    EXPECT_LT(pieces.size(), tolerance < 1e-5 ? 130u : 10u);
    for (const WallPiece& piece : pieces)
      for (const double share : {0.0, 0.25, 0.5, 1.0})
        EXPECT_NEAR((piece.a + share * (piece.b - piece.a) - Point(0.010, 0.010)).norm(), 0.010, 3e-6 + tolerance);
  }
  const auto mirrored = svg("<path d='M0 25 Q 10 15 20 25 T 40 25'/>");
  double lowest = 1;
  for (const WallPiece& piece : mirrored) lowest = std::min(lowest, piece.b.y());
  EXPECT_NEAR(lowest, 0.020, 1e-5) << "the second half swings to the other side";
}

TEST(Svg, CircularArcsStayArcs) {
  for (const bool large : {false, true})
    for (const bool sweep : {false, true}) {
      const auto pieces = svg(fmt::format("<path d='M30 20 A10 10 0 {} {} 40 30'/>", large ? 1 : 0, sweep ? 1 : 0));
      ASSERT_EQ(pieces.size(), 1u);
      const WallPiece& arc = pieces[0];
      EXPECT_NEAR(arc.radius, 0.010, 1e-12);
      EXPECT_NEAR(arc.to - arc.from, large ? 1.5 * pi : 0.5 * pi, 1e-9);
      const Point centre = large == sweep ? Point(0.040, 0.030) : Point(0.030, 0.020);
      EXPECT_LT((arc.centre - centre).norm(), 1e-9) << large << sweep << " " << arc.centre.transpose();
    }
  const auto turned = svg("<g transform='translate(50 25) rotate(30) scale(2)'><circle r='5'/></g>");
  EXPECT_NEAR(turned.at(0).radius, 0.010, 1e-12);
  EXPECT_LT((turned.at(0).centre - Point(0.05, 0.025)).norm(), 1e-12);
  const auto flat = svg("<ellipse cx='50' cy='25' rx='20' ry='10'/>", "", 1e-5);
  EXPECT_GT(flat.size(), 30u);
  for (const WallPiece& line : flat) {
    const Point at = line.a - Point(0.05, 0.025);
    EXPECT_NEAR(std::hypot(at.x() / 0.02, at.y() / 0.01), 1, 1e-9);
  }
}

TEST(Svg, ShapesAndWhatIsNotDrawn) {
  EXPECT_EQ(svg("<rect x='1' y='1' width='10' height='5'/>").size(), 4u);
  EXPECT_EQ(svg("<polygon points='0,0 10,0 10,10'/><polyline points='0,0 10,0 10,10'/>").size(), 5u);
  EXPECT_EQ(svg("<defs><path d='M0 0L1 1'/></defs><title>t</title><line x2='4' y2='4' style='display:none'/>").size(),
            0u);
}

TEST(Svg, WhatNobodySeesIsNoWall) {
  constexpr const char* line = "<line x2='4' y2='4' {}/>";
  for (const char* hidden :
       {"display='none'", "style='display : none'", "style='fill:none;display:none!important'", "visibility='hidden'",
        "style=\"visibility:collapse\"", "opacity='0'", "style='opacity:0.0'"})
    EXPECT_EQ(svg(fmt::format(fmt::runtime(line), hidden)).size(), 0u) << hidden;
  for (const char* seen : {"display='inline'", "style='-inkscape-display:none'", "visibility='visible'",
                           "opacity='0.5'", "style='display:inline'", "style='opacity:1'", "style='fill-opacity:0'"})
    EXPECT_EQ(svg(fmt::format(fmt::runtime(line), seen)).size(), 1u) << seen;
  // What is in a hidden group stays hidden, but for visibility, which each may say anew.
  EXPECT_EQ(
      svg("<g visibility='hidden'><line x2='4' y2='4'/><g visibility='visible'><line x2='4' y2='4'/></g></g>").size(),
      1u);
  EXPECT_EQ(svg("<g style='display:none'><line x2='4' y2='4' style='display:inline'/></g>").size(), 0u);
  EXPECT_EQ(svg("<g style='display:none'><use/><text>t</text></g>").size(), 0u);
}

TEST(Svg, WhatIsPaintedByNothingIsNoWall) {
  for (const char* unseen :
       {"<rect width='9' height='4' fill='none' stroke='none'/>",
        "<g stroke='none' fill='none'><path d='M0 0L1 1'/></g>",
        "<line x2='4' y2='4' stroke='black' stroke-opacity='0'/>", "<line x2='4' y2='4' stroke='none'/>",
        "<path d='M0 0L1 1' style='fill:transparent;stroke-width:0'/>",
        "<g stroke-opacity='0'><line x2='4' y2='4' stroke='black'/></g>"})
    EXPECT_EQ(svg(unseen).size(), 0u) << unseen;
  for (const char* seen : {"<line x2='4' y2='4' fill='none'/>", "<path d='M0 0L1 1' stroke='none'/>",
                           "<g stroke-opacity='0'><line x2='4' y2='4' stroke-opacity='0.5'/></g>",
                           "<g stroke='none' fill='none'><path d='M0 0L1 1' stroke='#000'/></g>"})
    EXPECT_EQ(svg(seen).size(), 1u) << seen;
}

TEST(Svg, GoesByItsStyleSheet) {
  const std::string sheet =
      "<style>/* { */ .gone, #b {display:none} line { visibility: hidden } .seen{visibility:visible}"
      "@font-face{font-family:a}</style>";
  EXPECT_EQ(svg(sheet + "<path class='x gone' d='M0 0L1 1'/>").size(), 0u);
  EXPECT_EQ(svg("<path id='b' d='M0 0L1 1'/>" + sheet).size(), 0u) << "wherever it stands";
  EXPECT_EQ(svg(sheet + "<line x2='4' y2='4'/><line class='seen' x2='4' y2='4'/>").size(), 1u);
  EXPECT_EQ(svg(sheet + "<line visibility='visible' x2='4' y2='4'/>").size(), 0u) << "before an attribute";
  EXPECT_EQ(svg(sheet + "<path class='gone' style='display:inline' d='M0 0L1 1'/>").size(), 1u) << "after a style";
  EXPECT_EQ(svg("<style><![CDATA[.a{stroke:#000;fill:none}]]></style><path class='a' d='M0 0L1 1'/>").size(), 1u);
}

TEST(Svg, SaysWhatIsLeftOut) {
  const DrawnPieces drawn = read_svg(
      "<svg width='10mm' viewBox='0 0 10 5'><text><tspan>a</tspan></text><text>b</text><flowRoot/><path d='M0 0L1 1'/>"
      "<g style='display:none'><path d='M0 0L1 1'/><rect/><text>c</text></g></svg>",
      "a.svg", {std::nullopt, 1, 1e-5});
  EXPECT_EQ(drawn.pieces.size(), 1u);
  EXPECT_EQ(drawn.left_out, (std::vector<std::string>{"1 flowRoot", "1 path, hidden", "1 rect, hidden", "2 text"}));
}

TEST(Svg, WhatCannotBeReadIsNamedWithItsLine) {
  const auto error = [](const std::string& shapes) { return error_of([&] { svg(shapes); }); };
  EXPECT_EQ(error("<path d='M1 2 L3'/>"), "a.svg:2: path: d: a number is missing after L");
  EXPECT_EQ(error("<path d='M1 2 X3 4'/>"), "a.svg:2: path: d: there is no command X");
  EXPECT_EQ(error("<use href='#a'/>"), "a.svg:2: use: cannot be read; turn it into paths");
  EXPECT_EQ(error("<rect width='3' height='2' rx='1'/>"), "a.svg:2: rect: has round corners; turn it into a path");
  EXPECT_EQ(error("<g transform='turn(3)'/>"), "a.svg:2: g: transform: turn with 1 numbers cannot be read");
  EXPECT_EQ(error("<line clip-path='url(#c)' x2='4' y2='4'/>"),
            "a.svg:2: line: clip-path: cannot be read; cut the paths themselves");
  EXPECT_EQ(error("<g style='mask: url(#c)'/>"), "a.svg:2: g: mask: cannot be read; cut the paths themselves");
  EXPECT_EQ(error("<line style='transform: translate(0px,-30px)' x2='4' y2='4'/>"),
            "a.svg:2: line: style: transform: cannot be read; make it an attribute, or apply it to the path");
  EXPECT_EQ(error("<style>.a{rotate:9deg}</style><g class='a'/>"),
            "a.svg:2: g: style: rotate: cannot be read; make it an attribute, or apply it to the path");
  EXPECT_EQ(error("<style>g path{display:none}</style>"),
            "a.svg:2: style: \"g path\" is no name, .class or #id: such a rule is not read; put it into the shapes");
  EXPECT_EQ(error("<style>@media print{.a{display:none}}</style>"),
            "a.svg:2: style: \"@media print\" is no name, .class or #id: such a rule is not read; put it into the "
            "shapes");
  EXPECT_TRUE(error("<path").starts_with("a.svg:2: is no XML")) << error("<path");
  const auto of = [](const std::string& text) {
    return error_of([&] { read_svg(text, "a.svg", {std::nullopt, 1, 1e-5}); });
  };
  EXPECT_EQ(of("<html/>"), "a.svg:1: is no SVG drawing");
  EXPECT_EQ(of("<svg viewBox='0 0 10 10'/>"),
            "a.svg:1: svg: its width has no unit such as mm: pieces.unit has to say how long a user unit is");
  EXPECT_EQ(of("<svg width='10mm'/>"), "a.svg:1: svg: has no viewBox: how long is its unit?");
}

/// A seeder whose tray has its outline from a drawing beside it.
class Drawings : public testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() / fmt::format("drawings-{}", ::getpid());
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  Vessel tray(const std::string& pieces) const {
    write("seeder.toml",
          "title = \"t\"\n[seeds.wheat]\ndiameter = \"4 mm\"\nmass = \"40 mg\"\n[contact]\n"
          "shell_compression = 1e-3\n[tray]\nlength = \"20 cm\"\nheight = \"10 cm\"\nfill = { count = 9 }\npieces = " +
              pieces + "\n[run]\nduration = \"1 s\"\n");
    return read_scene(folder / "seeder.toml").tray;
  }
  std::string error(const std::string& pieces) const {
    std::string message = error_of([&] { tray(pieces); });
    for (std::size_t at; (at = message.find(folder.string() + "/")) != std::string::npos;)
      message.erase(at, folder.string().size() + 1);
    return message;
  }

  std::filesystem::path folder;
};

constexpr const char* two_lines =
    "0\nLINE\n10\n0\n20\n50\n11\n40\n21\n20\n0\nLINE\n10\n40.0000004\n20\n20\n11\n80\n21\n50\n";

TEST_F(Drawings, AreSizedAndPlaced) {
  write("a.dxf", dxf(two_lines));
  const Vessel whole = tray("{ file = \"a.dxf\" }");
  ASSERT_EQ(whole.pieces.size(), 2u);
  EXPECT_LT((whole.pieces[0].a - Point(0, 0.05)).norm(), 1e-15);
  EXPECT_EQ(whole.pieces[1].a, whole.pieces[0].b) << "within a micrometre: one corner";
  const Vessel placed = tray(
      "[ { file = \"a.dxf\", scale = 0.5, at = [\"1 cm\", \"2 cm\"] }, "
      "{ centre = [\"5 cm\", \"5 cm\"], radius = \"1 cm\" } ]");
  ASSERT_EQ(placed.pieces.size(), 3u);
  EXPECT_LT((placed.pieces[0].b - Point(0.03, 0.03)).norm(), 1e-15);
  write("b.dxf", dxf(two_lines, "0"));
  EXPECT_LT((tray("{ file = \"b.dxf\", unit = \"cm\", scale = 0.1 }").pieces[0].b - Point(0.04, 0.02)).norm(), 1e-15);
  write("c.svg", "<svg viewBox='0 0 200 100'><path d='M0 0 L100 50'/></svg>");
  EXPECT_LT((tray("{ file = \"c.svg\", unit = \"mm\" }").pieces[0].b - Point(0.1, 0.05)).norm(), 1e-15);
}

TEST_F(Drawings, SayWhatTheyGave) {
  write("a.dxf",
        dxf_with_layers(layer("NOTES", 0, -1), line_on("WALL") + line_on("NOTES") + line_on("WALL", "60\n1\n")));
  write("b.svg", "<svg viewBox='0 0 20 10' height='100mm'><circle cx='10' cy='5' r='2'/><text>t</text></svg>");
  tray(
      "[ { file = \"a.dxf\", at = [\"1 cm\", \"2 cm\"] }, { line = [[\"0 m\", \"1 cm\"], [\"1 cm\", \"2 cm\"]] }, "
      "{ file = \"b.svg\" } ]");
  const Seeder seeder = read_seeder(folder / "seeder.toml");
  ASSERT_EQ(seeder.drawings.size(), 2u);
  EXPECT_EQ(seeder.drawings[1].first, 2u);
  EXPECT_EQ(
      drawing_text(seeder.drawings[0], seeder.scene),
      "drawing a.dxf: 1 piece from (10, 20) to (13, 24) mm, layer WALL; left out: 1 LINE on the layer NOTES, which "
      "is switched off; 1 LINE, invisible");
  EXPECT_EQ(drawing_text(seeder.drawings[1], seeder.scene),
            "drawing b.svg: 1 piece from (80, 30) to (120, 70) mm; left out: 1 text");
  EXPECT_EQ(drawing_warnings(seeder.scene, seeder.drawings),
            (std::vector<std::string>{"tray.pieces: a.dxf draws no more than 4 mm, the tray is 200 mm long and 100 mm "
                                      "high: is its unit right?"}));
}

TEST_F(Drawings, ThatLieBesideTheirVesselAreWarnedOf) {
  write("a.dxf", dxf(two_lines));
  const auto warnings = [&](const std::string& at) {
    tray("[{ file = \"a.dxf\", at = " + at + " }]");
    const Seeder seeder = read_seeder(folder / "seeder.toml");
    return seeder.scene.doubts_of_reader.sentences;
  };
  EXPECT_EQ(warnings("[\"30 cm\", \"2 cm\"]"),
            (std::vector<std::string>{
                "tray.pieces: a.dxf draws from (300, 40) to (380, 70) mm, wholly beside the tray, which is 200 mm "
                "long and 100 mm high: is its zero (at) right?"}));
  for (const char* beside : {"[\"-9 cm\", \"0 cm\"]", "[\"0 cm\", \"9 cm\"]"})
    EXPECT_EQ(warnings(beside).size(), 1u) << beside;
  for (const char* meets : {"[\"-7 cm\", \"0 cm\"]", "[\"19 cm\", \"7 cm\"]", "[\"0 cm\", \"-20 cm\"]"})
    EXPECT_TRUE(warnings(meets).empty()) << meets;
}

TEST_F(Drawings, MayBeDrawnOutAlongTheTray) {
  write("a.dxf", dxf(two_lines));
  EXPECT_EQ(tray("{ file = \"a.dxf\" }").pieces[1].drawn_out, DrawnOut::across);
  write("deep.toml",
        "space = \"3d\"\n[seeds.wheat]\ndiameter = \"4 mm\"\nmass = \"40 mg\"\n[contact]\nshell_compression = 1e-3\n"
        "[tray]\nlength = \"20 cm\"\nheight = \"10 cm\"\ndepth = \"8 cm\"\nfill = { count = 9 }\npieces = { file = "
        "\"a.dxf\", drawn_out = \"along\" }\n[run]\nduration = \"1 s\"\n");
  const Seeder seeder = read_seeder(folder / "deep.toml");
  ASSERT_EQ(seeder.scene.tray.pieces.size(), 2u);
  for (const WallPiece& piece : seeder.scene.tray.pieces) EXPECT_EQ(piece.drawn_out, DrawnOut::along);
  EXPECT_EQ(drawing_text(seeder.drawings[0], seeder.scene),
            "drawing a.dxf: 2 pieces from (0, 20) to (80, 50) mm across and up, drawn out along the vessel");
}

TEST_F(Drawings, OfWhichNothingIsSeenAreRefused) {
  write("a.dxf", dxf_with_layers(layer("NOTES", 0, -1), line_on("NOTES")));
  EXPECT_EQ(
      error("{ file = \"a.dxf\" }"),
      "seeder.toml:11: tray.pieces.file: a.dxf draws no line; left out: 1 LINE on the layer NOTES, which is switched "
      "off");
}

TEST_F(Drawings, AreKnownByTheirEndingInCapitalsToo) {
  write("U.DXF", dxf("0\nLINE\n10\n0\n20\n0\n11\n3\n21\n4\n"));
  write("u.Svg", "<svg width='10mm' viewBox='0 0 10 10'><path d='M0 0H3'/></svg>");
  EXPECT_EQ(tray("[{ file = \"U.DXF\" }]").pieces.size(), 1u);
  EXPECT_EQ(tray("[{ file = \"u.Svg\" }]").pieces.size(), 1u);
}

TEST_F(Drawings, BelongToWhatASeederWasReadFrom) {
  write("a.dxf", dxf(two_lines));
  tray("{ file = \"a.dxf\" }");
  const auto files = std::make_shared<SourceFiles>();
  const Scene scene = read_scene(folder / "seeder.toml", {}, files);
  const std::string path = std::filesystem::absolute(folder / "a.dxf").string();
  ASSERT_TRUE(files->texts().contains(path));
  std::filesystem::remove(folder / "a.dxf");
  EXPECT_EQ(read_scene(folder / "seeder.toml", {}, std::make_shared<SourceFiles>(files->texts())), scene);
}

TEST(GarbledDrawings, AreReadOrRefused) {
  const std::string drawn = dxf(std::string(two_lines) +
                                "0\nARC\n10\n5\n20\n5\n40\n2\n50\n270\n51\n90\n"
                                "0\nLWPOLYLINE\n70\n1\n10\n0\n20\n0\n42\n1\n10\n4\n20\n0\n");
  const std::string vector =
      "<svg width='10mm' viewBox='0 0 10 5'><g transform='rotate(30)'><path d='M1 2C3 4 5 6 7 8s1 1 2 2Q1 2 3 4T5 6A3 "
      "2 "
      "10 0 1 4 4z'/><circle r='3'/></g></svg>";
  const auto pieces_in = [](const std::string& text, bool is_dxf) {
    return is_dxf ? read_dxf(text, "a").pieces.size() : read_svg(text, "a", {1e-3, 1, 1e-5}).pieces.size();
  };
  const auto try_to_read = [&](const std::string& text, bool is_dxf) {
    try {
      EXPECT_LT(pieces_in(text, is_dxf), 1000U);
    } catch (const InputError&) {
    }
  };
  for (const bool is_dxf : {true, false}) {
    const std::string& whole = is_dxf ? drawn : vector;
    EXPECT_GT(pieces_in(whole, is_dxf), 0U);
    for (std::size_t at = 0; at < whole.size(); ++at) {
      try_to_read(whole.substr(0, at), is_dxf);
      for (const char other : {'9', 'e', '-', '\n', '\0', '\xff'}) {
        std::string changed = whole;
        changed[at] = other;
        try_to_read(changed, is_dxf);
      }
    }
  }
}

TEST_F(Drawings, AreRefusedWithFileLineAndKey) {
  write("a.dxf", dxf(two_lines));
  write("b.dxf", dxf(two_lines, "0"));
  write("empty.dxf", dxf(""));
  write("far.dxf", dxf("0\nLINE\n10\n0\n20\n0\n11\n1e9\n21\n0\n"));
  EXPECT_EQ(
      error("{ file = \"b.dxf\" }"),
      "seeder.toml:11: tray.pieces.unit: is missing, and the drawing's $INSUNITS does not say it; such as \"mm\"");
  EXPECT_EQ(error("{ file = \"a.dxf\", unit = \"cm\" }"),
            "seeder.toml:11: tray.pieces.unit: contradicts the drawing, whose $INSUNITS says 1 mm a unit");
  EXPECT_EQ(error("{ file = \"none.dxf\" }"), "seeder.toml:11: tray.pieces.file: there is no file none.dxf");
  EXPECT_EQ(error("{ file = \"seeder.toml\" }"),
            "seeder.toml:11: tray.pieces.file: seeder.toml is neither a .dxf nor a .svg");
  EXPECT_EQ(error("{ file = \"empty.dxf\" }"), "seeder.toml:11: tray.pieces.file: empty.dxf draws no line");
  EXPECT_EQ(error("{ file = \"far.dxf\" }"),
            "seeder.toml:11: tray.pieces.file: far.dxf draws something further than 100 m away, or a circle of less "
            "than 1 um");
  EXPECT_EQ(error("{ unit = \"mm\" }"),
            "seeder.toml:11: tray.pieces.file: is missing; expected a drawing, or a list of lines and arcs");
}

}  // namespace
}  // namespace vibrosow
