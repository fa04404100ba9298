#include "input/override.hpp"

#include <sstream>

#include "input/toml_lib.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

bool is_toml_value(const std::string& text) {
  try {
    return toml::parse("value = " + text).size() == 1;
  } catch (const toml::parse_error&) {
    return false;
  }
}

std::string quoted(const std::string& text) {
  std::ostringstream out;
  out << toml::toml_formatter(toml::value<std::string>(text));
  return out.str();
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

Override parse_override(const std::string& key_equals_value) {
  const std::string where = "--set " + key_equals_value;
  const auto equals = key_equals_value.find('=');
  if (equals == std::string::npos) {
    throw InputError(where + ": expected KEY=VALUE such as \"tray.motion.frequency=12 Hz\"");
  }
  const std::string key = trimmed(key_equals_value.substr(0, equals));
  const std::string value = trimmed(key_equals_value.substr(equals + 1));
  if (key.empty()) throw InputError(where + ": the key before \"=\" is missing");
  return {key, is_toml_value(value) ? value : quoted(value), where};
}

}  // namespace vibrosow
