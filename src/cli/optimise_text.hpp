#pragma once

#include <string>

#include "optimise/optimise.hpp"

namespace vibrosow {

/// The layouts that lead, how sure that is and what it cost, for a screen. `folder`: where front.toml is.
std::string optimise_text(const OptimiseResult& result, const std::string& folder);

}  // namespace vibrosow
