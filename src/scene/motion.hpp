#pragma once

#include <string>

#include "scene/scene.hpp"

namespace vibrosow {

/// Whether the motion moves the vessel at all: an amplitude or a frequency of zero does not.
bool moves(const VesselMotion& motion);

/// Whether the motion may turn the vessel.
bool turns(const VesselMotion& motion);

/// Whether the motion may move the vessel across the plane.
bool moves_across(const VesselMotion& motion);

/// Whether the vessel turns over and over: its own frame then does not say what is left and right, or even up.
bool turns_steadily(const Vessel& vessel);

/// Whether it does so about the axis across, so that its floor does not stay below.
bool turns_over(const Vessel& vessel);

/// "10 mm at 9 Hz", for people.
std::string motion_text(const VesselMotion& motion);

}  // namespace vibrosow
