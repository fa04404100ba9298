#pragma once

#include <vector>

#include "report/columns.hpp"
#include "report/output_folder.hpp"
#include "result/frame.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// A run's snapshots for ParaView and the like, in the lab frame and SI: series grains.pvd, contacts.pvd and
/// vessels.pvd, which list a .vtp file a snapshot each (VTK's XML format, arrays as base64 of zlib).
///  - grains_NNN.vtp: points, with id, lot (its number from 0), radius, velocity, angular_velocity, orientation (the
///    quaternion w, x, y, z of a clump), force (of all contacts) and place_in_tray (as in grains_NNN.csv);
///  - contacts_NNN.vtp: a line a contact from centre to centre or to the wall, with grain and partner (ids, of a wall
///    -1), normal_force and tangential_force on the grain, and overlap;
///  - vessels_NNN.vtp: walls as lines, with vessel (its number from 0).
std::vector<OutputFile> vtk_files(const Scene& scene, const std::vector<Frame>& frames);

/// What these files hold.
std::vector<FileText> vtk_file_texts();

/// By grain of the frame's bed, N: the sum of its contacts' forces.
std::vector<std::array<double, 3>> contact_forces(const Frame& frame);

}  // namespace vibrosow
