// Seeds of several lots: how many of each come, and what is refused.
#include "scene/mixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numeric>

#include "plan/model.hpp"
#include "scene/clump_shape.hpp"
#include "scene/input_error.hpp"
#include "scene/make_clump.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

using testing::HasSubstr;

/// Peas of `pea` of the seeds by number, among clover.
Scene clover_and_pea(double pea) {
  Scene scene;
  scene.lots = {{"clover", 1e-3, 6e-7, Shape::ball, 1 - pea}, {"pea", 6e-3, 1.3e-4, Shape::ball, pea}};
  scene.contact.shell_compression = 1e-3;
  scene.tray.name = "tray";
  scene.tray.length = scene.tray.height = 0.1, scene.tray.depth = 0.06;
  scene.run.duration = 2;
  return scene;
}

Fill filled(int count, bool keep = false) {
  return Fill{count, Packing::poured, 0, keep};
}

std::string refusal(const Scene& scene) {
  try {
    prepare(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Mixture, LotsComeInExactShares) {
  const std::vector<SeedLot> lots = clover_and_pea(0.3).lots;
  EXPECT_EQ(lot_counts(lots, 714), (std::vector<int>{500, 214}));
  const std::vector<SeedLot> thirds{
      {"a", 1, 1, Shape::ball, 1.0 / 3}, {"b", 1, 1, Shape::ball, 1.0 / 3}, {"c", 1, 1, Shape::ball, 1.0 / 3}};
  const std::vector<int> counts = lot_counts(thirds, 100);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0), 100);
}

TEST(Mixture, ALotThatGetsNoSeedOfAFillIsRefused) {
  for (const Space space : {Space::two_dimensional, Space::three_dimensional})
    for (const bool keep : {false, true}) {
      Scene scene = clover_and_pea(1e-3);
      scene.space = space;
      scene.tray.fill = filled(400, keep);
      EXPECT_EQ(
          refusal(scene),
          "tray.fill.count: of 400 seeds none is of pea: 0.1 % of the seeds, 17.8 % of their mass, were asked for; "
          "from 1000 seeds on there is one");
      scene.tray.fill->where = WrittenAt("seeder.toml:7: tray.fill.count");
      EXPECT_THAT(refusal(scene), testing::StartsWith("seeder.toml:7: tray.fill.count: of 400 seeds"));
      scene.tray.fill = filled(1000, keep);
      EXPECT_EQ(refusal(scene), "");
    }
}

TEST(Mixture, OfAHopperTooAndOfClumps) {
  Scene scene = clover_and_pea(1e-3);
  make_clump(scene.lots[1], elongated(9e-3, 4e-3), Space::two_dimensional);
  scene.lots[1].shape = Shape::clump;
  scene.tray.fill = filled(2000);
  scene.hopper = scene.tray;
  scene.hopper->name = "hopper", scene.hopper->origin.y() = 0.12;
  EXPECT_EQ(refusal(scene), "");
  scene.hopper->fill = filled(300);
  EXPECT_THAT(refusal(scene), HasSubstr("hopper.fill.count: of 300 seeds none is of pea"));
}

TEST(Mixture, RainThatBringsALotInNoRunIsRefused) {
  Scene scene = clover_and_pea(1e-3);
  scene.tray.rain = Rain{.rate = 100, .from = 0, .to = 0.1, .height = 0.08};  // 200 seeds in the run
  EXPECT_THAT(refusal(scene), HasSubstr("tray.rain.rate: the rain brings 0.2 seeds of pea while the run lasts"));
  scene.tray.rain->rate = 1000;
  EXPECT_EQ(refusal(scene), "");
  scene.tray.rain->stop = 0.1;
  EXPECT_THAT(refusal(scene), HasSubstr("the rain brings 0.1 seeds of pea"));
  scene.tray.fill = filled(1000);
  EXPECT_EQ(refusal(scene), "") << "the fill has some";
}

