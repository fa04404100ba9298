#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "picture/colours.hpp"

namespace vibrosow {

/// Pixels of a picture, row by row from the top: blue, green, red and one byte that counts for nothing.
using Pixels = std::vector<std::uint8_t>;

/// A GIF of pictures that come one after the other, its colours the nearest of a palette (at most 127).
class Film {
 public:
  /// In pixels.
  Film(int width, int height, const std::vector<Colour>& palette);
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  /// Shows the picture for some hundredths of a second.
  void add(const Pixels& picture, int hundredths);

  /// The file, with nothing to be added any more.
  std::string file();

 private:
  struct Encoder;

  Encoder* encoder_;
};

}  // namespace vibrosow
