#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/columns.hpp"

namespace vibrosow {

/// An entry of a JSON file made from a `Source`: where it stands, what it means and its value in one place.
template <class Source>
struct JsonKey {
  std::string path;  // "balance.counted"
  std::string unit;
  std::string description;
  std::function<nlohmann::ordered_json(const Source&)> value;
};

template <class Source>
using JsonKeys = std::vector<JsonKey<Source>>;

template <class Source>
std::string json_of(const JsonKeys<Source>& keys, const Source& source) {
  nlohmann::ordered_json json;
  for (const JsonKey<Source>& key : keys) {
    nlohmann::ordered_json::json_pointer place;
    for (std::size_t from = 0; from <= key.path.size();) {
      const std::size_t to = std::min(key.path.find('.', from), key.path.size());
      place /= key.path.substr(from, to - from);
      from = to + 1;
    }
    json[place] = key.value(source);
  }
  return json.dump(2) + '\n';
}

template <class Source>
FileText file_text(std::string name, std::string description, const JsonKeys<Source>& keys) {
  FileText text{std::move(name), std::move(description), {}};
  for (const JsonKey<Source>& key : keys) text.columns.push_back({key.path, key.unit, key.description});
  return text;
}

}  // namespace vibrosow
