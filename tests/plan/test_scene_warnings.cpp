#include "plan/scene_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "grains/fill_height.hpp"
#include "scene/clump_shape.hpp"
#include "scene/make_clump.hpp"

namespace vibrosow {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

constexpr double diameter = 4e-3;

/// A shaken tray with three holes, and seeds of 1200 kg/m3.
Scene sound() {
  Scene scene;
  SeedLot lot;
  lot.name = "wheat";
  lot.diameter = diameter;
  lot.mass = 1200 * std::numbers::pi / 6 * std::pow(diameter, 3);
  scene.lots = {lot};
  scene.contact.seed.friction = scene.contact.wall.friction = 0.3;
  scene.contact.wall.rolling_friction = 0.02;
  scene.tray.name = "tray";
  scene.tray.length = 0.5;
  scene.tray.height = 0.12;
  scene.tray.holes = {{0.1, 0.012}, {0.25, 0.012}, {0.4, 0.012}};
  scene.tray.fill = Fill{500};
  scene.tray.motion = HarmonicMotion{0, 0.01, 9};
  scene.run.duration = 10;
  return scene;
}

Vessel hopper(double outlet) {
  Vessel vessel;
  vessel.name = "hopper";
  vessel.origin = {0.2, 0.13};
  vessel.length = 0.08;
  vessel.height = 0.15;
  vessel.holes = {{0.04, outlet}};
  vessel.fill = Fill{200};
  return vessel;
}

TEST(SceneWarnings, ASoundSceneHasNone) {
  Scene scene = sound();
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  scene.hopper = hopper(0.03);
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  scene.tray.rain = Rain{200, 0, 0.5, 0.12};
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
}

TEST(SceneWarnings, ATableOfTooFewRowsForItsMotion) {
  Scene scene = sound();
  const auto shaken = [](int rows) {
    TableMotion table;
    for (int k = 0; k < 20 * rows; ++k) {
      table.times.push_back(k * 10.0 / (19 * rows));
      table.y.push_back(5e-3 * std::cos(2 * std::numbers::pi * (k + 0.5) / rows));
      table.x.push_back(0), table.angle.push_back(0);
    }
    return table;
  };
  scene.tray.motion = shaken(5);
  EXPECT_THAT(scene_warnings(scene), Contains(AllOf(StartsWith("tray.motion.file: between "),
                                                    HasSubstr("% of all that y_mm goes through; give more rows"))));
  scene.tray.motion = shaken(10);
  EXPECT_THAT(scene_warnings(scene), Not(Contains(HasSubstr("motion.file"))));
}

TEST(SceneWarnings, AContactThatIsMadeForOtherSeeds) {
  Scene scene = sound();
  scene.lots[0].crop = {{"wheat", "crops/wheat.toml"}};
  scene.lots[0].contact = {"wheat-steel", "contacts/wheat-steel.toml"};
  scene.contact.model.of_crops = true;
  EXPECT_THAT(scene_warnings(scene), IsEmpty()) << "each lot has that of its crop";
  scene.contact.model = {scene.lots[0].contact};
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  scene.contact.model = {{"pea-steel", "contacts/pea-steel.toml"}};
  EXPECT_THAT(scene_warnings(scene),
              ElementsAre(AllOf(HasSubstr("\"pea-steel\" is made for other seeds than seeds.wheat"),
                                HasSubstr("\"wheat-steel\""))));
  scene.contact.model = {{"contact", "fitted/contact.toml"}};
  EXPECT_THAT(scene_warnings(scene), IsEmpty()) << "one that was fitted, or chosen by hand";
  scene.contact.model = {{"pea-steel", "contacts/pea-steel.toml"}};
  scene.contact.overrides = {{0, -1, scene.contact.wall}, {0, 0, scene.contact.seed}};
  EXPECT_THAT(scene_warnings(scene), IsEmpty()) << "the seeder gives its pairs itself";
}

SeedLot ball(const std::string& name, double size, double fraction) {
  SeedLot lot;
  lot.name = name, lot.diameter = size, lot.number_fraction = fraction;
  lot.mass = 1200 * std::numbers::pi / 6 * std::pow(size, 3);
  return lot;
}

TEST(SceneWarnings, AMixtureThatIsNotTheOneAskedFor) {
  Scene scene = sound();
  scene.lots = {ball("clover", 2e-3, 0.995), ball("pea", 6e-3, 0.005)};
  scene.tray.fill->count = 500;  // 2.5 peas
  ASSERT_EQ(scene_warnings(scene).size(), 1u);
  EXPECT_THAT(scene_warnings(scene)[0],
              AllOf(StartsWith("tray.fill.count: of 500 seeds 2 are of pea: 0.4 % by number instead of 0.5 %, "),
                    HasSubstr("by mass instead of 11.9 %")));
  scene.tray.fill->count = 2000;
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  scene.tray.rain = Rain{.rate = 20, .from = 0, .to = 0.5, .height = 0.12};
  EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("the rain brings 1 seeds of pea on average")));
  scene.tray.rain->rate = 200;
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
}

