// Seeder files of balls in 3D.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "input/read_scene.hpp"
#include "scene/input_error.hpp"
#include "temporary_file.hpp"

namespace vibrosow::read_space_test {
namespace {

using testing::HasSubstr;

const std::string head = R"(space = "3d"
[seeds.wheat]
diameter = "4 mm"
mass = "30 mg"
[contact]
shell_compression = 1e-4
[run]
duration = "1 s"
[tray]
length = "50 cm"
height = "12 cm"
)";
const std::string whole = head + R"(depth = "6 cm"
fill = { count = 600 }
)";

Scene read(const std::string& text) {
  const TemporaryFolder folder;
  return read_scene(folder.write("seeder.toml", text));
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ReadSpace, WhatIsOf3DAloneIsToBeRightIn2DToo) {
  const auto in_2d = [](std::string text, const std::string& lines) {
    return text.replace(text.find("3d"), 2, "2d") + lines;
  };
  const std::string deep = head + "depth = '6 cm'\n", filled = "fill = { count = 60 }\n";
  EXPECT_EQ(refusal(in_2d(deep, filled)), "");
  EXPECT_THAT(refusal(in_2d(deep, filled + "plan = 'rond'\n")), HasSubstr("tray.plan"));
  EXPECT_THAT(refusal(in_2d(deep, filled + "plan = 'round'\n")), HasSubstr("tray.depth: contradicts length"));
  EXPECT_EQ(refusal(in_2d(head, filled + "plan = 'round'\n")), "");
  EXPECT_THAT(refusal(in_2d(deep, filled + "front_and_back = 'banana'\n")), HasSubstr("tray.front_and_back"));
}

TEST(ReadSpace, MapsAreProjectionsOrSlices) {
  const auto view = [](const std::string& text) { return read(text).record->view; };
  EXPECT_EQ(view(whole + "[record]\ntimes = '1 s'\n"), MapView::projection);
  EXPECT_EQ(view(whole + "[record]\ntimes = '1 s'\nview = 'slice'\n"), MapView::slice);
  EXPECT_THAT(refusal(whole + "[record]\ntimes = '1 s'\nview = 'slce'\n"), HasSubstr("record.view"));
  const std::string plane = whole.substr(whole.find('\n'));
  EXPECT_EQ(view(plane + "[record]\ntimes = '1 s'\nview = 'slice'\n"), MapView::projection) << "counts for nothing";
}

TEST(ReadSpace, ATrayWithRowsOfRoundHoles) {
  const Scene scene = read(whole + R"(
[tray.holes]
shape = "round"
count = 3
rows = 2
width = "8 mm"
pitch = "10 cm"
)");
  EXPECT_EQ(scene.space, Space::three_dimensional);
  EXPECT_EQ(scene.tray.depth, 0.06);
  ASSERT_EQ(scene.tray.holes.size(), 6u);
  const std::vector<std::pair<double, double>> places = {{0.15, 0.015}, {0.15, 0.045}, {0.25, 0.015},
                                                         {0.25, 0.045}, {0.35, 0.015}, {0.35, 0.045}};
  for (std::size_t k = 0; k < 6; ++k) {
    const Hole& hole = scene.tray.holes[k];
    EXPECT_EQ(hole.shape, HoleShape::round);
    EXPECT_DOUBLE_EQ(hole.centre, places[k].first);
    EXPECT_DOUBLE_EQ(hole.across, places[k].second);
    EXPECT_DOUBLE_EQ(hole.width, 0.008);
  }
}

