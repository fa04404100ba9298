#include "scenes/mirrored.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "support/bench.hpp"

namespace vibrosow {
namespace {

constexpr double pi = std::numbers::pi;

struct MirroredMotion {
  const Vessel& vessel;  // as it was

  Eigen::Vector2d swapped(const Eigen::Vector2d& pivot) const { return {vessel.length - pivot.x(), pivot.y()}; }

  VesselMotion operator()(HarmonicMotion motion) const {
    motion.direction = pi - motion.direction;
    return motion;
  }
  VesselMotion operator()(SumMotion motion) const {
    for (HarmonicMotion& component : motion.components) component.direction = pi - component.direction;
    return motion;
  }
  VesselMotion operator()(RockingMotion motion) const {
    motion.angle = -motion.angle, motion.pivot = swapped(motion.pivot);
    return motion;
  }
  VesselMotion operator()(TurningMotion motion) const {
    motion.angular_velocity = -motion.angular_velocity, motion.phase = -motion.phase;
    motion.pivot = swapped(motion.pivot);
    return motion;
  }
  /// The frame's zero is then the end that was the right one.
  VesselMotion operator()(TableMotion motion) const {
    for (std::size_t k = 0; k < motion.times.size(); ++k) {
      const double rest = vessel.tilt, now = vessel.tilt + motion.angle[k];
      motion.x[k] = -(motion.x[k] + vessel.length * (std::cos(now) - std::cos(rest)));
      motion.y[k] += vessel.length * (std::sin(now) - std::sin(rest));
      motion.angle[k] = -motion.angle[k];
    }
    return motion;
  }
};

WallPiece mirrored(WallPiece piece, double length) {
  if (piece.drawn_out == DrawnOut::along) return piece;
  if (piece.about && piece.axis == PieceAxis::along) {
    piece.a.y() = length - piece.a.y(), piece.b.y() = length - piece.b.y();
    return piece;
  }
  if (piece.about) {
    piece.about->x() = length - piece.about->x();
    return piece;
  }
  piece.a.x() = length - piece.a.x(), piece.b.x() = length - piece.b.x(), piece.centre.x() = length - piece.centre.x();
  std::tie(piece.from, piece.to) = std::pair(pi - piece.to, pi - piece.from);
  return piece;
}

Vessel mirrored(const Vessel& vessel) {
  Vessel other = vessel;
  const double length = vessel.length;
  other.origin = {-(vessel.origin.x() + length * std::cos(vessel.tilt)),
                  vessel.origin.y() + length * std::sin(vessel.tilt)};
  other.tilt = -vessel.tilt;
  for (Hole& hole : other.holes) hole.centre = length - hole.centre;
  std::ranges::stable_sort(other.holes, {}, [](const Hole& hole) { return std::pair(hole.centre, hole.across); });
  for (WallPiece& piece : other.pieces) piece = mirrored(piece, length);
  if (vessel.rain) other.rain->from = length - vessel.rain->to, other.rain->to = length - vessel.rain->from;
  if (vessel.motion) other.motion = std::visit(MirroredMotion{vessel}, *vessel.motion);
  return other;
}

}  // namespace

Scene mirrored(Scene scene) {
  scene.tray = mirrored(scene.tray);
  if (scene.hopper) scene.hopper = mirrored(*scene.hopper);
  for (SeedLot& lot : scene.lots)
    for (ClumpDisc& disc : lot.discs) disc.x = -disc.x;
  return scene;
}

Grains mirrored(const Grains& grains, Grains into) {
  for (std::size_t i = 0; i < grains.size(); ++i) {
    Eigen::Vector3d at = place_of(grains, i), velocity = velocity_of(grains, i), spin = turning_of(grains, i);
    at.x() = -at.x(), velocity.x() = -velocity.x();
    spin.y() = -spin.y(), spin.z() = -spin.z();
    Turn turned;
    if (grains.oriented && !grains.is_3d) turned.angle = -grains.angle[i];
    if (grains.oriented && grains.is_3d)
      turned.orientation = {grains.q_w[i], grains.q_x[i], -grains.q_y[i], -grains.q_z[i]};
    into.add(at, velocity, grains.lot[i], grains.kind(i), turned);
    set_turning(into, i, spin);
  }
  return into;
}

}  // namespace vibrosow
