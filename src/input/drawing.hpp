#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// What a drawing gave a vessel, for people.
struct Drawing {
  std::string vessel;                   // "tray" or "hopper"
  std::string file;                     // its name, fit for a terminal
  std::size_t first = 0, count = 0;     // of the vessel's pieces
  std::vector<std::string> layers{};    // on which they lie, by name
  std::vector<std::string> left_out{};  // "2 TEXT"
};

/// "drawing tray.dxf: 6 pieces from (0, 0) to (210, 60) mm, layer 0; left out: 1 MTEXT".
std::string drawing_text(const Drawing& drawing, const Scene& scene);

/// Warnings of drawings that are far smaller than the vessel they belong to, as of a wrong unit, or lie wholly beside
/// it.
std::vector<std::string> drawing_warnings(const Scene& scene, const std::vector<Drawing>& drawings);

}  // namespace vibrosow
