#include "study/study_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "input/key_units.hpp"
#include "portable_math/functions.hpp"
#include "scene/input_error.hpp"
#include "study/latin_hypercube.hpp"

namespace vibrosow {
namespace {

/// To so many digits: 0.1 + 2 * 0.1 is 0.3.
double rounded(double value, int digits) {
  if (value == 0) return 0;
  const int places = digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  const double unit = portable_math::pow(10.0, std::abs(places));
  return places > 0 ? std::round(value * unit) / unit : std::round(value / unit) * unit;
}

/// The ends of a table { from, to } or { from, to, step }.
struct Range {
  TomlValue from, to;
  const TomlValue* step;  // none: every value between
};

Range range_in(const TomlTable& table) {
  for (const TomlEntry& entry : table.entries)
    if (entry.key != "from" && entry.key != "to" && entry.key != "step")
      throw std::invalid_argument(fmt::format("a range has from, to and step, not \"{}\"", entry.key));
  const auto end = [&](std::string_view word) {
    const TomlEntry* entry = table.find(word);
    if (entry == nullptr)
      throw std::invalid_argument(fmt::format("a range needs from, to and step; {} is missing", word));
    return entry->value;
  };
  const TomlEntry* const step = table.find("step");
  return {end("from"), end("to"), step != nullptr ? &step->value : nullptr};
}

/// The values of one varied key: a list, one value, or a table { from, to, step }.
std::vector<TomlValue> values_of(const Override& varied) {
  if (const auto* list = varied.value->get<TomlValue::List>()) return *list;
  const auto* table = varied.value->get<TomlTable>();
  if (table == nullptr) return {*varied.value};
  const Range range = range_in(*table);
  if (range.step == nullptr)
    throw std::invalid_argument(
        "a range needs from, to and step; step is missing (a study with proposals may leave it out)");
  return range_values(varied.key, range.from, range.to, *range.step);
}

/// The value at a share (0 to 1) of the way through a varied key's values.
class Spread {
 public:
  explicit Spread(const Override& varied) : key_(varied.key) {
    const auto* table = varied.value->get<TomlTable>();
    const std::optional<Range> range = table != nullptr ? std::optional(range_in(*table)) : std::nullopt;
    if (!range || range->step != nullptr)
      values_ = values_of(varied);
    else if (range->from.get<std::int64_t>() != nullptr && range->to.get<std::int64_t>() != nullptr)
      values_ = range_values(key_, range->from, range->to, TomlValue{std::int64_t{1}});
    else
      set_ends(*range);
    if (values_.empty() && !from_) throw std::invalid_argument("an empty list; at least one value is needed");
  }

  std::size_t values() const { return from_ ? VariedSpace::parts_of_a_continuum : values_.size(); }

  TomlValue at(double share) const {
    if (!from_) return values_[static_cast<std::size_t>(share * static_cast<double>(values_.size()))];
    constexpr int digits = 4;  // as a drawing has them
    const double number = rounded(from_->number + share * length_, digits);
    return column_unit(key_) ? TomlValue{Quantity{number, from_->unit}} : value_of_column(key_, "", number);
  }

 private:
  void set_ends(const Range& range) {
    from_ = quantity_of(key_, range.from);
    const double from = value_of(key_, *from_), to = value_of(key_, quantity_of(key_, range.to));
    if (!std::isfinite(from) || !std::isfinite(to) || to <= from)
      throw std::invalid_argument("a range without a step leads from a number to a larger one");
    const auto unit = column_unit(key_);
    length_ = (to - from) / (unit ? unit_size(from_->unit, unit->dimension) : 1);
  }

