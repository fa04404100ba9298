#pragma once

#include <string>
#include <string_view>

namespace vibrosow {

/// `text` as valid UTF-8 without control characters, fit for a terminal and for JSON: every other byte as "\x1b".
std::string printable(std::string_view text);

}  // namespace vibrosow
