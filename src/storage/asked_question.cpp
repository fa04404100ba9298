#include "storage/asked_question.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "scene/checked_json.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// One of two texts: whether it is the first.
bool is_first(const nlohmann::json& json, std::string_view first, std::string_view second) {
  const auto text = json.get<std::string>();
  if (text != first && text != second) throw InputError("a text is not what it is to be");
  return text == first;
}

double number_in(const nlohmann::json& json, AskedRange<double> range) {
  return number_within(json, range.least, range.most);
}

int number_in(const nlohmann::json& json, AskedRange<int> range) {
  return static_cast<int>(whole_number(json, range.least, range.most));
}

OrderedJson rate_json(const WantedRate& rate) {
  return {{"unit", rate.is_of_seeds ? "seeds/s" : "kg/s"}, {"low", rate.low}, {"high", rate.high}};
}

std::optional<WantedRate> rate_in(const nlohmann::json& question) {
  if (!question.contains("rate")) return std::nullopt;
  const nlohmann::json& json = question.at("rate");
  const WantedRate rate{is_first(json.at("unit"), "seeds/s", "kg/s"),
                        number_within(json.at("low"), 0, most_wanted_rate),
                        number_within(json.at("high"), 0, most_wanted_rate)};
  if (!(rate.low > 0 && rate.high > rate.low)) throw InputError("a band is empty");
  return rate;
}

OrderedJson json_of_one(std::monostate) {
  return nullptr;
}

OrderedJson json_of_one(const DecideQuestion& question) {
  OrderedJson json = {{"command", DecideQuestion::command}, {"goal", question.goal}};
  if (question.rate) json["rate"] = rate_json(*question.rate);
  json["clogging_limit"] = question.clogging_limit;
  json["margin"] = question.margin;
  json["confidence"] = question.confidence;
  json["procedure"] = question.rule == SelectionRule::guaranteed ? "guaranteed" : "posterior";
  json["most_runs"] = question.most;
  json["drafts"] = question.drafts;
  return json;
}

OrderedJson json_of_one(const OptimiseQuestion& question) {
  OrderedJson json = {{"command", OptimiseQuestion::command}, {"goals", question.goals}};
  if (question.rate) json["rate"] = rate_json(*question.rate);
  json["clogging_limit"] = question.clogging_limit;
  if (question.spilled_limit) json["spilled_limit"] = *question.spilled_limit;
  json["confidence"] = question.confidence;
  json["runs"] = question.runs;
  return json;
}

DecideQuestion decide_question(const nlohmann::json& json) {
  DecideQuestion question{json.at("goal").get<std::string>()};
  question.rate = rate_in(json);
  question.clogging_limit = number_in(json.at("clogging_limit"), clogging_range);
  question.margin = number_in(json.at("margin"), margin_range);
  question.confidence = number_in(json.at("confidence"), confidence_range);
  question.rule =
      is_first(json.at("procedure"), "guaranteed", "posterior") ? SelectionRule::guaranteed : SelectionRule::posterior;
  question.most = number_in(json.at("most_runs"), most_runs_range);
  question.drafts = json.at("drafts").get<bool>();
  return question;
}

OptimiseQuestion optimise_question(const nlohmann::json& json) {
  OptimiseQuestion question{json.at("goals").get<std::vector<std::string>>()};
  if (question.goals.empty()) throw InputError("there is no goal");
  question.rate = rate_in(json);
  question.clogging_limit = number_in(json.at("clogging_limit"), clogging_range);
  if (json.contains("spilled_limit")) question.spilled_limit = number_in(json.at("spilled_limit"), spilled_range);
  question.confidence = number_in(json.at("confidence"), confidence_range);
  question.runs = number_in(json.at("runs"), search_runs_range);
  return question;
}

}  // namespace

std::string_view command_of(const AskedQuestion& question) {
  constexpr std::array<std::string_view, 3> commands{"", DecideQuestion::command, OptimiseQuestion::command};
  return commands.at(question.index());
}

OrderedJson json_of(const AskedQuestion& question) {
  return std::visit([](const auto& one) { return json_of_one(one); }, question);
}

AskedQuestion question_in(const nlohmann::json& json) {
  const bool is_decision = is_first(json.at("command"), DecideQuestion::command, OptimiseQuestion::command);
  AskedQuestion question;
  if (is_decision)
    question = decide_question(json);
  else
    question = optimise_question(json);
  if (nlohmann::json(json_of(question)) != json) throw InputError("a question has keys that are not known");
  return question;
}

}  // namespace vibrosow