TEST(ReadSpace, ARotorOfADishAboutAnUprightAxis) {
  const std::string rotor = whole + R"(box = false
pieces = [{ line = [["0 cm", "1 cm"], ["3 cm", "1 cm"], ["3 cm", "4 cm"]], about = ["25 cm", "3 cm"] }]
motion = { kind = "turning", speed = "30 rpm", axis = "upright", pivot = ["25 cm", "3 cm"] }
)";
  const Scene scene = read(rotor);
  ASSERT_EQ(scene.tray.pieces.size(), 2u);
  EXPECT_EQ(scene.tray.pieces[0].about, Eigen::Vector2d(0.25, 0.03));
  EXPECT_EQ(scene.tray.pieces[1].a, Eigen::Vector2d(0.03, 0.01));
  const auto& motion = std::get<TurningMotion>(*scene.tray.motion);
  EXPECT_EQ(motion.axis, TurningAxis::upright);
  EXPECT_EQ(motion.pivot, Eigen::Vector2d(0.25, 0.03));
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string text = rotor;
    text.replace(text.find(from), from.size(), to);
    return refusal(text);
  };
  EXPECT_THAT(refused("about = [\"25 cm\", \"3 cm\"]", "about = [\"25 cm\"]"), HasSubstr("along and across"));
  EXPECT_THAT(refused("[\"0 cm\", \"1 cm\"]", "[\"-1 cm\", \"1 cm\"]"), HasSubstr("distance from the axis"));
  EXPECT_THAT(refused("[\"3 cm\", \"1 cm\"]", "[\"0 cm\", \"0 cm\"]"), HasSubstr("lies on the axis"));
  EXPECT_THAT(refused("box = false", "box = false\nfront_and_back = \"periodic\""), HasSubstr("about an upright axis"));
  EXPECT_THAT(refused("{ count = 600 }", "{ count = 600, keep = true }"), HasSubstr("cannot be topped up"));
}

TEST(ReadSpace, ARodAboutAnAxisAlong) {
  const std::string rod = whole + R"(
pieces = [{ line = [["1 cm", "5 cm"], ["1 cm", "45 cm"]], about = ["6 cm", "3 cm"], axis = "along" }]
)";
  const Scene scene = read(rod);
  ASSERT_EQ(scene.tray.pieces.size(), 1u);
  EXPECT_EQ(scene.tray.pieces[0].axis, PieceAxis::along);
  EXPECT_EQ(scene.tray.pieces[0].about, Eigen::Vector2d(0.06, 0.03));
  EXPECT_EQ(scene.tray.pieces[0].b, Eigen::Vector2d(0.01, 0.45));
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string text = rod;
    text.replace(text.find(from), from.size(), to);
    return refusal(text);
  };
  EXPECT_THAT(refused("about = [\"6 cm\", \"3 cm\"]", "about = [\"6 cm\"]"), HasSubstr("up and across"));
  EXPECT_THAT(refused("[\"1 cm\", \"5 cm\"]", "[\"-1 cm\", \"5 cm\"]"),
              HasSubstr("distance from the axis, place along"));
  EXPECT_THAT(refused("\"along\"", "\"across\""), HasSubstr("is not one of upright, along"));
  EXPECT_THAT(refused("about = [\"6 cm\", \"3 cm\"], ", ""), HasSubstr("expected about beside it"));
  const std::string line = "line = [[\"1 cm\", \"5 cm\"], [\"1 cm\", \"45 cm\"]]";
  EXPECT_THAT(refused(line, "centre = [\"6 cm\", \"6 cm\"], radius = \"1 cm\""), HasSubstr("an arc is drawn out"));
}

TEST(ReadSpace, PiecesDrawnOutAlongTheTray) {
  const std::string groove = whole + R"(
pieces = [{ line = [["0 cm", "2 cm"], ["3 cm", "0 cm"], ["6 cm", "2 cm"]], drawn_out = "along" },
          { centre = ["3 cm", "5 cm"], radius = "1 cm", drawn_out = "along" },
          { line = [["1 cm", "5 cm"], ["2 cm", "5 cm"]] }]
)";
  const Scene scene = read(groove);
  ASSERT_EQ(scene.tray.pieces.size(), 4u);
  EXPECT_EQ(scene.tray.pieces[1].a, Eigen::Vector2d(0.03, 0));
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(scene.tray.pieces[k].drawn_out, k < 3 ? DrawnOut::along : DrawnOut::across);
  EXPECT_THAT(refusal(groove.substr(groove.find('\n'))),
              HasSubstr("tray.pieces[1].drawn_out: a piece is drawn out along the vessel"));
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string text = groove;
    text.replace(text.find(from), from.size(), to);
    return refusal(text);
  };
  EXPECT_THAT(refused("\"along\"", "\"upright\""), HasSubstr("is not one of across, along"));
  EXPECT_THAT(refused("drawn_out", "about = [\"3 cm\", \"3 cm\"], drawn_out"),
              HasSubstr("seeder.toml:15: tray.pieces[1].drawn_out: contradicts about"));
}

