#pragma once

#include <stdexcept>
#include <string>

namespace vibrosow {

/// The input is wrong. The message stands alone: "FILE:LINE: KEY: what is wrong, what is allowed". The program ends
/// with exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vibrosow
