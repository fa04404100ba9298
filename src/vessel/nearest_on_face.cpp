#include "vessel/nearest_on_face.hpp"

#include <algorithm>
#include <cmath>

namespace vibrosow {
namespace {

/// A place in a face's own frame: along e1, e2 and the normal.
struct FacePoint {
  double u, v, h;  // m
};

FacePoint in_face(const PlacedFace& face, const Eigen::Vector3d& point) {
  const Eigen::Vector3d from = point - face.origin;
  return {from.dot(face.e1), from.dot(face.e2), from.dot(face.normal)};
}

NearestOnFace at(const PlacedFace& face, const FacePoint& centre, const FacePoint& point, bool inside, double side) {
  const double du = point.u - centre.u, dv = point.v - centre.v, dh = point.h - centre.h;
  // Straight along the normal on a face, which a level floor then has without any rounding.
  const Eigen::Vector3d apart = inside && du == 0 && dv == 0
                                    ? Eigen::Vector3d(dh * face.normal)
                                    : Eigen::Vector3d(du * face.e1 + dv * face.e2 + dh * face.normal);
  return {apart, du * du + dv * dv + dh * dh, inside, side};
}

const RoundHole* hole_below(const Face& face, const FacePoint& centre) {
  for (const RoundHole& hole : face.holes) {
    const double du = centre.u - hole.u, dv = centre.v - hole.v;
    if (du * du + dv * dv < hole.radius * hole.radius) return &hole;
  }
  return nullptr;
}

/// Of a round plate, over none of its holes.
NearestOnFace nearest_in_outline(const PlacedFace& face, const FacePoint& centre) {
  const double radius = 0.5 * face.own->length_u;
  const double du = centre.u - radius, dv = centre.v - radius, distance = std::sqrt(du * du + dv * dv);
  if (distance < radius) return at(face, centre, {centre.u, centre.v, 0}, true, centre.h);
  return at(face, centre, {radius + radius * du / distance, radius + radius * dv / distance, 0}, false, centre.h);
}

NearestOnFace nearest_on_plate(const PlacedFace& face, const FacePoint& centre) {
  const Face& own = *face.own;
  if (const RoundHole* hole = hole_below(own, centre)) {
    const double du = centre.u - hole->u, dv = centre.v - hole->v, distance = std::sqrt(du * du + dv * dv);
    // On the hole's axis all of its rim is equally near: any fixed point of it.
    const double cu = distance > 0 ? du / distance : 1, cv = distance > 0 ? dv / distance : 0;
    return at(face, centre, {hole->u + hole->radius * cu, hole->v + hole->radius * cv, 0}, false, centre.h);
  }
  if (own.round) return nearest_in_outline(face, centre);
  const FacePoint point{std::clamp(centre.u, 0.0, own.length_u), std::clamp(centre.v, 0.0, own.length_v), 0};
  const bool inside = centre.u > 0 && centre.u < own.length_u && centre.v > 0 && centre.v < own.length_v;
  return at(face, centre, point, inside, centre.h);
}

/// The nearest point of the line that is revolved to (radius, height) in its half-plane.
struct OnLine {
  double radius, height, side;  // m, m, m2
  bool inside;
};
OnLine nearest_on_line(const Face& face, double radius, double height) {
  const double er = face.radius_b - face.radius_a, eh = face.height_b - face.height_a;
  const double dr = radius - face.radius_a, dh = height - face.height_a;
  const double along = (dr * er + dh * eh) / (er * er + eh * eh), side = dr * eh - dh * er;
  const double part = std::clamp(along, 0.0, 1.0);
  // A disc has no edge on its axis.
  const bool inside =
      (along > 0 || (along == 0 && face.radius_a == 0)) && (along < 1 || (along == 1 && face.radius_b == 0));
  return {face.radius_a + part * er, face.height_a + part * eh, side, inside};
}

NearestOnFace nearest_on_revolved(const PlacedFace& face, const FacePoint& centre) {
  const double rho = std::sqrt(centre.u * centre.u + centre.v * centre.v);
  double cu = rho > 0 ? centre.u / rho : 1, cv = rho > 0 ? centre.v / rho : 0;
  const double side = nearest_on_line(*face.own, rho, centre.h).side;
  const bool beside = cu >= face.cosine_half;
  if (!beside) cu = face.cosine_half, cv = std::copysign(face.sine_half, centre.v);
  // Beyond its angles: on the nearer of its two straight edges, to whose half-plane the centre is projected.
  const double radius = beside ? rho : centre.u * cu + centre.v * cv;
  const OnLine line = nearest_on_line(*face.own, radius, centre.h);
  return at(face, centre, {line.radius * cu, line.radius * cv, line.height}, beside && line.inside, side);
}

}  // namespace

NearestOnFace nearest_on_face(const PlacedFace& face, const Eigen::Vector3d& centre) {
  const FacePoint place = in_face(face, centre);
  return face.own->kind == Face::Kind::plate ? nearest_on_plate(face, place) : nearest_on_revolved(face, place);
}

Eigen::Vector3d face_normal_at(const PlacedFace& face, const Eigen::Vector3d& point) {
  if (face.own->kind == Face::Kind::plate) return face.normal;
  const FacePoint place = in_face(face, point);
  const double rho = std::sqrt(place.u * place.u + place.v * place.v);
  const double cu = rho > 0 ? place.u / rho : 1, cv = rho > 0 ? place.v / rho : 0;
  const double er = face.own->radius_b - face.own->radius_a, eh = face.own->height_b - face.own->height_a;
  const double per_length = 1 / std::sqrt(er * er + eh * eh);
  return per_length * (eh * (cu * face.e1 + cv * face.e2) - er * face.normal);
}

}  // namespace vibrosow
