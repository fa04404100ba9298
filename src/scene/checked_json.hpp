#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "scene/input_error.hpp"

namespace vibrosow {

/// Throws InputError where a text opens more than 100 lists and objects within one another: nothing of ours does, and
/// what copies or writes JSON calls itself for each.
void refuse_deep_json(std::string_view text);

/// A JSON text that somebody else may have written. Throws nlohmann's exceptions where it is none, InputError where it
/// is too deep.
template <class Json>
Json parse_json(std::string_view text) {
  refuse_deep_json(text);
  return Json::parse(text);
}

/// A whole number from `least` to `most`. Throws InputError where it is anything else.
template <class Json>
std::int64_t whole_number(const Json& json, std::int64_t least, std::int64_t most) {
  const bool whole = json.is_number_unsigned() ? json.template get<std::uint64_t>() <= std::uint64_t{INT64_MAX}
                                               : json.is_number_integer();
  if (!whole || json.template get<std::int64_t>() < least || json.template get<std::int64_t>() > most)
    throw InputError("a number is not what it is to be");
  return json.template get<std::int64_t>();
}

/// A random seed. Throws InputError where it is anything else.
template <class Json>
std::uint64_t seed_number(const Json& json) {
  if (!json.is_number_unsigned()) throw InputError("a random seed is not what it is to be");
  return json.template get<std::uint64_t>();
}

/// A number from `least` to `most`. Throws InputError where it is anything else.
template <class Json>
double number_within(const Json& json, double least, double most) {
  const double value = json.is_number() ? json.template get<double>() : least - 1;
  if (!(value >= least && value <= most)) throw InputError("a number is not what it is to be");
  return value;
}

}  // namespace vibrosow
