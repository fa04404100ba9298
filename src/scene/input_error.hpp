#pragma once

#include <stdexcept>
#include <string>

#include "scene/printable.hpp"

namespace vibrosow {

/// The input is wrong. The message stands alone: "FILE:LINE: KEY: what is wrong, what is allowed", and is made
/// printable whatever it quotes. The program ends with exit code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(printable(message)) {}
};

/// A value that cannot be read at all, such as a length without a unit, whatever else is asked for.
class UnreadableValue : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace vibrosow
