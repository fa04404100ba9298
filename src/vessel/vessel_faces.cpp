#include "vessel/vessel_faces.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "vessel/directions.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

using Vector = Eigen::Vector3d;

/// A plate from `corner` along two edges at right angles; edge_u x edge_v points to its positive side.
Face plate(const std::string& name, const Vector& corner, const Vector& edge_u, const Vector& edge_v) {
  Face face;
  face.name = name;
  face.origin = corner;
  face.length_u = edge_u.norm(), face.length_v = edge_v.norm();
  face.e1 = edge_u / face.length_u, face.e2 = edge_v / face.length_v;
  face.normal = cross(face.e1, face.e2);
  return face;
}

/// Over the rectangle of the floor [from_x, to_x] x [from_z, to_z], facing up.
Face level_plate(const std::string& name, double from_x, double to_x, double from_z, double to_z) {
  return plate(name, {from_x, 0, from_z}, {0, 0, to_z - from_z}, {to_x - from_x, 0, 0});
}

/// A line between two points, distance from the axis and place along it (m), turned all round the axis that passes
/// through `foot`.
Face revolved(const std::string& name, PieceAxis axis, const Vector& foot, const Eigen::Vector2d& a,
              const Eigen::Vector2d& b) {
  Face face;
  face.kind = Face::Kind::revolved;
  face.name = name;
  face.origin = foot;
  if (axis == PieceAxis::upright)
    face.e1 = Vector::UnitZ(), face.e2 = Vector::UnitX(), face.normal = Vector::UnitY();
  else
    face.e1 = Vector::UnitY(), face.e2 = Vector::UnitZ(), face.normal = Vector::UnitX();
  face.radius_a = a.x(), face.height_a = a.y(), face.radius_b = b.x(), face.height_b = b.y();
  face.half_angle = std::numbers::pi;
  return face;
}

struct Span {
  double from, to;  // m

  double length() const { return to - from; }
};

/// An arc about `centre`, `middle` the direction to the middle of it, drawn out along `normal` by `length` (m).
Face drawn_out_arc(const std::string& name, const Vector& centre, const Vector& middle, const Vector& normal,
                   double length, double radius, double angle) {
  Face face;
  face.kind = Face::Kind::revolved;
  face.name = name;
  face.origin = centre;
  face.e1 = middle, face.e2 = cross(normal, middle), face.normal = normal;
  face.radius_a = face.radius_b = radius;
  face.height_b = length;
  face.half_angle = 0.5 * angle;
  return face;
}

/// A wall's piece of the plane drawn out across.
Face drawn_out(const WallSegment& wall, const Span& z) {
  const auto at = [&](const Eigen::Vector2d& point) { return Vector(point.x(), point.y(), z.from); };
  if (wall.radius == 0) return plate(wall.name, at(wall.a), {0, 0, z.length()}, at(wall.b) - at(wall.a));
  const Eigen::Vector2d middle = unit_vector(0.5 * (wall.from + wall.to));
  return drawn_out_arc(wall.name, at(wall.centre), {middle.x(), middle.y(), 0}, Vector::UnitZ(), z.length(),
                       wall.radius, wall.to - wall.from);
}

/// A piece whose points are (z, y), drawn out along the vessel, `aside` (m) of where it is drawn.
Face drawn_along(const std::string& name, const WallPiece& piece, const Span& x, double aside) {
  const auto at = [&](const Eigen::Vector2d& point) { return Vector(x.from, point.y(), point.x() + aside); };
  if (piece.radius == 0) return plate(name, at(piece.a), at(piece.b) - at(piece.a), {x.length(), 0, 0});
  const Eigen::Vector2d middle = unit_vector(0.5 * (piece.from + piece.to));
  return drawn_out_arc(name, at(piece.centre), {0, middle.y(), middle.x()}, Vector::UnitX(), x.length(), piece.radius,
                       piece.to - piece.from);
}

