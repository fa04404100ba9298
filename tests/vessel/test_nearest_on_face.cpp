// The nearest point of a face against all of its points, tried on a grid.
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "vessel/nearest_on_face.hpp"

namespace vibrosow {
namespace {

double uniform(double from, double to) {
  return from + (to - from) * *rc::gen::inRange(0, 1000001) / 1e6;
}
Eigen::Vector3d random_point(double size) {
  return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
}

PlacedFace placed(const Face& face) {
  PlacedFace made;
  made.own = &face;
  made.origin = face.origin, made.e1 = face.e1, made.e2 = face.e2, made.normal = face.normal;
  made.now = made.on_mean = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  made.sine_half = std::sin(face.half_angle), made.cosine_half = std::cos(face.half_angle);
  return made;
}

void turn_at_random(Face& face) {
  Eigen::Quaterniond q(uniform(0.1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
  const Eigen::Matrix3d turn = q.normalized().toRotationMatrix();
  face.e1 = turn.col(0), face.e2 = turn.col(1), face.normal = turn.col(2);
  face.origin = random_point(0.1);
}

Face random_plate() {
  Face face;
  face.length_u = uniform(0.05, 0.2), face.length_v = uniform(0.05, 0.2);
  const int holes = *rc::gen::inRange(0, 3);
  for (int k = 0; k < holes; ++k)  // side by side along u
    face.holes.push_back({face.length_u * (k + 1) / (holes + 1), face.length_v / 2,
                          uniform(0.1, 0.45) * std::min(face.length_u / (holes + 1), face.length_v)});
  turn_at_random(face);
  return face;
}

Face random_round_plate() {
  Face face;
  face.round = true;
  face.length_u = face.length_v = uniform(0.05, 0.2);
  const double radius = 0.5 * face.length_u;
  const int holes = *rc::gen::inRange(0, 3);
  for (int k = 0; k < holes; ++k)
    face.holes.push_back({radius * (1 + (k == 0 ? -0.5 : 0.5)), radius, uniform(0.1, 0.45) * radius});
  turn_at_random(face);
  return face;
}

Face random_revolved() {
  Face face;
  face.kind = Face::Kind::revolved;
  face.radius_a = *rc::gen::element(0.0, 0.05, 0.1), face.radius_b = uniform(0.03, 0.1);
  face.height_b = *rc::gen::element(0.0, 0.05, 0.1);
  if (face.height_b == 0 && std::abs(face.radius_b - face.radius_a) < 0.01) face.radius_b = face.radius_a + 0.03;
  face.half_angle = *rc::gen::element(std::numbers::pi, 2.0, 0.8);
  turn_at_random(face);
  return face;
}

/// Points all over a face, on its edges and rims.
std::vector<Eigen::Vector3d> points_of(const Face& face, int steps) {
  std::vector<Eigen::Vector3d> points;
  const auto add = [&](double u, double v, double h) {
    points.push_back(face.origin + u * face.e1 + v * face.e2 + h * face.normal);
  };
  if (face.kind == Face::Kind::revolved) {
    for (int i = 0; i <= steps; ++i)
      for (int k = 0; k <= steps; ++k) {
        const double part = static_cast<double>(i) / steps, angle = face.half_angle * (2.0 * k / steps - 1);
        const double radius = face.radius_a + part * (face.radius_b - face.radius_a);
        add(radius * std::cos(angle), radius * std::sin(angle), face.height_a + part * (face.height_b - face.height_a));
      }
    return points;
  }
  for (int i = 0; i <= steps; ++i)
    for (int k = 0; k <= steps; ++k) {
      const double u = face.length_u * i / steps, v = face.length_v * k / steps;
      bool material =
          !face.round || std::hypot(u - 0.5 * face.length_u, v - 0.5 * face.length_v) <= 0.5 * face.length_u;
      for (const RoundHole& hole : face.holes) material &= std::hypot(u - hole.u, v - hole.v) >= hole.radius;
      if (material) add(u, v, 0);
    }
  for (const RoundHole& hole : face.holes)
    for (int k = 0; k < 4 * steps; ++k) {
      const double angle = 2 * std::numbers::pi * k / (4 * steps);
      add(hole.u + hole.radius * std::cos(angle), hole.v + hole.radius * std::sin(angle), 0);
    }
  for (int k = 0; face.round && k < 8 * steps; ++k) {
    const double angle = 2 * std::numbers::pi * k / (8 * steps), radius = 0.5 * face.length_u;
    add(radius * (1 + std::cos(angle)), radius * (1 + std::sin(angle)), 0);
  }
  return points;
}

void expect_nearest(const Face& face) {
  const Eigen::Vector3d centre = face.origin + random_point(0.25);
  const NearestOnFace nearest = nearest_on_face(placed(face), centre);
  const Eigen::Vector3d point = centre + nearest.apart;
  constexpr int steps = 120;
  double on_grid = 1, from_point = 1;
  for (const Eigen::Vector3d& other : points_of(face, steps)) {
    on_grid = std::min(on_grid, (other - centre).norm());
    from_point = std::min(from_point, (other - point).norm());
  }
  constexpr double spacing = 0.65 / steps;  // m, of the coarsest grid: a turn of a radius of 0.1
  RC_ASSERT(std::abs(std::sqrt(nearest.distance2) - nearest.apart.norm()) < 1e-15);
  RC_ASSERT(nearest.apart.norm() <= on_grid + 1e-12);
  RC_ASSERT(on_grid <= nearest.apart.norm() + spacing);
  RC_ASSERT(from_point <= spacing);
}

RC_GTEST_PROP(NearestOnFace, PlatesWithHoles, ()) {
  expect_nearest(random_plate());
}
RC_GTEST_PROP(NearestOnFace, RoundPlatesWithHoles, ()) {
  expect_nearest(random_round_plate());
}
RC_GTEST_PROP(NearestOnFace, CylindersConesDiscsAndRings, ()) {
  expect_nearest(random_revolved());
}

RC_GTEST_PROP(NearestOnFace, TheNormalPointsToThePositiveSide, ()) {
  const Face face = *rc::gen::arbitrary<bool>() ? random_plate() : random_revolved();
  const PlacedFace at = placed(face);
  for (int k = 0; k < 20; ++k) {
    const Eigen::Vector3d centre = face.origin + random_point(0.2);
    const NearestOnFace nearest = nearest_on_face(at, centre);
    if (!nearest.inside || nearest.distance2 < 1e-8) continue;
    const Eigen::Vector3d normal = face_normal_at(at, centre + nearest.apart);
    RC_ASSERT((std::copysign(1.0, -nearest.side) * normal - nearest.apart.normalized()).norm() < 1e-9);
  }
}

TEST(NearestOnFace, ALevelPlateIsStraightBelow) {
  Face face;
  face.origin = {0.1, 0.2, 0.3};
  face.e1 = Eigen::Vector3d::UnitZ(), face.e2 = Eigen::Vector3d::UnitX(), face.normal = Eigen::Vector3d::UnitY();
  face.length_u = face.length_v = 1;
  const NearestOnFace nearest = nearest_on_face(placed(face), {0.4321, 0.25, 0.5678});
  EXPECT_EQ(nearest.apart.x(), 0);
  EXPECT_EQ(nearest.apart.z(), 0);
  EXPECT_TRUE(nearest.inside);
  EXPECT_GT(nearest.side, 0);
}

TEST(NearestOnFace, OverAHoleTheRimIsNearest) {
  Face face;
  face.length_u = face.length_v = 0.1;
  face.holes = {{0.05, 0.05, 0.01}};
  const NearestOnFace nearest = nearest_on_face(placed(face), {0.056, 0.05, 0.003});
  EXPECT_FALSE(nearest.inside);
  EXPECT_NEAR(nearest.apart.x(), 0.004, 1e-15);
  EXPECT_NEAR(nearest.apart.z(), -0.003, 1e-15);
  EXPECT_TRUE(nearest_on_face(placed(face), {0.0601, 0.05, 0.003}).inside);
}

}  // namespace
}  // namespace vibrosow
