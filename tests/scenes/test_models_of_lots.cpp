// Mixtures whose lots have contact models of their own: what each lot gets of its model and of [contact], on drawn
// scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "input/presets.hpp"
#include "input/read_scene.hpp"
#include "scene/surfaces.hpp"
#include "scenes/any_scene.hpp"

namespace vibrosow {
namespace {

using Keys = std::map<std::string, std::string>;  // as they are written

/// "wall.friction" and the like, of a crop's or a contact model's file.
Keys keys_of(const std::string& text) {
  Keys keys;
  std::istringstream lines(text);
  std::string line, table;
  while (std::getline(lines, line) && line != "[sources]") {
    if (line.starts_with('[')) table = line.substr(1, line.find(']') - 1) + ".";
    const auto is = line.find(" = ");
    if (is == std::string::npos || line.starts_with('#')) continue;
    const auto comment = line.find("  #");
    keys[table + line.substr(0, line.find(' '))] = line.substr(is + 3, comment - is - 3);
  }
  return keys;
}

std::string without_quotes(const std::string& value) {
  return value.substr(1, value.size() - 2);
}

Keys keys_of_shipped(const std::string& name, const std::string& kind) {
  std::ifstream file(shipped_preset(name, kind));
  return keys_of({std::istreambuf_iterator<char>(file), {}});
}

/// What a drawn scene says of its lots' contacts.
class Mixture {
 public:
  explicit Mixture(const DrawnScene& drawn) : drawn_(drawn) {
    for (const auto& [key, value] : drawn.keys()) {
      if (key.starts_with("contact.")) contact_[key.substr(8)] = value;
      if (!key.starts_with("seeds.")) continue;
      const std::string lot = key.substr(6, key.find('.', 6) - 6);
      if (!seeds_.contains(lot)) lots_.push_back(lot);
      seeds_[lot][key.substr(7 + lot.size())] = value;
    }
  }

  const std::vector<std::string>& lots() const { return lots_; }
  const Keys& contact() const { return contact_; }

  /// Whether its lots have contact models, and [contact] leaves anything to them.
  bool has_models() const {
    for (const auto& [lot, keys] : seeds_)
      if (!keys.contains("contact") && !keys.contains("crop")) return false;
    if (contact_.contains("model")) return true;
    const auto is_stiff = [](const Keys& keys) {
      return keys.contains("shell_compression") || keys.contains("youngs_modulus");
    };
    const bool stiff =
        is_stiff(contact_) || std::ranges::all_of(seeds_, [&](const auto& lot) { return is_stiff(lot.second); });
    return !contact_.contains("law") && !(contact_.contains("friction") && stiff);
  }

  /// A lot's own model with what [contact] lays over it.
  Keys contact_of(const std::string& lot) const {
    Keys keys = model_of(lot);
    for (const auto& laid : contact_) {
      const std::string& key = laid.first;
      const bool of_pair = std::ranges::any_of(lots_, [&](const auto& other) { return key.starts_with(other + "."); });
      if (key != "model" && (!of_pair || key.starts_with(lot + ".wall."))) keys[key] = laid.second;
    }
    return keys;
  }

  /// The lot alone in some tray, with all of its contact written out.
  Scene alone(const std::string& lot) const {
    std::string text;
    for (const auto& [key, value] : drawn_.keys())
      if (key == "space") text += key + " = " + value + "\n";
    for (const auto& [key, value] : seeds_.at(lot))
      if (key != "contact" && !key.ends_with("_fraction")) text += "seeds." + lot + "." + key + " = " + value + "\n";
    for (const auto& [key, value] : contact_of(lot)) text += "contact." + key + " = " + value + "\n";
    text += "tray = { length = \"1 m\", height = \"1 m\", depth = \"1 m\", fill = { count = 1 } }\n";
    text += "run.duration = \"1 s\"\n";
    return read_scene(DrawnScene::path(), {}, drawn_.files_with(text));
  }

