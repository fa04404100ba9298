#include "report/replay.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "page_data.hpp"
#include "report/base64.hpp"
#include "report/page.hpp"
#include "report/study_page.hpp"

namespace vibrosow {
namespace {

using testing::ElementsAre;

Scene two_holes() {
  Scene scene;
  scene.lots.resize(1);
  scene.tray.holes.resize(2);
  scene.run.measure_from = 3;
  return scene;
}

Run run_of(int seeds) {
  Run run;
  run.random_seed = 9;
  run.end_time = 2;
  for (int k = 0; k < seeds; ++k) run.events.push_back({1e-3 * k, k % 3, 0, k, 4e-5, 0.1, 0.3});
  return run;
}

MetricMeans with_rate(double kg_per_s) {
  Outflow outflow;
  outflow.holes.resize(1);
  outflow.holes[0].hole = outflow.holes[0].lot = "all";
  outflow.holes[0].mass_rate = kg_per_s;
  return MetricMeans({&outflow});
}

TEST(Replay, HasTheCountsOfItsRun) {
  const nlohmann::json data = replay_data(two_holes(), run_of(7));
  EXPECT_EQ(data["random_seed"], 9);
  EXPECT_EQ(data["measure_from_s"], 2.0);  // where the run ended before
  EXPECT_EQ(data["holes"][0]["counted_all"], 2);
  EXPECT_EQ(data["holes"][1]["counted_all"], 2);
  EXPECT_EQ(data["events"]["hole"].size(), 7U);
}

/// Recordings as large as they may be.
TEST(Replay, AnyNumberTakesLessThanEightMegabytesOfThePage) {
  for (const std::size_t replays : {1U, 3U, 40U}) {
    std::size_t all = 0;
    for (std::size_t k = 0; k < replays; ++k) {
      const nlohmann::ordered_json data = replay_data(two_holes(), run_of(1000 * static_cast<int>(k % 4)));
      const std::string recording(most_recording_bytes(replays, data), 'x');
      all += page_text({{"replay", page_replay(data, recording)}}).size();
    }
    EXPECT_LE(all, 8000000U);
    EXPECT_GE(all, 7900000U);
  }
  EXPECT_EQ(most_recording_bytes(1000, replay_data(two_holes(), run_of(1000))), 0U);
}

TEST(Replay, StandsInItsLayoutWithItsRecording) {
  StudyResult result;
  result.study = three_trays();
  result.layouts.resize(3);
  const std::string recording("\0<b>\xff", 5);
  const Replays replays = {{2, page_replay(replay_data(two_holes(), run_of(3)), recording)}};
  const auto layouts = nlohmann::json::parse(page_data(study_page(result, 1), replays))["layouts"];
  EXPECT_FALSE(layouts[0].contains("replay"));
  EXPECT_EQ(from_base64(layouts[1]["replay"]["recording"].get<std::string>()), recording);
  EXPECT_TRUE(layouts[0].contains("command"));
  EXPECT_FALSE(layouts[2].contains("command"));  // it cannot be built
}

TEST(Replay, BestOfASweepAreThoseThatAreOkInTheOrderOfTheRate) {
  StudyResult result;
  result.study = three_trays();
  result.study.layouts[2].scene = 1;
  result.layouts.resize(3);
  result.layouts[0].metrics = result.layouts[2].metrics = with_rate(1);
  result.layouts[1].metrics = with_rate(2);
  const auto numbers = [&](std::size_t most) {
    std::vector<int> all;
    for (const WantedReplay& one : best_to_replay(answer_of(result, 5), most)) all.push_back(one.layout);
    return all;
  };
  EXPECT_THAT(numbers(9), ElementsAre(2, 1, 3));  // of the same rate the first by number
  EXPECT_THAT(numbers(2), ElementsAre(2, 1));
  EXPECT_EQ(best_to_replay(answer_of(result, 5), 1).front().random_seed, 5U);
  result.layouts[1].status = LayoutStanding::outside_the_model;
  result.layouts[2].metrics = {};
  EXPECT_THAT(numbers(9), ElementsAre(1));
}

TEST(Replay, CommandIsOneThatAShellTakesForWhatItIs) {
  Study study;
  study.base = "/some where/it's.toml";
  Layout layout;
  layout.overrides = {{"tray.motion.frequency", TomlValue{std::string("9 Hz")}, ""},
                      {"title", TomlValue{std::string("true")}, ""},  // a text, which TOML reads as something else
                      {"tray.holes.count", TomlValue{std::int64_t{5}}, ""},
                      {"hopper", std::nullopt, ""}};
  EXPECT_EQ(run_command_of(study, layout, 1),
            "vibrosow run 'it'\\''s.toml' --set 'tray.motion.frequency=9 Hz' --set 'title=\"true\"' "
            "--set 'tray.holes.count=5' --set 'hopper=' --html");
  EXPECT_THAT(run_command_of(study, layout, 4), testing::HasSubstr(" --random-seed 4 --html"));
}

}  // namespace
}  // namespace vibrosow