TEST(SceneWarnings, RowsThatSinkBelowTheHeightAskedFor) {
  for (const Space space : {Space::two_dimensional, Space::three_dimensional})
    for (const bool clumps : {false, true})
      for (const Packing packing : {Packing::poured, Packing::layers, Packing::hexagonal})
        for (const char* asked : {"tray", "hopper"}) {
          Scene scene = sound();
          scene.space = space;
          scene.contact.wall.rolling_friction = 0.02;
          if (clumps) make_clump(scene.lots[0], elongated(7e-3, 3e-3), space);
          scene.hopper = hopper(0.03);
          for (Vessel* vessel : {&scene.tray, &*scene.hopper}) {
            vessel->depth = 0.05;
            for (Hole& hole : vessel->holes) hole.across = 0.025, hole.across_length = 0.05;
            if (vessel->name != asked) continue;
            vessel->fill->packing = packing;
            vessel->fill->where = WrittenAt("seeder.toml:3: " + vessel->name + ".fill.height");
            vessel->fill->count = static_cast<int>(seeds_to_height(*vessel, scene.lots, space, 0.02));
          }
          const auto told = Contains(AllOf(StartsWith(std::string(asked) + ".fill.height: "), HasSubstr("in rows lie"),
                                           HasSubstr("they sink to some")));
          if (clumps && packing != Packing::poured)
            EXPECT_THAT(scene_warnings(scene), told);
          else
            EXPECT_THAT(scene_warnings(scene), Not(told));
          for (Vessel* vessel : {&scene.tray, &*scene.hopper}) vessel->fill->where = WrittenAt("s.toml:3: fill.count");
          EXPECT_THAT(scene_warnings(scene), Not(told)) << "a count lies as high as it lies";
        }
}

TEST(SceneWarnings, RowsOfTwoSizesSink) {
  Scene scene = sound();
  scene.lots.push_back(scene.lots[0]);
  scene.lots[0].number_fraction = 0.1;
  scene.lots[1].name = "clover", scene.lots[1].number_fraction = 0.9, scene.lots[1].diameter = 0.25 * diameter;
  scene.tray.fill->packing = Packing::layers;
  scene.tray.fill->where = WrittenAt("seeder.toml:3: tray.fill.height");
  EXPECT_THAT(scene_warnings(scene), Contains(HasSubstr("they sink to some")));
}

TEST(SceneWarnings, ABedOfTheSlicesThatCannotBe) {
  Scene scene = sound();
  scene.tray.depth = 0.06;
  scene.lots = {ball("clover", 1e-3, 216.0 / 217), ball("pea", 6e-3, 1.0 / 217)};
  scene.tray.fill->count = 10850;
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  // A seed of one large disc with a long tail of tiny ones is as thick as that nowhere else.
  scene.lots = {ball("tailed", 1e-3, 1)};
  scene.lots[0].shape = Shape::clump;
  scene.lots[0].discs = {{0, 0, 1e-3}};
  for (int k = 0; k < 40; ++k) scene.lots[0].discs.push_back({1.1e-3 + 3e-4 * k, 0, 2e-4});
  scene.lots[0].mass = 5e-6;
  ASSERT_EQ(scene_warnings(scene).size(), 1u);
  EXPECT_THAT(scene_warnings(scene)[0], AllOf(StartsWith("tray.depth: slices 2 mm thick make a bed of"),
                                              HasSubstr("% of the seeds' own density")));
}

TEST(SceneWarnings, DensityThatNoSeedHas) {
  Scene scene = sound();
  scene.lots[0].mass *= 10;
  EXPECT_THAT(scene_warnings(scene), ElementsAre(StartsWith("seeds.wheat: its mass and size make ")));
  scene.lots[0].mass /= 200;
  EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("make seeds of 60 kg/m3")));
  scene.lots[0].shape = Shape::disc;  // has no thickness
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
}

TEST(SceneWarnings, WhatTheReaderFoundIsOneOfThem) {
  Scene scene = sound();
  scene.doubts_of_reader.sentences = {"tray.pieces: a.dxf draws no more than 4 mm"};
  EXPECT_EQ(scene_warnings(scene), scene.doubts_of_reader.sentences);
}

TEST(SceneWarnings, DensityThatTheCropsSeedsHaveNot) {
  Scene scene = sound();
  scene.lots[0].crop = {{"wheat", "crops/wheat.toml"}, 1200.0};
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  scene.lots[0].mass *= 1.19;
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  for (const double times : {1.22, 1 / 1.22}) {
    scene = sound();
    scene.lots[0].crop = {{"wheat", "crops/wheat.toml"}, times * 1200};
    EXPECT_THAT(scene_warnings(scene), ElementsAre(AllOf(StartsWith("seeds.wheat: its mass and size make seeds of 1.2"),
                                                         HasSubstr("those of crop \"wheat\" have"))));
  }
}

TEST(SceneWarnings, ACropsContactModelThatIsNotUsed) {
  Scene scene = sound();
  scene.lots[0].contact = {"wheat-steel", "contacts/wheat-steel.toml"};
  EXPECT_THAT(scene_warnings(scene),
              ElementsAre(AllOf(StartsWith("contact: gives a stiffness"), HasSubstr("wheat-steel, the contact model"),
                                HasSubstr("restitution 1 and roll without resistance"))));
  scene.contact.model.of_crops = true;
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  scene.contact.model.of_crops = false, scene.contact.seed.restitution = 0.5;
  EXPECT_THAT(scene_warnings(scene), IsEmpty()) << "it is written out";
}