TEST(ReadSpace, RowsOfHolesWithCountsOfTheirOwn) {
  const std::string rows = whole + R"(
[tray.holes]
shape = "round"
count = [3, 2]
width = "8 mm"
pitch = "10 cm"
)";
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string text = rows;
    text.replace(text.find(from), from.size(), to);
    return refusal(text);
  };
  const Scene scene = read(rows + "open_at = [\"1 s\", \"2 s\", \"3 s\", \"4 s\", \"5 s\"]\n");
  const std::vector<std::array<double, 3>> places = {
      {0.15, 0.015, 1}, {0.2, 0.045, 4}, {0.25, 0.015, 2}, {0.3, 0.045, 5}, {0.35, 0.015, 3}};
  ASSERT_EQ(scene.tray.holes.size(), places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Hole& hole = scene.tray.holes[k];
    EXPECT_DOUBLE_EQ(hole.centre, places[k][0]);
    EXPECT_DOUBLE_EQ(hole.across, places[k][1]);
    EXPECT_DOUBLE_EQ(hole.open_at, places[k][2]) << "lists go row by row";
  }
  std::string own_pitch = rows;
  own_pitch.replace(own_pitch.find("pitch"), std::string::npos, "rows = 2\nacross = \"3 cm\"\nshape = \"slot\"\n");
  own_pitch.erase(own_pitch.find("shape = \"round\"\n"), 16);
  const Scene slots = read(own_pitch);
  ASSERT_EQ(slots.tray.holes.size(), 5u);
  EXPECT_DOUBLE_EQ(slots.tray.holes[0].centre, 0.125);
  EXPECT_NEAR(slots.tray.holes[1].centre, 0.5 / 3, 1e-11) << "each row has the pitch of its own number";
  EXPECT_DOUBLE_EQ(slots.tray.holes[1].across, 0.045);
  const Scene at = read(rows + "across = [\"1 cm\", \"5 cm\"]\n");
  EXPECT_DOUBLE_EQ(at.tray.holes[1].across, 0.05);
  EXPECT_EQ(read(rows + "rows = 2\n").tray.holes.size(), 5u);
  EXPECT_THAT(refused("[3, 2]", "[3, 0]"),
              HasSubstr("seeder.toml:17: tray.holes.count: must be a whole number from 1"));
  EXPECT_THAT(refused("[3, 2]", "[]"), HasSubstr("tray.holes.count: the list is empty"));
  EXPECT_THAT(refused("[3, 2]", "[3, 20]"), HasSubstr("tray.holes.pitch: hole"));
  EXPECT_THAT(refusal(rows + "rows = 3\n"), HasSubstr("seeder.toml:20: tray.holes.rows: contradicts count"));
  EXPECT_THAT(refusal(rows + "across = [\"1 cm\"]\n"), HasSubstr("tray.holes.across: lists 1 places for the 2 rows"));
  EXPECT_THAT(refused("\"8 mm\"", "[\"8 mm\", \"9 mm\", \"8 mm\"]"), HasSubstr("lists 3 widths for 5 holes"));
  EXPECT_THAT(refusal(rows.substr(rows.find('\n'))), HasSubstr("tray.holes.count: is one number in 2D"));
}

TEST(ReadSpace, RoundHolesOfAThickFloor) {
  const std::string holes = "\n[tray.holes]\ncount = 2\nwidth = \"8 mm\"\npitch = \"10 mm\"\n",
                    round = whole + holes + "shape = \"round\"\n";
  for (const Hole& hole : read(round).tray.holes) EXPECT_EQ(hole.rim_width(), hole.width);
  for (const Hole& hole : read(round + "thickness = \"2 mm\"\nchamfer = \"0.5 mm\"\n").tray.holes) {
    EXPECT_DOUBLE_EQ(hole.thickness, 2e-3);
    EXPECT_DOUBLE_EQ(hole.rim_width(), 9e-3);
    EXPECT_DOUBLE_EQ(hole.width, 8e-3);
  }
  EXPECT_DOUBLE_EQ(read(round + "chamfer = \"0.5 mm\"\n").tray.holes[0].thickness, 0.5e-3) << "at least";
  EXPECT_THAT(refusal(round + "chamfer = \"1.1 mm\"\n"), HasSubstr("tray.holes.pitch: hole 1")) << "their rims meet";
  EXPECT_THAT(refusal(round + "thickness = \"1 mm\"\nchamfer = \"1.5 mm\"\n"),
              HasSubstr("tray.holes.chamfer: 1.5 mm is more than the floor's thickness"));
  EXPECT_THAT(refusal(round + "thickness = \"20 mm\"\n"),
              HasSubstr("tray.holes.thickness: 20 mm reaches to the counting line"));
  for (const std::string key : {"thickness", "chamfer"})
    EXPECT_THAT(refusal(whole + holes + key + " = \"1 mm\"\n"), HasSubstr("tray.holes." + key + ": is of round holes"));
}

