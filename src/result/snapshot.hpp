#pragma once

#include <cstdint>
#include <vector>

namespace vibrosow {

/// The bed at one moment, in the lab frame; one entry a grain in each array, in order of insertion. Of a clump: its
/// centre of mass, and the circle about it that just holds it, in 3D the ball.
struct Snapshot {
  double time = 0;                       // s, of the step, not of the record asked for
  double tray_x = 0, tray_y = 0;         // m, displacement of the tray's frame from rest
  double tray_angle = 0;                 // rad, that it has turned from rest
  double tray_vx = 0, tray_vy = 0;       // m/s, of the frame's origin
  double tray_spin = 0;                  // rad/s, anticlockwise
  std::vector<double> x, y;              // m
  std::vector<double> vx, vy;            // m/s
  std::vector<double> omega;             // rad/s, anticlockwise; 0 without rotation
  std::vector<double> angle{};           // rad, how far a clump is turned from its lot's shape; empty without clumps
  std::vector<int> lot;                  // index in Scene::lots
  std::vector<std::int64_t> id;          // ascending, the same grain's in every snapshot of a run
  std::vector<double> radius, mass;      // m, kg
  std::vector<double> area;              // m2, of the grain itself, a clump's overlaps counted once; empty in 3D
  std::vector<double> start_x, start_y;  // m, where the grain was put in
  // In 3D, empty in 2D:
  double tray_z = 0, tray_vz = 0;                  // m, m/s, across
  std::vector<double> z{}, vz{};                   // m, m/s, across
  std::vector<double> omega_x{}, omega_y{};        // rad/s; 0 without rotation
  std::vector<double> q_w{}, q_x{}, q_y{}, q_z{};  // how a clump lies, as Grains has it; empty without clumps
  std::vector<double> start_z{};                   // m
  std::vector<double> volume{};                    // m3, of the grain itself
  std::vector<char>
      in_tray{};  // whether it is within the tray as that stands, and in no hopper there; empty: not known

  std::size_t size() const { return x.size(); }
  bool is_3d() const { return !z.empty(); }
  /// What a grain fills: area in 2D, volume in 3D.
  const std::vector<double>& extent() const { return is_3d() ? volume : area; }
};

}  // namespace vibrosow
