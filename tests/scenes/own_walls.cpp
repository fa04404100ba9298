#include "scenes/own_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace vibrosow {
namespace {

using Point = Eigen::Vector3d;
using Flat = Eigen::Vector2d;
using Distance = std::function<double(const Point&)>;
using FlatDistance = std::function<double(const Flat&)>;

double beyond(double value, double from, double to) {
  return std::max({from - value, value - to, 0.0});
}

double to_line(const Flat& a, const Flat& b, const Flat& p) {
  const Flat edge = b - a;
  const double along = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  return (p - a - along * edge).norm();
}

double to_arc(const WallPiece& arc, const Flat& p) {
  const auto end = [&](double angle) -> Flat {
    return arc.centre + arc.radius * Flat(std::cos(angle), std::sin(angle));
  };
  const Flat arm = p - arc.centre;
  const double turn = 2 * std::numbers::pi, span = arc.to - arc.from;
  const double angle = std::fmod(std::fmod(std::atan2(arm.y(), arm.x()) - arc.from, turn) + turn, turn);
  if (span >= turn * (1 - 1e-12) || angle <= span) return std::abs(arm.norm() - arc.radius);
  return std::min((p - end(arc.from)).norm(), (p - end(arc.to)).norm());
}

/// What is drawn in 2D, in 3D drawn out from front to back.
Distance drawn_out(const FlatDistance& flat, const Vessel& vessel, Space space) {
  if (space == Space::two_dimensional) return [flat](const Point& p) { return flat(p.head<2>()); };
  const bool endless = vessel.front_and_back == Sides::periodic;
  const double depth = *vessel.depth;
  return [=](const Point& p) { return std::hypot(flat(p.head<2>()), endless ? 0 : beyond(p.z(), 0, depth)); };
}

/// What is drawn across and up, drawn out from the left end to the right one.
Distance drawn_along(const FlatDistance& flat, const Vessel& vessel) {
  const bool endless = vessel.sides == Sides::periodic;
  const double length = vessel.length;
  return [=](const Point& p) { return std::hypot(flat({p.z(), p.y()}), endless ? 0 : beyond(p.x(), 0, length)); };
}

Distance line(const Flat& a, const Flat& b, const Vessel& vessel, Space space) {
  return drawn_out([=](const Flat& p) { return to_line(a, b, p); }, vessel, space);
}

/// Turned all round an axis; the points are (distance from it, place along it).
Distance revolved(const Flat& a, const Flat& b, const Point& foot, bool upright) {
  return [=](const Point& p) {
    const Point arm = p - foot;
    const double from_axis = upright ? std::hypot(arm.x(), arm.z()) : std::hypot(arm.y(), arm.z());
    return to_line(a, b, {from_axis, upright ? arm.y() : arm.x()});
  };
}

/// Of the level rectangle [x0, x1] x [z0, z1].
Distance level(double x0, double x1, double z0, double z1) {
  return [=](const Point& p) {
    const double x = beyond(p.x(), x0, x1), z = beyond(p.z(), z0, z1);
    return std::sqrt(x * x + z * z + p.y() * p.y());
  };
}

/// In periods beside each other as well.
Distance repeated(const Distance& once, double period, const Point& along) {
  return [=](const Point& p) { return std::min({once(p), once(p + period * along), once(p - period * along)}); };
}

class WallMaker {
 public:
  WallMaker(const Vessel& vessel, Space space)
      : vessel_(vessel), space_(space), deep_(space != Space::two_dimensional) {}

  std::vector<OwnWall> walls() {
    if (vessel_.box) add_box();
    for (std::size_t k = 0; k < vessel_.pieces.size(); ++k) add_piece(vessel_.pieces[k]);
    add_drum_ends();
    for (const Hole& hole : vessel_.holes) {
      const double radius = hole.width / 2;
      const Point middle(hole.centre, 0, hole.across);
      if (hole.chamfer > 0) add("chamfer", revolved({radius + hole.chamfer, 0}, {radius, -hole.chamfer}, middle, true));
      if (hole.thickness > hole.chamfer)
        add("bore", revolved({radius, -hole.chamfer}, {radius, -hole.thickness}, middle, true));
    }
    for (const Hole& hole : vessel_.holes)
      if (hole.open_at > 0) add("gate", lid(hole), hole.open_at);
    return std::move(walls_);
  }