TEST(ReadSpace, RowsWhereTheyAreSaidToBe) {
  const Scene scene =
      read(whole + R"(holes = { shape = "round", at = ["10 cm"], across = ["1 cm", "5 cm"], width = "8 mm" })");
  ASSERT_EQ(scene.tray.holes.size(), 2u);
  EXPECT_DOUBLE_EQ(scene.tray.holes[0].across, 0.01);
  EXPECT_DOUBLE_EQ(scene.tray.holes[1].across, 0.05);
}

TEST(ReadSpace, SlotsReachFromFrontToBackUnlessTheyAreSaidToBeShorter) {
  const Scene all = read(whole + R"(holes = { at = ["10 cm"], width = "8 mm" })");
  EXPECT_EQ(all.tray.holes.front().shape, HoleShape::slot);
  EXPECT_DOUBLE_EQ(all.tray.holes.front().across, 0.03);
  EXPECT_DOUBLE_EQ(all.tray.holes.front().across_length, 0.06);
  const Scene some = read(whole + R"(holes = { at = ["10 cm"], width = "8 mm", rows = 2, across = "2 cm" })");
  ASSERT_EQ(some.tray.holes.size(), 2u);
  EXPECT_DOUBLE_EQ(some.tray.holes[1].across, 0.045);
  EXPECT_DOUBLE_EQ(some.tray.holes[1].across_length, 0.02);
}

TEST(ReadSpace, AHopperTakesTheTraysDepthAndARoundOneItsDiameter) {
  const std::string hopper = R"(
[hopper]
left = "10 cm"
above = "10 cm"
length = "5 cm"
height = "10 cm"
fill = { count = 100 }
)";
  const Scene box = read(whole + hopper);
  EXPECT_EQ(box.hopper->depth, 0.06);
  EXPECT_EQ(box.hopper->front, 0);
  const Scene round = read(whole + hopper + R"(
plan = "round"
front = "5 mm"
funnel = "50 degree"
holes = { shape = "round", count = 1, width = "2 cm" }
)");
  EXPECT_EQ(round.hopper->plan, Plan::round);
  EXPECT_EQ(round.hopper->depth, 0.05);
  EXPECT_EQ(round.hopper->front, 0.005);
  EXPECT_DOUBLE_EQ(round.hopper->holes.front().across, 0.025);
  const Scene periodic = read(whole + "front_and_back = \"periodic\"\n" + hopper);
  EXPECT_EQ(periodic.hopper->front_and_back, Sides::periodic);
}

TEST(ReadSpace, AMotionInAnyDirection) {
  const Scene scene = read(whole + R"([tray.motion]
kind = "harmonic"
direction = [1, 0, 1]
amplitude = "1 mm"
frequency = "9 Hz"
)");
  const auto& motion = std::get<HarmonicMotion>(*scene.tray.motion);
  EXPECT_DOUBLE_EQ(motion.direction, 0);
  EXPECT_DOUBLE_EQ(motion.across, std::atan(1.0));
}

TEST(ReadSpace, InThePlaneWhatBelongsToSpaceCountsForNothing) {
  std::string text = whole + R"(front_and_back = "periodic"
holes = { shape = "round", at = ["10 cm"], rows = 2, width = "8 mm" }
)";
  text.replace(text.find("3d"), 2, "2d");
  const Scene scene = read(text);
  EXPECT_EQ(scene.space, Space::two_dimensional);
  EXPECT_EQ(scene.tray.holes.size(), 1u);
  EXPECT_EQ(scene.tray.front_and_back, Sides::walls);
}

TEST(ReadSpace, TheOlderWordFor2DIsRead) {
  std::string text = whole;
  text.replace(text.find("3d"), 2, "plane");
  EXPECT_EQ(read(text).space, Space::two_dimensional);
  text.replace(text.find("plane"), 5, "plan");
  EXPECT_THAT(refusal(text), HasSubstr("\"plan\" is not one of 2d, 3d"));
}

