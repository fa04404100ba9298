#pragma once

namespace vibrosow {

/// As many of `wanted` threads as the system lets this process have, at least 1; warns where they are fewer. The
/// library that starts them later would end the program.
int threads_to_be_had(int wanted);

}  // namespace vibrosow