Span along(const Hole& hole) {
  return {hole.centre - hole.width / 2, hole.centre + hole.width / 2};
}
Span across(const Hole& hole) {
  return {hole.across - hole.across_length / 2, hole.across + hole.across_length / 2};
}

bool is_round(const Hole& hole) {
  return hole.shape == HoleShape::round;
}

/// Where a periodic direction goes on, one period to either side: no ball gets further before it is carried over.
Span with_periods(Sides sides, double length) {
  return sides == Sides::periodic ? Span{-length, 2 * length} : Span{0, length};
}

/// Holes, and where a direction is periodic their images.
std::vector<Hole> with_images(const Vessel& vessel) {
  std::vector<Hole> holes;
  const int most_x = vessel.sides == Sides::periodic ? 1 : 0, most_z = vessel.front_and_back == Sides::periodic ? 1 : 0;
  for (int i = -most_x; i <= most_x; ++i)
    for (int k = -most_z; k <= most_z; ++k)
      for (Hole hole : vessel.holes) {
        hole.centre += i * vessel.length, hole.across += k * *vessel.depth;
        holes.push_back(hole);
      }
  return holes;
}

/// Whether every hole is a slot from front to back.
bool like_the_plane(const Vessel& vessel) {
  const double slack = 1e-9 * *vessel.depth;
  return std::ranges::all_of(vessel.holes, [&](const Hole& hole) {
    return !is_round(hole) && across(hole).from <= slack && across(hole).to >= *vessel.depth - slack;
  });
}

/// Strips between the ends of slots, each cut where slots pass through it.
void add_floor_with_slots(const std::string& name, const Span& x, const Span& z, const std::vector<Hole>& holes,
                          std::vector<Face>& faces) {
  std::vector<double> cuts = {x.from, x.to};
  for (const Hole& hole : holes) cuts.push_back(along(hole).from), cuts.push_back(along(hole).to);
  std::ranges::sort(cuts);
  int number = 0;
  for (std::size_t k = 1; k < cuts.size(); ++k) {
    const Span strip{cuts[k - 1], cuts[k]};
    if (strip.length() <= 1e-9 * x.length()) continue;
    std::vector<Span> open;
    for (const Hole& hole : holes)
      if (along(hole).from < 0.5 * (strip.from + strip.to) && along(hole).to > 0.5 * (strip.from + strip.to))
        open.push_back(across(hole));
    std::ranges::sort(open, {}, &Span::from);
    open.push_back({z.to, z.to});
    double begin = z.from;
    for (const Span& slot : open) {
      if (slot.from - begin > 1e-9 * z.length())
        faces.push_back(level_plate(name + std::to_string(++number), strip.from, strip.to, begin, slot.from));
      begin = slot.to;
    }
  }
}

void add_floor(const Vessel& vessel, const Span& z, std::vector<Face>& faces) {
  const std::vector<Hole> holes = with_images(vessel);
  const bool round = std::ranges::any_of(holes, is_round);
  if (vessel.funnel > 0)
    throw std::invalid_argument("a floor that slopes needs slots as long as the vessel is deep, or a round vessel");
  if (round && !std::ranges::all_of(holes, is_round))
    throw std::invalid_argument("round holes and slots cannot be mixed in one floor");
  const Span x = with_periods(vessel.sides, vessel.length);
  const std::string name = vessel.name + " floor ";
  if (!round) return add_floor_with_slots(name, x, z, holes, faces);
  Face face = level_plate(name + "1", x.from, x.to, z.from, z.to);
  for (const Hole& hole : holes)  // u goes across
    face.holes.push_back({hole.across - z.from, hole.centre - x.from, hole.rim_width() / 2});
  faces.push_back(face);
}

