#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "units/quantity.hpp"

namespace vibrosow {

/// Where a key is written.
struct SourcePlace {
  int line = 0, column = 0;  // of the file; 0: nowhere
  std::string origin;        // of what is laid over the file ("--set tray.length=2 m"), instead of a line
};

struct TomlValue;
struct TomlEntry;

/// The keys of a table in the order of the file; what was added later comes last.
struct TomlTable {
  std::vector<TomlEntry> entries;
  SourcePlace place{};
  bool is_inline = false;  // written { .. }

  const TomlEntry* find(std::string_view key) const;  // nullptr: not written
  TomlEntry* find(std::string_view key);
  /// Puts a value in place of the key's, or at the end.
  TomlEntry& set(const std::string& key, TomlValue value, const SourcePlace& at);
  void erase(std::string_view key);
};

/// A value of a TOML file. A program may put a quantity where a file has text such as "8 mm".
struct TomlValue {
  struct Date {
    std::string text;  // no key takes one
  };
  using List = std::vector<TomlValue>;
  std::variant<std::string, std::int64_t, double, bool, Quantity, Date, List, TomlTable> data;

  template <class T>
  const T* get() const {
    return std::get_if<T>(&data);
  }
};

struct TomlEntry {
  std::string key;
  TomlValue value;
  SourcePlace place;
};

/// What is not TOML, or beyond the limits; `line` of the text, from 1.
class TomlError : public std::runtime_error {
 public:
  TomlError(int at, const std::string& message) : std::runtime_error(message), line(at) {}
  int line;
};

/// Limits, far beyond any sensible file, without which a parser's recursion could outgrow the stack.
inline constexpr int most_key_parts = 32, deepest_nesting = 32;
inline constexpr std::size_t longest_key = 200;  // bytes, of one part

/// The root table of a file's text. Throws TomlError; a missing quote is said to be one.
TomlTable parse_toml(const std::string& text);

/// One value as it would stand after "key = ". Throws TomlError.
TomlValue parse_toml_value(const std::string& text);

/// Parts of a dotted key; throws TomlError (line 1) where one is empty or beyond the limits.
std::vector<std::string> key_parts(const std::string& dotted);

/// A value as TOML text on one line.
std::string toml_text(const TomlValue& value);

}  // namespace vibrosow
