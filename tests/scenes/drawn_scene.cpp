#include "scenes/drawn_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "input/read_scene.hpp"

namespace vibrosow {
namespace {

std::uint64_t mixed(std::uint64_t bits) {  // splitmix64
  bits += 0x9e3779b97f4a7c15;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
  return bits ^ (bits >> 31);
}

std::string quoted(const std::string& text) {
  return '"' + text + '"';
}
std::string in_unit(double value, const char* unit) {
  return fmt::format("\"{:.6g} {}\"", value, unit);
}
std::string mm(double value) {
  return in_unit(value, "mm");
}
std::string ms(double value) {
  return in_unit(value, "ms");
}
std::string degrees(double value) {
  return in_unit(value, "degree");
}
std::string list(const std::vector<std::string>& values) {
  return fmt::format("[{}]", fmt::join(values, ", "));
}
std::string point(double x, double y) {
  return list({mm(x), mm(y)});
}

/// Writes the keys of one seeder. Lengths in mm.
class SceneWriter {
 public:
  explicit SceneWriter(Draw& draw) : draw_(draw), deep_(draw.below("space", 2) == 1) {}

  void write() {
    if (deep_) set("space", quoted("3d"));
    write_lots();
    write_contact();
    write_tray();
    if (draw_.one_in("hopper", 3)) write_hopper();
    write_fill_where_there_is_none();
    write_run();
  }

  std::vector<DrawnScene::Key> keys;
  std::map<std::string, std::string> files;  // that they name, by path

 private:
  /// Of a vessel, as far as others depend on it.
  struct Shape {
    std::string name;
    double length, height, depth;
    bool box = true, round = false, drum = false, turns = false, periodic = false, periodic_across = false;
    bool closed = false;
    int holes = 0;
    double hole_at = 0, hole_width = 0;  // of one of them
    double floor = 0;                    // its thickness
  };

  void set(const std::string& key, const std::string& value) { keys.emplace_back(key, value); }
  void set(const std::string& key, double value) { set(key, fmt::format("{:.6g}", value)); }

  // ---- seeds ----

  void write_lots() {
    lots_ = draw_.below("lots", 3) + 1;
    crops_ = draw_.one_in("crops", 8);
    for (int k = 0; k < lots_; ++k) crops_ ? write_crop(k) : write_lot(k);
    if (lots_ == 1) return;
    // One lot may be so rare that a small fill has none of it.
    const bool rare = draw_.one_in("lots.rare", 4);
    std::vector<double> percent = lots_ == 2 ? std::vector<double>{50, 50} : std::vector<double>{50, 30, 20};
    if (rare) percent = lots_ == 2 ? std::vector<double>{99.5, 0.5} : std::vector<double>{70, 29.5, 0.5};
    const char* key = draw_.one_in("lots.by_mass", 2) ? "mass_fraction" : "number_fraction";
    for (int k = 0; k < lots_; ++k) set(lot(k) + "." + key, in_unit(percent[static_cast<std::size_t>(k)], "%"));
  }

  static std::string lot(int k) { return fmt::format("seeds.{}", "abc"[k]); }

  void write_lot(int k) {
    const std::string name = lot(k);
    const double size = draw_.number(name + ".size", 4, k == 0 ? 5 : 7);
    const int shape = draw_.below(name + ".shape", 6);
    const bool row = shape == 1 || shape == 2;
    if (shape == 1) set(name + ".shape", quoted("elongated"));
    if (shape == 2) set(name + ".shape", quoted("drop"));
    if (shape == 3) set(name + ".shape", quoted("dipole"));
    if (shape == 4) set(name + ".shape", quoted("discs"));
    const bool disc = shape == 5 && !deep_;
    if (disc) set(name + ".shape", quoted("disc"));
    const double length = row ? 1.3 * size : size;
    if (row) {
      const double width = draw_.number(name + ".width", 0.65, 0.5) * length;
      set(name + ".width", mm(width));
      if (draw_.one_in(name + ".flat", 3)) set(name + ".thickness", mm(0.6 * width));
    }
    if (shape == 3) set(name + ".distance", mm(draw_.number(name + ".distance", 0.5, 1.2) * size));
    if (shape == 4) {
      // No two of its axes alike, and in 3D off its plane.
      std::string discs = fmt::format("{{ x = {}, y = {}, diameter = {} }}, {{ x = {}, y = {}, diameter = {} }}", mm(0),
                                      mm(0), mm(0.8 * size), mm(0.5 * size), mm(0.1 * size), mm(0.6 * size));
      if (draw_.one_in(name + ".third", 2))
        discs += fmt::format(", {{ x = {}, y = {}, {}diameter = {} }}", mm(-0.1 * size), mm(0.45 * size),
                             deep_ ? fmt::format("z = {}, ", mm(0.2 * size)) : "", mm(0.5 * size));
      set(name + ".discs", "[" + discs + "]");
    } else {
      write_sizes(name, row ? "length" : "diameter", length);
    }
    write_mass(name, disc, size);
    largest_ = std::max(largest_, (shape >= 3 && shape <= 4 ? 2.2 : 1.3) * 1.25 * size);
    thinnest_ = std::min(thinnest_, row ? 0.5 * length : 0.8 * size);
  }

