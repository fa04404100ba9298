#include "report/studio_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "plan/model.hpp"
#include "report/page.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_json.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

/// Name of the crop that a scene has just as the studio would give it; empty where there is none.
std::string crop_of(const Scene& scene, const std::vector<StudioCrop>& crops) {
  const auto same = std::ranges::find_if(crops, [&](const StudioCrop& crop) {
    return crop.scene.lots == scene.lots && crop.scene.contact == scene.contact;
  });
  return same == crops.end() ? std::string() : same->name;
}

/// Why a page cannot run the scene; empty where nothing but its length might keep it from it.
std::string refusal(const StudioSeeder& one) {
  if (one.scene.space != Space::two_dimensional)
    return fmt::format(
        "Balls in 3D take some fifty times what a page can compute: vibrosow run {} --html makes a page that shows "
        "such "
        "a run.",
        one.name);
  try {
    prepare_to_run(one.scene);
  } catch (const InputError& error) {
    return fmt::format("It is not run as it is written: {}", error.what());
  }
  return "";
}

Json seeder(const StudioSeeder& one, const std::vector<StudioCrop>& crops) {
  const std::string why_not = refusal(one);
  const bool live = why_not.empty(), plane = one.scene.space == Space::two_dimensional;
  return {{"name", one.name},
          {"title", one.scene.title},
          {"own", one.own},
          {"toml", one.text},
          {"crop", crop_of(one.scene, crops)},
          {"space", plane ? "plane" : "three_dimensional"},
          {"live", live},
          {"why_not", why_not},
          {"steps", live ? Json(prepare_to_run(one.scene).step.steps) : Json(nullptr)},
          {"scene", Json::parse(scene_to_json(one.scene))}};
}

Json crop(const StudioCrop& one) {
  const Json scene = Json::parse(scene_to_json(one.scene));
  return {{"name", one.name},
          {"title", one.title},
          {"diameter_m", one.scene.lots.front().diameter},
          {"toml", {{"seeds", {{one.name, {{"crop", one.name}}}}}, {"contact", {{"model", one.model}}}}},
          {"lots", scene.at("lots")},
          {"contact", scene.at("contact")}};
}

}  // namespace

std::string studio_page(const std::string& page_template, const StudioPage& page) {
  Json data = {{"kind", "studio"},
               {"program", {{"name", "vibrosow"}, {"version", VIBROSOW_VERSION}}},
               {"opened", page.opened},
               {"seeders", Json::array()},
               {"crops", Json::array()}};
  for (const StudioSeeder& one : page.seeders) data["seeders"].push_back(seeder(one, page.crops));
  for (const StudioCrop& one : page.crops) data["crops"].push_back(crop(one));
  return filled_studio(page_template, page_text(data));
}

FileText studio_page_text() {
  return {"studio.html", "the studio: a page that simulates, for any browser, offline", {}};
}

}  // namespace vibrosow
