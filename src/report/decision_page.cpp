#include "report/decision_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "report/answer_doubts.hpp"
#include "report/decision_words.hpp"
#include "report/layout_text.hpp"
#include "report/page.hpp"
#include "report/study_page.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

const Figure& goal_figure(const DecideOptions& options) {
  return figure_named(options.goal->figure);
}

std::string_view unit_of(const Figure& figure) {
  return figure.name == "tray_seeds_per_s" ? "seeds/s" : figure.unit;
}

std::string in_figure(const MeanWithInterval& value, const Figure& figure) {
  return fmt::format("{} {}", with_interval(value, figure.unit_size, "±"), unit_of(figure));
}

/// "CV of a run 8.2 ± 0.4 %, unevenness (CV) 7.1 % (6.2 to 8.3 %), 43.2 ± 0.5 seeds/s of the tray, clogged in 0 of 203
/// runs"
std::string figures_sentence(const DecisionResult& result, std::size_t scene) {
  const SceneDecision& of = result.scenes[scene];
  std::string text;
  if (of.goal)
    text = fmt::format("{} {}, ", result.options.goal->words, in_figure(*of.goal, goal_figure(result.options)));
  if (of.unevenness) text += fmt::format("unevenness (CV) {}, ", unevenness_text(*of.unevenness));
  if (result.options.rate && of.rate)
    text += fmt::format("{} of the tray{}, ", in_figure(*of.rate, rate_figure(result.options.rate)),
                        of_plane(result.study.scenes[scene].space));
  return text + fmt::format("clogged in {} of {} runs", of.clogged, of.runs);
}

/// "Layout 7 (count 5, frequency 9 Hz)"
std::string named(const Study& study, const Layout& layout) {
  const std::string text = described(study, layout);
  return text.empty() ? fmt::format("Layout {}", layout.number) : fmt::format("Layout {} ({})", layout.number, text);
}

std::string numbers_that_are(const DecisionReport& report, Standing standing) {
  std::vector<int> numbers;
  for (const Layout& layout : report.result.study.layouts)
    if (stands(report.result, layout, standing)) numbers.push_back(layout.number);
  return fmt::format("{}", fmt::join(numbers, ", "));
}

std::string headline(const DecisionReport& report) {
  const DecisionResult& result = report.result;
  if (!result.is_sure) {
    const std::string text = undecided_sentence(result);
    return text.ends_with(':') ? fmt::format("{} {}.", text, numbers_that_are(report, Standing::undecided)) : text;
  }
  for (const Layout& layout : result.study.layouts)
    if (layout.scene && layout.scene == result.best)
      return fmt::format("{} is the best: {}. {}", named(result.study, layout), figures_sentence(result, *layout.scene),
                         promise_sentence(result));
  return no_best_sentence(result);
}

/// What is doubtful about the answer; which layouts failed stands with the layouts.
Json doubts(const DecisionReport& report) {
  const DecisionResult& result = report.result;
  Json all = doubt_sentences(doubts_about(report));
  if (result.is_sure && result.best && !is_guaranteed(result)) all.push_back(weakness_sentence());
  if (report.drafts && report.drafts->screens) all.push_back(drafts_sentence(*report.drafts));
  if (!result.tests_clogging && result.options.clogging_limit < 1) all.push_back(clogging_untested_sentence());
  return all;
}

Json asked(const DecisionResult& result) {
  const DecideOptions& options = result.options;
  Json all = Json::array();
  const auto add = [&](std::string_view name, const std::string& value) {
    all.push_back({{"name", name}, {"value", value}});
  };
  add("goal", fmt::format("{}: {}", options.goal->words, options.goal->description));
  if (options.rate) {
    const Figure& figure = rate_figure(options.rate);
    add("rate of the tray", fmt::format("{} to {} {}", to_digits(options.rate->low / figure.unit_size, 4),
                                        to_digits(options.rate->high / figure.unit_size, 4), unit_of(figure)));
  }
  if (result.tests_clogging) add("clogs in fewer than", percent_text(options.clogging_limit) + " of runs");
  add("a difference that does not matter", percent_text(options.margin) + " of the best's mean");
  add("wanted", sureness_text(options));
  add("procedure", is_guaranteed(result) ? "guaranteed" : "posterior");
  add("runs of a layout at most", fmt::format("{}", options.most));
  return all;
}

