#include "report/front_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/answer_doubts.hpp"
#include "report/decision_words.hpp"
#include "report/front_report.hpp"
#include "report/page.hpp"
#include "report/study_page.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

/// "CV of a run and power"
std::string goals_text(const OptimiseOptions& options) {
  std::string text;
  for (std::size_t g = 0; g < options.goals.size(); ++g)
    text += fmt::format("{}{}", g == 0 ? "" : g + 1 == options.goals.size() ? " and " : ", ", options.goals[g]->words);
  return text;
}

std::string headline(const OptimiseResult& result) {
  const auto count = [&](FrontStanding standing) {
    return std::ranges::count(result.layouts, standing, &FrontLayout::standing);
  };
  const auto sure = count(FrontStanding::on_front), unsure = count(FrontStanding::may_be_on_front);
  const std::string of = fmt::format("of {} that were tried", result.layouts.size());
  if (sure + unsure == 0) return fmt::format("No layout {} is known to meet the constraints.", of);
  const std::string may_be = fmt::format("{} layout{} may be", unsure, unsure == 1 ? "" : "s");
  const std::string front = fmt::format("on the front of {}", goals_text(result.options));
  if (sure == 0) return fmt::format("{} {}, {}; none is shown to be.", may_be, front, of);
  const std::string shown = fmt::format("{} layout{} {}", sure, sure == 1 ? " is" : "s are", front);
  return unsure == 0 ? fmt::format("{}, {}.", shown, of) : fmt::format("{}, {}; {} more may be.", shown, of, unsure);
}

Json doubts(const OptimiseResult& result) {
  Json all = doubt_sentences(doubts_about(result));
  if (result.is_interrupted) all.push_back("Interrupted: the same command goes on from here.");
  if (const std::string why = why_unsure(result); !why.empty()) all.push_back(why);
  all.push_back(front_promise(result));
  return all;
}

Json asked(const OptimiseOptions& options) {
  Json all = Json::array();
  const auto add = [&](const std::string& name, const std::string& value) {
    all.push_back({{"name", name}, {"value", value}});
  };
  for (const FrontGoal* goal : options.goals) add("goal", fmt::format("{}: {}", goal->words, goal->description));
  if (options.rate) {
    const Figure& figure = rate_figure(options.rate);
    const std::string_view unit = figure.name == "tray_seeds_per_s" ? "seeds/s" : figure.unit;
    add("rate of the tray", fmt::format("{} to {} {}", to_digits(options.rate->low / figure.unit_size, 4),
                                        to_digits(options.rate->high / figure.unit_size, 4), unit));
  }
  add("clogs in at most", percent_text(options.clogging_limit) + " of runs");
  if (options.spilled_limit) add("spills at most", percent_text(*options.spilled_limit) + " of the seeds");
  add("confidence of each standing", percent_text(options.confidence));
  add("runs at most", fmt::format("{}", options.runs));
  return all;
}

Json cost(const OptimiseResult& result, const SweepTiming& timing) {
  Json all = Json::array({front_cost(result)});
  if (const std::string text = page_timing(timing); !text.empty()) all.push_back(text);
  return all;
}

bool shows_rate(const OptimiseOptions& options) {
  const std::string_view rate = rate_figure(options.rate).name;
  return std::ranges::none_of(options.goals, [&](const FrontGoal* goal) { return goal->column == rate; });
}

Json figures_of(const OptimiseOptions& options) {
  Json all = Json::array();
  for (const FrontGoal* goal : options.goals)
    all.push_back({{"name", goal->column},
                   {"unit", goal->unit},
                   {"description", goal->description},
                   {"has_interval", true},
                   {"wanted", goal->figure && goal->figure->is_most ? "high" : "low"},
                   {"goal", true}});
  if (shows_rate(options)) all.push_back(page_figure(rate_figure(options.rate)));
  all.push_back({{"name", "clogged_percent"},
                 {"unit", "%"},
                 {"description", "share of its runs that clogged; the other figures are of the rest"},
                 {"has_interval", false},
                 {"words", "clogged"},
                 {"wanted", "low"}});
  return all;
}

bool is_compared(const OptimiseResult& result, std::size_t layout) {
  using enum FrontStanding;
  const FrontStanding standing = result.layouts[layout].standing;
  return result.study.layouts[layout].scene &&
         (standing == on_front || standing == may_be_on_front || standing == dominated);
}

Json layout(const OptimiseResult& result, std::size_t index, const Replays& replays) {
  const Layout& layout = result.study.layouts[index];
  const FrontLayout& of = result.layouts[index];
  const OptimiseOptions& options = result.options;
  Json one = page_layout(result.study, layout, options.first_random_seed, replays);
  one["status"] = is_compared(result, index) ? "ok" : standing_text(result, index);
  one["compared"] = is_compared(result, index);
  one["standing"] = standing_text(result, index);
  one["first_by_means"] = of.is_first_by_means;
  one["note"] = !layout.scene ? layout.invalid : of.reason.empty() && leads(of) ? edge_text(of) : of.reason;
  one["replicates"] = of.runs;
  if (of.runs == 0) return one;
  for (std::size_t g = 0; g < options.goals.size(); ++g)
    one["means"][std::string(options.goals[g]->column)] = page_interval(of.goals[g], options.goals[g]->unit_size);
  const Figure& rate = rate_figure(options.rate);
  if (shows_rate(options)) one["means"][std::string(rate.name)] = page_interval(of.rate, rate.unit_size);
  one["means"]["clogged_percent"] = {{"mean", 100.0 * of.clogged / of.runs}, {"half_width", nullptr}};
  return one;
}

}  // namespace

std::vector<WantedReplay> best_to_replay(const OptimiseResult& result, std::size_t most) {
  std::vector<WantedReplay> wanted;
  for (std::size_t i = 0; i < result.layouts.size() && wanted.size() < most; ++i) {
    const Layout& one = result.study.layouts[i];
    if (leads(result.layouts[i]))
      wanted.push_back({one.number, result.study.scenes[*one.scene], result.options.first_random_seed});
  }
  return wanted;
}

std::string front_page_data(const OptimiseResult& result, const SweepTiming& timing, const Replays& replays) {
  Json layouts = Json::array();
  for (std::size_t i = 0; i < result.layouts.size(); ++i) layouts.push_back(layout(result, i, replays));
  Json data = page_of_study("front", result.study);
  data.update({{"headline", headline(result)},
               {"doubts", doubts(result)},
               {"asked", asked(result.options)},
               {"cost", cost(result, timing)},
               {"figures", figures_of(result.options)},
               {"layouts", std::move(layouts)}});
  return page_text(data);
}

FileText front_page_text() {
  return {"report.html", "with --html: the front and the layouts to look at in any browser, each drawn", {}};
}

}  // namespace vibrosow
