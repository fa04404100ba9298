#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// What in a scene can hardly be meant although it can be run, each a sentence after the key that it is about
/// ("tray.holes.width: .."); empty for a sound scene. Predicted from the scene alone, and only where it is sure:
/// - a seed's density outside 100 to 5000 kg/m3;
/// - a mixture in which a fill misses what was asked for of a lot by more than 5 % of that, by number or by mass, or of
///   which rain brings fewer than 3 seeds on average;
/// - a tray of the plane whose slices mean a bed denser than the closest packing of balls (pi / sqrt(18) of the seeds'
/// own
///   density), or looser than any bed of seeds (0.3);
/// - holes narrower than a seed;
/// - a tray that stands still, without any friction;
/// - rain at a rate for which there is no room: in the time that a seed takes to fall its own diameter, sqrt(2 d / g),
///   no more seeds can come than lie side by side; or more rain than fits into a vessel without outlet;
/// - a hopper without outlet; one narrower than 3 seeds, where arches stop the flow (To, Lai, Pak 2001, doi
///   10.1103/PhysRevLett.86.71); or one through which less than half of what the tray's holes can pass falls, both by
///   the plane form of Beverloo, Leniger, van de Velde 1961 (doi 10.1016/0009-2509(61)85030-6), (width - 1.4 d)^(3/2).
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace vibrosow