  void write_crop(int k) {
    // Contacts of one scene all roll, or none does.
    const char* crops[2][3] = {{"pea", "wheat-ball", "soybean"}, {"wheat", "sugar-beet-pellet", "rice"}};
    const int roll = draw_.below("crops.roll", 2);
    set(lot(k) + ".crop", quoted(crops[roll][draw_.below(lot(k) + ".which", 3)]));
    set(lot(k) + ".moisture", in_unit(12, "%"));
    if (roll == 0 && draw_.one_in(lot(k) + ".own_contact", 6)) set(lot(k) + ".contact", quoted("rapeseed-steel"));
    largest_ = std::max(largest_, 8.5);
    thinnest_ = 2;
  }

  void write_sizes(const std::string& name, const std::string& key, double size) {
    const int kind = draw_.below(name + ".sizes", 8);
    if (kind == 0 || kind > 4) return set(name + "." + key, mm(size));
    if (kind == 1)
      return set(name + ".sizes", fmt::format("{{ distribution = \"uniform\", least = {}, most = {} }}", mm(0.8 * size),
                                              mm(1.2 * size)));
    if (kind == 4)
      return set(name + ".sizes",
                 fmt::format("{{ distribution = \"table\", {}s = {}, fractions = [\"25 %\", \"60 %\", \"15 %\"] }}",
                             key, list({mm(0.8 * size), mm(size), mm(1.2 * size)})));
    set(name + "." + key, mm(size));
    set(name + ".sizes", fmt::format("{{ distribution = \"{}\", deviation = {}{} }}",
                                     kind == 2 ? "normal" : "lognormal", mm(0.07 * size),
                                     draw_.one_in(name + ".cut", 2)
                                         ? fmt::format(", least = {}, most = {}", mm(0.9 * size), mm(1.2 * size))
                                         : ""));
  }

  void write_mass(const std::string& name, bool disc, double size) {
    const double mg = 0.6 * size * size * size;
    const int kind = draw_.below(name + ".mass", 3);
    if (kind == 1 || (disc && kind == 0)) return set(name + ".mass", in_unit(mg, "mg"));
    if (kind == 2) return set(name + ".thousand_grain_weight", in_unit(mg, "g"));
    set(name + ".density", in_unit(draw_.number(name + ".density", 1200, 700), "kg/m3"));
  }

  // ---- contact ----

  /// Each lot's own, made softer; or without a word, as stiff as they are.
  void write_contact_of_crops() {
    const int kind = draw_.below("contact.of_crops", 6);
    if (kind == 5) return;
    set("contact.model", quoted("crop"));
    set("contact.shell_compression", 1e-3);
    if (kind == 4) set("contact.friction", draw_.number("contact.friction", 0.4, 0));
    if (kind == 3) set("contact.a.wall.friction", 0.1);
  }

  void write_contact() {
    if (crops_) return write_contact_of_crops();
    if (draw_.one_in("models", 5)) return write_models();
    if (lots_ > 1 && draw_.one_in("contact.pair_of_lots", 6)) set("contact.a.b.friction", 0.25);
    const int law = draw_.below("contact.law", 4);
    if (law < 2) {
      set("contact.shell_compression", draw_.one_in("contact.stiff", 4) ? 3e-4 : 1e-3);
      if (draw_.one_in("contact.soft_lot", 5)) set(lot(0) + ".shell_compression", 2e-3);
    } else {
      set("contact.law", quoted("hertz"));
      set("contact.youngs_modulus", in_unit(draw_.one_in("contact.stiff", 4) ? 3 : 1, "MPa"));
      if (draw_.one_in("contact.poisson", 4)) set("contact.poisson_ratio", 0.2);
      if (draw_.one_in("contact.soft_lot", 5)) set(lot(0) + ".youngs_modulus", in_unit(0.5, "MPa"));
      if (draw_.one_in("contact.wall.soft", 3)) set("contact.wall.youngs_modulus", in_unit(5, "MPa"));
    }
    if (law == 3)
      set("contact.damping_rate", in_unit(1e3, "1/s"));
    else
      set("contact.restitution", draw_.number("contact.restitution", 0.4, 0.9));
    set("contact.friction", draw_.number("contact.friction", 0.4, 0));
    if (draw_.one_in("contact.friction_model", 2)) {
      set("contact.friction_model", quoted("spring"));
      if (draw_.one_in("contact.spring", 3))
        set("contact.tangential_ratio", 0.5), set("contact.tangential_damping", 0.2);
    } else if (draw_.one_in("contact.slip", 4)) {
      set("contact.slip_speed", in_unit(50, "mm/s"));
    }
    if (draw_.one_in("contact.rotation", 8))
      set("contact.rotation", "false");
    else
      write_rolling();
    if (draw_.one_in("contact.cohesion", 3)) set("contact.cohesion", in_unit(0.2, "mN"));
    if (draw_.one_in("contact.drag", 4)) set("contact.drag", in_unit(0.05, "g/s"));
    if (draw_.one_in("contact.arm", 6)) set("contact.friction_arm", quoted("rim"));
    if (draw_.one_in("contact.wall", 3)) set("contact.wall.friction", draw_.number("contact.wall.friction", 0.2, 0.7));
    if (draw_.one_in("contact.pair", 3)) set("contact.a.wall.friction", 0.1);
  }

  void write_rolling() {
    const int rolling = draw_.below("contact.rolling", 3);
    if (rolling == 0) return;
    set("contact.rolling", quoted(rolling == 1 ? "constant-torque" : "spring"));
    set("contact.rolling_friction", 0.1);
    if (draw_.one_in("contact.twisting", 2)) set("contact.twisting_friction", 0.05);
    if (rolling == 2 && draw_.one_in("contact.rolling_damping", 3)) set("contact.rolling_damping", 0.6);
  }

  // ---- a contact model of each lot ----

