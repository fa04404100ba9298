#include "scene/clump_shape.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "portable_math/functions.hpp"
#include "scene/clump_body.hpp"
#include "scene/free_arcs.hpp"

namespace vibrosow {
namespace {

using std::numbers::pi;

/// Integral over an arc of f(x, y, dx/dt, dy/dt).
template <class Integrand>
double along_arc(const ClumpDisc& disc, const Arc& arc, Integrand f) {
  double sum = 0;
  for (const Arc& part : quarters(arc))
    sum += boost::math::quadrature::gauss<double, 20>::integrate(
        [&](double t) {
          const auto at = portable_math::sine_cosine(t);
          const double cosine = disc.radius * at.cosine, sine = disc.radius * at.sine;
          return f(disc.x + cosine, disc.y + sine, -sine, cosine);
        },
        part.from, part.to);
  return sum;
}

/// Area of the discs' union: 1/2 integral(x dy - y dx) along the free arcs, in closed form.
double covered_area(const std::vector<ClumpDisc>& discs) {
  double area = 0;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const ClumpDisc& disc = discs[i];
    for (const Arc& arc : free_arcs(discs, i))
      area +=
          0.5 * disc.radius *
          (disc.radius * (arc.to - arc.from) + disc.x * (portable_math::sin(arc.to) - portable_math::sin(arc.from)) -
           disc.y * (portable_math::cos(arc.to) - portable_math::cos(arc.from)));
  }
  return area;
}

/// What a plane at the height z cuts out of the balls whose sections the discs are.
std::vector<ClumpDisc> sections(const std::vector<ClumpDisc>& discs, double z) {
  std::vector<ClumpDisc> cut;
  for (const ClumpDisc& disc : discs)
    if (disc.radius > z) cut.push_back({disc.x, disc.y, std::sqrt((disc.radius - z) * (disc.radius + z))});
  return cut;
}

/// Heights at which a ball ends, or the sections of two part: there their area is not smooth.
std::vector<double> kink_heights(const std::vector<ClumpDisc>& discs) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    heights.push_back(discs[i].radius);
    for (std::size_t j = i + 1; j < discs.size(); ++j) {
      const double distance = portable_math::hypot(discs[j].x - discs[i].x, discs[j].y - discs[i].y),
                   r = discs[i].radius;
      const double along = (distance + (r - discs[j].radius) * (r + discs[j].radius) / distance) / 2;
      if (std::abs(along) < r) heights.push_back(std::sqrt((r - along) * (r + along)));
    }
  }
  return heights;
}

double volume_by_heights(const std::vector<ClumpDisc>& discs) {
  std::vector<double> heights = kink_heights(discs);
  heights.push_back(0);
  std::ranges::sort(heights);
  double volume = 0;
  for (std::size_t k = 1; k < heights.size(); ++k) {
    if (!(heights[k] > heights[k - 1])) continue;
    constexpr unsigned halvings = 10;  // at most
    constexpr double tolerance = 1e-10;
    volume += 2 * boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
                      [&](double z) { return covered_area(sections(discs, z)); }, heights[k - 1], heights[k], halvings,
                      tolerance);
  }
  return volume;
}

/// Whether no valley between a row's discs is deeper than `valley`, m.
bool is_smooth(const std::vector<ClumpDisc>& row, double valley) {
  for (std::size_t k = 1; k < row.size(); ++k)
    if (valley_depth(row[k - 1], row[k]) > valley) return false;
  return true;
}

/// The disc at a fraction `along` (-1 to 1) of the way from the ellipse's middle to its end disc.
ClumpDisc inscribed_disc(double length, double width, double along) {
  const double a = 0.5 * length, b = 0.5 * width, eccentricity2 = (a - b) * (a + b) / (a * a);
  return {a * eccentricity2 * along, 0, b * std::sqrt(1 - eccentricity2 * along * along)};
}

