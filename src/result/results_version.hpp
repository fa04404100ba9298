#pragma once

namespace vibrosow {

/// To be raised whenever a scene and a random seed give another run than before: what was kept of runs of another
/// version is then left alone and made again.
inline constexpr int results_version = 11;

}  // namespace vibrosow
