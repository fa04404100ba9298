#include "report/page.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "report/base64.hpp"
#include "scene/checked_json.hpp"
#include "scene/input_error.hpp"
#include "scene/spaces.hpp"
#include "vessel/vessel_faces.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/vessel_walls.hpp"
#include "vessel/wall_points.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

Json line(const WallSegment& wall) {
  Json points = Json::array();
  for (const Eigen::Vector2d& at : wall_points(wall)) points.push_back({in_mm(at.x()), in_mm(at.y())});
  Json result = {{"points_mm", std::move(points)}};
  if (wall.opens_at > 0) result["opens_at_s"] = wall.opens_at;
  return result;
}

Json holes_of(const Vessel& vessel) {
  Json holes = Json::array();
  for (std::size_t i = 0; i < vessel.holes.size(); ++i) {
    const Hole& hole = vessel.holes[i];
    const bool is_round = hole.shape == HoleShape::round;
    holes.push_back({{"number", i + 1},
                     {"x_mm", in_mm(hole.centre)},
                     {"z_mm", in_mm(hole.across)},
                     {"half_x_mm", in_mm(hole.width / 2)},
                     {"half_z_mm", in_mm((is_round ? hole.width : hole.across_length) / 2)},
                     {"round", is_round}});
  }
  return holes;
}

/// `from_the_side`: what the plane sees of it.
Json vessel(const Vessel& whole, const Vessel& from_the_side) {
  Json result = {{"name", whole.name},
                 {"at_mm", {in_mm(whole.origin.x()), in_mm(whole.origin.y()), in_mm(whole.front)}},  // at rest
                 {"tilt_rad", whole.tilt},
                 {"length_mm", in_mm(whole.length)},
                 {"height_mm", in_mm(whole.height)},
                 {"depth_mm", whole.depth ? Json(in_mm(*whole.depth)) : Json(nullptr)},
                 {"lines", Json::array()},
                 {"holes", holes_of(whole)}};
  for (const WallSegment& wall : walls_from_the_front(from_the_side)) result["lines"].push_back(line(wall));
  return result;
}

Json vector(const Eigen::Vector3d& of) {
  return {of.x(), of.y(), of.z()};
}

Json face(const Face& of) {
  Json result = {{"at_mm", vector(1e3 * of.origin)}, {"e1", vector(of.e1)}, {"e2", vector(of.e2)}};
  if (of.kind == Face::Kind::plate) {
    result["size_mm"] = {in_mm(of.length_u), in_mm(of.length_v)};
    if (of.round) result["round"] = true;
    for (const RoundHole& hole : of.holes)
      result["holes_mm"].push_back({in_mm(hole.u), in_mm(hole.v), in_mm(hole.radius)});
  } else {
    result["rims_mm"] = {{in_mm(of.radius_a), in_mm(of.height_a)}, {in_mm(of.radius_b), in_mm(of.height_b)}};
    result["half_angle_rad"] = of.half_angle;
  }
  if (of.opens_at > 0) result["opens_at_s"] = of.opens_at;
  return result;
}

Json faces_of(const Vessel& vessel) {
  Json all = Json::array();
  for (const Face& one : vessel_faces(drawn_once(vessel))) all.push_back(face(one));
  return all;
}

/// So often that straight on from each place to the next leaves the motion by less than a hundredth of its amplitude,
/// and at most so many places.
Json path_of(const Vessel& vessel, const MotionBounds& bounds, double end) {
  constexpr double most = 20000, of_period = 0.25;  // rad of the fastest swing
  const double step =
      std::max(bounds.acceleration > 0 ? of_period * bounds.speed / bounds.acceleration : end, end / most);
  const VesselPath path(vessel);
  const auto rounded = [](double value, double parts) { return std::round(value * parts) / parts + 0.0; };
  Json at = Json::array();
  for (int k = 0; k <= static_cast<int>(end / step) + 1; ++k) {
    const Pose pose = path.pose(k * step);
    const Eigen::Vector2d place = vessel.origin + pose.displacement;
    at.push_back({rounded(in_mm(place.x()), 1e4), rounded(in_mm(place.y()), 1e4),
                  rounded(in_mm(vessel.front + pose.across), 1e4), rounded(vessel.tilt + pose.angle, 1e6)});
  }
  return {{"step_s", step}, {"at", std::move(at)}};
}

