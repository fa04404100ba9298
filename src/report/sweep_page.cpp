#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

#include "report/answer_doubts.hpp"
#include "report/number_text.hpp"
#include "report/study_page.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

std::string headline(const StudyResult& result) {
  const auto of_status = [&](LayoutStanding status) {
    return std::ranges::count(result.layouts, status, &LayoutResult::status);
  };
  std::string text = fmt::format("{} layout{}", result.layouts.size(), result.layouts.size() == 1 ? "" : "s");
  const Metric& rate = metric_named("rate_g_per_s");
  std::vector<MeanWithInterval> rates;
  for (const LayoutResult& one : result.layouts)
    if (is_compared(one.status) && one.metrics[rate]) rates.push_back(*one.metrics[rate]);
  const auto stated = [&](const MeanWithInterval& value) {
    const auto& half = value.half_width_95;
    return interval_text(value.mean / rate.unit_size, half ? std::optional(*half / rate.unit_size) : std::nullopt, "±");
  };
  const auto [least, most] = std::ranges::minmax_element(rates, {}, &MeanWithInterval::mean);
  if (rates.size() == 1) text += fmt::format(" let out {} g/s", stated(*most));
  if (rates.size() > 1) text += fmt::format(" let out from {} to {} g/s", stated(*least), stated(*most));
  text += '.';
  for (const auto& [status, words] : {std::pair(LayoutStanding::invalid, "cannot be built"),
                                      std::pair(LayoutStanding::stopped, "were stopped by the guard"),
                                      std::pair(LayoutStanding::outside_the_model, "lie outside the model"),
                                      std::pair(LayoutStanding::incomplete, "have runs that are missing")})
    if (of_status(status) > 0) text += fmt::format(" {} {}.", of_status(status), words);
  return text;
}

}  // namespace

StudyPage study_page(const StudyResult& result, std::uint64_t first_random_seed) {
  StudyPage page{.answer = answer_of(result, first_random_seed), .headline = headline(result)};
  page.remarks = doubt_remarks(doubts_about(page.answer));
  std::ranges::move(left_out_remarks(page.answer), std::back_inserter(page.remarks));
  return page;
}

FileText sweep_page_text() {
  return {"report.html", "with --html: the layouts to look at in any browser, each drawn, with its figures", {}};
}

}  // namespace vibrosow