TEST(SceneWarnings, HolesNarrowerThanASeed) {
  Scene scene = sound();
  scene.tray.holes[1].width = 3.9e-3;
  EXPECT_THAT(scene_warnings(scene), ElementsAre("tray.holes.width: 3.9 mm is narrower than seeds of wheat, up to 4 mm "
                                                 "thick, which cannot pass"));
  scene.lots[0].shape = Shape::clump;  // 4 mm long, 3 mm thick
  scene.lots[0].discs = {{-0.5e-3, 0, 1.5e-3}, {0.5e-3, 0, 1.5e-3}};
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  scene.lots[0].sizes = {SizeDistribution::Kind::uniform, diameter, 0, 2e-3, 6e-3, {}, {}};
  EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("up to 4.5 mm thick")));
}

TEST(SceneWarnings, NeitherMotionNorFriction) {
  Scene scene = sound();
  scene.tray.motion.reset();
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  scene.contact.seed.friction = scene.contact.wall.friction = 0;
  EXPECT_THAT(scene_warnings(scene), ElementsAre(StartsWith("tray.motion: the tray stands still")));
  scene.tray.motion = HarmonicMotion{0, 0, 9};
  EXPECT_THAT(scene_warnings(scene), ElementsAre(StartsWith("tray.motion: ")));
  scene.contact.overrides = {{0, -1, {0.2}}};
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
}

TEST(SceneWarnings, BallsInAThinLayerThatRollFreely) {
  Scene thin = sound();
  thin.tray.fill->count = 150;
  thin.contact.wall.rolling_friction = 0;
  const auto told =
      ElementsAre(StartsWith("contact.wall.rolling_friction: is 0, and round seeds lie in a thin bed (1 layers)"));
  EXPECT_THAT(scene_warnings(thin), told);
  thin.contact.overrides = {{0, -1, {.friction = 0.3}}};
  EXPECT_THAT(scene_warnings(thin), told);
  for (const auto& mend : std::vector<std::function<void(Scene&)>>{
           [](Scene& scene) {
             scene.contact.overrides = {{0, -1, {.friction = 0.3, .rolling_friction = 0.02}}};
           },
           [](Scene& scene) { scene.contact.rotation = false; },
           [](Scene& scene) { scene.lots[0].shape = Shape::clump; },
           [](Scene& scene) { std::get<HarmonicMotion>(*scene.tray.motion).direction = std::numbers::pi / 2; },
           [](Scene& scene) { scene.tray.fill->count = 500; }, [](Scene& scene) { scene.tray.fill.reset(); },
           [](Scene& scene) { scene.tray.funnel = 0.5; }, [](Scene& scene) { scene.tray.box = false; }}) {
    Scene mended = thin;
    mend(mended);
    EXPECT_THAT(scene_warnings(mended), Not(Contains(HasSubstr("roll on it"))));
  }
}

TEST(SceneWarnings, RainThatHasNoRoom) {
  Scene scene = sound();
  scene.tray.fill.reset();
  scene.tray.rain = Rain{10000, 0.2, 0.2, 0.12};
  EXPECT_THAT(scene_warnings(scene),
              ElementsAre(StartsWith("tray.rain.rate: 1e+04 seeds/s cannot all come: 1 seeds lie side by side")));
  scene.tray.rain->rate = 30;
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  scene.tray.rain->rate = 10000;
  scene.tray.rain->from = 0, scene.tray.rain->to = 0.5;
  EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("126 seeds lie side by side")));
}

TEST(SceneWarnings, RainThatHardlyBringsASeed) {
  Scene scene = sound();
  scene.tray.rain = Rain{.rate = 0.2, .to = 0.5, .height = 0.12};
  EXPECT_THAT(scene_warnings(scene), ElementsAre("tray.rain: brings 2 seeds on average in the whole run"));
  scene.tray.rain->rate = 40, scene.tray.rain->start = 10;
  EXPECT_THAT(scene_warnings(scene), ElementsAre("tray.rain: brings 0 seeds on average in the whole run",
                                                 StartsWith("tray.rain.start: it rains from 10 s on")));
}

TEST(SceneWarnings, MoreRainThanAClosedTrayHolds) {
  Scene scene = sound();
  scene.tray.fill.reset();
  scene.tray.rain = Rain{1000, 0, 0.5, 0.12};
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  scene.tray.holes.clear();
  EXPECT_THAT(scene_warnings(scene),
              ElementsAre(StartsWith("tray.rain.rate: 1e+04 seeds are to come, but the tray has no")));
  scene.tray.rain->stop = 3;
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
}

TEST(SceneWarnings, HopperThatCannotFollow) {
  Scene scene = sound();
  scene.hopper = hopper(0.011);
  EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("below 3 arches stop the flow")));
  scene.hopper = hopper(0.013);
  scene.tray.holes.assign(5, {0.1, 0.02});
  EXPECT_THAT(scene_warnings(scene), ElementsAre(StartsWith("hopper.holes.width: the hopper cannot follow")));
  scene.hopper->holes.clear();
  EXPECT_THAT(scene_warnings(scene), ElementsAre("hopper.holes: is missing, so no seed leaves the hopper"));
}