TEST(Mixture, OneLotAndALotThatNobodyAskedForAreNotMissing) {
  Scene scene = clover_and_pea(0);
  scene.tray.fill = filled(10);
  EXPECT_FALSE(missing_lot(scene));
  scene.lots.pop_back();
  scene.lots[0].number_fraction = 1;
  scene.tray.fill = filled(1);
  EXPECT_TRUE(lot_shares(scene).empty());
  EXPECT_FALSE(missing_lot(scene));
}

TEST(Mixture, SharesAreByNumberAndByMassOfAllSizes) {
  Scene scene = clover_and_pea(0.25);
  // Of twice 1/2 and 3/2 of the diameter: E[d^3] = 1.75.
  scene.lots[1].sizes = {SizeDistribution::Kind::table, 0, 0, 0, 0, {3e-3, 9e-3}, {0.5, 0.5}};
  scene.tray.fill = filled(10);
  scene.tray.rain = Rain{.rate = 100, .start = 0.5};
  const std::vector<LotShare> shares = lot_shares(scene);
  ASSERT_EQ(shares.size(), 4u);
  EXPECT_EQ(shares[1].seeds, 2) << "7.5 and 2.5; of equal remainders the first";
  EXPECT_EQ(shares[1].of_number, 0.2);
  EXPECT_EQ(shares[1].asked_number, 0.25);
  const double pea = 1.75 * 1.3e-4, clover = 6e-7;
  EXPECT_NEAR(shares[1].of_mass, 2 * pea / (2 * pea + 8 * clover), 1e-12);
  EXPECT_NEAR(shares[1].asked_mass, pea / (pea + 3 * clover), 1e-12);
  EXPECT_EQ(shares[3].source, SeedSource::rain);
  EXPECT_NEAR(shares[3].seeds, 0.25 * 150, 1e-9);
  EXPECT_NEAR(shares[3].of_number, 0.25, 1e-12);
}

TEST(Mixture, ASizeWithoutASeedIsToldHoweverFewWereAskedFor) {
  Scene scene = clover_and_pea(1);
  scene.lots.erase(scene.lots.begin());
  SeedLot& pea = scene.lots[0];
  pea.sizes = {SizeDistribution::Kind::table, 0, 0, 0, 0, {6e-3, 6.1e-3, 6e-3}, {0.5, 0.01, 0.49}};
  scene.tray.fill = filled(50);
  std::vector<DrawnSeeds> drawn;
  for (int k = 0; k < 50; ++k) count_drawn(drawn, scene.lots, 0, 0, 1, pea.mass);
  const std::vector<LotShare> sizes = size_shares(scene, drawn);
  ASSERT_EQ(sizes.size(), 2u) << "6 mm stands there twice";
  EXPECT_NEAR(sizes[0].asked_number, 0.99, 1e-15);
  EXPECT_EQ(sizes[0].of_mass, 1);
  EXPECT_THAT(
      drawn_warnings(scene, drawn),
      testing::ElementsAre(testing::StartsWith(
          "tray.fill.count: none of the seeds of pea is of 6.1 mm: 0 % by number instead of 1 %, 0 % by mass")));
  count_drawn(drawn, scene.lots, 0, 0, 6.1e-3 / pea.diameter, pea.mass);
  EXPECT_THAT(drawn_warnings(scene, drawn), testing::IsEmpty());
}

TEST(Mixture, FromTheNumberThatIsAdvisedEveryLotIsThere) {
  EXPECT_TRUE(rc::check("every lot has a seed", [] {
    const double rare = *rc::gen::map(rc::gen::inRange(1, 2000), [](int k) { return k * 1e-4; });
    const std::vector<SeedLot> lots{{"a", 1, 1, Shape::ball, 0.6 * (1 - rare)},
                                    {"b", 1, 1, Shape::ball, rare},
                                    {"c", 1, 1, Shape::ball, 0.4 * (1 - rare)}};
    const int least = static_cast<int>(std::ceil(1 / rare));
    for (const int count : lot_counts(lots, std::max(least, 3))) RC_ASSERT(count > 0);
  }));
}

}  // namespace
}  // namespace vibrosow
