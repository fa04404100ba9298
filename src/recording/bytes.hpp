#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace vibrosow {

/// Puts a number at the end of the bytes, the lowest first.
template <class Value>
void append(std::string& bytes, Value value) {
  static_assert(std::endian::native == std::endian::little);
  const auto as_bytes = std::bit_cast<std::array<char, sizeof(Value)>>(value);
  bytes.append(as_bytes.data(), as_bytes.size());
}

/// The lowest bytes of all values, then the next: the higher ones are nearly all 0, which packs to next to nothing.
void append_planes(std::string& bytes, const std::vector<std::uint32_t>& values);

/// A zlib stream of the bytes.
std::string packed(const std::string& bytes);

}  // namespace vibrosow
