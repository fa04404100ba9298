#pragma once

#include <cstddef>
#include <string>

namespace vibrosow {

/// `good` with fuzzed edits: four bytes each, the place (two of them), what is done there and with what.
inline std::string edited(std::string good, const std::string& edits) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(edits[i]); };
  for (std::size_t i = 0; i + 4 <= edits.size() && !good.empty(); i += 4) {
    const std::size_t place = (byte(i) + 256u * byte(i + 1)) % good.size();
    switch (byte(i + 2) % 4) {
      case 0:
        good[place] = edits[i + 3];
        break;
      case 1:
        good.erase(place, 1u + byte(i + 3));
        break;
      case 2:
        good.insert(place, 1u + byte(i + 3) % 16, edits[i + 3]);
        break;
      default:
        good.resize(place);
    }
  }
  return good;
}

}  // namespace vibrosow
