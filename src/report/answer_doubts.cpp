#include "report/answer_doubts.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

/// After "layout 3" or "layouts 3 to 5".
std::string predicate(LayoutStanding standing, bool several) {
  switch (standing) {
    case LayoutStanding::invalid:
      return "cannot be built";
    case LayoutStanding::stopped:
      return several ? "were stopped by the guard" : "was stopped by the guard";
    case LayoutStanding::incomplete:
      return several ? "have runs that are missing" : "has runs that are missing";
    default:
      return std::string(name_of(standing));
  }
}

bool is_left_out(AnswerKind kind, LayoutStanding standing) {
  if (standing == LayoutStanding::outside_the_model) return false;  // a doubt says so
  if (kind == AnswerKind::sweep) return !is_compared(standing);
  return has_failed(standing);
}

/// Those of one standing and reason.
struct LeftOut {
  LayoutStanding standing;
  std::string reason;
  std::vector<int> layouts;  // their numbers
};

Remark remark(const LeftOut& of) {
  std::string text = numbers_text("layout", of.layouts) + " " + predicate(of.standing, of.layouts.size() > 1);
  if (!of.reason.empty()) text += ": " + of.reason;
  return {Severity::mild, std::move(text)};
}

std::string paragraph_of(const std::vector<Remark>& remarks) {
  std::string text;
  for (const Remark& remark : remarks) text += wrapped(sentence_of(remark));
  return text;
}

}  // namespace

std::vector<Remark> doubt_remarks(const std::vector<SharedDoubt>& doubts, std::string_view noun, std::size_t most) {
  std::vector<Remark> remarks;
  for (const SharedDoubt& doubt : doubts) {
    if (remarks.size() == most) {
      remarks.push_back({words_of(doubt.kind).severity,
                         fmt::format("{} more kinds of doubts: the table names them", doubts.size() - most)});
      break;
    }
    remarks.push_back(remark_of(doubt, noun));
  }
  return remarks;
}

std::string doubts_paragraph(const std::vector<SharedDoubt>& doubts, std::string_view noun, std::size_t most) {
  return paragraph_of(doubt_remarks(doubts, noun, most));
}

std::string left_out_paragraph(const Answer& answer) {
  return paragraph_of(left_out_remarks(answer));
}

std::vector<Remark> left_out_remarks(const Answer& answer) {
  std::vector<LeftOut> all;
  for (const AnsweredLayout& one : answer.layouts) {
    if (!is_left_out(answer.kind, one.standing)) continue;
    const std::string reason = one.reason.empty() ? doubts_text(one.doubts) : one.reason;
    const auto is_same = [&](const LeftOut& known) { return known.standing == one.standing && known.reason == reason; };
    auto known = std::ranges::find_if(all, is_same);
    if (known == all.end()) known = all.insert(all.end(), {one.standing, reason, {}});
    known->layouts.push_back(answer.study->layouts[one.layout].number);
  }
  std::vector<Remark> remarks;
  std::size_t rest = 0;
  for (const LeftOut& one : all)
    if (remarks.size() < most_doubts)
      remarks.push_back(remark(one));
    else
      rest += one.layouts.size();
  if (rest > 0)
    remarks.push_back({Severity::mild, fmt::format("{} more layout{} not compared, for other reasons: the table names "
                                                   "them",
                                                   rest, rest == 1 ? " is" : "s are")});
  return remarks;
}

Json doubt_json(const Doubt& doubt) {
  const DoubtWords& words = words_of(doubt.kind);
  return {{"kind", words.name},
          {"serious", words.severity == Severity::serious},
          {"text", doubt.text},
          {"what_to_do", words.advice}};
}

Json doubts_json(const std::vector<SharedDoubt>& doubts, const std::string& noun) {
  Json all = Json::array();
  for (const SharedDoubt& doubt : doubts) {
    Json one = doubt_json({doubt.kind, doubt.text});
    one[noun + "s"] = doubt.layouts;
    one["runs"] = doubt.runs;
    one["of_runs"] = doubt.of;
    all.push_back(std::move(one));
  }
  return all;
}

FileText doubts_file_text(std::string_view noun) {
  return {
      "doubts.json",
      fmt::format("what speaks against the answer's runs: a list `doubts` as in decision.json, of {}s by number", noun),
      {}};
}

OutputFile doubts_file(const std::vector<SharedDoubt>& doubts, const std::string& noun) {
  return {"doubts.json", Json{{"doubts", doubts_json(doubts, noun)}}.dump(2) + '\n'};
}

}  // namespace vibrosow