  std::vector<OwnWall> lids() {
    for (const Hole& hole : vessel_.holes) add("lid", lid(hole));
    return std::move(walls_);
  }

 private:
  void add(const std::string& name, Distance distance, double opens_at = 0) {
    if (vessel_.sides == Sides::periodic) distance = repeated(distance, vessel_.length, Point::UnitX());
    if (deep_ && vessel_.front_and_back == Sides::periodic)
      distance = repeated(distance, *vessel_.depth, Point::UnitZ());
    walls_.push_back({vessel_.name + " " + name, opens_at, std::move(distance)});
  }

  double left(const Hole& hole) const { return hole.centre - hole.width / 2; }
  double right(const Hole& hole) const { return hole.centre + hole.width / 2; }

  Distance lid(const Hole& hole) const {
    if (!deep_) return line({left(hole), 0}, {right(hole), 0}, vessel_, space_);
    if (hole.shape == HoleShape::round)
      return revolved({0, 0}, {hole.width / 2 + hole.chamfer, 0}, {hole.centre, 0, hole.across}, true);
    return level(left(hole), right(hole), hole.across - hole.across_length / 2, hole.across + hole.across_length / 2);
  }

  void add_box() {
    if (deep_ && vessel_.plan == Plan::round) return add_round();
    const double length = vessel_.length, height = vessel_.height;
    const double slope = std::tan(vessel_.funnel);
    double foot_left = 0, foot_right = 0;
    if (vessel_.funnel > 0) {
      foot_left = slope * left(vessel_.holes.front()), foot_right = slope * (length - right(vessel_.holes.back()));
      add_slopes(slope);
    } else {
      add_floor();
    }
    if (vessel_.sides == Sides::walls) {
      add("left wall", line({0, foot_left}, {0, height}, vessel_, space_));
      add("right wall", line({length, foot_right}, {length, height}, vessel_, space_));
    }
    if (!deep_ || vessel_.front_and_back != Sides::walls) return;
    for (const double z : {0.0, *vessel_.depth})
      add(z == 0 ? "front" : "back", [=](const Point& p) {
        const double x = beyond(p.x(), 0, length), y = beyond(p.y(), 0, height);
        return std::sqrt(x * x + y * y + (p.z() - z) * (p.z() - z));
      });
  }

  /// From the ends, and from ridges midway between holes.
  void add_slopes(double slope) {
    double from = 0;
    for (std::size_t k = 0; k < vessel_.holes.size(); ++k) {
      const Hole& hole = vessel_.holes[k];
      const bool last = k + 1 == vessel_.holes.size();
      const double to = last ? vessel_.length : 0.5 * (right(hole) + left(vessel_.holes[k + 1]));
      if (left(hole) - from > 1e-9 * vessel_.length)
        add("slope", line({from, slope * (left(hole) - from)}, {left(hole), 0}, vessel_, space_));
      if (to - right(hole) > 1e-9 * vessel_.length)
        add("slope", line({right(hole), 0}, {to, slope * (to - right(hole))}, vessel_, space_));
      from = to;
    }
  }

  void add_floor() {
    const double length = vessel_.length, depth = deep_ ? *vessel_.depth : 0;
    if (deep_ && !vessel_.holes.empty() && vessel_.holes.front().shape == HoleShape::round) {
      const std::vector<Hole> holes = vessel_.holes;
      return add("floor", [=](const Point& p) {
        for (const Hole& hole : holes) {
          const double in_plan = std::hypot(p.x() - hole.centre, p.z() - hole.across);
          const double rim = hole.width / 2 + hole.chamfer;
          if (in_plan < rim) return std::hypot(rim - in_plan, p.y());
        }
        return level(0, length, 0, depth)(p);
      });
    }
    std::vector<double> cuts = {0, length};
    for (const Hole& hole : vessel_.holes) cuts.push_back(left(hole)), cuts.push_back(right(hole));
    std::ranges::sort(cuts);
    for (std::size_t k = 1; k < cuts.size(); ++k)
      if (cuts[k] - cuts[k - 1] > 1e-9 * length) add_strip(cuts[k - 1], cuts[k]);
  }

