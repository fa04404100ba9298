#include "cli/drawn_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "files/atomic_file.hpp"
#include "files/whole_file.hpp"
#include "grains/orientation.hpp"
#include "input/csv_lines.hpp"
#include "recording/read_recording.hpp"
#include "report/csv.hpp"
#include "report/page.hpp"
#include "scene/checked_json.hpp"
#include "scene/input_error.hpp"
#include "scene/motion.hpp"
#include "scene/printable.hpp"
#include "scene/scene_json.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

/// Throws InputError where there is no such file.
std::string text_of(const fs::path& path) {
  std::optional<std::string> text = text_of_file(path);
  if (!text) throw InputError(fmt::format("{}: is missing", path.string()));
  return std::move(*text);
}

/// A table that `run` wrote, by names of columns.
class ReportTable {
 public:
  explicit ReportTable(const fs::path& path) : csv_(parse_csv_lines(text_of(path), path.string())) {
    for (std::size_t k = 0; k < csv_.header.fields.size(); ++k) columns_[csv_.header.fields[k]] = k;
  }
  std::size_t rows() const { return csv_.rows.size(); }
  const std::string& text(std::size_t row, const std::string& column) const {
    const auto found = columns_.find(column);
    if (found == columns_.end()) throw InputError(fmt::format("{}: has no column {}", csv_.file, column));
    return csv_.rows[row].fields[found->second];
  }
  bool has(std::size_t row, const std::string& column) const {
    return columns_.contains(column) && !text(row, column).empty();
  }
  /// From `least` to `most`, which no run of ours is beyond.
  double number(std::size_t row, const std::string& column, double least = -1e9, double most = 1e9) const {
    const auto value = csv_number(text(row, column), csv_.decimal_comma);
    if (value && *value >= least && *value <= most) return *value;
    throw InputError(fmt::format("{}:{}: {}: \"{}\" is no number from {:g} to {:g}", csv_.file, csv_.rows[row].line,
                                 column, text(row, column), least, most));
  }

 private:
  CsvLines csv_;
  std::map<std::string, std::size_t> columns_;
};

int lot_named(const Scene& scene, const std::string& name, const fs::path& file) {
  const auto lot = std::ranges::find_if(scene.lots, [&](const SeedLot& one) { return defused(one.name) == name; });
  if (lot == scene.lots.end()) throw InputError(fmt::format("{}: run.json knows no lot \"{}\"", file.string(), name));
  return static_cast<int>(lot - scene.lots.begin());
}

/// Whether a recorded bed has the scene's lots and dimensions.
bool is_of_scene(const Snapshot& bed, const Scene& scene) {
  const auto is_lot = [&](int lot) {
    return static_cast<std::size_t>(lot) < scene.lots.size();
  };  // unsigned in the file
  const bool turned = scene.space == Space::two_dimensional || bed.q_w.empty() == bed.q_z.empty();
  return std::ranges::all_of(bed.lot, is_lot) && turned &&
         (bed.size() == 0 || bed.is_3d() == (scene.space != Space::two_dimensional));
}

