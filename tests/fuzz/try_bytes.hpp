#pragma once

#include <string>

namespace vibrosow {

/// One fuzzed input: read, or refused by an InputError. Any other exception, a crash or what a sanitiser says is a
/// defect. Each target defines it.
void try_bytes(const std::string& bytes);

}  // namespace vibrosow
