#include "report/xyz_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "report/vtk_report.hpp"
#include "vessel/vessel_faces.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/wall_points.hpp"

namespace vibrosow {
namespace {

struct Box {
  Eigen::Vector3d least = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d most = -least;

  void take(const Eigen::Vector3d& at) { least = least.cwiseMin(at), most = most.cwiseMax(at); }
};

void take_vessel(const Vessel& vessel, Space space, Box& box) {
  if (space == Space::two_dimensional)
    for (const WallSegment& wall : vessel_walls(vessel))
      for (const Eigen::Vector2d& own : wall_points(wall)) {
        const Eigen::Vector2d lab = in_lab_frame(vessel, {}, own);
        box.take({lab.x(), lab.y(), 0});
      }
  else
    for (const Face& face : vessel_faces(vessel))
      for (const auto& line : face_lines(face))
        for (const Eigen::Vector3d& own : line) box.take(point_in_lab(vessel, {}, own));
}

/// The slice of a plane is as thick as the largest seed.
Box box_of(const Scene& scene) {
  Box box;
  take_vessel(drawn_once(scene.tray), scene.space, box);
  if (scene.hopper) take_vessel(drawn_once(*scene.hopper), scene.space, box);
  if (scene.space == Space::two_dimensional) {
    const double half = 0.5 * std::ranges::max_element(scene.lots, {}, &SeedLot::diameter)->diameter;
    box.least.z() = -half, box.most.z() = half;
  }
  const Vessel& tray = scene.tray;
  if (tray.sides == Sides::periodic) box.least.x() = tray.origin.x(), box.most.x() = tray.origin.x() + tray.length;
  if (tray.front_and_back == Sides::periodic) box.least.z() = tray.front, box.most.z() = tray.front + *tray.depth;
  return box;
}

}  // namespace

std::string grains_xyz(const Scene& scene, const std::vector<Frame>& frames) {
  const Box box = box_of(scene);
  const Eigen::Vector3d size = box.most - box.least;
  const auto periodic = [](Sides sides) { return sides == Sides::periodic ? "T" : "F"; };
  std::string text;
  for (const Frame& frame : frames) {
    const Snapshot& bed = frame.bed;
    const auto forces = contact_forces(frame);
    text += fmt::format(
        "{}\nLattice=\"{} 0 0 0 {} 0 0 0 {}\" Origin=\"{} {} {}\" pbc=\"{} F {}\" "
        "Properties=species:S:1:pos:R:3:radius:R:1:velo:R:3:force:R:3:id:I:1 Time={}\n",
        bed.size(), size.x(), size.y(), size.z(), box.least.x(), box.least.y(), box.least.z(),
        periodic(scene.tray.sides), periodic(scene.tray.front_and_back), bed.time);
    for (std::size_t i = 0; i < bed.size(); ++i)
      text +=
          fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}\n", scene.lots.at(static_cast<std::size_t>(bed.lot[i])).name,
                      bed.x[i], bed.y[i], bed.is_3d() ? bed.z[i] : 0, bed.radius[i], bed.vx[i], bed.vy[i],
                      bed.is_3d() ? bed.vz[i] : 0, forces[i][0], forces[i][1], forces[i][2], bed.id[i]);
  }
  return text;
}

FileText xyz_file_text() {
  return {"grains.xyz",
          "with --xyz: extended XYZ for OVITO, one frame a snapshot, in the lab frame",
          {{"species", "", "name of its seeds"},
           {"pos", "m", "place"},
           {"radius", "m", "as in grains_NNN.csv"},
           {"velo", "m/s", "velocity"},
           {"force", "N", "of all its contacts"},
           {"id", "", "as in grains_NNN.csv"}}};
}

}  // namespace vibrosow