  std::string key_;
  std::vector<TomlValue> values_;
  std::optional<Quantity> from_{};  // of a range without a step
  double length_ = 0;               // of it, in the unit of its start
};

/// What `make` gives of a varied key, or why it cannot as an error of its line.
template <class Make>
auto of_key(Table& vary, const Override& varied, Make make) {
  try {
    return make(varied);
  } catch (const std::invalid_argument& error) {
    vary.fail(varied.key, error.what());
  } catch (const UnitError& error) {
    vary.fail(varied.key, error.what());
  }
}

}  // namespace

Quantity quantity_of(const std::string& key, const TomlValue& value) {
  if (const auto* whole = value.get<std::int64_t>()) return {static_cast<double>(*whole), ""};
  if (const auto* number = value.get<double>()) return {*number, ""};
  const auto* typed = value.get<Quantity>();
  const auto* text = value.get<std::string>();
  if (typed == nullptr && text == nullptr)
    throw std::invalid_argument(fmt::format("{} is not a number", toml_text(value)));
  Quantity quantity = typed != nullptr ? *typed : split_quantity(*text);
  if (!column_unit(key) && !quantity.unit.empty())
    throw std::invalid_argument(fmt::format("{}: a plain number is expected", toml_text(value)));
  return quantity;
}

double value_of(const std::string& key, const Quantity& quantity) {
  const auto unit = column_unit(key);
  return unit ? in_si(quantity, unit->dimension) : quantity.number;
}

std::vector<TomlValue> range_values(const std::string& key, const TomlValue& from, const TomlValue& to,
                                    const TomlValue& step) {
  const Quantity start = quantity_of(key, from);
  const double first = value_of(key, start), last = value_of(key, quantity_of(key, to));
  const double by = value_of(key, quantity_of(key, step));
  if (!std::isfinite(first) || !std::isfinite(last) || !std::isfinite(by))
    throw std::invalid_argument("a range is of finite numbers");
  const double steps = (last - first) / by;
  if (by == 0 || steps < 0) throw std::invalid_argument("the range's step does not lead from its start to its end");
  if (steps > static_cast<double>(most_layouts))
    throw std::invalid_argument(fmt::format("the range has more than {} values", most_layouts));
  if (std::abs(steps - std::round(steps)) > 1e-6)
    throw std::invalid_argument(
        fmt::format("a step of {} from {} does not end at {}", toml_text(step), toml_text(from), toml_text(to)));

  const auto unit = column_unit(key);
  const double size = unit ? unit_size(start.unit, unit->dimension) : 1;
  std::vector<TomlValue> values;
  for (int i = 0; i <= static_cast<int>(std::round(steps)); ++i) {
    const double number = rounded(start.number + i * by / size, 12);
    if (unit) {
      values.push_back({Quantity{number, start.unit}});
    } else {
      values.push_back(value_of_column(key, "", number));
    }
  }
  return values;
}

std::vector<Changes> read_grid(Table& vary) {
  std::vector<Changes> grid{{}};
  for (const Override& varied : vary.dotted_values()) {
    const std::vector<TomlValue> values = of_key(vary, varied, values_of);
    if (values.empty()) vary.fail(varied.key, "an empty list; at least one value is needed");
    if (grid.size() * values.size() > most_layouts)
      vary.fail(varied.key, fmt::format("the grid has more than {} layouts", most_layouts));
    std::vector<Changes> longer;
    longer.reserve(grid.size() * values.size());
    for (const Changes& point : grid) {
      for (const TomlValue& value : values) {
        longer.push_back(point);
        longer.back().push_back({varied.key, value, varied.where});
      }
    }
    grid = std::move(longer);
  }
  return grid;
}

VariedSpace::VariedSpace(Table& vary) : keys_(vary.dotted_values()) {
  for (const Override& varied : keys_) {
    const Spread spread = of_key(vary, varied, [](const Override& key) { return Spread(key); });
    values_.push_back(spread.values());
    value_at_.emplace_back([spread](double share) { return spread.at(share); });
  }
}

std::vector<std::string> VariedSpace::names() const {
  std::vector<std::string> names;
  for (const Override& varied : keys_) names.push_back(varied.key);
  return names;
}

Changes VariedSpace::at(const std::vector<double>& point) const {
  Changes changes;
  for (std::size_t k = 0; k < keys_.size(); ++k)
    changes.push_back({keys_[k].key, value_at_[k](point.at(k)), keys_[k].where});
  return changes;
}

std::vector<Changes> read_proposals(Table& vary, std::size_t points) {
  const VariedSpace space(vary);
  std::vector<Changes> proposals;
  for (const std::vector<double>& point : latin_hypercube(points, space.axes())) proposals.push_back(space.at(point));
  return proposals;
}

}  // namespace vibrosow