TEST(SceneWarnings, InThePlaneSlotsReachFromFrontToBack) {
  Scene scene = sound();
  scene.tray.slots_in_3d = {3, 0.75};
  EXPECT_THAT(scene_warnings(scene),
              ElementsAre(AllOf(StartsWith("tray.holes.across: in 2D"), HasSubstr("open 75 % of the depth"),
                                HasSubstr("up to 1.3 times too high")),
                          StartsWith("tray.holes.rows: in 2D one hole stands for 3")));
}

TEST(SceneWarnings, InThePlaneAHopperIsAsDeepAsItsTray) {
  Scene scene = sound();
  scene.tray.depth = 0.08;
  scene.hopper = hopper(0.03);
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  scene.hopper->depth = 0.08;
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  scene.hopper->depth = 0.02;
  EXPECT_THAT(scene_warnings(scene), ElementsAre(AllOf(StartsWith("hopper.depth: 20 mm is taken for the tray's 80 mm"),
                                                       HasSubstr("4 times"))));
}

TEST(SceneWarnings, InThePlaneARoundHoleIsTakenForASlot) {
  Scene scene = sound();
  scene.tray.depth = 0.06;
  scene.tray.holes = {{0.25, 0.016, 0, HoleShape::round, 0, 0}};
  EXPECT_THAT(scene_warnings(scene), ElementsAre(StartsWith("tray.holes.shape: in 2D a round hole is taken for a slot "
                                                            "from front to back, 4.8 times the area of a round hole")));
  scene.tray.slots_in_3d.rows = 2;
  EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("from front to back, 2.4 times the area of its round holes"),
                                                 StartsWith("tray.holes.rows: in 2D one hole stands for 2")));
  scene.tray.slots_in_3d.rows = 1;
  scene.space = Space::three_dimensional;
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
}

Scene sound_3d(HoleShape shape = HoleShape::slot) {
  Scene scene = sound();
  scene.space = Space::three_dimensional;
  scene.tray.depth = 0.06;
  scene.tray.fill->count = 5000;
  for (Hole& hole : scene.tray.holes)
    hole.shape = shape, hole.across = 0.03, hole.across_length = shape == HoleShape::slot ? 0.06 : 0;
  return scene;
}

WallPiece straight(double ax, double ay, double bx, double by) {
  WallPiece piece;
  piece.a = {ax, ay}, piece.b = {bx, by};
  return piece;
}
WallPiece turned(double ra, double ha, double rb, double hb, PieceAxis axis = PieceAxis::upright,
                 const Eigen::Vector2d& about = {0.25, 0.03}) {
  WallPiece piece = straight(ra, ha, rb, hb);
  piece.about = about, piece.axis = axis;
  return piece;
}

std::vector<std::string> warnings_with(Scene scene, std::vector<WallPiece> pieces) {
  scene.tray.pieces = std::move(pieces);
  return scene_warnings(scene);
}

TEST(SceneWarnings, APieceOverAHole) {
  for (const Scene& scene : {sound(), sound_3d(), sound_3d(HoleShape::round)}) {
    EXPECT_THAT(warnings_with(scene, {straight(0.2, 0, 0.3, 0)}),
                ElementsAre("tray.pieces: piece 1 covers hole 2: what is drawn across a hole is a wall there"));
    EXPECT_THAT(warnings_with(scene, {straight(0, 0.001, 0.5, 0.001)}),
                ElementsAre(HasSubstr("piece 1 covers hole 1, hole 2, hole 3:")));
    EXPECT_THAT(warnings_with(scene, {straight(0.2, 0.05, 0.3, 0.05), straight(0.247, -1e-4, 0.3, 1e-4)}),
                ElementsAre(HasSubstr("piece 2 covers hole 2 (75 % of it):")));
    EXPECT_THAT(warnings_with(scene, {straight(0.25, 0.05, 0.25, -0.01)}),
                ElementsAre(HasSubstr("hole 2 (stands in it)")));
    WallPiece arc;
    arc.centre = {0.25, 0.05}, arc.radius = 0.05, arc.from = 1.1 * std::numbers::pi, arc.to = 1.9 * std::numbers::pi;
    EXPECT_THAT(warnings_with(scene, {arc}), ElementsAre(HasSubstr("covers hole 2:")));
    // A roof above, a chute beneath that begins at the edges, a line on the floor up to the edge.
    EXPECT_THAT(warnings_with(scene, {straight(0.2, 0.01, 0.3, 0.01), straight(0.244, 0, 0.24, -0.015),
                                      straight(0.256, 0, 0.256, -0.015), straight(0.2, 0, 0.244, 0)}),
                IsEmpty());
  }
}

TEST(SceneWarnings, ATurnedPieceOverAHole) {
  for (const HoleShape shape : {HoleShape::slot, HoleShape::round}) {
    const Scene scene = sound_3d(shape);
    EXPECT_THAT(warnings_with(scene, {turned(0, 0, 0.1, 0)}), ElementsAre(HasSubstr("covers hole 2:")));
    EXPECT_THAT(warnings_with(scene, {turned(0, 0, 0.003, 0)}), ElementsAre(HasSubstr("hole 2 (")));
    EXPECT_THAT(warnings_with(scene, {turned(0.0019, 0, 0.0019, 0.4, PieceAxis::along, {0, 0.03})}),
                ElementsAre(HasSubstr("piece 1 covers hole 1 (")));
    EXPECT_THAT(warnings_with(scene, {turned(0.04, 0.02, 0.1, 0.05),
                                      turned(0.01, 0.1, 0.01, 0.4, PieceAxis::along, {0.05, 0.03})}),
                IsEmpty());
  }
}

