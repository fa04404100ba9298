#include "fields/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace vibrosow {

std::int64_t cells_over(double length, double cell) {
  constexpr double rounding = 1e-9;  // of a cell
  return static_cast<std::int64_t>(std::ceil(length / cell - rounding));
}

Grid grid_over(const std::vector<const Snapshot*>& snapshots, double cell) {
  if (!(cell > 0)) throw std::invalid_argument("the cells of a grid need an edge above 0");
  const double infinity = std::numeric_limits<double>::infinity();
  double left = infinity, right = -infinity, bottom = infinity, top = -infinity;
  for (const Snapshot* s : snapshots)
    for (std::size_t i = 0; i < s->size(); ++i) {
      left = std::min(left, s->x[i] - s->radius[i]), right = std::max(right, s->x[i] + s->radius[i]);
      bottom = std::min(bottom, s->y[i] - s->radius[i]), top = std::max(top, s->y[i] + s->radius[i]);
    }
  Grid grid;
  grid.cell = cell;
  if (left > right) return grid;
  const auto below = [&](double at) { return static_cast<std::int64_t>(std::floor(at / cell)); };
  grid.first_column = below(left), grid.first_row = below(bottom);
  grid.columns = below(right) - grid.first_column + 1, grid.rows = below(top) - grid.first_row + 1;
  return grid;
}

}  // namespace vibrosow
