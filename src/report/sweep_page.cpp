#include "report/sweep_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "report/answer_doubts.hpp"
#include "report/layout_columns.hpp"
#include "report/page.hpp"
#include "report/study_page.hpp"
#include "report/sweep_report.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

/// Those that any layout has; pooled ones have no interval.
std::vector<const Figure*> figures_of(const StudyResult& result) {
  std::vector<const Figure*> known;
  for (const Figure& figure : figures())
    if (std::ranges::any_of(result.layouts, [&](const LayoutResult& one) { return one.figures[figure].has_value(); }))
      known.push_back(&figure);
  return known;
}

Json holes(const LayoutResult& layout) {
  Json all = Json::array();
  for (const HoleFigures& hole : layout.holes)
    if (hole.hole != "all")
      all.push_back({{"hole", hole.hole},
                     {"lot", hole.lot},
                     {"seeds_per_s", page_interval(hole.seeds_per_s, 1)},
                     {"g_per_s", page_interval(hole.mass_rate, 1e-3)},
                     {"longest_pause_s", page_interval(hole.longest_pause, 1)}});
  return all;
}

Json layout(Json one, const LayoutRow& row, const std::vector<const Figure*>& known) {
  Json means = Json::object();
  for (const Figure* figure : known)
    means[std::string(figure->name)] = page_interval(row.of().figures[*figure], figure->unit_size);
  one.update({{"status", layout_status(row.of().status)},
              {"compared", is_comparable(row.of().status)},
              {"note", layout_note(row.of())},
              {"replicates", row.of().replicates},
              {"means", std::move(means)},
              {"misfit_percent", page_interval(row.of().misfit_percent, 1)},
              {"holes", holes(row.of())}});
  return one;
}

std::string headline(const StudyResult& result) {
  const auto of_status = [&](LayoutStatus status) {
    return std::ranges::count(result.layouts, status, &LayoutResult::status);
  };
  std::string text = fmt::format("{} layout{}", result.layouts.size(), result.layouts.size() == 1 ? "" : "s");
  const Figure& rate = figure_named("rate_g_per_s");
  std::optional<double> least, most;
  for (const LayoutResult& one : result.layouts)
    if (is_comparable(one.status) && one.figures[rate]) {
      const double value = one.figures[rate]->mean / rate.unit_size;
      least = std::min(value, least.value_or(value)), most = std::max(value, most.value_or(value));
    }
  if (most) text += fmt::format(" let out {} to {} g/s", to_digits(*least, 3), to_digits(*most, 3));
  text += '.';
  for (const auto& [status, words] : {std::pair(LayoutStatus::invalid, "cannot be built"),
                                      std::pair(LayoutStatus::stopped, "were stopped by the guard"),
                                      std::pair(LayoutStatus::outside_the_model, "lie outside the model"),
                                      std::pair(LayoutStatus::incomplete, "have runs that are missing")})
    if (of_status(status) > 0) text += fmt::format(" {} {}.", of_status(status), words);
  return text;
}

}  // namespace

std::vector<WantedReplay> best_to_replay(const StudyResult& result, std::uint64_t first_random_seed, std::size_t most) {
  const Figure& rate = figure_named("rate_g_per_s");
  std::vector<LayoutRow> rows = layout_rows(result);
  std::erase_if(rows, [&](const LayoutRow& row) { return !is_comparable(row.of().status) || !row.of().figures[rate]; });
  std::ranges::stable_sort(rows, std::greater(), [&](const LayoutRow& row) { return row.of().figures[rate]->mean; });
  rows.resize(std::min(most, rows.size()));
  std::vector<WantedReplay> wanted;
  for (const LayoutRow& row : rows)
    wanted.push_back({row.layout().number, result.study.scenes[*row.layout().scene], first_random_seed});
  return wanted;
}

std::string sweep_page_data(const StudyResult& result, std::uint64_t first_random_seed, const Replays& replays) {
  const std::vector<const Figure*> known = figures_of(result);
  Json figure_texts = Json::array(), layouts = Json::array();
  for (const Figure* figure : known) figure_texts.push_back(page_figure(*figure));
  for (const LayoutRow& row : layout_rows(result))
    layouts.push_back(layout(page_layout(result.study, row.layout(), first_random_seed, replays), row, known));
  Json data = page_of_study("sweep", result.study);
  data.update({{"headline", headline(result)},
               {"doubts", doubt_sentences(doubts_about(result))},
               {"figures", std::move(figure_texts)},
               {"layouts", std::move(layouts)}});
  return page_text(data);
}

std::string sweep_page(const std::string& page_template, const StudyResult& result, std::uint64_t first_random_seed,
                       const Replays& replays) {
  return filled_page(page_template, sweep_page_data(result, first_random_seed, replays));
}

FileText sweep_page_text() {
  return {"report.html", "with --html: the layouts to look at in any browser, each drawn, with its figures", {}};
}

}  // namespace vibrosow
