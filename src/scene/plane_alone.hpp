#pragma once

namespace vibrosow {

/// Whether this is of a program that simulates nothing in 3D and is to be small, as the pages' is.
#ifdef VIBROSOW_PLANE_ALONE
inline constexpr bool plane_alone = true;
#else
inline constexpr bool plane_alone = false;
#endif

}  // namespace vibrosow