TEST(SceneWarnings, ATubeInAHole) {
  const auto stands = ElementsAre(HasSubstr("piece 1 covers hole 2 (stands in it):"));
  for (const HoleShape shape : {HoleShape::slot, HoleShape::round}) {
    const Scene scene = sound_3d(shape);
    for (const double radius : {0.003, 0.0031, 0.0049})
      EXPECT_THAT(warnings_with(scene, {turned(radius, -0.005, radius, 0.03)}), stands) << radius;
    EXPECT_THAT(warnings_with(scene, {turned(0.02, -0.005, 0.02, 0.03, PieceAxis::upright, {0.27, 0.03})}), stands);
    // A thin disc upright across the hole; a wide cylinder along the tray whose side passes through the floor there.
    EXPECT_THAT(warnings_with(scene, {turned(0, 0.2501, 0.01, 0.2501, PieceAxis::along, {0.001, 0.03})}), stands);
    const auto wide = warnings_with(scene, {turned(0.01, 0.24, 0.01, 0.26, PieceAxis::along, {0, 0.0312})});
    EXPECT_THAT(wide, SizeIs(shape == HoleShape::slot ? 1 : 0));
    // Round it, above it, and beside it.
    EXPECT_THAT(warnings_with(sound_3d(HoleShape::round), {turned(0.006, -0.005, 0.006, 0.03)}), IsEmpty());
    EXPECT_THAT(warnings_with(scene, {turned(0.003, 0.01, 0.003, 0.03)}), IsEmpty());
    EXPECT_THAT(warnings_with(scene, {turned(0.02, -0.005, 0.02, 0.03, PieceAxis::upright, {0.28, 0.03})}), IsEmpty());
    EXPECT_THAT(warnings_with(scene, {turned(0, 0.26, 0.01, 0.26, PieceAxis::along, {0.001, 0.03})}), IsEmpty());
  }
}

/// A periodic tray's pieces stand again a period on, along it and across.
TEST(SceneWarnings, AnImageOfAPieceOverAHole) {
  const auto first = ElementsAre(HasSubstr("piece 1 covers hole 1:")), last = ElementsAre(HasSubstr("covers hole 3:"));
  for (Scene scene : {sound(), sound_3d(), sound_3d(HoleShape::round)}) {
    scene.tray.holes[0].centre = 0.007, scene.tray.holes[2].centre = 0.493;
    EXPECT_THAT(warnings_with(scene, {straight(0.49, 0.001, 0.4999, 0.001)}), ElementsAre(HasSubstr("hole 3 (")));
    scene.tray.sides = Sides::periodic;
    EXPECT_THAT(warnings_with(scene, {straight(0.5005, 0.001, 0.514, 0.001)}), first);
    EXPECT_THAT(warnings_with(scene, {straight(-0.014, 0.001, -0.0005, 0.001)}), last);
    if (scene.space == Space::two_dimensional) continue;
    EXPECT_THAT(warnings_with(scene, {turned(0, 0, 0.04, 0, PieceAxis::upright, {0.507, 0.03})}),
                ElementsAre(AllOf(HasSubstr("hole 1"), HasSubstr("hole 3"))));
    EXPECT_THAT(warnings_with(scene, {turned(0.0019, 0.501, 0.0019, 0.513, PieceAxis::along, {0, 0.03})}),
                ElementsAre(HasSubstr("covers hole 1 (")));
  }
  Scene deep = sound_3d(HoleShape::round);
  deep.tray.front_and_back = Sides::periodic;
  for (Hole& hole : deep.tray.holes) hole.across = 0.007;
  EXPECT_THAT(warnings_with(deep, {turned(0, 0, 0.009, 0, PieceAxis::upright, {0.25, 0.067})}),
              ElementsAre(HasSubstr("piece 1 covers hole 2:")));
  WallPiece along = straight(0.0605, 0, 0.074, 0);
  along.drawn_out = DrawnOut::along;
  EXPECT_THAT(warnings_with(deep, {along}), ElementsAre(HasSubstr("covers hole 1, hole 2, hole 3:")));
}

TEST(SceneWarnings, PiecesBeyondTheNextPeriod) {
  const auto beyond = Contains(HasSubstr("is no wall anywhere"));
  for (Scene scene : {sound(), sound_3d()})
    for (const double shift : {0.0, 0.52, -0.52, 0.8, -0.6}) {
      scene.tray.sides = Sides::periodic;
      EXPECT_THAT(warnings_with(scene, {straight(0.1 + shift, 0.05, 0.2 + shift, 0.05)}), IsEmpty()) << shift;
    }
  Scene scene = sound_3d();
  EXPECT_THAT(warnings_with(scene, {straight(1.001, 0.05, 1.01, 0.05)}), Not(beyond));
  EXPECT_THAT(warnings_with(scene, {turned(0.01, 0.05, 0.01, 0.06, PieceAxis::upright, {0.25, 0.125})}), Not(beyond));
  scene.tray.sides = scene.tray.front_and_back = Sides::periodic;
  EXPECT_THAT(warnings_with(scene, {straight(1.001, 0.05, 1.01, 0.05)}),
              ElementsAre("tray.pieces: piece 1 reaches from 1001 mm to 1010 mm along the periodic tray: what lies "
                          "before -500 mm or beyond 1000 mm, further than a period beside it, is no wall anywhere; "
                          "draw it in the tray"));
  EXPECT_THAT(warnings_with(scene, {straight(-0.51, 0.05, -0.4, 0.05)}), beyond);
  EXPECT_THAT(warnings_with(scene, {turned(0.01, 0.05, 0.01, 0.06, PieceAxis::upright, {0.25, 0.125})}), beyond);
  WallPiece along = straight(0.11, 0.05, 0.13, 0.05);
  along.drawn_out = DrawnOut::along;
  EXPECT_THAT(warnings_with(scene, {along}), beyond);
}