/// A snapshot's file, whose places are in the tray's frame.
Snapshot snapshot_in(const fs::path& file, const Scene& scene, double time) {
  constexpr double mm = 1e-3;
  const ReportTable table(file);
  const Pose moved = vessel_pose(scene.tray, time), pose = steady_frame(scene.tray, moved);
  const PoseRate rate = vessel_velocity(scene.tray, time);
  const double angle = scene.tray.tilt + pose.angle;
  const Orientation turned{std::cos(0.5 * angle), 0, 0, std::sin(0.5 * angle)};
  Snapshot bed;
  bed.time = time;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Eigen::Vector2d own(mm * table.number(row, "x_mm"), mm * table.number(row, "y_mm"));
    const Eigen::Vector2d at = in_lab_frame(scene.tray, pose, own);
    const Eigen::Vector2d own_velocity(table.number(row, "vx_m_per_s"), table.number(row, "vy_m_per_s"));
    const Eigen::Vector2d velocity =
        in_lab_frame(scene.tray, pose, own + own_velocity) - at +
        (turns_steadily(scene.tray) ? Eigen::Vector2d(0, 0) : material_velocity(scene.tray, pose, rate, at));
    bed.x.push_back(at.x()), bed.y.push_back(at.y());
    bed.vx.push_back(velocity.x()), bed.vy.push_back(velocity.y());
    bed.id.push_back(static_cast<std::int64_t>(table.number(row, "id", 0, 1e15)));
    bed.lot.push_back(lot_named(scene, table.text(row, "lot"), file));
    bed.radius.push_back(mm * table.number(row, "radius_mm", 1e-6, 1e6));
    if (table.has(row, "angle_rad")) bed.angle.push_back(table.number(row, "angle_rad") + angle);
    if (scene.space == Space::two_dimensional) continue;
    bed.z.push_back(mm * table.number(row, "z_mm") + scene.tray.front + pose.across);
    bed.vz.push_back(table.number(row, "vz_m_per_s") + rate.across_velocity);
    if (!table.has(row, "q_w")) continue;
    const Orientation q = turned * Orientation{table.number(row, "q_w"), table.number(row, "q_x"),
                                               table.number(row, "q_y"), table.number(row, "q_z")};
    bed.q_w.push_back(q.w), bed.q_x.push_back(q.x), bed.q_y.push_back(q.y), bed.q_z.push_back(q.z);
  }
  return bed;
}

/// None where the run ended before the first.
std::vector<Frame> snapshots_in(const fs::path& folder, const Scene& scene) {
  const fs::path list = folder / "records.csv";
  const bool has_rows = fs::exists(list) && std::ranges::count(text_of(list), '\n') > 1;
  if (!has_rows) return {};
  const ReportTable records(list);
  std::vector<Frame> frames;
  for (std::size_t row = 0; row < records.rows(); ++row) {
    if (records.text(row, "lot") != "all") continue;
    const fs::path file =
        folder / fmt::format("grains_{:03}.csv", static_cast<int>(records.number(row, "record", 1, 1e8)));
    frames.push_back({snapshot_in(file, scene, records.number(row, "time_s", 0))});
  }
  return frames;
}

}  // namespace

bool is_run_folder(const fs::path& path) {
  return fs::is_directory(path);
}

Scene scene_of_run(const fs::path& folder) {
  const fs::path file = folder / "run.json";
  const std::string text = text_of(file);
  try {
    const auto json = parse_json<nlohmann::json>(text);
    Scene scene = scene_from_json(json.at("scene").dump());
    scene.title = printable(json.at("title").get<std::string>());
    return scene;
  } catch (const nlohmann::json::exception&) {
    throw InputError(fmt::format("{}: was not written by vibrosow", file.string()));
  }
}

KeptFrames kept_frames(const fs::path& folder, const Scene& scene) {
  const fs::path page = folder / "report.html";
  std::vector<Frame> frames;
  if (fs::exists(page)) {
    const std::string recording = recording_in(text_of(page));
    const auto keep = [&](const Snapshot& bed) {
      if (!is_of_scene(bed, scene))
        throw InputError(fmt::format("{}: its recording is of another scene", page.string()));
      frames.push_back({bed});
    };
    if (!recording.empty()) read_recording(recording, keep);
    if (!frames.empty()) return {std::move(frames), false};
  }
  frames = snapshots_in(folder, scene);
  if (!frames.empty()) return {std::move(frames), true};
  throw InputError(fmt::format(
      "{}: keeps no frame of its run, which was made without --html and has no [record], or ended before its first; "
      "draw its seeder instead",
      folder.string()));
}

std::vector<Frame> nearest_frames(std::vector<Frame> frames, const std::vector<double>& times) {
  std::vector<std::size_t> nearest;
  for (const double time : times) {
    const auto far = [&](const Frame& frame) { return std::abs(frame.bed.time - time); };
    const auto found = std::ranges::min_element(frames, {}, far);
    nearest.push_back(static_cast<std::size_t>(found - frames.begin()));
  }
  std::ranges::sort(nearest);
  nearest.erase(std::unique(nearest.begin(), nearest.end()), nearest.end());
  std::vector<Frame> result;
  for (const std::size_t k : nearest) result.push_back(std::move(frames[k]));
  return result;
}

}  // namespace vibrosow