  /// The floor between two places along it, but for the slots that pass there.
  void add_strip(double from, double to) {
    if (!deep_) {
      const bool open = std::ranges::any_of(vessel_.holes, [&](const Hole& hole) {
        return left(hole) < 0.5 * (from + to) && right(hole) > 0.5 * (from + to);
      });
      if (!open) add("floor", line({from, 0}, {to, 0}, vessel_, space_));
      return;
    }
    double front = 0;
    std::vector<std::pair<double, double>> open;
    for (const Hole& hole : vessel_.holes)
      if (left(hole) < 0.5 * (from + to) && right(hole) > 0.5 * (from + to))
        open.emplace_back(hole.across - hole.across_length / 2, hole.across + hole.across_length / 2);
    open.emplace_back(*vessel_.depth, *vessel_.depth);
    std::ranges::sort(open);
    for (const auto& [begin, end] : open) {
      if (begin - front > 1e-9 * *vessel_.depth) add("floor", level(from, to, front, begin));
      front = end;
    }
  }

  void add_round() {
    const double radius = vessel_.length / 2;
    const Point foot(radius, 0, radius);
    add("wall", revolved({radius, 0}, {radius, vessel_.height}, foot, true));
    if (vessel_.funnel > 0) {
      const double outlet = vessel_.holes.front().width / 2;
      return add("funnel", revolved({outlet, 0}, {radius, std::tan(vessel_.funnel) * (radius - outlet)}, foot, true));
    }
    const std::vector<Hole> holes = vessel_.holes;
    add("floor", [=](const Point& p) {
      for (const Hole& hole : holes) {
        const double in_plan = std::hypot(p.x() - hole.centre, p.z() - hole.across);
        if (in_plan < hole.width / 2) return std::hypot(hole.width / 2 - in_plan, p.y());
      }
      return std::hypot(std::max(0.0, std::hypot(p.x() - radius, p.z() - radius) - radius), p.y());
    });
  }

  void add_piece(const WallPiece& piece) {
    if (piece.drawn_out == DrawnOut::along)
      return add("piece", drawn_along(
                              [piece](const Flat& p) {
                                return piece.radius > 0 ? to_arc(piece, p) : to_line(piece.a, piece.b, p);
                              },
                              vessel_));
    if (piece.radius > 0)
      return add("piece", drawn_out([piece](const Flat& p) { return to_arc(piece, p); }, vessel_, space_));
    if (!piece.about) return add("piece", line(piece.a, piece.b, vessel_, space_));
    if (!deep_) return;
    const bool upright = piece.axis == PieceAxis::upright;
    const Point foot =
        upright ? Point(piece.about->x(), 0, piece.about->y()) : Point(0, piece.about->x(), piece.about->y());
    add("piece", revolved(piece.a, piece.b, foot, upright));
  }

  void add_drum_ends();

  const Vessel& vessel_;
  Space space_;
  bool deep_;
  std::vector<OwnWall> walls_;
};

/// The full circle that closes a vessel without a box; the generator draws it first.
const WallPiece* circle_of(const Vessel& vessel) {
  if (vessel.box || vessel.pieces.empty()) return nullptr;
  const WallPiece& first = vessel.pieces.front();
  double closed = 0;  // rad, of arcs that lie side by side
  for (const WallPiece& piece : vessel.pieces)
    if (piece.radius > 0 && piece.radius == first.radius && piece.centre == first.centre)
      closed += piece.to - piece.from;
  return closed > 2 * std::numbers::pi * (1 - 1e-9) ? &first : nullptr;
}

void WallMaker::add_drum_ends() {
  const WallPiece* circle = circle_of(vessel_);
  if (!deep_ || circle == nullptr || vessel_.front_and_back != Sides::walls) return;
  const WallPiece drum = *circle;
  for (const double z : {0.0, *vessel_.depth})
    add("end of the drum", [=](const Point& p) {
      return std::hypot(std::max(0.0, (p.head<2>() - drum.centre).norm() - drum.radius), p.z() - z);
    });
}

}  // namespace

std::vector<OwnWall> own_walls(const Vessel& vessel, Space space) {
  return WallMaker(vessel, space).walls();
}

std::vector<OwnWall> own_lids(const Vessel& vessel, Space space) {
  return WallMaker(vessel, space).lids();
}