  /// What the models of all lots have in common.
  struct Models {
    bool hertz, damped_by_rate, spring;
    int rolling;
  };

  /// They may differ in what all seeds share. [contact] may settle that, and lie over them with some of its keys.
  void write_models() {
    const bool hertz = draw_.one_in("models.hertz", 3);
    const Models models{hertz, hertz && draw_.one_in("models.damping_rate", 3), draw_.one_in("models.spring", 2),
                        draw_.below("models.rolling", 3)};
    const DrawnScene::Key odd = odd_key(models);
    const int who = draw_.below("models.odd.lot", lots_);
    for (int k = 0; k < lots_; ++k) write_model(k, models, k == who ? odd : DrawnScene::Key{});
    if (!odd.first.empty() && draw_.one_in("models.settled", 3)) set("contact." + odd.first, odd.second);
    write_over_models(models);
  }

  /// Of what is one for all seeds, and counts for something with such models.
  DrawnScene::Key odd_key(const Models& models) {
    if (!draw_.one_in("models.odd", 2)) return {};
    std::vector<DrawnScene::Key> odd = {{"drag", in_unit(0.05, "g/s")}, {"friction_arm", quoted("rim")}};
    odd.emplace_back("friction_model", quoted(models.spring ? "sliding" : "spring"));
    if (models.rolling == 0) odd.emplace_back("rotation", "false");
    if (models.rolling == 2) odd.emplace_back("rolling_damping", "0.6");
    if (!models.spring || models.rolling == 1) odd.emplace_back("slip_speed", in_unit(50, "mm/s"));
    if (models.spring) odd.emplace_back("tangential_ratio", "0.5"), odd.emplace_back("tangential_damping", "0.2");
    if (models.hertz) odd.emplace_back("wall.youngs_modulus", in_unit(5, "MPa"));
    if (models.damped_by_rate) odd.emplace_back("damping_rate", in_unit(2e3, "1/s"));
    return odd[static_cast<std::size_t>(draw_.below("models.odd.key", static_cast<int>(odd.size())))];
  }

  void write_model(int k, const Models& models, const DrawnScene::Key& odd) {
    const std::string name = lot(k) + ".model.";
    std::map<std::string, std::string> model;
    const auto give = [&](const std::string& key, double from, double to) {
      model[key] = fmt::format("{:.6g}", draw_.number(name + key, from, to));
    };
    if (models.hertz)
      model["law"] = quoted("hertz"), model["youngs_modulus"] = in_unit(draw_.number(name + "modulus", 1, 3), "MPa");
    else
      give("shell_compression", 1e-3, 4e-4);
    give("friction", 0.4, 0);
    if (models.damped_by_rate)
      model["damping_rate"] = in_unit(1e3, "1/s");
    else
      give("restitution", 0.4, 0.9);
    if (draw_.one_in(name + "walls", 2)) give("wall.friction", 0.2, 0.7);
    if (draw_.one_in(name + "sticky", 4)) model["cohesion"] = in_unit(0.2, "mN");
    if (models.spring) model["friction_model"] = quoted("spring");
    if (models.rolling > 0)
      model["rolling"] = quoted(models.rolling == 1 ? "constant-torque" : "spring"),
      give("rolling_friction", 0.1, 0.02);
    if (!odd.first.empty()) model[odd.first] = odd.second;
    const std::string file = fmt::format("{}-contact.toml", "abc"[k]);
    for (const auto& [key, value] : model) files["/drawn/" + file] += key + " = " + value + "\n";
    set(lot(k) + ".contact", quoted(file));
  }

  /// Some keys alone leave the rest to the models; a law, or both stiffness and friction, do not.
  void write_over_models(const Models& models) {
    const auto stiffness = [&] {
      if (models.hertz) return set("contact.youngs_modulus", in_unit(2, "MPa"));
      set("contact.shell_compression", 8e-4);
    };
    const int kind = draw_.below("contact.over", 7);
    if (kind == 1 || kind > 4) set("contact.friction", draw_.number("contact.over.friction", 0.3, 0.1));
    if (kind == 2 || kind > 4) stiffness();
    if (kind == 3) set("contact.wall.friction", 0.15);
    if (kind == 4 && !models.damped_by_rate) set("contact.restitution", 0.6);
    if (kind == 5 && draw_.one_in("contact.over.law", 2))
      set("contact.law", quoted(models.hertz ? "hertz" : "elastic-shell"));
    if (kind == 6 || draw_.one_in("contact.over.named", 4)) set("contact.model", quoted("crop"));
    if (draw_.one_in("contact.pair", 3)) set("contact.a.wall.friction", 0.1);
    if (lots_ > 1 && draw_.one_in("models.pair_of_lots", 2)) set("contact.a.b.friction", 0.25);
    if (lots_ > 1 && !models.hertz && draw_.one_in("contact.soft_lot", 5)) set(lot(0) + ".shell_compression", 2e-3);
  }

  // ---- vessels ----

  void write_tray() {
    Shape tray{"tray", draw_.number("tray.length", 60, 90), draw_.number("tray.height", 40, 60),
               draw_.number("tray.depth", 25, 40)};
    tray.drum = draw_.one_in("tray.drum", 10);
    if (tray.drum) tray.box = false, tray.height = tray.length;
    if (!tray.drum && draw_.one_in("tray.box", 10)) tray.box = false;
    tray.round = deep_ && tray.box && draw_.one_in("tray.round", 6);
    write_sides(tray);
    write_vessel(tray);
    write_drill(tray);
    tray_ = tray;
  }

