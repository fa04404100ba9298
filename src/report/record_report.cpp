#include "report/record_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fields/asymmetry.hpp"
#include "fields/motion.hpp"
#include "fields/packing_fraction.hpp"
#include "fields/segregation.hpp"
#include "fields/tray_frame.hpp"
#include "outflow/flow.hpp"
#include "report/csv.hpp"

namespace vibrosow {
namespace {

/// In mm, of nine digits: overlaps of stiff grains are below a micrometre.
std::string place(double length) {
  return fmt::format("{:.9g}", 1e3 * length + 0.0);  // no "-0"
}

std::string millimetres(double length) {
  return csv_number(length * 1e3);
}
std::string grams(double mass) {
  return csv_number(mass * 1e3);
}
std::string lot_name(const Scene& scene, int lot) {
  return scene.lots.at(static_cast<std::size_t>(lot)).name;
}

/// In the tray's frame; a null snapshot stays none.
std::optional<Snapshot> in_tray_frame(const Scene& scene, const Snapshot* lab) {
  if (!lab) return std::nullopt;
  return in_tray_frame(*lab, scene.tray);
}

/// Of one lot, or of all where `lot` is negative.
std::vector<std::string> records_row(const Scene& scene, const Snapshot& own, std::size_t record, int lot) {
  const std::vector<std::size_t> inside = grains_in_tray(own, scene.tray);
  std::int64_t grains = 0;
  double mass = 0;
  for (const std::size_t i : inside)
    if (lot < 0 || own.lot[i] == lot) ++grains, mass += own.mass[i];
  const bool all = lot < 0;
  return {fmt::format("{}", record),
          csv_number(own.time),
          all ? "all" : lot_name(scene, lot),
          csv_number(grains),
          grams(mass),
          csv_number(all ? std::nullopt : segregation_index(own, scene.tray, lot)),
          csv_number(all ? flux_asymmetry(own, scene.tray) : std::nullopt),
          csv_number(all ? surface_asymmetry(own, scene.tray, scene.record->cell) : std::nullopt),
          csv_number(all ? bed_packing(own, scene.lots, scene.tray, scene.record->cell) : std::nullopt)};
}

}  // namespace

std::string grains_csv(const Scene& scene, const Snapshot& snapshot, const Snapshot* before) {
  const Snapshot own = in_tray_frame(snapshot, scene.tray);
  std::vector<std::optional<double>> shear(own.size());
  if (const auto earlier = in_tray_frame(scene, before)) shear = shear_strain(*earlier, own, fit_reach(*earlier));
  CsvTable table({"id", "lot", "x_mm", "y_mm", "vx_m_per_s", "vy_m_per_s", "omega_rad_per_s", "angle_rad", "radius_mm",
                  "start_x_mm", "start_y_mm", "shear"});
  for (std::size_t i = 0; i < own.size(); ++i)
    table.add_row({csv_number(own.id[i]), lot_name(scene, own.lot[i]), place(own.x[i]), place(own.y[i]),
                   csv_number(own.vx[i]), csv_number(own.vy[i]), csv_number(own.omega[i]),
                   own.angle.empty() ? "" : csv_number(own.angle[i]), millimetres(own.radius[i]),
                   millimetres(own.start_x[i]), millimetres(own.start_y[i]), csv_number(shear[i])});
  return table.text();
}

std::string fields_csv(const Scene& scene, const Snapshot& snapshot, const Snapshot* before) {
  const double cell = scene.record->cell;
  const Snapshot own = in_tray_frame(snapshot, scene.tray);
  const std::optional<Snapshot> earlier = in_tray_frame(scene, before);
  const Grid grid = earlier ? grid_over({&*earlier, &own}, cell) : grid_over({&own}, cell);
  const std::vector<double> packing = packing_fraction(own, scene.lots, grid);
  const std::vector<double> change = earlier ? packing_change(*earlier, own, scene.lots, grid) : std::vector<double>{};
  const auto motion = cell_motion(own, grid, std::max(fit_reach(own), cell));
  CsvTable table({"x_mm", "y_mm", "packing_fraction", "packing_change", "vx_m_per_s", "vy_m_per_s", "shear_rate_per_s",
                  "dilation_rate_per_s"});
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (packing[k] == 0 && (!earlier || change[k] == 0)) continue;
    std::optional<double> vx, vy, shear_rate, dilation_rate;
    if (packing[k] > 0 && motion[k]) {
      vx = motion[k]->velocity.x(), vy = motion[k]->velocity.y();
      if (motion[k]->gradient) shear_rate = shear(*motion[k]->gradient), dilation_rate = dilation(*motion[k]->gradient);
    }
    const Eigen::Vector2d centre = grid.centre(k);
    table.add_row({millimetres(centre.x()), millimetres(centre.y()), csv_number(packing[k]),
                   earlier ? csv_number(change[k]) : "", csv_number(vx), csv_number(vy), csv_number(shear_rate),
                   csv_number(dilation_rate)});
  }
  return table.text();
}

