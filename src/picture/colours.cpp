#include "picture/colours.hpp"

#include <algorithm>
#include <array>

namespace vibrosow {

Colour lot_colour(std::size_t lot) {
  constexpr std::array<Colour, 7> colours{{{0.902, 0.624, 0.0},
                                           {0.0, 0.447, 0.698},
                                           {0.0, 0.620, 0.451},
                                           {0.800, 0.475, 0.655},
                                           {0.337, 0.706, 0.914},
                                           {0.835, 0.369, 0.0},
                                           {0.941, 0.894, 0.259}}};
  return colours[lot % colours.size()];
}

Colour ramp_colour(double share) {
  constexpr std::array<Colour, 5> colours{{{0.267, 0.005, 0.329},
                                           {0.229, 0.322, 0.546},
                                           {0.128, 0.567, 0.551},
                                           {0.369, 0.789, 0.383},
                                           {0.993, 0.906, 0.144}}};
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(place), colours.size() - 2);
  return mixed(colours[k + 1], colours[k], place - static_cast<double>(k));
}

}  // namespace vibrosow