  void write_sides(Shape& tray) {
    if (tray.drum || tray.round) return;
    const int sides = draw_.below("tray.sides", 5);
    if (sides == 3) set("tray.sides", quoted("open"));
    tray.periodic = sides == 4;
    if (tray.periodic) set("tray.sides", quoted("periodic")), tray.length = std::max(48.0, 6 * largest_);
    const int across = draw_.below("tray.front_and_back", 5);
    if (across == 3) set("tray.front_and_back", quoted("open"));
    tray.periodic_across = across == 4;
    if (across == 4) set("tray.front_and_back", quoted("periodic")), tray.depth = 6 * largest_;
  }

  void write_hopper() {
    Shape hopper{"hopper", draw_.number("hopper.length", 30, 45), draw_.number("hopper.height", 30, 60), tray_.depth};
    hopper.round = deep_ && draw_.one_in("hopper.round", 3);
    hopper.periodic_across = tray_.periodic_across && !hopper.round;
    const bool beside = !tray_.periodic && draw_.one_in("hopper.beside", 6);
    // Over a periodic tray as long as that, or up to its seam; there what crosses over has to meet the hopper's walls.
    const int seam = tray_.periodic ? draw_.below("hopper.seam", 4) : 0;
    if (seam == 1) hopper.length = tray_.length;
    hopper.closed = seam > 0 && draw_.one_in("hopper.closed", 2);
    const double part = seam == 2 ? 0 : seam == 3 ? 1 : draw_.number("hopper.left", 0.5, 1);
    const double over = part * (tray_.length - hopper.length);
    set("hopper.left", mm(beside ? left_beside(hopper) : over));
    // Above the tray's walls, within them, or in its bed.
    const int above = draw_.below("hopper.above", 8);
    const double high = draw_.one_in("hopper.high", 4) ? 120 : 5;
    set("hopper.above", mm(above == 7 ? 3 : above > 3 ? 15 : tray_.height + high));
    const bool in_front = deep_ && !tray_.periodic_across && draw_.one_in("hopper.in_front", 8);
    if (in_front) set("hopper.front", mm(-0.4 * tray_.depth));
    if (deep_ && hopper.round && tray_.depth > hopper.length && !in_front)
      set("hopper.front", mm(0.5 * (tray_.depth - hopper.length)));
    if (deep_ && !hopper.round && !hopper.periodic_across && draw_.one_in("hopper.depth", 3)) {
      hopper.depth = 0.8 * tray_.depth;
      set("hopper.depth", mm(hopper.depth));
      if (!in_front) set("hopper.front", mm(0.1 * tray_.depth));
    }
    write_vessel(hopper);
  }

  /// So that its outlet, in its middle, is over an end of the tray or beyond it.
  double left_beside(const Shape& hopper) {
    const double ends[] = {-0.5 * hopper.length, -hopper.length - 2, tray_.length - 0.5 * hopper.length,
                           tray_.length + 2};
    return ends[draw_.below("hopper.beside.where", 4)];
  }

  void write_vessel(Shape& vessel) {
    const std::string& name = vessel.name;
    set(name + ".length", mm(vessel.length));
    set(name + ".height", mm(vessel.height));
    if (vessel.round) {
      set(name + ".plan", quoted("round"));
      vessel.depth = vessel.length;
    } else if (name == "tray" && (deep_ || draw_.one_in("tray.has_depth", 2))) {
      set(name + ".depth", mm(vessel.depth));
    }
    if (!vessel.box) set(name + ".box", "false");
    vessel.turns = draw_.one_in(name + (vessel.drum ? ".drum.turns" : ".turns"), vessel.drum ? 2 : 10);
    if (!vessel.drum && !vessel.periodic && draw_.one_in(name + ".tilt", 4))
      set(name + ".tilt", degrees(draw_.number(name + ".tilt.angle", 2, -8)));
    write_holes(vessel);
    write_pieces(vessel);
    write_fill(vessel);
    write_rain(vessel);
    write_motion(vessel);
  }

  void write_holes(Shape& vessel) {
    const std::string& name = vessel.name;
    const bool hopper = name == "hopper";
    if (vessel.closed || vessel.drum || (vessel.turns && !upright(vessel))) return;
    vessel.holes = hopper ? 1 : draw_.below(name + ".holes", 3);
    if (vessel.round) vessel.holes = std::min(vessel.holes, 1);
    if (vessel.holes == 0) return;
    const double width = hopper ? draw_.number(name + ".width", 12, 20) : draw_.number(name + ".width", 9, 15);
    vessel.hole_width = width;
    if (draw_.one_in(name + ".at", 3)) {
      std::vector<std::string> at;
      for (int k = 0; k < vessel.holes; ++k) at.push_back(mm((k + 1) * vessel.length / (vessel.holes + 1)));
      set(name + ".holes.at", list(at));
      vessel.hole_at = vessel.length / (vessel.holes + 1);
    } else if (deep_ && !vessel.round && !hopper && draw_.one_in(name + ".unlike_rows", 5)) {
      return write_unlike_rows(vessel, width);
    } else {
      set(name + ".holes.count", vessel.holes);
      double pitch = vessel.length / (vessel.holes + 1);
      if (draw_.one_in(name + ".pitch", 4)) pitch = 0.4 * vessel.length, set(name + ".holes.pitch", mm(pitch));
      vessel.hole_at = 0.5 * (vessel.length - (vessel.holes - 1) * pitch);
    }
    set(name + ".holes.width", mm(width));
    const bool funnel = draw_.one_in(name + ".funnel", hopper ? 2 : 5) && vessel.box;
    if (vessel.round || (!funnel && draw_.one_in(name + ".round_holes", 4))) {
      set(name + ".holes.shape", quoted("round"));
      if (!vessel.round && draw_.one_in(name + ".rows", 3)) set(name + ".holes.rows", 2);
      if (draw_.one_in(name + ".thick_floor", 3)) {
        vessel.floor = draw_.number(name + ".thickness", 0.6, 3);
        set(name + ".holes.thickness", mm(vessel.floor));
      }
      if (!funnel && draw_.one_in(name + ".chamfered", 3)) set(name + ".holes.chamfer", mm(0.5));
    } else if (deep_ && !funnel && draw_.one_in(name + ".short_slots", 4)) {
      set(name + ".holes.across", mm(0.6 * vessel.depth));
    }
    if (funnel) set(name + ".funnel", degrees(draw_.number(name + ".funnel.slope", 20, 45)));
    if (draw_.one_in(name + ".gate", 4)) write_gate(vessel);
  }

