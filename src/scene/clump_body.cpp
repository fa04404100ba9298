#include "scene/clump_body.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <optional>

#include "portable_math/functions.hpp"
#include "scene/cross_product.hpp"
#include "scene/free_arcs.hpp"

namespace vibrosow {
namespace {

using std::numbers::pi;

/// Calls `take(x, weight)` for the points of Gauss' rule on [from, to].
template <unsigned points, class Take>
void for_each_point(double from, double to, Take take) {
  using Rule = boost::math::quadrature::gauss<double, points>;
  static_assert(points % 2 == 0);
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k)
    for (const double side : {-1.0, 1.0}) take(middle + side * half * Rule::abscissa()[k], half * Rule::weights()[k]);
}

/// Integrals over a body of 1, r and r r^T.
struct Moments {
  double volume = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  Body body() const {
    const Eigen::Vector3d centre = first / volume;
    return {volume, centre, second / volume - centre * centre.transpose()};
  }
};

/// Adds what a section at the height z, `weight` thick, contributes. In it the integrals of 1, x, y, x^2, y^2 and x y
/// are those of x dy, x^2 / 2 dy, -y^2 / 2 dx, x^3 / 3 dy, -y^3 / 3 dx and x^2 y / 2 dy along the arcs.
void add_section(const std::vector<ClumpDisc>& discs, double z, double weight, Moments& moments) {
  double area = 0, x1 = 0, y1 = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < discs.size(); ++i)
    for (const Arc& arc : free_arcs(discs, i))
      for (const Arc& part : quarters(arc))
        for_each_point<20>(part.from, part.to, [&](double angle, double w) {
          const auto [sine, cosine] = portable_math::sine_cosine(angle);
          const double x = discs[i].x + discs[i].radius * cosine, y = discs[i].y + discs[i].radius * sine;
          const double dx = -discs[i].radius * sine * w, dy = discs[i].radius * cosine * w;
          area += x * dy, x1 += x * x / 2 * dy, y1 -= y * y / 2 * dx;
          xx += x * x * x / 3 * dy, yy -= y * y * y / 3 * dx, xy += x * x * y / 2 * dy;
        });
  moments.volume += weight * area;
  moments.first += weight * Eigen::Vector3d(x1, y1, z * area);
  moments.second += weight * Eigen::Matrix3d{{xx, xy, z * x1}, {xy, yy, z * y1}, {z * x1, z * y1, z * z * area}};
}

std::vector<ClumpDisc> sections_at(const std::vector<ClumpDisc>& balls, double z) {
  std::vector<ClumpDisc> cut;
  for (const ClumpDisc& ball : balls) {
    const double width2 = (ball.radius - (z - ball.z)) * (ball.radius + (z - ball.z));
    if (width2 > 0) cut.push_back({ball.x, ball.y, std::sqrt(width2)});
  }
  return cut;
}

