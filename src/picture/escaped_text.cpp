#include "picture/escaped_text.hpp"

namespace vibrosow {

std::string escaped_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '&')
      safe += "&amp;";
    else if (c == '"')
      safe += "&quot;";
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      safe += "\xEF\xBF\xBD";
    else
      safe += c;
  }
  return safe;
}

}  // namespace vibrosow
