#include "input/override.hpp"

#include <algorithm>

#include "input/wording.hpp"
#include "scene/input_error.hpp"
#include "scene/trimmed.hpp"

namespace vibrosow {
namespace {

TomlValue value_or_text(const std::string& text) {
  try {
    return parse_toml_value(text);
  } catch (const TomlError&) {
    return {text};
  }
}

}  // namespace

Override parse_override(const std::string& key_equals_value) {
  const std::string where = "--set " + shortened(key_equals_value);
  const auto equals = key_equals_value.find('=');
  if (equals == std::string::npos) {
    throw InputError(where + ": expected KEY=VALUE such as \"tray.motion.frequency=12 Hz\"");
  }
  const std::string key(trimmed(key_equals_value.substr(0, equals)));
  const std::string value(trimmed(key_equals_value.substr(equals + 1)));
  if (key.empty()) throw InputError(where + ": the key before \"=\" is missing");
  if (value.empty()) return {key, std::nullopt, where};
  return {key, value_or_text(value), where};
}

}  // namespace vibrosow