  /// Of all holes or of the second, and one may open when all is over.
  void write_gate(const Shape& vessel) {
    const std::string& name = vessel.name;
    const double time = draw_.one_in(name + ".gate.late", 6) ? 200 : draw_.number(name + ".gate.time", 10, 40);
    const bool one = vessel.holes == 2 && draw_.one_in(name + ".gate.one", 3);
    set(name + ".holes.open_at", one ? list({ms(0), ms(time)}) : ms(time));
  }

  /// Two rows with numbers of their own, of round holes or short slots.
  void write_unlike_rows(Shape& vessel, double width) {
    vessel.hole_at = vessel.length / 2;  // of the row that has one
    const std::string holes = vessel.name + ".holes.";
    set(holes + "count", list({std::to_string(vessel.holes), std::to_string(3 - vessel.holes)}));
    vessel.holes = 3;
    if (draw_.one_in(holes + "pitch", 3)) set(holes + "pitch", mm(0.4 * vessel.length));
    set(holes + "width", draw_.one_in(holes + "widths", 3) ? list({mm(width), mm(0.8 * width), mm(width)}) : mm(width));
    if (draw_.one_in(holes + "slots", 2))
      set(holes + "across", mm(0.4 * vessel.depth));
    else
      set(holes + "shape", quoted("round"));
  }

  void write_pieces(const Shape& vessel) {
    const std::string& name = vessel.name;
    const double l = vessel.length, h = vessel.height, middle = l / 2;
    std::vector<std::string> pieces;
    const auto line = [&](const std::vector<std::string>& points) {
      pieces.push_back(fmt::format("{{ line = {} }}", list(points)));
    };
    const auto arc = [&](double x, double y, double radius, double from, double to) {
      pieces.push_back(fmt::format("{{ centre = {}, radius = {}, from = {}, to = {} }}", point(x, y), mm(radius),
                                   degrees(from), degrees(to)));
    };
    const auto turned = [&](const std::vector<std::string>& points, double a, double b, const char* axis) {
      pieces.push_back(fmt::format("{{ line = {}, about = {}, axis = \"{}\" }}", list(points), point(a, b), axis));
    };
    if (vessel.drum) {
      if (draw_.one_in(name + ".arcs", 3))
        arc(middle, middle, middle, 0, 180), arc(middle, middle, middle, 180, 360);
      else
        pieces.push_back(fmt::format("{{ centre = {}, radius = {} }}", point(middle, middle), mm(middle)));
      if (draw_.one_in(name + ".lifter", 2)) line({point(middle, 0.02 * l), point(middle, 0.15 * l)});
      const int lifters = draw_.below(name + ".lifters", 5);  // at the axis, above it, both, or a paddle through it
      if (lifters == 1 || lifters == 3) line({point(0.99 * l, middle), point(0.8 * l, middle)});
      if (lifters == 2 || lifters == 3) line({point(0.16 * l, 0.84 * l), point(0.28 * l, 0.72 * l)});
      if (lifters == 4) line({point(0.2 * l, middle), point(0.8 * l, middle)});
    } else if (!vessel.box) {  // two slopes, a gap between them
      line({point(0, 0.9 * h), point(0, 0.5 * h), point(middle - 8, 1)});
      line({point(middle + 8, 1), point(l, 0.5 * h), point(l, 0.9 * h)});
    }
    const auto along = [&](const std::vector<std::string>& points) {
      pieces.push_back(fmt::format("{{ line = {}, drawn_out = \"along\" }}", list(points)));
    };
    const double d = vessel.depth;
    const int in_both = 13, kinds = deep_ ? 18 : in_both;
    for (const char* which : {".piece", ".other_piece"}) {
      const int drawn = vessel.drum ? 0 : draw_.below(name + which, 3 * kinds);
      const int kind = drawn < kinds ? drawn : 0;                                          // most have none
      if (kind == 1) line({point(0, 0.4 * h), point(0.6 * l, 0.25 * h)});                  // a sloping shelf
      if (kind == 2) line({point(0, 0.5 * h), point(0.4 * l, 2), point(0.4 * l + 1, 2)});  // a drawn slope
      if (kind == 3) line({point(0.3 * l, 0.1 * h), point(0.3 * l, 0.7 * h)});             // a board
      if (kind == 4) arc(middle, 0, 0.15 * l, 0, 180);                                     // a hump
      if (kind == 5) arc(middle, 0.4 * h, 6, 0, 360);                                      // a rod across
      if (kind == 6) line({point(0, 0), point(l, 0)});                                     // a floor drawn twice
      if (kind == 7)
        line({point(middle, 0), point(middle, 0.5 * h)}), line({point(middle, 0.25 * h), point(l, 0.5 * h)});
      if (kind == 8) line({point(l, 0), point(l, h)});          // an end wall drawn twice
      if (kind == 9) arc(0.3 * l, 0.3 * h, 0.2 * l, 200, 340);  // a bowl
      if (kind == 10) line(fine_bowl(draw_.number(name + which + ".fine", 8, 60), vessel));
      if (kind == 11) pieces.push_back(drawn_bowl(vessel, which));
      if (kind == 12) pieces.push_back(drawn_hump(vessel, which));
      if (kind == 13 && draw_.one_in(name + which + ".roof", 2))  // beneath it seeds come from all sides
        turned({point(0, 0.5 * h), point(0.3 * std::min(l, d), 0.4 * h)}, middle, d / 2, "upright");
      else if (kind == 13)
        turned({point(6, 0), point(6, 0.4 * h)}, middle, d / 2, "upright");
      if (kind == 14) turned({point(4, 0), point(4, l)}, 0.4 * h, vessel.depth / 2, "along");
      if (kind == 15) along({point(0, 0.35 * h), point(0.5 * d, 0), point(d, 0.3 * h)});  // a groove
      if (kind == 16) along({point(0, 0.4 * h), point(0.6 * d, 0.25 * h)});               // a shelf
      if (kind == 17)                                                                     // a trough
        pieces.push_back(fmt::format("{{ centre = {}, radius = {}, from = {}, to = {}, drawn_out = \"along\" }}",
                                     point(0.5 * d, 0.4 * h), mm(0.3 * d), degrees(200), degrees(330)));
    }
    if (vessel.holes > 0 && draw_.one_in(name + ".plate", 6)) line(plate_at_hole(vessel));
    if (!pieces.empty()) set(name + ".pieces", list(pieces));
  }