std::vector<ClumpDisc> elongated_row(double length, double width, double valley) {
  for (int count = 3; count <= most_row_discs; count += 2) {
    std::vector<ClumpDisc> row;
    for (int k = 0; k < count; ++k) {
      // Denser towards the ends, where discs are small: the valleys come out about equally deep.
      const double place = 2.0 * k / (count - 1) - 1;
      row.push_back(inscribed_disc(length, width, portable_math::sin(place * pi / 3) / portable_math::sin(pi / 3)));
    }
    if (is_smooth(row, valley)) return row;
  }
  return {};
}

std::vector<ClumpDisc> drop_row(double length, double width, double valley) {
  constexpr double tip = 0.25;  // of the width
  const double largest = 0.5 * width, smallest = tip * largest;
  const double last = length - largest - smallest;  // from the first centre
  for (int count = 3; count <= most_row_discs; ++count) {
    std::vector<ClumpDisc> row;
    for (int k = 0; k < count; ++k) {
      const double radius = largest * portable_math::pow(tip, static_cast<double>(k) / (count - 1));
      row.push_back({last * (largest - radius) / (largest - smallest), 0, radius});
    }
    if (is_smooth(row, valley)) return row;
  }
  return {};
}

/// How many balls of diameter `thickness` side by side are `width` wide and smooth enough; 0: too many.
int balls_across(double width, double thickness) {
  if (width - thickness <= deepest_valley * width) return 1;
  for (int count = 2; count <= most_balls_across; ++count) {
    const ClumpDisc ball{0, 0, 0.5 * thickness}, next{(width - thickness) / (count - 1), 0, 0.5 * thickness};
    if (valley_depth(ball, next) <= deepest_valley * width) return count;
  }
  return 0;
}

/// `row_of(length, width, valley)` makes the row.
template <class Row>
std::vector<ClumpDisc> solid(Row row_of, double length, double width, double thickness) {
  const int across = balls_across(width, thickness);
  if (across == 0) return {};
  if (across == 1) return row_of(length, std::sqrt(width * thickness), deepest_valley * width);
  std::vector<ClumpDisc> balls;
  for (const ClumpDisc& ball : row_of(length, thickness, deepest_valley * width))
    for (int k = 0; k < across; ++k) {
      const double place = 2.0 * k / (across - 1) - 1;
      balls.push_back({ball.x, place * ball.radius * (width / thickness - 1), ball.radius});
    }
  return balls;
}

}  // namespace

Plate plate_of(const std::vector<ClumpDisc>& discs) {
  // About the discs' own middle, so that a clump far from the origin loses no digits.
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const ClumpDisc& disc : discs) middle += Eigen::Vector2d(disc.x, disc.y) / static_cast<double>(discs.size());
  std::vector<ClumpDisc> near = discs;
  for (ClumpDisc& disc : near) disc.x -= middle.x(), disc.y -= middle.y();

  double area = 0, polar = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < near.size(); ++i)
    for (const Arc& arc : free_arcs(near, i)) {
      area += along_arc(near[i], arc, [](double x, double y, double dx, double dy) { return (x * dy - y * dx) / 2; });
      first.x() += along_arc(near[i], arc, [](double x, double, double, double dy) { return x * x * dy / 2; });
      first.y() += along_arc(near[i], arc, [](double, double y, double dx, double) { return -y * y * dx / 2; });
      polar += along_arc(
          near[i], arc, [](double x, double y, double dx, double dy) { return (x * x * x * dy - y * y * y * dx) / 3; });
    }
  const Eigen::Vector2d centre = first / area;
  return {area, middle + centre, polar / area - centre.squaredNorm()};
}

double volume_of_balls(const std::vector<ClumpDisc>& discs) {
  const bool in_a_row = std::ranges::all_of(discs, [&](const ClumpDisc& disc) { return disc.y == discs.front().y; });
  return in_a_row ? row_body(discs).volume : volume_by_heights(discs);
}

std::vector<ClumpDisc> about_centre_of_mass(std::vector<ClumpDisc> discs) {
  const Eigen::Vector2d centre = plate_of(discs).centre;
  for (ClumpDisc& disc : discs) disc.x -= centre.x(), disc.y -= centre.y();
  return discs;
}

