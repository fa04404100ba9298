#pragma once

#include <vector>

namespace vibrosow {

/// Where an axis is marked, from its first tick to its last.
struct Ticks {
  double low, high;
  std::vector<double> at;
};

/// At steps of 1, 2 or 5 times a power of ten, at most `most` + 2 ticks that hold `low` to `high`, which are put the
/// right way round; of a single value one step about it.
Ticks linear_ticks(double low, double high, int most = 6);

/// At powers of ten that hold two values above 0, and at 2 and 5 times them where that is within two decades.
Ticks logarithmic_ticks(double low, double high);

}  // namespace vibrosow
