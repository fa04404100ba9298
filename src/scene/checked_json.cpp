#include "scene/checked_json.hpp"

namespace vibrosow {

void refuse_deep_json(std::string_view text) {
  constexpr int most = 100;
  int depth = 0;
  bool in_text = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char letter = text[k];
    if (letter == '"') in_text = !in_text;
    if (in_text && letter == '\\') ++k;  // whatever it makes of the next
    if (in_text) continue;
    if (letter == '[' || letter == '{') ++depth;
    if (letter == ']' || letter == '}') --depth;
    if (depth > most) throw InputError("the JSON text is nested too deeply");
  }
}

}  // namespace vibrosow