  /// A bowl of so many short lines.
  std::vector<std::string> fine_bowl(double lines, const Shape& vessel) const {
    const double x = 0.6 * vessel.length, y = 0.5 * vessel.height, radius = 0.3 * vessel.length;
    const int count = static_cast<int>(lines);
    std::vector<std::string> points;
    for (int k = 0; k <= count; ++k) {
      const double angle = (-2.6 + 2.1 * k / count);  // rad
      points.push_back(point(x + radius * std::cos(angle), y + radius * std::sin(angle)));
    }
    return points;
  }

  /// An SVG of a curve, a line and what is no wall.
  std::string drawn_bowl(const Shape& vessel, const std::string& which) {
    const double l = vessel.length, h = vessel.height;
    const std::string file = vessel.name + which + ".svg";
    files["/drawn/" + file] = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}mm\" height=\"{1:g}mm\" viewBox=\"0 0 {0:g} {1:g}\">"
        "<g style=\"fill:none;stroke:#000\"><path d=\"M {2:g},{3:g} C {2:g},{4:g} {5:g},{4:g} {5:g},{3:g} H "
        "{6:g}\"/></g>"
        "<text x=\"1\" y=\"5\">a bowl</text></svg>",
        l, h, 0.3 * l, 0.5 * h, 0.9 * h, 0.6 * l, 0.75 * l);
    return fmt::format("{{ file = {}{} }}", quoted(file),
                       draw_.one_in(file + ".coarse", 3) ? ", tolerance = " + mm(0.3) : "");
  }

  /// A DXF of an arc, a line and one that nobody sees.
  std::string drawn_hump(const Shape& vessel, const std::string& which) {
    const std::string file = vessel.name + which + ".dxf";
    const double radius = 0.12 * vessel.length;
    files["/drawn/" + file] = fmt::format(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
        "0\nARC\n8\nW\n10\n0\n20\n0\n40\n{0:g}\n50\n0\n51\n180\n"
        "0\nLINE\n8\nW\n10\n{0:g}\n20\n0\n11\n{1:g}\n21\n{2:g}\n"
        "0\nLINE\n8\nW\n60\n1\n10\n-99\n20\n0\n11\n99\n21\n0\n0\nENDSEC\n0\nEOF\n",
        radius, 2 * radius, 0.5 * radius);
    return fmt::format("{{ file = {}, at = {} }}", quoted(file), point(0.45 * vessel.length, 0.2 * vessel.height));
  }

  /// Level: near below the hole or further down, within the floor, near above or further up; over all of it or half.
  std::vector<std::string> plate_at_hole(const Shape& vessel) {
    const std::string key = vessel.name + ".plate.";
    const double heights[] = {-vessel.floor - 0.7 * thinnest_, -vessel.floor - 2 * thinnest_, -0.5 * vessel.floor,
                              0.3 * thinnest_, 2 * thinnest_};
    const double y = heights[draw_.below(key + "where", 5)], half = 0.5 * vessel.hole_width;
    const double right = vessel.hole_at + (draw_.one_in(key + "half", 3) ? 0 : half + 1);
    return {point(vessel.hole_at - half - 1, y), point(right, y)};
  }

  void write_fill(const Shape& vessel) {
    const std::string& name = vessel.name;
    if (!draw_.one_in(name + ".no_fill", 4)) write_fill_of(vessel);
  }

