#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "outflow/doubts.hpp"
#include "outflow/statistics.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// A length (m) in mm.
inline double in_mm(double metres) {
  return 1e3 * metres;
}

/// Of each remark whether it is serious, its text and, where there is something, what to do.
nlohmann::ordered_json page_remarks(const std::vector<Remark>& remarks);

/// A scene's lots, and its vessels as they are seen from the side, in 3D with the holes of their floors; mm.
nlohmann::ordered_json page_lots(const Scene& scene);
nlohmann::ordered_json page_vessels(const Scene& scene);

/// In 3D the faces of each vessel by its name (vessel/face.hpp), mm, in the vessel's own frame: of a plate its size
/// along e1 and e2 and its round holes (place and radius), of a surface of revolution about e1 x e2 its two rims
/// (radius and height) and half its angle. Copies that a periodic direction has beside the vessel are left out. Empty
/// in 2D.
nlohmann::ordered_json page_faces(const Scene& scene);

/// In 3D where each vessel that moves is until `end_time` (s), by its name: {step_s, at}, every step_s the place of
/// its frame's zero (x, y, z in mm, lab) and its angle (rad). A recording has two or three frames a shake: too few to
/// move between them. Empty in 2D.
nlohmann::ordered_json page_paths(const Scene& scene, double end_time);

/// {mean, half width of its 95 % interval}, in `unit`; null where there is none.
nlohmann::ordered_json page_interval(const std::optional<MeanWithInterval>& value, double unit);

/// JSON in one line that holds no "<", so that nothing in it can end the script that it stands in.
std::string page_text(const nlohmann::ordered_json& data);

/// A page: `page_template` (shipped_page) with the data (page_text) and, unless it is empty, the file of a Recording in
/// their places. Throws std::invalid_argument for a template without them.
std::string filled_page(const std::string& page_template, const std::string& data, const std::string& recording = {});

/// The studio's, of its own template.
std::string filled_studio(const std::string& page_template, const std::string& data);

/// The file of the Recording that a page was filled with; empty without one.
std::string recording_in(const std::string& page);

/// What a page shows, kept beside the reports that could not be made again without simulating.
inline constexpr const char* page_data_name = "report.json";

/// report.json and, unless `page_template` is empty, report.html.
std::vector<OutputFile> page_files(const std::string& page_template, const std::string& data,
                                   const std::string& recording = {});

/// What report.json holds.
FileText page_data_text();

}  // namespace vibrosow
