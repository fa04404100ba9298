#include "report/answer_doubts.hpp"

#include <fmt/format.h>

#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::vector<std::string> doubt_sentences(const std::vector<SharedDoubt>& doubts, std::string_view noun) {
  constexpr std::size_t most = 6;
  std::vector<std::string> sentences;
  for (const SharedDoubt& doubt : doubts) {
    if (sentences.size() == most) {
      sentences.push_back(fmt::format("{} more kinds of doubts: the table names them.", doubts.size() - most));
      break;
    }
    sentences.push_back(doubt_sentence(doubt, noun));
  }
  return sentences;
}

std::string doubts_paragraph(const std::vector<SharedDoubt>& doubts, std::string_view noun) {
  std::string text;
  for (const std::string& sentence : doubt_sentences(doubts, noun)) text += wrapped(sentence);
  return text;
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

}  // namespace vibrosow