TEST(SceneWarnings, APieceAlongTheTrayOverAHole) {
  const auto along = [](WallPiece piece) {
    piece.drawn_out = DrawnOut::along;
    return piece;
  };
  for (const HoleShape shape : {HoleShape::slot, HoleShape::round}) {
    const Scene scene = sound_3d(shape);
    EXPECT_THAT(warnings_with(scene, {along(straight(0, 0, 0.06, 0))}),
                ElementsAre(HasSubstr("piece 1 covers hole 1, hole 2, hole 3:")));
    EXPECT_THAT(warnings_with(scene, {along(straight(0.03, 0, 0.06, 0))}),
                ElementsAre(HasSubstr("covers hole 1 (50 % of it), hole 2")));
    EXPECT_THAT(warnings_with(scene, {along(straight(0.03, 0.05, 0.03, -0.01))}),
                ElementsAre(HasSubstr("hole 2 (stands in it)")));
    EXPECT_THAT(warnings_with(scene, {along(straight(0.03, -0.05, 0.03, -0.04))}),
                ElementsAre(HasSubstr("piece 1 reaches 50 mm below the tray's floor")));
  }
  // A groove whose flat bottom is as wide as the round holes.
  EXPECT_THAT(warnings_with(sound_3d(HoleShape::round),
                            {along(straight(0, 0.02, 0.024, 0)), along(straight(0.036, 0, 0.06, 0.02))}),
              IsEmpty());
}

TEST(SceneWarnings, HolesThatPiecesShutOff) {
  Scene scene = sound_3d(HoleShape::round);
  std::vector<WallPiece> groove = {straight(0, 0.02, 0.03, 0), straight(0.03, 0, 0.06, 0.02)};
  for (WallPiece& piece : groove) piece.drawn_out = DrawnOut::along;
  EXPECT_THAT(warnings_with(scene, groove), ElementsAre(HasSubstr("covers hole 1"), HasSubstr("covers hole 1")));
  scene.tray.holes[1].across = 0.008;
  EXPECT_THAT(warnings_with(scene, groove),
              ElementsAre(HasSubstr("hole 1 ("), HasSubstr("hole 1 ("),
                          AllOf(StartsWith("tray.pieces: shut off hole 2, or leave ways narrower than 4.5"),
                                HasSubstr("not looked for"))));
  const std::vector<WallPiece> slope = {straight(0, 0.05, 0.2, 0)};
  for (const Scene& one : {sound(), sound_3d()})
    EXPECT_THAT(warnings_with(one, slope), ElementsAre("tray.pieces: shut off hole 1: no seed comes there from above"));
  EXPECT_THAT(warnings_with(sound(), {straight(0, 0.05, 0.2, 0.02)}), IsEmpty()) << "a shelf";
}

TEST(SceneWarnings, PiecesThatReachBelowTheCountingLine) {
  Scene scene = sound();
  EXPECT_THAT(warnings_with(scene, {straight(0.27, 0, 0.27, -0.019)}), IsEmpty());
  EXPECT_THAT(warnings_with(scene, {straight(0.27, 0, 0.27, -0.019), straight(0.22, 0, 0.22, -0.035)}),
              ElementsAre(StartsWith(
                  "tray.pieces: piece 2 reaches 35 mm below the tray's floor, and seeds are counted 20 mm")));
  scene.run.count_below = 0.05;
  EXPECT_THAT(warnings_with(scene, {straight(0.22, 0, 0.22, -0.035)}), IsEmpty());
}

TEST(SceneWarnings, PiecesOfAnotherSize) {
  EXPECT_THAT(warnings_with(sound(), {straight(0, 0, 0, 12.7)}),
              ElementsAre(StartsWith("tray.pieces: reach over 1.27e+04 mm, the tray is 500 mm long")));
}

class VesselsThatMeet : public testing::TestWithParam<Space> {
 protected:
  static Scene over(double above) {
    Scene scene = GetParam() == Space::two_dimensional ? sound() : sound_3d();
    scene.hopper = hopper(0.03);
    scene.hopper->holes[0].across = 0.03, scene.hopper->holes[0].across_length = 0.06;
    scene.hopper->depth = scene.tray.depth;
    scene.hopper->fill->count *= GetParam() == Space::two_dimensional ? 1 : 10;
    scene.hopper->origin.y() = above;
    return scene;
  }
};
INSTANTIATE_TEST_SUITE_P(Both, VesselsThatMeet, testing::Values(Space::two_dimensional, Space::three_dimensional),
                         [](const auto& info) -> std::string {
                           return info.param == Space::two_dimensional ? "plane" : "space";
                         });