void fill(std::string& page, const std::string& place, const std::string& content) {
  const std::size_t at = page.find(place);
  if (at == std::string::npos) throw std::invalid_argument("the page's template has no place " + place);
  page.replace(at, place.size(), content);
}

}  // namespace

nlohmann::ordered_json page_lots(const Scene& scene) {
  Json all = Json::array();
  for (const SeedLot& lot : scene.lots) {
    Json one = {{"name", lot.name}, {"diameter_mm", in_mm(lot.diameter)}};
    for (const ClumpDisc& disc : lot.discs)
      one["discs"].push_back({{"x_mm", in_mm(disc.x)},
                              {"y_mm", in_mm(disc.y)},
                              {"z_mm", in_mm(disc.z)},
                              {"radius_mm", in_mm(disc.radius)}});
    all.push_back(std::move(one));
  }
  return all;
}

nlohmann::ordered_json page_vessels(const Scene& scene) {
  const Scene slice = in_plane(scene);
  Json all = Json::array({vessel(scene.tray, slice.tray)});
  if (scene.hopper) all.push_back(vessel(*scene.hopper, *slice.hopper));
  return all;
}

nlohmann::ordered_json page_faces(const Scene& scene) {
  Json all = Json::object();
  if (scene.space == Space::two_dimensional) return all;
  all[scene.tray.name] = faces_of(scene.tray);
  if (scene.hopper) all[scene.hopper->name] = faces_of(*scene.hopper);
  return all;
}

nlohmann::ordered_json page_paths(const Scene& scene, double end_time) {
  Json all = Json::object();
  if (scene.space == Space::two_dimensional || !(end_time > 0)) return all;
  const auto add = [&](const Vessel& vessel) {
    const MotionBounds bounds = motion_bounds(vessel);
    if (bounds.speed > 0) all[vessel.name] = path_of(vessel, bounds, end_time);
  };
  add(scene.tray);
  if (scene.hopper) add(*scene.hopper);
  return all;
}

Json page_remarks(const std::vector<Remark>& remarks) {
  Json all = Json::array();
  for (const Remark& remark : remarks) {
    Json one = {{"serious", remark.severity == Severity::serious}, {"text", remark.text}};
    if (!remark.what_to_do.empty()) one["what_to_do"] = remark.what_to_do;
    all.push_back(std::move(one));
  }
  return all;
}

Json page_interval(const std::optional<MeanWithInterval>& value, double unit) {
  const auto number = [&](double of) { return std::isfinite(of) ? Json(of / unit) : Json(nullptr); };
  if (!value) return nullptr;
  return {{"mean", number(value->mean)},
          {"half_width", value->half_width_95 ? number(*value->half_width_95) : Json(nullptr)}};
}

std::string page_text(const Json& data) {
  const std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;
  for (const char c : text) c == '<' ? safe.append("\\u003c") : safe.append(1, c);
  return safe;
}

std::string filled_page(const std::string& page_template, const std::string& data, const std::string& recording) {
  std::string html = page_template;
  fill(html, "@RECORDING@", base64(recording));
  fill(html, "@REPORT_DATA@", data);
  return html;
}

std::string filled_studio(const std::string& page_template, const std::string& data) {
  std::string html = page_template;
  fill(html, "@STUDIO_DATA@", data);
  return html;
}

std::string recording_in(const std::string& page) {
  const std::string begin = "<script id=\"recording\" type=\"text/plain\">";
  const std::size_t at = page.rfind(begin);
  if (at == std::string::npos) return "";
  const std::size_t from = at + begin.size();
  return from_base64(page.substr(from, page.find('<', from) - from)).value_or("");
}

std::vector<OutputFile> page_files(const std::string& page_template, const std::string& data,
                                   const std::string& recording) {
  std::vector<OutputFile> files = {{page_data_name, data + '\n'}};
  if (!page_template.empty()) files.push_back({"report.html", filled_page(page_template, data, recording)});
  return files;
}

FileText page_data_text() {
  return {page_data_name, "what report.html shows; `vibrosow report` makes the page of it", {}};
}

}  // namespace vibrosow
