#include "outflow/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace vibrosow {
namespace {

using Value = std::optional<double>;

constexpr double gram = 1e-3;  // kg
constexpr double percent = 1e-2;

const HoleOutflow& whole(const Outflow& outflow) {
  return *find_row(outflow, "all", "all");
}

constexpr std::array table = {
    Figure{"rate_g_per_s", "g per s", "g/s", gram, "mass flow through all holes, of the plane slice, in the window",
           [](const Outflow& o) { return Value(whole(o).mass_rate); }},
    Figure{"seeds_per_s", "seeds per s", "1/s", 1, "seeds through all holes, of the plane slice, in the window",
           [](const Outflow& o) { return Value(whole(o).seeds_per_s); }},
    Figure{"evenness_cv_percent", "evenness CV %", "%", percent,
           "coefficient of variation of the holes' rates, without what counting alone gives",
           [](const Outflow& o) { return o.evenness_cv; }},
    Figure{"instability_cv_percent", "instability CV %", "%", percent,
           "coefficient of variation of the whole outflow over ten equal parts of the window",
           [](const Outflow& o) { return o.instability_cv; }},
    Figure{"longest_pause_s", "pause s", "s", 1, "longest time in the window in which no seed came from any hole",
           [](const Outflow& o) { return Value(whole(o).longest_pause); }},
    Figure{"spilled_percent", "spilled %", "%", percent,
           "seeds that left over the rim, of all that left the tray in the whole run",
           [](const Outflow& o) { return Value(o.spilled_fraction); }},
};

}  // namespace

std::span<const Figure> figures() {
  return table;
}

const Figure& figure_named(std::string_view name) {
  const auto found = std::ranges::find(table, name, &Figure::name);
  if (found == table.end()) throw std::invalid_argument("there is no figure named " + std::string(name));
  return *found;
}

FigureMeans::FigureMeans(const std::vector<const Outflow*>& replicates) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    std::vector<double> values;
    for (const Outflow* one : replicates) {
      const Value value = table[i].of(*one);
      if (value && std::isfinite(*value)) values.push_back(*value);
    }
    if (!values.empty()) means_[i] = mean_with_interval(values);
  }
}

const std::optional<MeanWithInterval>& FigureMeans::operator[](const Figure& figure) const {
  return means_.at(static_cast<std::size_t>(&figure - table.data()));
}

}  // namespace vibrosow
