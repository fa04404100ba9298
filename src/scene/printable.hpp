#pragma once

#include <string>
#include <string_view>

namespace vibrosow {

/// `text` as valid UTF-8 without control characters, nor those that turn the direction of what follows, fit for a
/// terminal and for JSON: every other byte as "\x1b".
std::string printable(std::string_view text);

/// The same of a text of several lines, whose ends and tabs stay.
std::string printable_lines(std::string_view text);

/// A word that a shell takes as it is.
std::string shell_quoted(const std::string& word);

/// Whether a lot may have such a name, which stands in CSV files and beside the words "all" and "wall": letters,
/// digits, _ and -.
bool is_lot_name(std::string_view name);

}  // namespace vibrosow