  void write_fill_of(const Shape& vessel) {
    const std::string& name = vessel.name;
    filled_ = true;
    const int most = static_cast<int>(vessel.length * vessel.height / (1.6 * largest_ * largest_)) * (deep_ ? 2 : 1);
    int count = 8 + static_cast<int>(draw_.number(name + ".count", 0.2, 0.6) * most);
    // So many that a heap meets itself across the seam.
    if (deep_ && (vessel.periodic || vessel.periodic_across))
      count = std::max(count, static_cast<int>(2 * vessel.length * vessel.depth / (largest_ * largest_)));
    if (draw_.one_in(name + ".too_many", 16)) count = 4 * most;
    if (draw_.one_in(name + ".to_a_height", 5))
      set(name + ".fill.height", mm(draw_.number(name + ".fill.height", 0.3, 0.6) * vessel.height));
    else
      set(name + ".fill.count", count);
    const int packing = draw_.below(name + ".packing", 4);
    if (packing < 2) set(name + ".fill.packing", quoted("poured"));
    if (packing == 2) set(name + ".fill.packing", quoted("layers"));
    if (packing == 3) set(name + ".fill.packing", quoted("hexagonal"));
    if (packing > 1 && draw_.one_in(name + ".jitter", 3)) set(name + ".fill.jitter", 0.05);
    if (!vessel.turns && draw_.one_in(name + ".keep", 3)) set(name + ".fill.keep", "true");
  }

  void write_rain(const Shape& vessel) {
    const std::string& name = vessel.name;
    if (!draw_.one_in(name + ".rain", vessel.periodic ? 2 : 4)) return;
    filled_ = true;
    // So much, and everywhere, that it meets itself across a seam.
    const double most = vessel.periodic ? 1200 : 600;
    set(name + ".rain.rate", in_unit(draw_.number(name + ".rain.rate", 300, most), "1/s"));
    if (!vessel.periodic && draw_.one_in(name + ".rain.part", 2)) {
      set(name + ".rain.from", mm(0.2 * vessel.length));
      set(name + ".rain.to", mm(0.7 * vessel.length));
    }
    if (draw_.one_in(name + ".rain.height", 2))
      set(name + ".rain.height", mm(draw_.number(name + ".rain.how_high", 1.3, 0.2) * vessel.height));
    if (draw_.one_in(name + ".rain.start", 4)) set(name + ".rain.start", ms(10));
    if (draw_.one_in(name + ".rain.stop", 4)) set(name + ".rain.stop", ms(40));
  }

  void write_fill_where_there_is_none() {
    if (!filled_) write_fill_of(tray_);
  }

  // ---- motion ----

  bool upright(const Shape& vessel) { return deep_ && draw_.one_in(vessel.name + ".turns.upright", 2); }

  void write_motion(const Shape& vessel) {
    const std::string& name = vessel.name;
    const std::string key = name + ".motion.";
    if (vessel.turns && !vessel.periodic && !vessel.periodic_across) return write_turning(vessel);
    const int kind = draw_.below(name + ".motion", 6);
    if (name == "hopper" && !draw_.one_in("hopper.moves", 3)) return;
    if (kind == 5) return;
    if (kind == 0 || (kind == 2 && vessel.periodic)) {
      set(key + "kind", quoted("harmonic"));
      write_oscillation(vessel);
    }
    if (kind == 1) {
      set(key + "kind", quoted("sum"));
      set(key + "components",
          "[{ amplitude = \"1 mm\", frequency = \"15 Hz\" }, { direction = \"70 degree\", amplitude = "
          "\"0.5 mm\", frequency = \"23 Hz\", phase = \"30 degree\" }]");
    }
    if (kind == 2 && !vessel.periodic) {
      set(key + "kind", quoted("rocking"));
      set(key + "pivot", point(draw_.number(key + "pivot", 0.5, 0) * vessel.length, 0));
      set(key + "angle", degrees(draw_.number(key + "angle", 1, 4)));
      set(key + "frequency", in_unit(10, "Hz"));
    }
    if (kind > 2) return write_table(vessel);
    write_course(key);
  }

  void write_course(const std::string& key) {
    if (draw_.one_in(key + "ramp", 3)) set(key + "ramp", ms(20));
    if (!draw_.one_in(key + "stop", 4)) return;
    set(key + "stop", ms(30));
    if (draw_.one_in(key + "stop_ramp", 2)) set(key + "stop_ramp", ms(10));
  }

  void write_oscillation(const Shape& vessel) {
    const std::string key = vessel.name + ".motion.";
    const int direction = draw_.below(key + "direction", deep_ ? 4 : 3);
    if (direction == 1) set(key + "direction", degrees(90));
    if (direction == 2) set(key + "direction", degrees(-30));
    if (direction == 3) set(key + "direction", "[1, 0.5, 0.3]");
    set(key + "amplitude", mm(draw_.number(key + "amplitude", 1, 3)));
    set(key + "frequency", in_unit(draw_.number(key + "frequency", 10, 20), "Hz"));
    if (draw_.one_in(key + "phase", 3)) set(key + "phase", degrees(60));
  }

  void write_turning(const Shape& vessel) {
    const std::string key = vessel.name + ".motion.";
    set(key + "kind", quoted("turning"));
    set(key + "speed", in_unit(draw_.number(key + "speed", 60, -90), "rpm"));
    const bool is_upright = !vessel.drum && upright(vessel);
    if (is_upright) set(key + "axis", quoted("upright"));
    set(key + "pivot", point(vessel.length / 2, is_upright ? vessel.depth / 2 : vessel.height / 2));
    write_course(key);
  }