  /// With its lots in the file the other way round.
  std::string turned_round() const {
    std::vector<std::string> of_lots;
    std::string rest;
    for (const auto& [key, value] : drawn_.keys())
      if (!key.starts_with("seeds.")) rest += key + " = " + value + "\n";
    for (auto lot = lots_.rbegin(); lot != lots_.rend(); ++lot)
      for (const auto& [key, value] : seeds_.at(*lot)) of_lots.push_back("seeds." + *lot + "." + key + " = " + value);
    std::string text;
    for (const std::string& line : of_lots) text += line + "\n";
    return text + rest;
  }

 private:
  Keys model_of(const std::string& lot) const {
    const Keys& seeds = seeds_.at(lot);
    if (!seeds.contains("contact")) {
      const Keys crop = keys_of_shipped(without_quotes(seeds.at("crop")), "crops");
      return without_title(keys_of_shipped(without_quotes(crop.at("contact")), "contacts"));
    }
    const std::string name = without_quotes(seeds.at("contact"));
    if (name.ends_with(".toml")) return keys_of(drawn_.texts().at("/drawn/" + name));
    return without_title(keys_of_shipped(name, "contacts"));
  }
  static Keys without_title(Keys keys) {
    keys.erase("title");
    return keys;
  }

  const DrawnScene& drawn_;
  std::vector<std::string> lots_;
  std::map<std::string, Keys> seeds_;
  Keys contact_;
};

constexpr const char* shared_keys[] = {
    "friction_model",     "drag",    "rotation",        "friction_arm", "slip_speed", "tangential_ratio",
    "tangential_damping", "rolling", "rolling_damping", "damping_rate", "law",        "wall.youngs_modulus"};

/// What all seeds share and the lots' contacts do not agree in; empty: they do.
std::string differing_key(const Mixture& mixture) {
  const Keys first = mixture.contact_of(mixture.lots().front());
  for (const std::string& lot : mixture.lots()) {
    const Keys other = mixture.contact_of(lot);
    for (const std::string key : shared_keys) {
      const auto here = first.find(key), there = other.find(key);
      if ((here == first.end()) != (there == other.end())) return key;
      if (here != first.end() && here->second != there->second) return key;
    }
  }
  return "";
}

/// How a message names what lots do not agree in.
std::string words_for(const std::string& key) {
  const bool is_model = key == "law" || key == "friction_model" || key == "rolling";
  return is_model ? "of several laws, friction models or rolling models" : key + ": is shared by all seeds";
}

std::string taken_though_models_differ(const DrawnScene& drawn) {
  const Mixture mixture(drawn);
  if (!mixture.has_models()) return "";
  const std::string differs = differing_key(mixture), refused = refusal([&] { drawn.read(); });
  if (differs.empty())
    return refused.find("is shared by all") == std::string::npos && refused.find("several laws") == std::string::npos
               ? ""
               : "models that agree in what all seeds share are refused: " + refused;
  if (refused.empty()) return "models that differ in " + differs + " are taken";
  return !refused.starts_with("contact.") || refused.find(words_for(differs)) != std::string::npos
             ? ""
             : "models that differ in " + differs + " are refused for another reason: " + refused;
}

TEST(DrawnScene, IsRefusedWhereModelsDifferInWhatAllSeedsShare) {
  expect_of_drawn_scenes(400, taken_though_models_differ);
}

/// What seeds of a lot have of their own.
struct OwnContact {
  Surface seed, wall;
  double shell_compression, youngs_modulus, poisson_ratio;
  bool operator==(const OwnContact&) const = default;
};

OwnContact own_contact(const Scene& scene, std::size_t lot) {
  const Surfaces surfaces = meeting_surfaces(scene.contact, scene.lots.size());
  const SeedLot& seeds = scene.lots[lot];
  return {surfaces.pairs[lot * scene.lots.size() + lot], surfaces.walls[lot],
          seeds.shell_compression.value_or(scene.contact.shell_compression),
          seeds.youngs_modulus.value_or(scene.contact.youngs_modulus),
          seeds.poisson_ratio.value_or(scene.contact.poisson_ratio)};
}

/// The contact without what lots have of their own.
Contact shared_part(Contact contact) {
  const Contact none;
  contact.seed = none.seed, contact.wall = none.wall, contact.overrides.clear();
  contact.shell_compression = none.shell_compression, contact.youngs_modulus = none.youngs_modulus;
  contact.poisson_ratio = none.poisson_ratio;
  return contact;
}

Surface between(const Surface& a, const Surface& b) {
  return {(a.friction + b.friction) / 2, (a.restitution + b.restitution) / 2,
          (a.rolling_friction + b.rolling_friction) / 2, (a.cohesion + b.cohesion) / 2,
          (a.twisting_friction + b.twisting_friction) / 2};
}

std::string not_of_its_model(const DrawnScene& drawn) {
  const Mixture mixture(drawn);
  const std::optional<Scene> scene = mixture.has_models() ? scene_of(drawn) : std::nullopt;
  if (!scene) return "";
  const Surfaces surfaces = meeting_surfaces(scene->contact, scene->lots.size());
  std::vector<Scene> alone;
  for (const std::string& lot : mixture.lots()) alone.push_back(mixture.alone(lot));
  for (std::size_t lot = 0; lot < alone.size(); ++lot) {
    const std::string& name = mixture.lots()[lot];
    if (!(own_contact(*scene, lot) == own_contact(alone[lot], 0))) return name + " has not the contact of its model";
    if (!(shared_part(scene->contact) == shared_part(alone[lot].contact)))
      return "what all seeds share is not what the model of " + name + " says";
    for (std::size_t other = 0; other < lot; ++other) {
      Surface expected = between(alone[other].contact.seed, alone[lot].contact.seed);
      const auto written = mixture.contact().find(mixture.lots()[other] + "." + name + ".friction");
      if (written != mixture.contact().end()) expected.friction = std::strtod(written->second.c_str(), nullptr);
      if (!(surfaces.pairs[other * alone.size() + lot] == expected))
        return "between " + mixture.lots()[other] + " and " + name + " is not the mean of both";
    }
  }
  return "";
}

TEST(DrawnScene, GivesEachLotItsModelUnderTheKeysOfContact) {
  expect_of_drawn_scenes(400, not_of_its_model);
}

std::string depends_on_order(const DrawnScene& drawn) {
  const Mixture mixture(drawn);
  if (mixture.lots().size() == 1 || !mixture.has_models()) return "";
  std::optional<Scene> one, other;
  const std::string text = mixture.turned_round(), refused = refusal([&] { one = drawn.read(); });
  const std::string refused_turned =
      refusal([&] { other = read_scene(DrawnScene::path(), {}, drawn.files_with(text)); });
  if (one.has_value() != other.has_value())
    return "refused with the lots in one order alone: " + refused + refused_turned;
  if (!one) return "";
  if (!(shared_part(one->contact) == shared_part(other->contact))) return "what all seeds share depends on the order";
  const Surfaces here = meeting_surfaces(one->contact, one->lots.size());
  const Surfaces there = meeting_surfaces(other->contact, one->lots.size());
  const std::size_t lots = one->lots.size();
  for (std::size_t a = 0; a < lots; ++a) {
    if (!(own_contact(*one, a) == own_contact(*other, lots - 1 - a)))
      return "the contact of " + one->lots[a].name + " depends on the lots' order";
    for (std::size_t b = 0; b < lots; ++b)
      if (!(here.pairs[a * lots + b] == there.pairs[(lots - 1 - a) * lots + lots - 1 - b]))
        return "the contact between " + one->lots[a].name + " and " + one->lots[b].name + " depends on the lots' order";
  }
  return "";
}

TEST(DrawnScene, GivesLotsTheSameContactsInAnyOrder) {
  expect_of_drawn_scenes(400, depends_on_order);
}

}  // namespace
}  // namespace vibrosow