/// A flat floor ends at the wall, a funnel is a cone round the one hole. A hole as wide as the vessel leaves no floor.
void add_round_vessel(const Vessel& vessel, std::vector<Face>& faces) {
  const double radius = vessel.length / 2;
  const Vector middle(radius, 0, radius);
  if (vessel.funnel > 0) {
    const double outlet = vessel.holes.front().width / 2;
    faces.push_back(
        revolved(vessel.name + " funnel", PieceAxis::upright, middle, {outlet, 0}, {radius, highest_floor(vessel)}));
  } else if (vessel.holes.empty() || vessel.holes.front().width < vessel.length * (1 - 1e-9)) {
    add_floor(vessel, {0, vessel.length}, faces);
    faces.back().round = true;
  }
  faces.push_back(revolved(vessel.name + " wall", PieceAxis::upright, middle, {radius, 0}, {radius, vessel.height}));
}

void add_end_walls(const Vessel& vessel, const Span& z, std::vector<Face>& faces) {
  if (vessel.sides != Sides::walls) return;
  const double height = vessel.height;
  faces.push_back(plate(vessel.name + " left wall", {0, 0, z.from}, {0, height, 0}, {0, 0, z.length()}));
  faces.push_back(plate(vessel.name + " right wall", {vessel.length, 0, z.from}, {0, 0, z.length()}, {0, height, 0}));
}

void add_front_and_back(const Vessel& vessel, std::vector<Face>& faces) {
  if (vessel.front_and_back != Sides::walls) return;
  const Span x = with_periods(vessel.sides, vessel.length);
  const double height = vessel.height;
  faces.push_back(plate(vessel.name + " front", {x.from, 0, 0}, {x.length(), 0, 0}, {0, height, 0}));
  faces.push_back(plate(vessel.name + " back", {x.from, 0, *vessel.depth}, {0, height, 0}, {x.length(), 0, 0}));
}

/// A drum's discs; where the pieces make no drum the front and back are missing, as floor and end walls are.
void add_ends_of_drum(const Vessel& vessel, std::vector<Face>& faces) {
  const std::optional<DrumCircle> circle = drum_of(vessel);
  if (!circle || vessel.front_and_back != Sides::walls) return;
  for (const double z : {0.0, *vessel.depth}) {
    Face disc;
    disc.kind = Face::Kind::revolved;
    disc.name = vessel.name + (z == 0 ? " front" : " back");
    disc.origin = {circle->centre.x(), circle->centre.y(), z};
    disc.e1 = Vector::UnitX(), disc.e2 = Vector::UnitY(), disc.normal = Vector::UnitZ();
    disc.radius_b = circle->radius;
    disc.half_angle = std::numbers::pi;
    faces.push_back(disc);
  }
}

/// Where the axis of such a piece passes, in the vessel's frame.
Vector foot_of(const WallPiece& piece) {
  return piece.axis == PieceAxis::upright ? Vector(piece.about->x(), 0, piece.about->y())
                                          : Vector(0, piece.about->x(), piece.about->y());
}

/// Pieces turned about axes, and where a direction is periodic their images.
void add_revolved_pieces(const Vessel& vessel, std::vector<Face>& faces) {
  const int most_x = vessel.sides == Sides::periodic ? 1 : 0, most_z = vessel.front_and_back == Sides::periodic ? 1 : 0;
  for (std::size_t k = 0; k < vessel.pieces.size(); ++k) {
    const WallPiece& piece = vessel.pieces[k];
    if (!piece.about) continue;
    for (int i = -most_x; i <= most_x; ++i)
      for (int j = -most_z; j <= most_z; ++j)
        faces.push_back(revolved(vessel.name + " piece " + std::to_string(k + 1), piece.axis,
                                 foot_of(piece) + Vector(i * vessel.length, 0, j * vessel.depth.value()), piece.a,
                                 piece.b));
  }
}

/// Pieces drawn out along the vessel, and where the depth is periodic their images.
void add_pieces_along(const Vessel& vessel, std::vector<Face>& faces) {
  const int most_z = vessel.front_and_back == Sides::periodic ? 1 : 0;
  const Span x = with_periods(vessel.sides, vessel.length);
  for (std::size_t k = 0; k < vessel.pieces.size(); ++k)
    for (int j = -most_z; j <= most_z && vessel.pieces[k].drawn_out == DrawnOut::along; ++j)
      faces.push_back(
          drawn_along(vessel.name + " piece " + std::to_string(k + 1), vessel.pieces[k], x, j * vessel.depth.value()));
}

