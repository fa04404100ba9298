#include "input/toml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include "scene/trimmed.hpp"

namespace vibrosow {
namespace {

// Limits, before toml++ sees the text: it reads long keys and deep nesting, and its tables cannot be destroyed again.

/// Walks the text outside comments and strings.
class LimitCheck {
 public:
  explicit LimitCheck(std::string_view text) : text_(text) {}

  void run() {
    while (at_ < text_.size() && !broken_) step();
  }

 private:
  void step() {
    const char c = text_[at_];
    if (c == '#') {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (c == '"' || c == '\'') {
      skip_string(c);
    } else {
      ++at_;
      count(c);
    }
  }

  void count(char c) {
    if (c == '.' && ++parts_ > most_key_parts)
      throw TomlError(line_, fmt::format("a key has more than {} parts", most_key_parts));
    if (c == '[' || c == '{') ++depth_;
    if (c == ']' || c == '}') --depth_;
    if (depth_ > deepest_nesting)
      throw TomlError(line_, fmt::format("lists or tables lie more than {} deep within each other", deepest_nesting));
    if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) parts_ = 1;
    if (c == '\n') ++line_;
  }

  /// A string that does not end is for the parser to tell.
  void skip_string(char quote) {
    const std::string triple(3, quote);
    const bool long_string = text_.substr(at_).starts_with(triple);
    const std::string_view end = long_string ? std::string_view(triple) : std::string_view(triple).substr(0, 1);
    for (at_ += end.size(); !text_.substr(at_, end.size()).starts_with(end); ++at_) {
      broken_ = at_ >= text_.size() || (text_[at_] == '\n' && !long_string);
      if (broken_) return;
      if (text_[at_] == '\\' && quote == '"' && at_ + 1 < text_.size()) ++at_;
      if (text_[at_] == '\n') ++line_;
    }
    at_ = std::min(at_ + end.size(), text_.size());
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1, parts_ = 1, depth_ = 0;
  bool broken_ = false;
};

// Advice on a line that is not TOML.

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// What an unquoted value that is a quantity or a word should be: "4 mm" in quotes.
std::optional<std::string> unquoted(std::string_view rest) {
  std::string_view value = trimmed(rest.substr(0, rest.find_first_of(",]}#")));
  if (value.ends_with('"') || value.ends_with('\'')) value = trimmed(value.substr(0, value.size() - 1));
  if (value.empty() || value.find_first_of("=\"'") != std::string_view::npos) return std::nullopt;
  const std::string_view unit = trimmed(value.substr(number_length(value)));
  const bool quantity = number_length(value) > 0 && !unit.empty() &&
                        (is_letter(unit[0]) || unit[0] == '%' || static_cast<unsigned char>(unit[0]) >= 0x80);
  std::string lower(value);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool word = is_letter(value[0]) && lower != "true" && lower != "false";
  if (!quantity && !word) return std::nullopt;
  return fmt::format("a {} is written in quotes: \"{}\"", quantity ? "quantity with its unit" : "text", value);
}

std::optional<std::string> missing_quote(std::string_view line) {
  if (trimmed(line).starts_with('[')) return std::nullopt;  // a table's name
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char c = line[at];
    if (c == '#') break;
    if (c == '"' || c == '\'') {
      const auto end = line.find(c, at + 1);
      if (end == std::string_view::npos)
        return fmt::format("the quote before {} is not closed", toml_text({std::string(trimmed(line.substr(at + 1)))}));
      at = end;
    }
    if (c != '=' && c != '[' && c != ',') continue;
    if (auto advice = unquoted(line.substr(at + 1))) return advice;
  }
  return std::nullopt;
}

std::string_view line_of(std::string_view text, std::size_t number) {
  for (std::size_t k = 1; k < number; ++k) {
    const auto end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

// From toml++'s tree to ours.

TomlValue converted(const toml::node& node);

SourcePlace place_of(const toml::source_region& source) {
  return {static_cast<int>(source.begin.line), static_cast<int>(source.begin.column), {}};
}

void check_length(std::string_view key, int line) {
  if (key.size() > longest_key)
    throw TomlError(line, fmt::format("the key {}... is longer than {} bytes", key.substr(0, 40), longest_key));
}

TomlTable converted_table(const toml::table& table) {
  TomlTable result;
  result.place = place_of(table.source());
  result.is_inline = table.is_inline();
  for (const auto& [key, node] : table) {
    SourcePlace place = place_of(key.source());
    if (place.line == 0) place = result.place;
    check_length(key.str(), place.line);
    result.entries.push_back({std::string(key.str()), converted(node), place});
  }
  std::ranges::stable_sort(result.entries, {},
                           [](const TomlEntry& entry) { return std::pair(entry.place.line, entry.place.column); });
  return result;
}

template <class Date>
TomlValue date(const Date& value) {
  std::ostringstream text;
  text << value.get();
  return {TomlValue::Date{text.str()}};
}

TomlValue converted(const toml::node& node) {
  if (const auto* text = node.as_string()) return {text->get()};
  if (const auto* whole = node.as_integer()) return {whole->get()};
  if (const auto* number = node.as_floating_point()) return {number->get()};
  if (const auto* flag = node.as_boolean()) return {flag->get()};
  if (const auto* day = node.as_date()) return date(*day);
  if (const auto* time = node.as_time()) return date(*time);
  if (const auto* both = node.as_date_time()) return date(*both);
  if (const auto* table = node.as_table()) return {converted_table(*table)};
  TomlValue::List list;
  for (const toml::node& element : *node.as_array()) list.push_back(converted(element));
  return {std::move(list)};
}

// To text.

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (code < 0x20 || code == 0x7f) {
      result += fmt::format("\\u{:04x}", code);
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string key_text(const std::string& key) {
  const bool bare = !key.empty() && std::ranges::all_of(key, [](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? key : in_quotes(key);
}

struct TextOf {
  std::string operator()(const std::string& text) const { return in_quotes(text); }
  std::string operator()(std::int64_t whole) const { return fmt::format("{}", whole); }
  std::string operator()(double number) const {
    const std::string digits = fmt::format("{}", number);
    return digits.find_first_of(".en") == std::string::npos ? digits + ".0" : digits;
  }
  std::string operator()(bool flag) const { return flag ? "true" : "false"; }
  std::string operator()(const Quantity& quantity) const {
    return in_quotes(fmt::format("{} {}", quantity.number, quantity.unit));
  }
  std::string operator()(const TomlValue::Date& value) const { return value.text; }
  std::string operator()(const TomlValue::List& list) const {
    std::vector<std::string> parts;
    for (const TomlValue& element : list) parts.push_back(toml_text(element));
    return list.empty() ? "[]" : fmt::format("[ {} ]", fmt::join(parts, ", "));
  }
  std::string operator()(const TomlTable& table) const {
    std::vector<std::string> parts;
    for (const TomlEntry& entry : table.entries)
      parts.push_back(fmt::format("{} = {}", key_text(entry.key), toml_text(entry.value)));
    return parts.empty() ? "{}" : fmt::format("{{ {} }}", fmt::join(parts, ", "));
  }
};

}  // namespace

const TomlEntry* TomlTable::find(std::string_view key) const {
  const auto found = std::ranges::find(entries, key, &TomlEntry::key);
  return found != entries.end() ? &*found : nullptr;
}

TomlEntry* TomlTable::find(std::string_view key) {
  return const_cast<TomlEntry*>(std::as_const(*this).find(key));
}

TomlEntry& TomlTable::set(const std::string& key, TomlValue value, const SourcePlace& at) {
  TomlEntry* entry = find(key);
  if (entry == nullptr) return entries.emplace_back(TomlEntry{key, std::move(value), at});
  *entry = {key, std::move(value), at};
  return *entry;
}

void TomlTable::erase(std::string_view key) {
  std::erase_if(entries, [key](const TomlEntry& entry) { return entry.key == key; });
}

TomlTable parse_toml(const std::string& text) {
  LimitCheck(text).run();
  try {
    TomlTable root = converted_table(toml::parse(text));
    root.place = {};
    return root;
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;
    const auto advice = missing_quote(line_of(text, line));
    throw TomlError(static_cast<int>(line), advice.value_or(std::string(error.description())));
  }
}

TomlValue parse_toml_value(const std::string& text) {
  TomlTable table = parse_toml("value = " + text);
  if (table.entries.size() != 1) throw TomlError(1, "not one value");
  return std::move(table.entries.front().value);
}

std::vector<std::string> key_parts(const std::string& dotted) {
  std::vector<std::string> parts;
  for (std::size_t from = 0, dot = 0; dot != std::string::npos; from = dot + 1) {
    dot = dotted.find('.', from);
    parts.push_back(dotted.substr(from, dot == std::string::npos ? dot : dot - from));
    if (parts.back().empty()) throw TomlError(1, "a part of the key is empty");
    check_length(parts.back(), 1);
    if (parts.size() > most_key_parts) throw TomlError(1, fmt::format("a key has more than {} parts", most_key_parts));
  }
  return parts;
}

std::string toml_text(const TomlValue& value) {
  return std::visit(TextOf{}, value.data);
}

}  // namespace vibrosow