  /// Begins displaced and, where the vessel may turn, turned; it may begin late, hold still between its moves, or last
  /// longer than the run.
  void write_table(const Shape& vessel) {
    const std::string file = vessel.name + ".csv";
    const bool turns = !vessel.periodic && draw_.one_in(vessel.name + ".table.turns", 2);
    const bool across = deep_ && draw_.one_in(vessel.name + ".table.across", 3);
    const double angle = turns ? draw_.number(vessel.name + ".table.angle", 3, -6) : 0;
    std::string text = fmt::format("time_s,x_mm,y_mm{}{}\n", turns ? ",angle_degree" : "", across ? ",z_mm" : "");
    const int when = draw_.below(vessel.name + ".table.when", 4);
    const bool holds = draw_.one_in(vessel.name + ".table.holds", 3);
    double time = when == 2 ? 0.02 : 0;
    for (int k = 0; k < (when == 3 ? 12 : 6); ++k, time += 0.01) {
      const std::string row = fmt::format(",{:g},{:g}{}{}\n", 1.0 + (k % 2), 0.5 * (k % 3),
                                          turns ? fmt::format(",{:g}", angle * (1 - 0.15 * k)) : "",
                                          across ? fmt::format(",{:g}", 0.4 * k) : "");
      text += fmt::format("{:g}", time) + row;
      if (holds && k % 2 == 1) time += 0.03, text += fmt::format("{:g}", time) + row;
    }
    files["/drawn/" + file] = text;
    set(vessel.name + ".motion.kind", quoted("table"));
    set(vessel.name + ".motion.file", quoted(file));
  }

  // ---- run ----

  void write_drill(const Shape& tray) {
    if (tray.holes == 0 || !draw_.one_in("drill", 6)) return;
    set("drill.row_spacing", in_unit(15, "cm"));
    set("drill.speed", in_unit(8, "km/h"));
  }

  void write_run() {
    const double duration = draw_.number("run.duration", 40, 80);
    set("run.duration", ms(duration));
    set("run.count_below", mm(draw_.number("run.count_below", 4, 10)));
    if (draw_.one_in("run.measure_late", 4))
      set("run.measure_from", ms(0.8 * duration));
    else if (draw_.one_in("run.measure_from", 3))
      set("run.measure_from", ms(15));
    if (draw_.one_in("run.start", 3)) set("run.start", quoted("with-tray"));
    if (draw_.one_in("run.pause", 6)) set("run.end_after_pause", ms(25));
    if (draw_.one_in("record", 4)) {
      set("record.every", ms(10));
      if (draw_.one_in("record.cell", 2)) set("record.cell", quoted("3 diameters"));
      if (draw_.one_in("record.view", 2)) set("record.view", quoted("slice"));
    }
    const int scheme = draw_.below("numerics.integrator", 5);
    if (scheme == 3) set("numerics.integrator", quoted("rk2-midpoint"));
    if (scheme == 4) set("numerics.integrator", quoted("gear5"));
    if (draw_.one_in("numerics.steps", 5)) set("numerics.steps_per_contact", draw_.one_in("numerics.few", 3) ? 3 : 30);
    if (draw_.one_in("guard", 5)) set("guard.warn_relative_overlap", 0.1);
  }

  Draw& draw_;
  bool deep_;
  int lots_ = 1;
  bool crops_ = false;
  double largest_ = 0;     // mm, at least the diameter of the largest seed
  double thinnest_ = 100;  // mm, some thickness of the thinnest lot
  bool filled_ = false;
  Shape tray_{};
};

}  // namespace

int Draw::below(const std::string& name, int n) {
  if (plain_.contains(name)) return 0;
  std::uint64_t bits = seed_;
  for (const char c : name) bits = mixed(bits ^ static_cast<unsigned char>(c));
  const int chosen = static_cast<int>(bits % static_cast<std::uint64_t>(n));
  if (chosen != 0 && std::ranges::find(taken_, name) == taken_.end()) taken_.push_back(name);
  return chosen;
}

DrawnScene::DrawnScene(std::uint64_t seed, std::set<std::string> plain) : seed_(seed), plain_(std::move(plain)) {
  Draw draw(seed_, plain_);
  SceneWriter writer(draw);
  writer.write();
  taken_ = draw.taken();
  keys_ = std::move(writer.keys);
  files_ = std::move(writer.files);
}

std::string DrawnScene::toml() const {
  std::string text;
  for (const Key& key : keys_) text += key.first + " = " + key.second + "\n";
  return text;
}

std::string DrawnScene::told() const {
  std::string text = "\n" + toml();
  for (const auto& [file, rows] : files_) {
    text += "# " + file + ":\n# ";
    for (const char c : rows) text += c == '\n' ? std::string("\n# ") : std::string(1, c);
    text += "\n";
  }
  return text;
}

std::map<std::string, std::string> DrawnScene::texts() const {
  std::map<std::string, std::string> texts = files_;
  texts[path()] = toml();
  return texts;
}

std::shared_ptr<SourceFiles> DrawnScene::files_with(const std::string& text) const {
  std::map<std::string, std::string> all = texts();
  all[path()] = text;
  return std::make_shared<SourceFiles>(std::move(all));
}

Scene DrawnScene::read() const {
  return read_scene(path(), {}, files_with(toml()));
}

std::vector<DrawnScene> DrawnScene::plainer() const {
  std::vector<DrawnScene> scenes;
  const auto without = [&](std::size_t from, std::size_t to) {
    std::set<std::string> plain = plain_;
    for (std::size_t k = from; k < to; ++k) plain.insert(taken_[k]);
    scenes.emplace_back(seed_, std::move(plain));
  };
  for (std::size_t many = taken_.size() / 2; many > 0; many /= 2)
    for (std::size_t from = 0; from < taken_.size(); from += many) without(from, std::min(from + many, taken_.size()));
  return scenes;
}

}  // namespace vibrosow
