#pragma once

#include <string>

namespace vibrosow {

/// One change to a seeder file: a full key ("tray.holes.count") and a value as TOML text ("5", "\"12 Hz\"").
struct Override {
  std::string key;
  std::string toml_value;
  std::string where;  // for messages: "--set tray.holes.count=5" or "studies/wheat.toml:12"
};

/// From a command line's KEY=VALUE; VALUE is read as TOML where it is valid TOML, as a string otherwise.
/// Throws InputError without "=" or with an empty key.
Override parse_override(const std::string& key_equals_value);

}  // namespace vibrosow