TEST(ReadSpace, NothingNegativeHugeAndNoNumberAreRefusedByTheirKey) {
  for (const std::string length : {"0 cm", "-1 cm", "1e9 m", "1e300 m", "nan cm", "inf cm"}) {
    SCOPED_TRACE(length);
    const auto refused = [&](const std::string& text, const std::string& key) {
      std::string file = text;
      file.replace(file.find("LENGTH"), 6, length);
      EXPECT_THAT(refusal(file), HasSubstr(key));
    };
    refused(head + "depth = 'LENGTH'\nfill = { count = 600 }\n", "tray.depth");
    refused(whole + "holes = { shape = 'round', count = 2, width = 'LENGTH' }\n", "tray.holes.width");
    refused(whole + "holes = { at = '10 cm', width = '8 mm', across = 'LENGTH' }\n", "tray.holes.across");
    if (length != "0 cm")
      refused(whole + "holes = { shape = 'round', at = '10 cm', width = '8 mm', across = 'LENGTH' }\n", "tray.holes");
  }
  for (const std::string number : {"-1", "1e300", "nan", "inf"}) {
    std::string text = whole;
    text.replace(text.find("[run]"), 5, "twisting_friction = " + number + "\n[run]");
    EXPECT_THAT(refusal(text), HasSubstr("twisting_friction")) << number;
  }
}

TEST(ReadSpace, WhatCannotBeMeantIsRefused) {
  EXPECT_THAT(refusal(head + "fill = { count = 600 }\n"), HasSubstr("depth: is missing"));
  EXPECT_THAT(
      refusal(whole + R"(holes = { shape = "round", at = ["10 cm"], across = "1 mm", width = "8 mm" })"),
      HasSubstr("tray.holes.at: hole 1 at 100 mm, 1 mm from the front, 8 mm wide, is not within the floor, which "
                "is 500 mm long and 60 mm deep"));
  EXPECT_THAT(refusal(whole + R"(holes = { shape = "round", at = ["10 cm", "10.5 cm"], rows = 2, width = "8 mm" })"),
              HasSubstr("overlaps or touches"));
  EXPECT_THAT(
      refusal(whole + R"(holes = { shape = "round", at = ["10 cm"], rows = 2, across = ["1 cm"], width = "8 mm" })"),
      HasSubstr("tray.holes.rows: contradicts across"));
  EXPECT_THAT(refusal(whole + R"(holes = { at = ["10 cm"], rows = 2, width = "8 mm" })"),
              HasSubstr("tray.holes.across: is missing"));
  EXPECT_THAT(refusal(whole + R"(holes = { at = ["10 cm"], across = "7 cm", width = "8 mm" })"),
              HasSubstr("tray.holes.across: 70 mm is longer than 60 mm"));
  EXPECT_THAT(refusal(whole + "plan = \"round\"\n"), HasSubstr("tray.depth: contradicts length"));
  EXPECT_THAT(refusal(whole + "funnel = \"40 degree\"\nholes = { shape = \"round\", count = 1, width = \"8 mm\" }\n"),
              HasSubstr("tray.funnel: needs slots from front to back"));
  EXPECT_THAT(
      refusal(whole +
              "[tray.motion]\nkind = \"harmonic\"\ndirection = [1, 0]\namplitude = \"1 mm\"\nfrequency = \"9 Hz\"\n"),
      HasSubstr("three numbers"));
  std::string plane =
      whole + "[tray.motion]\nkind = \"harmonic\"\ndirection = [0, 0, 1]\namplitude = \"1 mm\"\nfrequency = \"9 Hz\"\n";
  plane.replace(plane.find("3d"), 2, "2d");
  EXPECT_THAT(refusal(plane), HasSubstr("tray.motion.direction: a motion from front to back needs space"));
  EXPECT_THAT(refusal(whole + "holes = { shape = \"square\", count = 1, width = \"8 mm\" }\n"),
              HasSubstr("tray.holes.shape"));
  std::string tiny = whole;
  tiny.replace(tiny.find("6 cm"), 4, "2 cm");
  EXPECT_THAT(refusal(tiny + "front_and_back = \"periodic\"\n"), HasSubstr("6 diameters"));
}

}  // namespace
}  // namespace vibrosow::read_space_test
