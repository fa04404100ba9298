#include "report/record_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fields/asymmetry.hpp"
#include "fields/map_part.hpp"
#include "fields/motion.hpp"
#include "fields/packing_fraction.hpp"
#include "fields/segregation.hpp"
#include "fields/tray_frame.hpp"
#include "outflow/flow.hpp"
#include "report/columns.hpp"

namespace vibrosow {
namespace {

using Value = std::optional<double>;

/// A coordinate in mm, of nine digits: overlaps of stiff grains are below a micrometre.
template <class Row, class Get>
Column<Row> place_column(std::string name, std::string description, Get get) {
  return {{std::move(name), "mm", std::move(description)}, [get](const Row& row) {
            return CsvField(fmt::format("{:.9g}", 1e3 * get(row) + 0.0), true);  // no "-0"
          }};
}

std::string lot_name(const Scene& scene, int lot) {
  return scene.lots.at(static_cast<std::size_t>(lot)).name;
}

/// In the tray's frame; a null snapshot stays none.
std::optional<Snapshot> in_tray_frame(const Scene& scene, const Snapshot* lab) {
  if (!lab) return std::nullopt;
  return in_tray_frame(*lab, scene.tray);
}

struct GrainRow {
  const Scene* scene;
  const Snapshot* own;
  std::size_t i;
  Value shear;
};

/// In 3D there are more columns, after those of the plane.
Columns<GrainRow> grains_columns(Space space) {
  using R = const GrainRow&;
  const auto quantity = [](std::string name, Unit unit, std::string description,
                           std::vector<double> Snapshot::*values) {
    return quantity_column<GrainRow>(std::move(name), unit, std::move(description),
                                     [values](R r) { return (r.own->*values)[r.i]; });
  };
  const auto place = [](std::string name, std::string description, std::vector<double> Snapshot::*values) {
    return place_column<GrainRow>(std::move(name), std::move(description),
                                  [values](R r) { return (r.own->*values)[r.i]; });
  };
  const auto quaternion = [](std::string name, std::vector<double> Snapshot::*values) {
    return quantity_column<GrainRow>(
        std::move(name), plain,
        "in 3D: of the rotation from a clump's own axes to the tray's; empty in a scene without clumps",
        [values](R r) { return (r.own->*values).empty() ? Value() : Value((r.own->*values)[r.i]); });
  };
  Columns<GrainRow> columns = {
      text_column<GrainRow>("id", "number of the grain, in order of insertion, the same in every snapshot",
                            [](R r) { return r.own->id[r.i]; }),
      text_column<GrainRow>("lot", "name of its seeds", [](R r) { return lot_name(*r.scene, r.own->lot[r.i]); }),
      place("x_mm", "place from the tray's left end", &Snapshot::x),
      place("y_mm", "height over the tray's floor", &Snapshot::y),
      quantity("vx_m_per_s", metres_per_second, "velocity along the floor, against the tray", &Snapshot::vx),
      quantity("vy_m_per_s", metres_per_second, "velocity upwards", &Snapshot::vy),
      quantity("omega_rad_per_s", radians_per_second, "angular velocity, anticlockwise", &Snapshot::omega),
      quantity_column<GrainRow>("angle_rad", radians,
                                "in 2D: how far a clump is turned; empty in a scene without clumps",
                                [](R r) { return r.own->angle.empty() ? Value() : Value(r.own->angle[r.i]); }),
      quantity("radius_mm", millimetres, "radius of the grain, of a clump of the circle or ball that just holds it",
               &Snapshot::radius),
      quantity("start_x_mm", millimetres, "where it was put in", &Snapshot::start_x),
      quantity("start_y_mm", millimetres, "where it was put in", &Snapshot::start_y),
      quantity_column<GrainRow>("shear", plain,
                                "shear strain about it since the snapshot before; empty where it is undefined",
                                [](R r) { return r.shear; })};
  if (space == Space::two_dimensional) return columns;
  append(columns, {place("z_mm", "in 3D: place from the tray's front", &Snapshot::z),
                   quantity("vz_m_per_s", metres_per_second, "in 3D: velocity across, to the back", &Snapshot::vz),
                   quantity("omega_x_rad_per_s", radians_per_second, "in 3D: angular velocity about the floor's length",
                            &Snapshot::omega_x),
                   quantity("omega_y_rad_per_s", radians_per_second, "in 3D: angular velocity about the upright axis",
                            &Snapshot::omega_y),
                   quantity("start_z_mm", millimetres, "in 3D: where it was put in", &Snapshot::start_z),
                   quaternion("q_w", &Snapshot::q_w), quaternion("q_x", &Snapshot::q_x),
                   quaternion("q_y", &Snapshot::q_y), quaternion("q_z", &Snapshot::q_z)});
  return columns;
}

struct CellRow {
  Eigen::Vector2d centre;
  double packing;
  Value change, vx, vy, vz, shear_rate, dilation_rate;
};

/// In 3D there is one column more, after those of the plane.
Columns<CellRow> fields_columns(Space space) {
  const auto quantity = [](std::string name, Unit unit, std::string description, Value CellRow::*value) {
    return quantity_column<CellRow>(std::move(name), unit, std::move(description),
                                    [value](const CellRow& r) { return r.*value; });
  };
  Columns<CellRow> columns = {
      quantity_column<CellRow>("x_mm", millimetres, "middle of the cell, from the tray's left end",
                               [](const CellRow& r) { return r.centre.x(); }),
      quantity_column<CellRow>("y_mm", millimetres, "middle of the cell, over the tray's floor",
                               [](const CellRow& r) { return r.centre.y(); }),
      quantity_column<CellRow>("packing_fraction", plain, "share of the cell that grains cover, in 3D fill",
                               [](const CellRow& r) { return r.packing; }),
      quantity("packing_change", plain, "its change since the snapshot before", &CellRow::change),
      quantity("vx_m_per_s", metres_per_second, "mean velocity along the floor", &CellRow::vx),
      quantity("vy_m_per_s", metres_per_second, "mean velocity upwards", &CellRow::vy),
      quantity("shear_rate_per_s", per_second, "difference of the principal stretch rates", &CellRow::shear_rate),
      quantity("dilation_rate_per_s", per_second, "trace of the velocity gradient, above 0 where the bed loosens",
               &CellRow::dilation_rate)};
  if (space != Space::two_dimensional)
    columns.push_back(
        quantity("vz_m_per_s", metres_per_second, "in 3D: mean velocity across, to the back", &CellRow::vz));
  return columns;
}

CellRow cell_row(const Grid& grid, std::size_t k, double packing, Value change,
                 const std::optional<CellMotion>& motion) {
  CellRow row{grid.centre(k), packing, change, {}, {}, {}, {}, {}};
  if (packing == 0 || !motion) return row;
  row.vx = motion->velocity.x(), row.vy = motion->velocity.y(), row.vz = motion->velocity.z();
  if (motion->gradient) row.shear_rate = shear(*motion->gradient), row.dilation_rate = dilation(*motion->gradient);
  return row;
}

/// The smallest grid that covers every grain; along a periodic tray of one period.
Grid map_grid(const std::vector<const Snapshot*>& snapshots, double cell, const Periods& periods) {
  Grid grid = grid_over(snapshots, cell);
  if (periods.along > 0 && grid.size() > 0) grid.first_column = 0, grid.columns = cells_over(periods.along, cell);
  return grid;
}

/// Of one lot, or of all where `lot` is negative.
struct RecordRow {
  const Scene* scene;
  const Snapshot* own;
  std::size_t record;
  int lot;
  bool all() const { return lot < 0; }
};

std::vector<std::size_t> grains_of(const RecordRow& row) {
  std::vector<std::size_t> grains = grains_in_tray(*row.own, row.scene->tray);
  std::erase_if(grains, [&](std::size_t i) { return !row.all() && row.own->lot[i] != row.lot; });
  return grains;
}

double mass_of(const RecordRow& row) {
  double mass = 0;
  for (const std::size_t i : grains_of(row)) mass += row.own->mass[i];
  return mass;
}

Columns<RecordRow> records_columns() {
  using R = const RecordRow&;
  return {text_column<RecordRow>("record", "number of the snapshot", [](R r) { return r.record; }),
          quantity_column<RecordRow>("time_s", seconds, "when it was taken", [](R r) { return r.own->time; }),
          text_column<RecordRow>("lot", "name of the seeds, or all",
                                 [](R r) { return r.all() ? "all" : lot_name(*r.scene, r.lot); }),
          text_column<RecordRow>("grains", "in the tray", [](R r) { return grains_of(r).size(); }),
          quantity_column<RecordRow>("mass_g", grams, "in the tray", mass_of),
          quantity_column<RecordRow>(
              "segregation", plain, "segregation index, above 0 where the lot lies high",
              [](R r) { return r.all() ? Value() : segregation_index(*r.own, r.scene->tray, r.lot); }),
          quantity_column<RecordRow>("flux_asymmetry", plain, "left less right of the downward momentum, of their sum",
                                     [](R r) { return r.all() ? flux_asymmetry(*r.own, r.scene->tray) : Value(); }),
          quantity_column<RecordRow>(
              "surface_asymmetry", plain, "left less right of the free surface's height, of their sum",
              [](R r) { return r.all() ? surface_asymmetry(*r.own, r.scene->tray, r.scene->record->cell) : Value(); }),
          quantity_column<RecordRow>("packing_fraction", plain, "of the inside of the bed", [](R r) {
            return r.all() ? bed_packing(*r.own, r.scene->lots, r.scene->tray, r.scene->record->cell) : Value();
          })};
}

struct ProfileRow {
  const Scene* scene;
  double time;
  LotInLayer layer;
};

Columns<ProfileRow> profile_columns() {
  using R = const ProfileRow&;
  return {quantity_column<ProfileRow>("time_s", seconds, "when the snapshot was taken", [](R r) { return r.time; }),
          quantity_column<ProfileRow>("height_mm", millimetres, "middle of the layer, over the tray's floor",
                                      [](R r) { return r.layer.height; }),
          text_column<ProfileRow>("lot", "name of the seeds", [](R r) { return lot_name(*r.scene, r.layer.lot); }),
          text_column<ProfileRow>("grains", "of the lot in the layer", [](R r) { return r.layer.grains; }),
          quantity_column<ProfileRow>("mass_g", grams, "of the lot in the layer", [](R r) { return r.layer.mass; }),
          quantity_column<ProfileRow>("mass_fraction", plain, "share of the lot in the layer's mass",
                                      [](R r) { return r.layer.mass_fraction; })};
}

Columns<FlowWindow> flow_columns() {
  using R = const FlowWindow&;
  return {quantity_column<FlowWindow>("from_s", seconds, "begin of the part of the run", [](R r) { return r.from; }),
          quantity_column<FlowWindow>("to_s", seconds, "its end", [](R r) { return r.to; }),
          text_column<FlowWindow>("hole", "number of the hole from the left, or all",
                                  [](R r) { return r.hole > 0 ? fmt::format("{}", r.hole) : "all"; }),
          text_column<FlowWindow>("grains", "that left", [](R r) { return r.grains; }),
          quantity_column<FlowWindow>("mass_g", grams, "that left", [](R r) { return r.mass; }),
          quantity_column<FlowWindow>("asymmetry", plain, "left less right of its hole's middle, of the mass that left",
                                      [](R r) { return r.asymmetry; }),
          text_column<FlowWindow>("pauses", "that begin in this part", [](R r) { return r.pauses; }),
          quantity_column<FlowWindow>("longest_pause_s", seconds, "the longest of these",
                                      [](R r) { return r.longest_pause; }),
          quantity_column<FlowWindow>("paused_s", seconds, "time in pauses in this part", [](R r) { return r.paused; }),
          quantity_column<FlowWindow>("paused_fraction", plain, "share of this part that is paused",
                                      [](R r) { return r.paused_fraction(); })};
}

}  // namespace

std::string grains_csv(const Scene& scene, const Snapshot& snapshot, const Snapshot* before, CsvFormat format) {
  const Snapshot own = in_tray_frame(snapshot, scene.tray);
  std::vector<Value> shear(own.size());
  if (const auto earlier = in_tray_frame(scene, before))
    shear = shear_strain(*earlier, own, fit_reach(*earlier), periods_of(scene.tray, own.is_3d()));
  Csv<GrainRow> csv(grains_columns(scene.space), format);
  for (std::size_t i = 0; i < own.size(); ++i) csv.add({&scene, &own, i, shear[i]});
  return csv.text();
}

std::string fields_csv(const Scene& scene, const Snapshot& snapshot, const Snapshot* before, CsvFormat format) {
  const double cell = scene.record->cell;
  const Periods periods = periods_of(scene.tray, scene.space != Space::two_dimensional);
  Snapshot own = in_tray_frame(snapshot, scene.tray);
  std::optional<Snapshot> earlier = in_tray_frame(scene, before);
  const double reach = std::max(fit_reach(own), cell);
  const Grid grid = map_grid(
      earlier ? std::vector<const Snapshot*>{&*earlier, &own} : std::vector<const Snapshot*>{&own}, cell, periods);
  own = with_images(own, periods, reach + cell);
  if (earlier) earlier = with_images(*earlier, periods, reach + cell);
  const MapPart part = map_part(scene);
  const std::vector<double> packing = packing_fraction(own, scene.lots, grid, part);
  const std::vector<double> change =
      earlier ? packing_change(*earlier, own, scene.lots, grid, part) : std::vector<double>{};
  const auto motion = cell_motion(own, grid, reach, part);
  Csv<CellRow> csv(fields_columns(scene.space), format);
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (packing[k] == 0 && (!earlier || change[k] == 0)) continue;
    csv.add(cell_row(grid, k, packing[k], earlier ? Value(change[k]) : Value(), motion[k]));
  }
  return csv.text();
}

