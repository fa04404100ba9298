#pragma once

#include <cstddef>

/// How much a scene lists at most, read from whatever file.
namespace vibrosow::list_limits {

inline constexpr std::size_t lots = 100;         // each has a surface with each
inline constexpr std::size_t clump_balls = 100;  // each is a grain to the search for contacts
inline constexpr std::size_t sizes = 1000;       // of a table
inline constexpr std::size_t components = 100;   // of a motion
inline constexpr std::size_t pieces = 20'000;    // of a vessel; a drawing has fewer
inline constexpr std::size_t snapshots = 100'000;

}  // namespace vibrosow::list_limits