TEST_P(VesselsThatMeet, AreNamed) {
  const auto met = ElementsAre(StartsWith("hopper: passes through the tray, at "));
  EXPECT_THAT(scene_warnings(over(0.05)), IsEmpty()) << "within the tray's end walls, clear of them";
  Scene scene = over(0.05);
  scene.hopper->origin.x() = -0.005;
  EXPECT_THAT(scene_warnings(scene), met) << "through the end wall all the time";
  scene.hopper->origin.x() = 0.005;
  EXPECT_THAT(scene_warnings(scene), met) << "which reaches it when it swings";
  scene.hopper->origin.x() = 0.011;
  EXPECT_THAT(scene_warnings(scene), IsEmpty()) << "which does not";
  scene.tray.motion = HarmonicMotion{0.5 * std::numbers::pi, 0.01, 9};
  scene.hopper->origin = {0.2, 0.009};
  EXPECT_THAT(scene_warnings(scene), met) << "the floor comes up to it";
  scene.hopper->origin = {0.2, 0.011};
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  scene.tray.motion = HarmonicMotion{0, 0.01, 9};
  scene.hopper->origin = {0.2, 0};
  EXPECT_THAT(scene_warnings(scene), IsEmpty()) << "it slides on the floor";
}

/// A table that pushes the tray aside for 30 ms once, and two parts of a motion that meet in step once in 20 s.
TEST_P(VesselsThatMeet, HoweverBriefly) {
  const auto met = Contains(StartsWith("hopper: passes through the tray, at 2.6"));
  const auto clear = Not(Contains(HasSubstr("passes through")));
  Scene scene = over(0.05);
  const std::vector<double> none(6, 0.0);
  scene.tray.motion = TableMotion{{0, 2.6, 2.601, 2.616, 2.631, 2.7}, {0, 0, 0, 0.02, 0, 0}, none, none, {}};
  for (const double left : {0.005, 0.015, 0.0195}) {
    scene.hopper->origin.x() = left;
    EXPECT_THAT(scene_warnings(scene), met) << left;
  }
  scene.hopper->origin.x() = 0.0205;
  EXPECT_THAT(scene_warnings(scene), clear);
  scene.run.duration = 12;
  scene.tray.motion = SumMotion{{HarmonicMotion{0, 0.005, 9}, HarmonicMotion{0, 0.005, 9.05, 0, std::numbers::pi}}};
  scene.hopper->origin.x() = 0.0097;
  EXPECT_THAT(scene_warnings(scene), Contains(HasSubstr("passes through the tray, at ")));
  scene.hopper->origin.x() = 0.0103;
  EXPECT_THAT(scene_warnings(scene), clear);
}

/// Over its ramp, when only the hopper moves, and beside a tray that stops.
TEST_P(VesselsThatMeet, WhateverOfThemMoves) {
  const auto met = Contains(StartsWith("hopper: passes through the tray, at "));
  const auto clear = Not(Contains(HasSubstr("passes through")));
  Scene scene = over(0.05);
  scene.run.duration = 1000;
  scene.tray.motion.reset();
  for (const double ramp : {0.0, 1e-3, 2.0}) {
    HarmonicMotion motion{0, 0.01, 9, ramp};
    for (const double stop : {never, 5.0}) {
      motion.stop = stop;
      scene.hopper->motion = motion;
      scene.hopper->origin.x() = 0.0097;
      EXPECT_THAT(scene_warnings(scene), met) << ramp;
      scene.hopper->origin.x() = 0.0103;
      EXPECT_THAT(scene_warnings(scene), clear) << ramp;
    }
  }
}

TEST_P(VesselsThatMeet, WithTheirPieces) {
  Scene scene = over(0.05);
  scene.tray.pieces = {straight(0.195, 0.01, 0.195, 0.1)};
  EXPECT_THAT(scene_warnings(scene), ElementsAre(StartsWith("hopper: passes through the tray, at ")));
  scene.tray.pieces = {straight(0.18, 0.01, 0.18, 0.1)};
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  scene.hopper->pieces = {straight(-0.021, -0.03, -0.021, 0)};
  EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("piece 1 and ")));
}

