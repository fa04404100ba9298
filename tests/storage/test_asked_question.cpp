#include "storage/asked_question.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::json;

DecideQuestion decision() {
  return {"rate", WantedRate{true, 40.85, 45.15}, 0.05, 0.02, 0.95, SelectionRule::posterior, 400, true};
}

OptimiseQuestion search() {
  return {{"unevenness", "power"}, WantedRate{false, 0.1, 0.2}, 0.05, 0.01, 0.95, 60};
}

Json written(const AskedQuestion& question) {
  return Json::parse(json_of(question).dump());
}

bool is_read(const Json& json) {
  try {
    question_in(json);
    return true;
  } catch (const InputError&) {
  } catch (const Json::exception&) {
  }
  return false;
}

TEST(AskedQuestion, ComesBackToTheBit) {
  for (const AskedQuestion& question : {AskedQuestion(decision()), AskedQuestion(search())})
    EXPECT_EQ(question_in(written(question)), question) << command_of(question);
  DecideQuestion plain = decision();
  plain.rate.reset();
  plain.margin = 0.1 + 0.2;
  EXPECT_EQ(question_in(written(plain)), AskedQuestion(plain));
  OptimiseQuestion free = search();
  free.rate.reset(), free.spilled_limit.reset();
  EXPECT_EQ(question_in(written(free)), AskedQuestion(free));
}

TEST(AskedQuestion, SaysItsUnits) {
  EXPECT_EQ(written(decision())["rate"], Json({{"unit", "seeds/s"}, {"low", 40.85}, {"high", 45.15}}));
  EXPECT_EQ(written(search())["rate"], Json({{"unit", "kg/s"}, {"low", 0.1}, {"high", 0.2}}));
  EXPECT_EQ(command_of(decision()), "decide");
  EXPECT_EQ(command_of(search()), "optimise");
  EXPECT_EQ(command_of({}), "");
}

TEST(AskedQuestion, HasEachNumberInItsRange) {
  const Json good = written(decision()), front = written(search());
  const auto with = [](Json json, const char* place, const Json& value) {
    json[Json::json_pointer(place)] = value;
    return json;
  };
  EXPECT_TRUE(is_read(with(good, "/clogging_limit", 1))) << "all may clog";
  for (const char* share : {"/clogging_limit", "/margin", "/confidence"})
    for (const Json& bad : {Json(0), Json(-0.1), Json(1.1), Json("5 %"), Json(), Json::array({0.5})})
      EXPECT_FALSE(is_read(with(good, share, bad))) << share << " " << bad;
  for (const Json& bad : {Json(1), Json(-5), Json(1'000'001), Json(1e99), Json(2.5), Json(UINT64_MAX), Json("9")}) {
    EXPECT_FALSE(is_read(with(good, "/most_runs", bad))) << bad;
    EXPECT_FALSE(is_read(with(front, "/runs", bad))) << bad;
  }
  for (const Json& bad : {Json(0), Json(-1), Json(50), Json(1e99), Json(), Json("40")})
    EXPECT_FALSE(is_read(with(good, "/rate/low", bad))) << bad;
  EXPECT_FALSE(is_read(with(front, "/spilled_limit", 0)));
  EXPECT_FALSE(is_read(with(front, "/confidence", 0.5)));
}

TEST(AskedQuestion, HasNothingElse) {
  const Json good = written(decision()), front = written(search());
  const auto changed = [](Json json, const std::function<void(Json&)>& change) {
    change(json);
    return json;
  };
  for (const Json& whole : {good, front})
    for (const auto& [key, value] : whole.items())
      if (key != "rate" && key != "spilled_limit") {
        EXPECT_FALSE(is_read(changed(whole, [&key = key](Json& json) { json.erase(key); }))) << key;
      }
  for (const auto& change : std::vector<std::function<void(Json&)>>{
           [](Json& json) { json["command"] = "sweep"; }, [](Json& json) { json["command"] = 3; },
           [](Json& json) { json["more"] = 1; }, [](Json& json) { json["rate"]["unit"] = "seeds/min"; },
           [](Json& json) { json["rate"]["more"] = 1; }, [](Json& json) { json["rate"] = nullptr; }}) {
    EXPECT_FALSE(is_read(changed(good, change)));
    EXPECT_FALSE(is_read(changed(front, change)));
  }
  EXPECT_FALSE(is_read(changed(good, [](Json& json) { json["procedure"] = "best"; })));
  EXPECT_FALSE(is_read(changed(good, [](Json& json) { json["drafts"] = 1; })));
  EXPECT_FALSE(is_read(changed(front, [](Json& json) { json["goals"] = Json::array(); })));
  EXPECT_FALSE(is_read(changed(front, [](Json& json) { json["goals"] = "power"; })));
  for (const Json& bad : {Json(), Json(3), Json("decide"), Json::array({"decide", "--goal=rate"})})
    EXPECT_FALSE(is_read(bad)) << bad;
}

}  // namespace
}  // namespace vibrosow
