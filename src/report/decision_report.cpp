#include "report/decision_report.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "answer/answer.hpp"
#include "report/answer_doubts.hpp"
#include "report/expected_report.hpp"
#include "report/json_keys.hpp"
#include "report/layout_columns.hpp"
#include "report/study_page.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

struct DecisionRow {
  const DecisionReport* report;
  const Answer* answer;
  std::size_t index;
  const Layout& layout() const { return report->result.study.layouts[index]; }
  /// None where the layout cannot be built.
  const SceneDecision* of() const { return layout().scene ? &report->result.scenes[*layout().scene] : nullptr; }
};

/// A mean of a row, in the unit of a figure that its decision names.
template <class MetricOf, class Get>
void add_decided_columns(Columns<DecisionRow>& columns, const std::string& name, const std::string& description,
                         MetricOf metric_of, Get get) {
  add_mean_columns(columns, name, plain, description, [metric_of, get](const DecisionRow& r) {
    std::optional<MeanWithInterval> value = r.of() ? get(*r.of()) : std::nullopt;
    if (!value) return value;
    const double unit = metric_of(r.report->result.options).unit_size;
    value->mean /= unit;
    if (value->half_width_95) *value->half_width_95 /= unit;
    return value;
  });
}

const Metric& metric_of_goal(const DecideOptions& options) {
  return metric_named(options.goal->metric);
}

const Metric& metric_of_rate(const DecideOptions& options) {
  return rate_metric(options.rate);
}

Columns<DecisionRow> decision_columns(const std::vector<std::string>& keys) {
  using R = const DecisionRow&;
  Columns<DecisionRow> columns = layout_columns<DecisionRow>();
  columns.push_back(text_column<DecisionRow>(
      "standing",
      "best; not shown to be worse; worse (with the confidence asked for); misses the rate (or meets it by less than a "
      "fifth of the band); clogs; ruled out by drafts; failed (it cannot be run, has no such goal, or left the model); "
      "invalid; undecided",
      [](R r) { return std::string(name_of(r.answer->layouts[r.index].standing)); }));
  columns.push_back(
      text_column<DecisionRow>("reason", "why it failed or is invalid; else what makes it less sure", [](R r) {
        const SceneDecision* of = r.of();
        if (!of) return r.layout().invalid;
        return of->reason.empty() ? doubts_text(of->doubts) : of->reason;
      }));
  append(columns, key_columns<DecisionRow>(keys));
  append(columns, {text_column<DecisionRow>("runs", "after which it was decided, so far those that were made",
                                            [](R r) { return r.of() ? r.of()->runs : 0; }),
                   text_column<DecisionRow>(
                       "clogged",
                       "of these, runs that clogged; the means are of the others where clogging is tested, else of all",
                       [](R r) { return r.of() ? r.of()->clogged : 0; })});
  add_decided_columns(columns, "goal", "the goal's figure of a single run, in its unit (decision.json names it)",
                      metric_of_goal, [](const SceneDecision& of) { return of.goal; });
  add_decided_columns(columns, "rate",
                      "rate in the unit of decision.json's rate.figure: of the tray where one is asked for, else "
                      "rate_g_per_s of sweep.csv",
                      metric_of_rate, [](const SceneDecision& of) { return of.rate; });
  add_unevenness_columns(columns, "coefficient of variation of the holes' rates by all these runs together",
                         [](R r) { return r.of() ? r.of()->unevenness : std::nullopt; });
  add_expected_columns(
      columns, [](R r) -> const auto& { return r.answer->layouts[r.index].expected; });
  return columns;
}

template <class Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

Json whole(double number) {
  return Json(static_cast<std::int64_t>(number));
}