/// Heights at which the pattern of a union's sections changes: where on its surface a ball begins or ends, the circle
/// in which two balls meet does, or three balls meet.
class PatternHeights {
 public:
  explicit PatternHeights(const std::vector<ClumpDisc>& balls) : balls_(balls) {
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      const Eigen::Vector3d up(0, 0, balls_[i].radius);
      add(centre_of(balls_[i]) + up), add(centre_of(balls_[i]) - up);
      for (std::size_t j = i + 1; j < balls_.size(); ++j) {
        add_circle(balls_[i], balls_[j]);
        for (std::size_t k = j + 1; k < balls_.size(); ++k) add_corners(balls_[i], balls_[j], balls_[k]);
      }
    }
    std::ranges::sort(heights_);
  }
  const std::vector<double>& sorted() const { return heights_; }

 private:
  /// Unless it lies within a ball.
  void add(const Eigen::Vector3d& point) {
    constexpr double within = 1 - 1e-9;
    const auto holds = [&](const ClumpDisc& ball) {
      return (point - centre_of(ball)).squaredNorm() < within * ball.radius * ball.radius;
    };
    if (std::ranges::none_of(balls_, holds)) heights_.push_back(point.z());
  }

  void add_circle(const ClumpDisc& a, const ClumpDisc& b) {
    const Eigen::Vector3d apart = centre_of(b) - centre_of(a);
    const double distance = apart.norm();
    if (distance == 0) return;
    const double along = (distance + (a.radius - b.radius) * (a.radius + b.radius) / distance) / 2;
    const double radius2 = (a.radius - along) * (a.radius + along);
    if (radius2 <= 0) return;
    const Eigen::Vector3d axis = apart / distance, middle = centre_of(a) + along * axis;
    const Eigen::Vector3d rise = Eigen::Vector3d(0, 0, 1) - axis.z() * axis;
    const double slope = rise.norm();
    constexpr double level = 1e-9;
    if (slope < level) {
      heights_.push_back(middle.z());
      return;
    }
    const Eigen::Vector3d top = std::sqrt(radius2) / slope * rise;
    add(middle + top), add(middle - top);
  }

  /// The two points that three spheres have in common, by trilateration.
  void add_corners(const ClumpDisc& a, const ClumpDisc& b, const ClumpDisc& c) {
    const Eigen::Vector3d to_b = centre_of(b) - centre_of(a), to_c = centre_of(c) - centre_of(a);
    const double distance = to_b.norm();
    if (distance == 0) return;
    const Eigen::Vector3d e1 = to_b / distance;
    const double i = e1.dot(to_c);
    const Eigen::Vector3d aside = to_c - i * e1;
    const double j = aside.norm();
    constexpr double in_line = 1e-12;
    if (j <= in_line * distance) return;
    const Eigen::Vector3d e2 = aside / j;
    const double x = (distance + (a.radius - b.radius) * (a.radius + b.radius) / distance) / 2;
    const double y = ((a.radius - c.radius) * (a.radius + c.radius) + i * i + j * j - 2 * i * x) / (2 * j);
    const double z2 = a.radius * a.radius - x * x - y * y;
    if (z2 <= 0) return;
    const Eigen::Vector3d foot = centre_of(a) + x * e1 + y * e2, up = std::sqrt(z2) * cross(e1, e2);
    add(foot + up), add(foot - up);
  }

  const std::vector<ClumpDisc>& balls_;
  std::vector<double> heights_;
};

/// About the balls' own middle, so that a clump far from the origin loses no digits.
Body body_by_sections(std::vector<ClumpDisc> balls) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const ClumpDisc& ball : balls) middle += centre_of(ball) / static_cast<double>(balls.size());
  for (ClumpDisc& ball : balls) ball.x -= middle.x(), ball.y -= middle.y(), ball.z -= middle.z();
  const PatternHeights pattern(balls);
  const std::vector<double>& heights = pattern.sorted();
  const double least = 1e-13 * (heights.back() - heights.front());
  Moments moments;
  for (std::size_t k = 1; k < heights.size(); ++k) {
    const double from = heights[k - 1], height = heights[k] - from;
    if (height <= least) continue;
    // Roots of the distance from a change become smooth in s, of which the distance is the square.
    for_each_point<30>(0, 1, [&](double s, double weight) {
      const double z = from + height * s * s * (3 - 2 * s);
      add_section(sections_at(balls, z), z, weight * height * 6 * s * (1 - s), moments);
    });
  }
  Body body = moments.body();
  body.centre += middle;
  return body;
}

/// The direction of the line on which all balls lie, its largest component positive; nothing when they do not.
std::optional<Eigen::Vector3d> common_line(const std::vector<ClumpDisc>& balls) {
  constexpr double in_line = 1e-12;
  const auto from_first = [&](const ClumpDisc& ball) { return Eigen::Vector3d(centre_of(ball) - centre_of(balls[0])); };
  Eigen::Vector3d furthest = Eigen::Vector3d::Zero();
  for (const ClumpDisc& ball : balls)
    if (from_first(ball).squaredNorm() > furthest.squaredNorm()) furthest = from_first(ball);
  const double distance = furthest.norm();
  if (distance == 0) return Eigen::Vector3d(1, 0, 0);
  Eigen::Vector3d line = furthest / distance;
  const auto aside = [&](const ClumpDisc& ball) {
    return (from_first(ball) - from_first(ball).dot(line) * line).norm() > in_line * distance;
  };
  if (std::ranges::any_of(balls, aside)) return std::nullopt;
  if (line.maxCoeff() < -line.minCoeff()) line = -line;
  return line;
}

/// The balls in line, along x from the first.
std::vector<ClumpDisc> along_x(const std::vector<ClumpDisc>& balls, const Eigen::Vector3d& line) {
  std::vector<ClumpDisc> row;
  for (const ClumpDisc& ball : balls)
    row.push_back({(centre_of(ball) - centre_of(balls[0])).dot(line), 0, ball.radius});
  return row;
}