double holding_radius(const std::vector<ClumpDisc>& discs) {
  double radius = 0;
  for (const ClumpDisc& disc : discs)
    radius = std::max(radius, portable_math::hypot(portable_math::hypot(disc.x, disc.y), disc.z) + disc.radius);
  return radius;
}

namespace {

struct LeaningClump {
  const std::vector<ClumpDisc>& discs;
  const std::vector<double>& weights;
  double gyration2, depth;

  /// On the side whose outward normal is (nx, ny).
  SideContacts on_side(double nx, double ny) const {
    const auto reach = [nx, ny](const ClumpDisc& disc) { return disc.x * nx + disc.y * ny + disc.radius; };
    const double furthest = reach(*std::ranges::max_element(discs, {}, reach));
    SideContacts side{0, 0, 0, 0};
    double weight = 0, arms = 0, squares = 0;
    for (std::size_t k = 0; k < discs.size(); ++k) {
      const ClumpDisc& disc = discs[k];
      if (reach(disc) < furthest - depth * disc.radius) continue;
      const double arm = disc.y * nx - disc.x * ny;
      ++side.discs;
      weight += weights[k], arms += weights[k] * arm, squares += weights[k] * arm * arm / gyration2;
      side.turning += weights[k] * disc.radius * disc.radius / gyration2;
    }
    const double apart = weight - squares;
    side.on_a_side = 0.5 * (weight + squares + std::sqrt(apart * apart + 4 * arms * arms / gyration2));
    return side;
  }
};

}  // namespace

SideContacts side_contacts(const std::vector<ClumpDisc>& discs, const std::vector<double>& weights, double gyration2,
                           double depth) {
  const LeaningClump clump{discs, weights, gyration2, depth};
  SideContacts most{1, 0, 0, 0};
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const ClumpDisc& a = discs[i];
    most.at_a_tip = std::max(most.at_a_tip, weights[i] * (1 + (a.x * a.x + a.y * a.y) / gyration2));
    most.on_a_side = std::max(most.on_a_side, weights[i]);
    most.turning = std::max(most.turning, weights[i] * a.radius * a.radius / gyration2);
    for (const ClumpDisc& b : discs) {
      // The side along the common tangent of two discs, to the left of the way from a to b.
      const double dx = b.x - a.x, dy = b.y - a.y, distance = std::sqrt(dx * dx + dy * dy);
      if (!(distance > std::abs(a.radius - b.radius))) continue;
      const double along = (a.radius - b.radius) / distance, across = std::sqrt(1 - along * along);
      const SideContacts side =
          clump.on_side((along * dx - across * dy) / distance, (along * dy + across * dx) / distance);
      most.discs = std::max(most.discs, side.discs);
      most.on_a_side = std::max(most.on_a_side, side.on_a_side);
      most.turning = std::max(most.turning, side.turning);
    }
  }
  return most;
}

double valley_depth(const ClumpDisc& a, const ClumpDisc& b) {
  const double distance = std::abs(b.x - a.x);
  if (distance <= std::abs(a.radius - b.radius)) return 0;
  if (distance > a.radius + b.radius) return std::numeric_limits<double>::infinity();
  const double along = (distance + (a.radius - b.radius) * (a.radius + b.radius) / distance) / 2;
  const double across = std::sqrt(std::max(0.0, (a.radius - along) * (a.radius + along)));
  const double sine = (a.radius - b.radius) / distance;  // of the common tangent's slope
  return a.radius - along * sine - across * std::sqrt(1 - sine * sine);
}

std::vector<ClumpDisc> elongated(double length, double width) {
  return elongated_row(length, width, deepest_valley * width);
}

std::vector<ClumpDisc> drop(double length, double width) {
  return drop_row(length, width, deepest_valley * width);
}

std::vector<ClumpDisc> elongated_solid(double length, double width, double thickness) {
  return solid(elongated_row, length, width, thickness);
}

std::vector<ClumpDisc> drop_solid(double length, double width, double thickness) {
  return solid(drop_row, length, width, thickness);
}

std::vector<ClumpDisc> dipole(double diameter, double distance) {
  return {{-0.5 * distance, 0, 0.5 * diameter}, {0.5 * distance, 0, 0.5 * diameter}};
}

}  // namespace vibrosow
