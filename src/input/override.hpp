#pragma once

#include <optional>
#include <string>

#include "input/toml_value.hpp"

namespace vibrosow {

/// One change to a seeder file: a full key ("tray.holes.count") and its value, or none: the key is taken out, as if it
/// had not been written.
struct Override {
  std::string key;
  std::optional<TomlValue> value;
  std::string where;  // for messages: "--set tray.holes.count=5" or "studies/wheat.toml:12"
};

/// From a command line's KEY=VALUE; VALUE is read as TOML where it is valid TOML, as a string otherwise, and KEY= takes
/// the key out. Throws InputError without "=" or with an empty key.
Override parse_override(const std::string& key_equals_value);

}  // namespace vibrosow