/// Turns the axes so that a symmetric matrix becomes diagonal, by Jacobi's rotations; what lies aside by less than the
/// integration's error is none. The columns of the result are the axes.
Eigen::Matrix3d principal_axes(Eigen::Matrix3d matrix) {
  const double nothing = 1e-10 * matrix.trace();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  constexpr int most_sweeps = 50;  // five or six do
  for (int sweep = 0; sweep < most_sweeps; ++sweep)
    for (const auto& [p, q] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
      if (std::abs(matrix(p, q)) <= (sweep == 0 ? nothing : 1e-6 * nothing)) continue;
      const double ratio = (matrix(q, q) - matrix(p, p)) / (2 * matrix(p, q));
      const double tangent = std::copysign(1.0, ratio) / (std::abs(ratio) + std::sqrt(ratio * ratio + 1));
      const double cosine = 1 / std::sqrt(tangent * tangent + 1), sine = tangent * cosine;
      Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
      turn(p, p) = turn(q, q) = cosine, turn(p, q) = sine, turn(q, p) = -sine;
      matrix = (turn.transpose() * matrix * turn).eval();
      axes = (axes * turn).eval();
    }
  return axes;
}

}  // namespace

RowBody row_body(const std::vector<ClumpDisc>& row) {
  std::vector<double> places;
  for (const ClumpDisc& a : row) {
    places.insert(places.end(), {a.x - a.radius, a.x + a.radius});
    for (const ClumpDisc& b : row)
      if (b.x > a.x) places.push_back(0.5 * (a.x + b.x + (a.radius - b.radius) * (a.radius + b.radius) / (b.x - a.x)));
  }
  std::ranges::sort(places);
  double volume = 0, first = 0, second = 0, fourth = 0;
  for (std::size_t k = 1; k < places.size(); ++k) {
    const double from = places[k - 1], to = places[k], middle = 0.5 * (from + to);
    const auto width2 = [middle](const ClumpDisc& ball) {
      return (ball.radius - (middle - ball.x)) * (ball.radius + (middle - ball.x));
    };
    const ClumpDisc widest = *std::ranges::max_element(row, {}, width2);
    if (width2(widest) <= 0) continue;
    // With u = x - middle: the radius squared is w - 2 d u - u^2.
    const double half = 0.5 * (to - from), w = width2(widest), d = middle - widest.x;
    const double half3 = half * half * half, half5 = half3 * half * half;
    const double slice = 2 * half * pi * (w - half * half / 3), lean = -pi * 4 / 3 * d * half3;
    volume += slice;
    first += middle * slice + lean;
    second += middle * middle * slice + 2 * middle * lean + pi * (2 * w * half3 / 3 - 2 * half5 / 5);
    fourth += pi * (2 * half * w * w + (4 * d * d - 2 * w) * 2 * half3 / 3 + 2 * half5 / 5);
  }
  const double centre = first / volume;
  return {volume, centre, second / volume - centre * centre, fourth / 4 / volume};
}

Body body_of_balls(const std::vector<ClumpDisc>& balls) {
  const std::optional<Eigen::Vector3d> line = common_line(balls);
  if (!line) return body_by_sections(balls);
  const RowBody row = row_body(along_x(balls, *line));
  const Eigen::Matrix3d on_line = *line * line->transpose();
  return {row.volume, centre_of(balls[0]) + row.centre * *line,
          row.along * on_line + row.across * (Eigen::Matrix3d::Identity() - on_line)};
}

SolidClump solid_clump(const std::vector<ClumpDisc>& balls) {
  if (const std::optional<Eigen::Vector3d> line = common_line(balls)) {
    SolidClump clump{along_x(balls, *line), {}};
    const RowBody row = row_body(clump.balls);
    for (ClumpDisc& ball : clump.balls) ball.x -= row.centre;
    clump.gyration2 = {2 * row.across, row.across + row.along, row.across + row.along};
    return clump;
  }
  const Body body = body_of_balls(balls);
  const Eigen::Matrix3d axes = principal_axes(body.spread);
  const Eigen::Vector3d spread = (axes.transpose() * body.spread * axes).diagonal();
  SolidClump clump{balls, Eigen::Vector3d::Constant(spread.sum()) - spread};
  for (ClumpDisc& ball : clump.balls) {
    const Eigen::Vector3d at = axes.transpose() * (centre_of(ball) - body.centre);
    ball.x = at.x(), ball.y = at.y(), ball.z = at.z();
  }
  return clump;
}

}  // namespace vibrosow
