#pragma once

#include <optional>
#include <string>

namespace vibrosow {

std::string base64(const std::string& bytes);

/// None for what is not base64.
std::optional<std::string> from_base64(std::string text);

}  // namespace vibrosow
