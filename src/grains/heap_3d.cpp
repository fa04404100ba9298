#include "grains/heap_3d.hpp"

#include <algorithm>
#include <cmath>

#include "compute/nearest_image.hpp"

namespace vibrosow {

Heap3d::Direction::Direction(double whole, double largest, Sides sides)
    : count(std::max<std::size_t>(1, static_cast<std::size_t>(whole / largest))),
      width(whole / static_cast<double>(count)),
      length(whole),
      periodic(sides == Sides::periodic) {}

std::size_t Heap3d::Direction::at(double place) const {
  return std::min(static_cast<std::size_t>(std::max(place, 0.0) / width), count - 1);
}

double Heap3d::Direction::apart(double a, double b) const {
  return periodic ? nearest_image(a - b, length) : a - b;
}

template <class Visit>
void Heap3d::Direction::for_each_near(double place, Visit visit) const {
  const std::size_t middle = at(place);
  visit(middle);
  if (middle > 0 || (periodic && count > 2)) visit(middle > 0 ? middle - 1 : count - 1);
  if (middle + 1 < count || (periodic && count > 2)) visit(middle + 1 < count ? middle + 1 : 0);
}

Heap3d::Heap3d(const Vessel& vessel, double largest)
    : largest_(largest), x_(vessel.length, largest, vessel.sides), z_(*vessel.depth, largest, vessel.front_and_back) {
  columns_.resize(x_.count * z_.count);
}

void Heap3d::add(const Eigen::Vector3d& centre, double radius) {
  std::vector<std::vector<Ball>>& column = columns_[x_.at(centre.x()) * z_.count + z_.at(centre.z())];
  const std::size_t row = static_cast<std::size_t>(std::max(centre.y(), 0.0) / largest_);
  if (column.size() <= row) column.resize(row + 1);
  column[row].push_back({centre.x(), centre.y(), centre.z(), radius});
}

double Heap3d::touching_height(const FloorPlace& place, double radius, double least) const {
  x_.for_each_near(place.x(), [&](std::size_t i) {
    z_.for_each_near(place.y(), [&](std::size_t k) {
      const std::vector<std::vector<Ball>>& column = columns_[i * z_.count + k];
      for (std::size_t row = column.size(); row-- > 0 && (static_cast<double>(row) + 2) * largest_ > least;)
        for (const Ball& ball : column[row]) least = std::max(least, touching_height(ball, place, radius));
    });
  });
  return least;
}

double Heap3d::touching_height(const Ball& ball, const FloorPlace& place, double radius) const {
  const double dx = x_.apart(place.x(), ball.x), dz = z_.apart(place.y(), ball.z), reach = radius + ball.radius;
  const double left2 = reach * reach - dx * dx - dz * dz;
  return left2 > 0 ? ball.y + std::sqrt(left2) : 0;
}

}  // namespace vibrosow
