#pragma once

#include <cstdint>
#include <random>

namespace vibrosow {

/// Random numbers of a run. The same seed gives the same numbers with every standard library: the engine is specified
/// by the standard, its distributions are not, so the conversion to a real number is our own.
class Random {
 public:
  explicit Random(std::uint64_t seed = 1) : engine_(seed) {}

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in 0 .. count-1.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(uniform() * static_cast<double>(count)); }

  /// To be saved and restored.
  std::mt19937_64& engine() { return engine_; }
  const std::mt19937_64& engine() const { return engine_; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace vibrosow