/// Of the one vessel over a hole of the other, as they stand at the start.
TEST_P(VesselsThatMeet, APieceOfOneOverAHoleOfTheOther) {
  const Scene clear = over(0.05);  // the outlet is 0.225 to 0.255 of the tray, a hole 0.244 to 0.256
  const auto with = [&](const std::vector<WallPiece>& of_tray, const std::vector<WallPiece>& of_hopper,
                        double tilt = 0) {
    Scene scene = clear;
    scene.tray.pieces = of_tray, scene.hopper->pieces = of_hopper, scene.tray.tilt = tilt;
    return scene_warnings(scene);
  };
  const auto outlet = ElementsAre(
      "tray.pieces: piece 1 lies, as the vessels stand at the start, across the hopper's hole 1: what is drawn across "
      "a hole is a wall there");
  EXPECT_THAT(with({straight(0.22, 0.049, 0.26, 0.049)}, {}), outlet);
  EXPECT_THAT(with({straight(0.22, 0.045, 0.26, 0.045)}, {}), IsEmpty()) << "a seed below it";
  EXPECT_THAT(with({straight(0.24, 0.049, 0.26, 0.049)}, {}), ElementsAre(HasSubstr("hopper's hole 1 (50 % of it)")));
  EXPECT_THAT(with({}, {straight(0.04, -0.0499, 0.06, -0.0499)}),
              ElementsAre(HasSubstr("hopper.pieces: piece 1 lies, as the vessels stand at the start, across the tray's "
                                    "hole 2:")));
  // Turned back by the tray's tilt, the line lies level under the outlet.
  const double tilt = 0.1, c = std::cos(tilt), s = std::sin(tilt);
  const auto level = [&](double x) { return Eigen::Vector2d(c * x + s * 0.049, -s * x + c * 0.049); };
  EXPECT_THAT(with({WallPiece{.a = level(0.22), .b = level(0.26)}}, {}, tilt), Contains(HasSubstr("hopper's hole 1:")));
  if (GetParam() == Space::two_dimensional) return;
  EXPECT_THAT(with({turned(0, 0.049, 0.05, 0.049, PieceAxis::upright, {0.24, 0.03})}, {}), outlet);
  Scene beside = clear;
  beside.hopper->front = 0.07, beside.hopper->pieces = {straight(0.04, -0.0499, 0.06, -0.0499)};
  EXPECT_THAT(scene_warnings(beside), Not(Contains(HasSubstr("tray's hole"))));
}

/// Over a periodic tray a hopper stands in every period.
TEST_P(VesselsThatMeet, APieceOfTheNextHopperOverAHole) {
  Scene scene = over(0.05);
  scene.tray.sides = Sides::periodic, scene.tray.holes[2].centre = 0.493;
  scene.hopper->origin.x() = 0;
  scene.hopper->pieces = {straight(-0.014, -0.0499, 0, -0.0499)};
  EXPECT_THAT(scene_warnings(scene), Contains(HasSubstr("across the tray's hole 3:")));
}

TEST(SceneWarnings, APieceThatPlugsAHoleFromBelow) {
  Scene scene = sound();
  const auto plate = [](double y) { return WallPiece{.a = {0.09, y}, .b = {0.11, y}}; };
  scene.tray.pieces = {plate(-0.003)};
  EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("piece 1 covers hole 1:"))) << "seeds are 4 mm";
  scene.tray.pieces = {plate(-0.0041)};
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  for (Hole& hole : scene.tray.holes) hole.thickness = 0.01;
  EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("piece 1 covers hole 1:"))) << "within the floor";
  scene.tray.pieces = {plate(-0.013)};
  EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("piece 1 covers hole 1:"))) << "nearer to it than a seed";
  scene.tray.pieces = {plate(-0.0141)};
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
}

TEST(SceneWarnings, AnOutletBesideTheTray) {
  Scene scene = sound();
  scene.hopper = hopper(0.03);
  for (const double left : {0.0, 0.42}) {
    scene.hopper->origin.x() = left;
    EXPECT_THAT(scene_warnings(scene), IsEmpty()) << left;
  }
  scene.hopper->origin.x() = -0.05;  // its outlet is 25 to 55 mm from its left end
  EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("hopper.holes: hole 1 is over -25 mm to 5 mm of the tray, "
                                                           "which is 500 mm long: what falls beside the tray is")));
  scene.hopper->origin.x() = 0.46;
  EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("beside the tray is spilled")));
  scene.tray.sides = Sides::periodic;
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
}

/// Seeds fall straight down, however the tray lies.
TEST(SceneWarnings, AnOutletBesideATiltedTray) {
  Scene scene = sound();
  scene.hopper = hopper(0.03);
  scene.hopper->origin.y() = 1;
  scene.tray.tilt = 0.1;  // its mouth goes from -12 to 486 mm
  for (const double left : {-0.03, 0.42}) {
    scene.hopper->origin.x() = left;
    EXPECT_THAT(scene_warnings(scene), IsEmpty()) << left;
  }
  for (const double left : {-0.045, 0.44}) {
    scene.hopper->origin.x() = left;
    EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("beside the tray is spilled"))) << left;
  }
  scene.tray.sides = Sides::open;  // its floor goes to 498 mm
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
}

TEST(SceneWarnings, AnOutletInFrontOfTheTrayOrBehindIt) {
  Scene scene = sound();
  scene.space = Space::three_dimensional;
  scene.tray.depth = 0.1;
  for (Hole& hole : scene.tray.holes) hole.across = 0.05, hole.across_length = 0.1;
  scene.hopper = hopper(0.03);
  scene.hopper->depth = 0.04;
  scene.hopper->holes[0].across = 0.02, scene.hopper->holes[0].across_length = 0.04;
  for (const double front : {0.0, 0.06}) {
    scene.hopper->front = front;
    EXPECT_THAT(scene_warnings(scene), IsEmpty()) << front;
  }
  scene.hopper->front = -0.01;
  EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("hole 1 is over -10 mm to 30 mm from the tray's front, "
                                                           "which is 100 mm deep: what falls beside the tray is")));
  scene.hopper->front = 0.07;
  EXPECT_THAT(scene_warnings(scene), ElementsAre(HasSubstr("beside the tray is spilled")));
  scene.tray.front_and_back = Sides::periodic;
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
}

}  // namespace
}  // namespace vibrosow
