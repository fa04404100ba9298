#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// As files, options and reports call them, in the order of the enumeration.
inline const std::vector<std::string>& integrator_names() {
  static const std::vector<std::string> names{"velocity-verlet", "rk2-midpoint", "gear5"};
  return names;
}

inline const std::string& integrator_name(Integrator integrator) {
  return integrator_names()[static_cast<std::size_t>(integrator)];
}

}  // namespace vibrosow