Json cost(const DecisionReport& report, const SweepTiming& timing) {
  Json all = Json::array({cost_sentence(report.result)});
  for (const std::string& text : {page_timing(timing), correlation_sentence(report.result)})
    if (!text.empty()) all.push_back(text);
  if (report.drafts && !report.drafts->screens) all.push_back(drafts_sentence(*report.drafts));
  return all;
}

bool is_compared(const SceneDecision& of) {
  using enum Standing;
  const bool was_judged =
      of.standing == best || of.standing == not_shown_worse || of.standing == worse || of.standing == undecided;
  return was_judged && !of.is_screened_out;
}

/// "ok" of those that are compared by the goal, and what they failed at of the others.
std::string status_of(const DecisionReport& report, const Layout& layout) {
  const bool compared = layout.scene && is_compared(report.result.scenes[*layout.scene]);
  return compared ? "ok" : standing_text(report, layout);
}

bool shows_rate(const DecideOptions& options) {
  return rate_figure(options.rate).name != goal_figure(options).name;
}

Json figures_of(const DecideOptions& options) {
  Json goal = page_figure(goal_figure(options));
  goal.update({{"description", options.goal->description},
               {"has_interval", true},
               {"wanted", options.goal->is_most ? "high" : "low"},
               {"judged", true}});
  Json all = Json::array({std::move(goal)});
  if (shows_rate(options)) all.push_back(page_figure(rate_figure(options.rate)));
  all.push_back({{"name", "clogged_percent"},
                 {"unit", "%"},
                 {"description", "share of its runs that clogged; the other figures are of the rest"},
                 {"has_interval", false},
                 {"words", "clogged"},
                 {"wanted", "low"}});
  return all;
}

Json layout(const DecisionReport& report, const Layout& layout, const Replays& replays) {
  const DecisionResult& result = report.result;
  Json one = page_layout(result.study, layout, result.options.first_random_seed, replays);
  one["status"] = status_of(report, layout);
  one["compared"] = layout.scene && is_compared(result.scenes[*layout.scene]);
  one["standing"] = standing_text(report, layout);
  if (!layout.scene) {
    one["note"] = layout.invalid;
    return one;
  }
  const SceneDecision& of = result.scenes[*layout.scene];
  one["note"] = of.reason;
  one["replicates"] = of.runs;
  const Figure &goal = goal_figure(result.options), &rate = rate_figure(result.options.rate);
  one["means"][std::string(goal.name)] = page_interval(of.goal, goal.unit_size);
  if (shows_rate(result.options)) one["means"][std::string(rate.name)] = page_interval(of.rate, rate.unit_size);
  if (of.runs > 0) one["means"]["clogged_percent"] = {{"mean", 100.0 * of.clogged / of.runs}, {"half_width", nullptr}};
  return one;
}

}  // namespace

std::vector<WantedReplay> best_to_replay(const DecisionReport& report, std::size_t most) {
  const DecisionResult& result = report.result;
  const auto scene_of = [&](const Layout* layout) -> const SceneDecision& { return result.scenes[*layout->scene]; };
  std::vector<const Layout*> layouts;
  for (const Layout& one : result.study.layouts) {
    if (is_in_the_answer(result, one)) layouts.push_back(&one);
  }
  std::erase_if(layouts, [&](const Layout* one) { return !scene_of(one).goal; });
  const double sign = result.options.goal->is_most ? -1 : 1;
  std::ranges::stable_sort(layouts, {}, [&](const Layout* one) {
    return std::pair(one->scene != result.best, sign * scene_of(one).goal->mean);
  });
  layouts.resize(std::min(most, layouts.size()));
  std::vector<WantedReplay> wanted;
  for (const Layout* one : layouts)
    wanted.push_back({one->number, result.study.scenes[*one->scene], result.options.first_random_seed});
  return wanted;
}

std::string decision_page_data(const DecisionReport& report, const SweepTiming& timing, const Replays& replays) {
  const DecisionResult& result = report.result;
  Json layouts = Json::array();
  for (const Layout& one : result.study.layouts) layouts.push_back(layout(report, one, replays));
  Json data = page_of_study("decision", result.study);
  data.update({{"headline", headline(report)},
               {"doubts", doubts(report)},
               {"asked", asked(result)},
               {"cost", cost(report, timing)},
               {"confidence", sureness_text(result.options)},
               {"figures", figures_of(result.options)},
               {"layouts", std::move(layouts)}});
  return page_text(data);
}

FileText decision_page_text() {
  return {"report.html", "with --html: the answer and the layouts to look at in any browser, each drawn", {}};
}

}  // namespace vibrosow
