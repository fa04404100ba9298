#include "report/front_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdint>

#include "answer/answer.hpp"
#include "input/toml_value.hpp"
#include "report/answer_doubts.hpp"
#include "report/expected_report.hpp"
#include "report/json_keys.hpp"
#include "report/layout_columns.hpp"
#include "report/number_text.hpp"
#include "report/study_page.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

struct FrontRow {
  const OptimiseResult* result;
  const Answer* answer;
  std::size_t index;
  const Layout& layout() const { return result->study.layouts[index]; }
  const FrontLayout& of() const { return result->layouts[index]; }
  /// None where the goal was not asked for, or no run flowed.
  std::optional<MeanWithInterval> goal(const FrontGoal& goal) const {
    const auto found = std::ranges::find(result->options.goals, &goal);
    return found == result->options.goals.end()
               ? std::nullopt
               : of().goals[static_cast<std::size_t>(found - result->options.goals.begin())];
  }
};

Columns<FrontRow> pareto_columns(const std::vector<std::string>& keys, const std::vector<const FrontGoal*>& goals) {
  using R = const FrontRow&;
  Columns<FrontRow> columns = {
      text_column<FrontRow>("layout", "number of the layout, in the order in which they were tried",
                            [](R r) { return r.layout().number; }),
      text_column<FrontRow>(
          "standing",
          "on the front; may be on the front; dominated; misses the rate; spills; clogs; failed (it cannot be run, has "
          "no such goal, or left the model); invalid; each with the confidence asked for",
          [](R r) { return std::string(name_of(r.answer->layouts[r.index].standing)); }),
      text_column<FrontRow>("first_by_means",
                            "1: by its means it meets the constraints, and no other that does has better means",
                            [](R r) { return r.of().is_first_by_means ? 1 : 0; }),
      text_column<FrontRow>("reason", "why it failed or is invalid; else what makes it less sure", [](R r) {
        if (!r.layout().scene) return r.layout().invalid;
        return r.of().reason.empty() ? doubts_text(r.of().doubts) : r.of().reason;
      })};
  columns.push_back(text_column<FrontRow>("at_edge", "keys whose values end their ranges",
                                          [](R r) { return fmt::format("{}", fmt::join(r.of().at_edge, " ")); }));
  append(columns, key_columns<FrontRow>(keys));
  append(columns,
         {text_column<FrontRow>("runs", "of the layout as it is", [](R r) { return r.of().runs; }),
          text_column<FrontRow>(
              "clogged", "of these, runs that clogged; the means are of the others, or where all may clog of all",
              [](R r) { return r.of().clogged; })});
  for (const FrontGoal* goal : goals)
    add_mean_columns(columns, std::string(goal->column), Unit{goal->unit, goal->unit_size},
                     fmt::format("goal {} (empty where not asked for), {}", goal->name, goal->description),
                     [goal](R r) { return r.goal(*goal); });
  add_mean_columns(columns, "rate", plain,
                   "rate in the unit of optimise.json's rate.figure: of the tray where one is asked for, else "
                   "rate_g_per_s of sweep.csv",
                   [](R r) {
                     std::optional<MeanWithInterval> value = r.of().rate;
                     if (!value) return value;
                     const double unit = rate_metric(r.result->options.rate).unit_size;
                     value->mean /= unit;
                     if (value->half_width_95) *value->half_width_95 /= unit;
                     return value;
                   });
  add_unevenness_columns(columns, "coefficient of variation of the holes' rates by all these runs together",
                         [](R r) { return r.of().unevenness; });
  add_expected_columns(
      columns, [](R r) -> const auto& { return r.of().expected; });
  return columns;
}

std::vector<const FrontGoal*> all_goals() {
  std::vector<const FrontGoal*> all;
  for (const FrontGoal& goal : front_goals()) all.push_back(&goal);
  return all;
}

JsonKeys<OptimiseResult> optimise_keys() {
  using S = const OptimiseResult&;
  const auto of_rate = [](auto get) {
    return [get](S s) {
      return s.options.rate ? Json(get(*s.options.rate) / rate_metric(s.options.rate).unit_size) : Json();
    };
  };
  const auto count = [](FrontStanding standing) {
    return [standing](S s) { return Json(std::ranges::count(s.layouts, standing, &FrontLayout::standing)); };
  };
  return {
      {"goals", "", "what layouts are compared by",
       [](S s) {
         Json names = Json::array();
         for (const FrontGoal* goal : s.options.goals) names.push_back(goal->name);
         return names;
       }},
      {"interrupted", "", "whether runs are missing; the same command resumes",
       [](S s) { return Json(s.is_interrupted); }},
      {"confidence_percent", "%", "of each standing", [](S s) { return Json(100 * s.options.confidence); }},
      {"rate.figure", "", "of pareto.csv's rate", [](S s) { return Json(rate_metric(s.options.rate).name); }},
      {"rate.low", "", "lower end of the band, in its unit; null: none is asked for",
       of_rate([](const WantedRate& rate) { return rate.low; })},
      {"rate.high", "", "upper end", of_rate([](const WantedRate& rate) { return rate.high; })},
      {"clogging_limit_percent", "%", "share of runs that may clog",
       [](S s) { return Json(100 * s.options.clogging_limit); }},
      {"spilled_limit_percent", "%", "of seeds that may leave over the rim; null: none is asked for",
       [](S s) { return s.options.spilled_limit ? Json(100 * *s.options.spilled_limit) : Json(); }},
      {"doubts", "", doubts_description, [](S s) { return doubts_json(doubts_about(answer_of(s))); }},
      {"layouts", "", "that were tried", [](S s) { return Json(s.layouts.size()); }},
      {"on_the_front", "", "of these", count(FrontStanding::on_front)},
      {"may_be_on_the_front", "", "of these", count(FrontStanding::may_be_on_front)},
      {"dominated", "", "of these", count(FrontStanding::dominated)},
      {"runs", "", "that were asked for at most", [](S s) { return Json(s.options.runs); }},
      {"cost.runs", "", "that it took, variants included",
       [](S s) { return Json(static_cast<std::int64_t>(s.cost.runs)); }},
      {"cost.grain_steps", "", "of these", [](S s) { return Json(s.cost.grain_steps); }},
  };
}