OwnRoom::OwnRoom(const Vessel& vessel, Space space, double fine)
    : vessel_(vessel),
      deep_(space != Space::two_dimensional),
      fine_(fine),
      along_(static_cast<int>(vessel.length / fine)),
      up_(static_cast<int>(vessel.height / fine)),
      across_(deep_ ? static_cast<int>(*vessel.depth / fine) : 1) {
  if (circle_of(vessel_) != nullptr || (vessel.funnel == 0 && vessel.pieces.empty())) return;
  std::vector<OwnWall> walls = own_walls(vessel, space);
  for (OwnWall& lid : own_lids(vessel, space)) walls.push_back(std::move(lid));
  flood(walls);
}

std::size_t OwnRoom::index(int i, int j, int k) const {
  return static_cast<std::size_t>((std::int64_t{k} * up_ + j) * along_ + i);
}

/// Two neighbours with a wall between them are not both further from it than half their distance.
void OwnRoom::flood(const std::vector<OwnWall>& walls) {
  const double clear = 0.501 * fine_;
  reached_.assign(static_cast<std::size_t>(along_) * static_cast<std::size_t>(up_) * static_cast<std::size_t>(across_),
                  0);
  std::vector<std::array<int, 3>> front;
  const bool around = vessel_.sides == Sides::periodic, through = vessel_.front_and_back == Sides::periodic;
  const auto reach = [&](int i, int j, int k) {
    if (around) i = (i + along_) % along_;  // past one side and in at the other
    if (through) k = (k + across_) % across_;
    if (i < 0 || j < 0 || k < 0 || i >= along_ || j >= up_ || k >= across_) return;
    char& flag = reached_[index(i, j, k)];
    if (flag != 0) return;
    flag = 2;  // looked at
    const Eigen::Vector3d at = place(i, j, k);
    if (!is_between_ends(at)) return;
    for (const OwnWall& wall : walls)
      if (wall.distance(at) < clear) return;
    flag = 1;
    front.push_back({i, j, k});
  };
  for (int i = 0; i < along_; ++i)
    for (int k = 0; k < across_; ++k) reach(i, up_ - 1, k);
  while (!front.empty()) {
    const auto [i, j, k] = front.back();
    front.pop_back();
    reach(i - 1, j, k), reach(i + 1, j, k), reach(i, j - 1, k), reach(i, j + 1, k), reach(i, j, k - 1),
        reach(i, j, k + 1);
  }
}

bool OwnRoom::is_between_ends(const Eigen::Vector3d& centre) const {
  if (const WallPiece* circle = circle_of(vessel_)) {
    if ((centre.head<2>() - circle->centre).norm() > circle->radius) return false;
    return !deep_ || vessel_.front_and_back == Sides::periodic || beyond(centre.z(), 0, *vessel_.depth) == 0;
  }
  if (deep_ && vessel_.plan == Plan::round)
    return std::hypot(centre.x() - vessel_.length / 2, centre.z() - vessel_.length / 2) <= vessel_.length / 2;
  if (vessel_.sides != Sides::periodic && beyond(centre.x(), 0, vessel_.length) > 0) return false;
  return !deep_ || vessel_.front_and_back == Sides::periodic || beyond(centre.z(), 0, *vessel_.depth) == 0;
}

bool OwnRoom::contains(Eigen::Vector3d centre) const {
  if (!is_between_ends(centre) || centre.y() < 0) return false;
  if (vessel_.sides == Sides::periodic) centre.x() -= vessel_.length * std::floor(centre.x() / vessel_.length);
  if (deep_ && vessel_.front_and_back == Sides::periodic)
    centre.z() -= *vessel_.depth * std::floor(centre.z() / *vessel_.depth);
  if (reached_.empty() || centre.y() >= fine_ * up_) return true;
  const auto before = [&](double at) { return static_cast<int>(std::floor(at / fine_ - 0.5)); };
  // One of the places around it.
  for (int di = 0; di <= 1; ++di)
    for (int dj = 0; dj <= 1; ++dj)
      for (int dk = 0; dk <= (deep_ ? 1 : 0); ++dk) {
        const int i = std::clamp(before(centre.x()) + di, 0, along_ - 1);
        const int j = std::clamp(before(centre.y()) + dj, 0, up_ - 1);
        const int k = deep_ ? std::clamp(before(centre.z()) + dk, 0, across_ - 1) : 0;
        if (reached_[index(i, j, k)] == 1) return true;
      }
  return false;
}

}  // namespace vibrosow