std::string records_csv(const Scene& scene, const std::vector<Snapshot>& snapshots, CsvFormat format) {
  Csv<RecordRow> csv(records_columns(), format);
  const int lots = static_cast<int>(scene.lots.size());
  for (std::size_t k = 0; k < snapshots.size(); ++k) {
    const Snapshot own = in_tray_frame(snapshots[k], scene.tray);
    for (int lot = 0; lots > 1 && lot < lots; ++lot) csv.add({&scene, &own, k + 1, lot});
    csv.add({&scene, &own, k + 1, -1});
  }
  return csv.text();
}

std::string profile_csv(const Scene& scene, const std::vector<Snapshot>& snapshots, CsvFormat format) {
  Csv<ProfileRow> csv(profile_columns(), format);
  for (const Snapshot& snapshot : snapshots)
    for (const LotInLayer& layer : lot_profile(in_tray_frame(snapshot, scene.tray), scene.tray,
                                               static_cast<int>(scene.lots.size()), scene.record->cell))
      csv.add({&scene, snapshot.time, layer});
  return csv.text();
}

std::string flow_csv(const Scene& scene, const Run& run, CsvFormat format) {
  return csv_of(flow_columns(), flow_over_time(scene, run), format);
}

std::vector<OutputFile> record_files(const Scene& scene, const Run& run, CsvFormat format) {
  if (!scene.record) return {};
  std::vector<OutputFile> files;
  for (std::size_t k = 0; k < run.snapshots.size(); ++k) {
    const Snapshot* before = k > 0 ? &run.snapshots[k - 1] : nullptr;
    files.push_back({fmt::format("grains_{:03}.csv", k + 1), grains_csv(scene, run.snapshots[k], before, format)});
    files.push_back({fmt::format("fields_{:03}.csv", k + 1), fields_csv(scene, run.snapshots[k], before, format)});
  }
  files.push_back({"records.csv", records_csv(scene, run.snapshots, format)});
  files.push_back({"profile.csv", profile_csv(scene, run.snapshots, format)});
  files.push_back({"flow.csv", flow_csv(scene, run, format)});
  return files;
}

std::vector<FileText> record_file_texts() {
  return {
      file_text("grains_NNN.csv",
                "of each snapshot: one row per grain, in the tray's frame, of a tray that turns steadily that at rest",
                grains_columns(Space::three_dimensional)),
      file_text("fields_NNN.csv",
                "of each snapshot: one row per cell that holds a part of a grain, in it or in the snapshot before, "
                "in the tray's frame; in 3D of the view that record.view names",
                fields_columns(Space::three_dimensional)),
      file_text("records.csv", "one row per snapshot and lot, and per snapshot one of all lots", records_columns()),
      file_text("profile.csv", "one row per snapshot, layer and lot", profile_columns()),
      file_text("flow.csv",
                "one row per hole and tenth of the run, or of the time until the tray was empty, and per hole one "
                "of all of it",
                flow_columns())};
}

}  // namespace vibrosow