/// "key = value" lines, those that are taken out first.
std::string changes_text(const std::vector<Override>& changes) {
  std::string lines, unset;
  for (const Override& change : changes)
    if (change.value)
      lines += fmt::format("{} = {}\n", change.key, toml_text(*change.value));
    else
      unset += fmt::format("{}{}", unset.empty() ? "" : ", ", toml_text({change.key}));
  return (unset.empty() ? "" : fmt::format("unset = [ {} ]\n", unset)) + lines;
}

}  // namespace

std::string why_unsure(const OptimiseResult& result) {
  int unsure = 0, meets = 0;
  for (const FrontLayout& one : result.layouts) {
    if (one.standing != FrontStanding::may_be_on_front) continue;
    ++unsure, meets += one.surely_meets;
  }
  if (unsure == 0) return "";
  const std::string begin = fmt::format("Of the {} that may be on the front, ", unsure);
  const std::string_view constraint = result.options.rate ? "the rate" : "the constraints";
  const std::string better = "not shown to be better in some goal than every other; more runs (--runs) may decide";
  if (meets == unsure) return begin + fmt::format("each is {}.", better);
  if (meets == 0) return begin + fmt::format("none surely meets {}; more runs (--runs) may decide.", constraint);
  return begin + fmt::format("{} do not surely meet {}, and {} are {}.", unsure - meets, constraint, meets, better);
}

std::string front_promise(const OptimiseResult& result) {
  const std::string alone =
      result.options.goals.size() > 1
          ? ""
          : " Of a single goal `vibrosow decide` finds the best of given layouts with a guarantee.";
  return fmt::format(
      "\"On the front\" and \"dominated\" are among the layouts that were tried, each with a confidence of {:g} %, and "
      "no proof, since later runs were chosen by the results of earlier ones. That no better layout exists within the "
      "ranges is not promised.{}",
      100 * result.options.confidence, alone);
}

std::string front_cost(const OptimiseResult& result) {
  return fmt::format("Cost: {} layouts, {} runs, {} grain-steps.", result.layouts.size(),
                     static_cast<long long>(result.cost.runs), count_text(result.cost.grain_steps));
}

std::string pareto_csv(const OptimiseResult& result, CsvFormat format) {
  const Answer answer = answer_of(result);
  std::vector<FrontRow> rows;
  for (std::size_t i = 0; i < result.layouts.size(); ++i) rows.push_back({&result, &answer, i});
  return csv_of(pareto_columns(result.study.keys, result.options.goals), rows, format);
}

std::string optimise_json(const OptimiseResult& result) {
  return json_of(optimise_keys(), result);
}

std::string front_study(const OptimiseResult& result, const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const Study& study = result.study;
  const auto is_varied = [&](const Override& change) {
    return std::ranges::find(study.keys, change.key) != study.keys.end();
  };
  std::vector<Override> fixed = study.layouts.front().overrides;
  std::erase_if(fixed, is_varied);
  const std::string base = fs::absolute(study.base).lexically_relative(fs::absolute(folder)).generic_string();
  std::string text = fmt::format(
      "# Written by vibrosow optimise: the layouts on the front, and those that are first by their means.\n"
      "title = {}\nbase = {}\n",
      toml_text({study.title}), toml_text({base}));
  if (!fixed.empty()) text += "\n[set]\n" + changes_text(fixed);
  for (std::size_t i = 0; i < study.layouts.size(); ++i) {
    if (!leads(result.layouts[i])) continue;
    std::vector<Override> own = study.layouts[i].overrides;
    std::erase_if(own, [&](const Override& change) { return !is_varied(change); });
    text += fmt::format("\n[[layout]]\nname = \"layout {}\"\n{}", study.layouts[i].number, changes_text(own));
  }
  return text;
}

std::vector<FileText> optimise_file_texts() {
  return {file_text("pareto.csv", "one row per layout that was tried", pareto_columns({"KEY"}, all_goals())),
          file_text("optimise.json", "what was asked, how many layouts stand where, and what it cost", optimise_keys()),
          {"front.toml",
           "a study of the layouts on the front and those that are first by their means, where there are any",
           {}},
          front_page_text()};
}

std::vector<OutputFile> optimise_files(const OptimiseResult& result, const std::filesystem::path& folder,
                                       CsvFormat format) {
  std::vector<OutputFile> files = {{"pareto.csv", pareto_csv(result, format)},
                                   {"optimise.json", optimise_json(result)}};
  if (std::ranges::any_of(result.layouts, leads)) files.push_back({"front.toml", front_study(result, folder)});
  return files;
}

}  // namespace vibrosow