/// A lid over a hole and over its images.
void add_gate(const std::string& name, const Hole& hole, std::vector<Face>& faces) {
  Face face = is_round(hole)
                  ? revolved(name, PieceAxis::upright, {hole.centre, 0, hole.across}, {0, 0}, {hole.rim_width() / 2, 0})
                  : level_plate(name, along(hole).from, along(hole).to, across(hole).from, across(hole).to);
  face.opens_at = hole.open_at;
  faces.push_back(face);
}

/// A round hole's wall in a thick floor, its upper edge broken.
void add_bore(const std::string& name, const Hole& hole, std::vector<Face>& faces) {
  const Vector middle(hole.centre, 0, hole.across);
  const double radius = hole.width / 2;
  if (hole.chamfer > 0)
    faces.push_back(revolved(name, PieceAxis::upright, middle, {radius + hole.chamfer, 0}, {radius, -hole.chamfer}));
  if (hole.thickness > hole.chamfer)
    faces.push_back(revolved(name, PieceAxis::upright, middle, {radius, -hole.chamfer}, {radius, -hole.thickness}));
}

/// Floor, walls and funnel, but for what is drawn out.
void add_box(const Vessel& vessel, const Span& z, std::vector<Face>& faces) {
  if (vessel.plan == Plan::round) return add_round_vessel(vessel, faces);
  if (!like_the_plane(vessel)) add_floor(vessel, z, faces), add_end_walls(vessel, z, faces);
  add_front_and_back(vessel, faces);
}

}  // namespace

std::vector<Face> vessel_faces(const Vessel& vessel) {
  std::vector<Face> faces;
  const Span z = with_periods(vessel.front_and_back, *vessel.depth);
  if (vessel.box) add_box(vessel, z, faces);
  // What is drawn out: all of the plane's walls where holes are slots from front to back, else pieces alone.
  Vessel drawn = vessel;
  drawn.box = vessel.box && vessel.plan == Plan::rectangle && like_the_plane(vessel);
  for (Hole& hole : drawn.holes) hole.open_at = 0;
  for (const WallSegment& wall : vessel_walls(drawn)) faces.push_back(drawn_out(wall, z));
  add_pieces_along(vessel, faces);
  add_revolved_pieces(vessel, faces);
  add_ends_of_drum(vessel, faces);
  const std::vector<Hole> holes = with_images(vessel);
  for (std::size_t k = 0; k < holes.size(); ++k) {
    const std::string number = std::to_string(k % vessel.holes.size() + 1);
    add_bore(vessel.name + " hole " + number, holes[k], faces);
    if (holes[k].open_at > 0) add_gate(vessel.name + " gate " + number, holes[k], faces);
  }
  return faces;
}

double largest_radius_in_plan(const Vessel& vessel, const Eigen::Vector2d& about) {
  double largest = 0;
  const auto include = [&](const Vector& point) {
    largest = std::max(largest, (Eigen::Vector2d(point.x(), point.z()) - about).norm());
  };
  for (const Face& face : vessel_faces(vessel)) {
    if (face.kind == Face::Kind::plate) {
      for (const double u : {0.0, face.length_u})
        for (const double v : {0.0, face.length_v}) include(face.origin + u * face.e1 + v * face.e2);
      continue;
    }
    for (const auto& [radius, height] :
         {std::pair(face.radius_a, face.height_a), std::pair(face.radius_b, face.height_b)}) {
      const Vector middle = face.origin + height * face.normal;
      const double in_plan = (Eigen::Vector2d(middle.x(), middle.z()) - about).norm();
      largest = std::max(largest, in_plan + radius);
    }
  }
  return largest;
}

}  // namespace vibrosow