std::string records_csv(const Scene& scene, const std::vector<Snapshot>& snapshots) {
  CsvTable table({"record", "time_s", "lot", "grains", "mass_g", "segregation", "flux_asymmetry", "surface_asymmetry",
                  "packing_fraction"});
  const int lots = static_cast<int>(scene.lots.size());
  for (std::size_t k = 0; k < snapshots.size(); ++k) {
    const Snapshot own = in_tray_frame(snapshots[k], scene.tray);
    for (int lot = 0; lots > 1 && lot < lots; ++lot) table.add_row(records_row(scene, own, k + 1, lot));
    table.add_row(records_row(scene, own, k + 1, -1));
  }
  return table.text();
}

std::string profile_csv(const Scene& scene, const std::vector<Snapshot>& snapshots) {
  CsvTable table({"time_s", "height_mm", "lot", "grains", "mass_g", "mass_fraction"});
  for (const Snapshot& snapshot : snapshots)
    for (const LotInLayer& row : lot_profile(in_tray_frame(snapshot, scene.tray), scene.tray,
                                             static_cast<int>(scene.lots.size()), scene.record->cell))
      table.add_row({csv_number(snapshot.time), millimetres(row.height), lot_name(scene, row.lot),
                     csv_number(row.grains), grams(row.mass), csv_number(row.mass_fraction)});
  return table.text();
}

std::string flow_csv(const Scene& scene, const Run& run) {
  CsvTable table({"from_s", "to_s", "hole", "grains", "mass_g", "asymmetry", "pauses", "longest_pause_s", "paused_s",
                  "paused_fraction"});
  for (const FlowWindow& row : flow_over_time(scene, run))
    table.add_row({csv_number(row.from), csv_number(row.to), row.hole > 0 ? fmt::format("{}", row.hole) : "all",
                   csv_number(row.grains), grams(row.mass), csv_number(row.asymmetry), csv_number(row.pauses),
                   csv_number(row.longest_pause), csv_number(row.paused), csv_number(row.paused_fraction())});
  return table.text();
}

std::vector<OutputFile> record_files(const Scene& scene, const Run& run) {
  if (!scene.record) return {};
  std::vector<OutputFile> files;
  for (std::size_t k = 0; k < run.snapshots.size(); ++k) {
    const Snapshot* before = k > 0 ? &run.snapshots[k - 1] : nullptr;
    files.push_back({fmt::format("grains_{:03}.csv", k + 1), grains_csv(scene, run.snapshots[k], before)});
    files.push_back({fmt::format("fields_{:03}.csv", k + 1), fields_csv(scene, run.snapshots[k], before)});
  }
  files.push_back({"records.csv", records_csv(scene, run.snapshots)});
  files.push_back({"profile.csv", profile_csv(scene, run.snapshots)});
  files.push_back({"flow.csv", flow_csv(scene, run)});
  return files;
}

}  // namespace vibrosow
