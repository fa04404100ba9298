#include "scene/printable.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace vibrosow {
namespace {

std::uint32_t byte_at(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0;
}

/// Whether a character stands for nothing but the direction of others, or ends a line (Unicode 15, chapters 23.2, 5.8).
bool is_unseen(std::uint32_t code) {
  return code == 0x61c || code == 0x200e || code == 0x200f || (code >= 0x2028 && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069);
}

/// Bytes of the UTF-8 character that `text` begins with (Unicode 15, table 3-7); 0: not one, or a control character.
std::size_t character_length(std::string_view text) {
  const std::uint32_t first = byte_at(text, 0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  std::uint32_t code = first & (0x7fU >> length);
  for (std::size_t k = 1; k < length; ++k) {
    const std::uint32_t next = byte_at(text, k);
    if ((next & 0xc0U) != 0x80U) return 0;
    code = code << 6U | (next & 0x3fU);
  }
  constexpr std::uint32_t least[] = {0, 0, 0xa0, 0x800, 0x10000};  // 0x80 to 0x9f are control characters
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  return first >= 0xc0 && first < 0xf8 && code >= least[length] && code <= 0x10ffff && !surrogate && !is_unseen(code)
             ? length
             : 0;
}

/// `kept`: control characters that stay.
std::string shown(std::string_view text, std::string_view kept) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = kept.find(text[0]) != std::string_view::npos ? 1 : character_length(text);
    if (length > 0) {
      result += text.substr(0, length);
    } else {
      result += fmt::format("\\x{:02x}", byte_at(text, 0));
    }
    text.remove_prefix(length > 0 ? length : 1);
  }
  return result;
}

}  // namespace

std::string printable(std::string_view text) {
  return shown(text, "");
}

std::string printable_lines(std::string_view text) {
  return shown(text, "\n\t");
}

std::string shell_quoted(const std::string& word) {
  std::string quoted(1, '\'');
  for (const char letter : word) {
    if (letter == '\'') quoted.append("'\\'");  // out of the quotes, one that stands for itself, and in again
    quoted.push_back(letter);
  }
  quoted.push_back('\'');
  return quoted;
}

bool is_lot_name(std::string_view name) {
  const bool plain = std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return plain && !name.empty() && name != "all" && name != "wall";
}

}  // namespace vibrosow
