#include "report/study_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "input/key_units.hpp"
#include "report/expected_report.hpp"
#include "report/layout_text.hpp"
#include "report/page.hpp"
#include "report/terminal_text.hpp"
#include "scene/scene_json.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

std::string_view kind_of(AnswerKind kind) {
  switch (kind) {
    case AnswerKind::sweep:
      return "sweep";
    case AnswerKind::decision:
      return "decision";
    case AnswerKind::search:
      break;
  }
  return "front";
}

Json metric(const AnswerMetric& of, AnswerKind kind) {
  Json one = {{"name", of.name}};
  if (!of.heading.empty()) one["heading"] = of.heading;
  one["unit"] = of.unit, one["description"] = of.description, one["has_interval"] = of.has_interval;
  if (of.name == clogged_metric) one["words"] = "clogged";
  if (kind == AnswerKind::sweep) return one;
  if (of.wanted != Wanted::any) one["wanted"] = of.wanted == Wanted::high ? "high" : "low";
  if (of.is_goal) one[kind == AnswerKind::decision ? "judged" : "goal"] = true;
  return one;
}

Json holes(const std::vector<HoleMetrics>& metrics) {
  Json all = Json::array();
  for (const HoleMetrics& hole : metrics)
    if (hole.hole != "all")
      all.push_back({{"hole", hole.hole},
                     {"lot", hole.lot},
                     {"seeds_per_s", page_interval(hole.seeds_per_s, 1)},
                     {"g_per_s", page_interval(hole.mass_rate, 1e-3)},
                     {"longest_pause_s", page_interval(hole.longest_pause, 1)}});
  return all;
}

/// How it is built: number, name, what it is in words, values of the keys, vessels, its scene, and the command that
/// runs it alone.
Json layout_of(const Answer& answer, const Layout& layout) {
  const Study& study = *answer.study;
  Json values = Json::array();
  for (const std::string& key : study.keys) {
    const auto value = layout.values.find(key);
    values.push_back(value == layout.values.end() ? "" : value->second);
  }
  Json one = {{"number", layout.number},
              {"name", layout.name},
              {"described", described(study, layout)},
              {"values", std::move(values)},
              {"vessels", layout.scene ? page_vessels(study.scenes[*layout.scene]) : Json::array()}};
  if (!layout.scene) return one;
  one["scene"] = Json::parse(scene_to_json(study.scenes[*layout.scene]));
  one["command"] = run_command_of(study, layout, answer.first_random_seed);
  return one;
}

/// Places of keys among the study's.
Json places(const Study& study, const std::vector<std::string>& keys) {
  Json all = Json::array();
  for (const std::string& key : keys) all.push_back(std::ranges::find(study.keys, key) - study.keys.begin());
  return all;
}

/// Why it stands so, and what makes it less sure.
std::string note(const AnsweredLayout& of) {
  std::string text = of.reason;
  for (const std::string& more : {doubts_text(of.doubts), of.is_named ? edge_text(of.at_edge) : std::string()})
    if (!more.empty()) text += (text.empty() ? "" : "; ") + more;
  return text;
}

Json layout(const Answer& answer, const AnsweredLayout& of, const Replays& replays) {
  const Layout& layout = answer.study->layouts[of.layout];
  const bool of_sweep = answer.kind == AnswerKind::sweep, compared = is_compared(of.standing);
  Json one = layout_of(answer, layout);
  if (const auto replay = replays.find(layout.number); replay != replays.end()) one["replay"] = replay->second;
  one["status"] = compared && !of_sweep ? "ok" : name_of(of.standing);
  one["compared"] = compared;
  if (!of_sweep) one["standing"] = name_of(of.standing);
  if (answer.kind == AnswerKind::search)
    one["first_by_means"] = of.is_first_by_means, one["at_edge"] = places(*answer.study, of.at_edge);
  one["note"] = note(of);
  one["replicates"] = of.runs;
  if (!of.values.empty()) {
    Json& means = one["means"] = Json::object();
    for (std::size_t k = 0; k < of.values.size(); ++k)
      means[std::string(answer.metrics[k].name)] = page_interval(of.values[k], answer.metrics[k].unit_size);
  }
  if (of.expected) one["expected"] = expected_sentence(*of.expected);
  if (!of_sweep) return one;
  one["misfit_percent"] = page_interval(of.misfit_percent, 1);
  one["holes"] = holes(of.holes);
  return one;
}

}  // namespace

std::string page_data(const StudyPage& page, const Replays& replays) {
  const Answer& answer = page.answer;
  const Study& study = *answer.study;
  const bool plane =
      std::ranges::all_of(study.scenes, [](const Scene& one) { return one.space == Space::two_dimensional; });
  Json keys = Json::array(), asked = Json::array(), metrics = Json::array(), layouts = Json::array();
  for (const std::string& key : study.keys) keys.push_back(condition_column(key));
  for (const auto& [name, value] : page.asked) asked.push_back({{"name", name}, {"value", value}});
  for (const AnswerMetric& of : answer.metrics) metrics.push_back(metric(of, answer.kind));
  for (const AnsweredLayout& of : answer.layouts) layouts.push_back(layout(answer, of, replays));
  Json data = {{"kind", kind_of(answer.kind)},
               {"program", {{"name", "vibrosow"}, {"version", VIBROSOW_VERSION}}},
               {"title", study.title},
               {"space", plane ? "plane" : "three_dimensional"},
               {"keys", std::move(keys)},
               {"headline", page.headline},
               {"remarks", page_remarks(page.remarks)}};
  if (const std::string expected = expected_sentence(answer); !expected.empty()) data["expected"] = expected;
  if (!page.asked.empty()) data["asked"] = std::move(asked), data["cost"] = page.cost;
  if (page.wanted) {
    const Metric& rate = rate_metric(page.wanted);
    data["wanted"] = {{"figure", rate.name},
                      {"low", page.wanted->low / rate.unit_size},
                      {"high", page.wanted->high / rate.unit_size}};
  }
  if (!page.confidence.empty()) data["confidence"] = page.confidence;
  data["figures"] = std::move(metrics), data["layouts"] = std::move(layouts);
  return page_text(data);
}

std::vector<WantedReplay> best_to_replay(const Answer& answer, std::size_t most) {
  std::vector<WantedReplay> wanted;
  for (const std::size_t index : answer.best_first) {
    if (wanted.size() == most) break;
    const Layout& layout = answer.study->layouts[index];
    wanted.push_back({layout.number, answer.study->scenes[layout.scene.value()], answer.first_random_seed});
  }
  return wanted;
}

std::string page_timing(const SweepTiming& timing) {
  if (timing.runs == 0) return "";
  return fmt::format("The {} run{} of this command took {} s, up to {} side by side.", timing.runs,
                     timing.runs == 1 ? "" : "s", to_digits(timing.wall_time, 3), timing.jobs);
}

}  // namespace vibrosow