JsonKeys<DecisionReport> decision_keys() {
  using S = const DecisionReport&;
  const auto of_rate = [](auto get) {
    return [get](S s) {
      const auto& rate = s.result.options.rate;
      return rate ? Json(get(*rate) / rate_metric(rate).unit_size) : Json();
    };
  };
  return {
      {"best", "", "number of the best layout; null: none is known, or none meets the constraints",
       [](S s) {
         for (const Layout& layout : s.result.study.layouts)
           if (layout.scene && layout.scene == s.result.best) return Json(layout.number);
         return Json();
       }},
      {"sure", "", "whether it is, or that there is none, with the confidence asked for",
       [](S s) { return Json(s.result.is_sure); }},
      {"interrupted", "", "whether runs are missing; the same command resumes",
       [](S s) { return Json(s.result.is_interrupted); }},
      {"procedure", "", "guaranteed or posterior",
       [](S s) { return Json(s.result.options.rule == SelectionRule::guaranteed ? "guaranteed" : "posterior"); }},
      {"confidence_percent", "%", "that was asked for", [](S s) { return Json(100 * s.result.options.confidence); }},
      {"margin_percent", "%", "of the best's mean, below which a difference does not matter",
       [](S s) { return Json(100 * s.result.options.margin); }},
      {"random_seed", "", "of the first run of each layout; those of the others follow it",
       [](S s) { return Json(s.result.options.first_random_seed); }},
      {"goal.name", "", "what layouts are compared by", [](S s) { return Json(s.result.options.goal->name); }},
      {"goal.figure", "", "the figure of a run that it is, as in sweep.csv",
       [](S s) { return Json(s.result.options.goal->metric); }},
      {"rate.figure", "", "of decision.csv's rate", [](S s) { return Json(metric_of_rate(s.result.options).name); }},
      {"rate.low", "", "lower end of the band, in its unit; null: none is asked for",
       of_rate([](const WantedRate& rate) { return rate.low; })},
      {"rate.high", "", "upper end", of_rate([](const WantedRate& rate) { return rate.high; })},
      {"clogging_limit_percent", "%", "share of runs that may clog; null: it was not tested",
       [](S s) { return s.result.tests_clogging ? Json(100 * s.result.options.clogging_limit) : Json(); }},
      {"doubts", "", doubts_description, [](S s) { return doubts_json(doubts_about(answer_of(s.result))); }},
      {"correlation", "", "between layouts, of the goals of runs under one random seed, mean over pairs",
       [](S s) { return or_null(s.result.correlation); }},
      {"cost.runs", "", "that the decision took", [](S s) { return whole(s.result.cost.runs); }},
      {"cost.grain_steps", "", "of these", [](S s) { return Json(s.result.cost.grain_steps); }},
      {"equal_grid.runs", "", "that Rinott's procedure would take for the same confidence, by the first runs",
       [](S s) { return s.result.equal_grid ? whole(s.result.equal_grid->runs) : Json(); }},
      {"equal_grid.grain_steps", "", "of these",
       [](S s) { return s.result.equal_grid ? Json(s.result.equal_grid->grain_steps) : Json(); }},
      {"drafts.correlation", "", "between the means of pilot layouts as drafts and as they are; null: no drafts",
       [](S s) { return s.drafts ? or_null(s.drafts->correlation) : Json(); }},
      {"drafts.screened", "", "whether drafts ruled layouts out",
       [](S s) { return Json(s.drafts && s.drafts->screens); }},
      {"drafts.runs", "", "drafts made", [](S s) { return s.drafts ? whole(s.drafts->cost.runs) : Json(); }},
      {"drafts.grain_steps", "", "of these", [](S s) { return s.drafts ? Json(s.drafts->cost.grain_steps) : Json(); }},
  };
}

}  // namespace

std::string decision_csv(const DecisionReport& report, CsvFormat format) {
  const Answer answer = answer_of(report.result);
  std::vector<DecisionRow> rows;
  for (std::size_t i = 0; i < answer.layouts.size(); ++i) rows.push_back({&report, &answer, i});
  return csv_of(decision_columns(report.result.study.keys), rows, format);
}

std::string decision_json(const DecisionReport& report) {
  return json_of(decision_keys(), report);
}

std::vector<FileText> decision_file_texts() {
  return {file_text("decision.csv", "one row per layout", decision_columns({"KEY"})),
          file_text("decision.json", "the answer, what was asked and what it cost", decision_keys()),
          decision_page_text()};
}

std::vector<OutputFile> decision_files(const DecisionReport& report, CsvFormat format) {
  return {{"decision.csv", decision_csv(report, format)}, {"decision.json", decision_json(report)}};
}

}  // namespace vibrosow
