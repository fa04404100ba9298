#include "input/measured.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "input/key_units.hpp"
#include "input/wording.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

/// How a cumulative curve is made of what a balance shows.
enum class Balance {
  of_what_left,            // as it stands
  of_what_is_left_behind,  // under the vessel: the first reading less each
  not_tared,               // with the weight of the container: each less the first reading
};

/// A column that states a quantity, and the column that must stand beside it.
struct QuantityColumn {
  std::string_view name;
  std::string_view beside;  // "": none
  MeasuredQuantity quantity;
  Balance balance = Balance::of_what_left;
};

constexpr std::array quantity_columns = {
    QuantityColumn{"caught_g", "duration_s", MeasuredQuantity::mass_rate},
    QuantityColumn{"caught_seeds", "duration_s", MeasuredQuantity::seed_rate},
    QuantityColumn{"rate_g_per_s", "", MeasuredQuantity::mass_rate},
    QuantityColumn{"seeds_per_s", "", MeasuredQuantity::seed_rate},
    QuantityColumn{"mass_g", "time_s", MeasuredQuantity::mass_curve},
    QuantityColumn{"remaining_g", "time_s", MeasuredQuantity::mass_curve, Balance::of_what_is_left_behind},
    QuantityColumn{"gross_g", "time_s", MeasuredQuantity::mass_curve, Balance::not_tared},
    QuantityColumn{"seeds", "time_s", MeasuredQuantity::seed_curve},
    QuantityColumn{"discharged_percent", "time_s", MeasuredQuantity::fraction_curve},
};
constexpr std::string_view one_quantity_needed =
    "exactly one quantity is needed: caught_g or caught_seeds with duration_s; rate_g_per_s; seeds_per_s; or "
    "time_s with mass_g (remaining_g of a balance under the vessel, gross_g of one under what catches, not tared), "
    "seeds or "
    "discharged_percent";

/// Of what is not zero, in the unit of its column: beyond any seeder, and within them rates and misfits stay finite.
constexpr double least_value = 1e-6, most_value = 1e9;
constexpr double shortest_span = 1e-3, earliest = 1e-9, latest = 1e6;  // s

constexpr std::array<std::string_view, 4> label_columns = {"hole", "lot", "repeat", "note"};
constexpr std::array<std::string_view, 2> companion_columns = {"duration_s", "time_s"};

std::vector<std::string> known_plain_columns() {
  std::vector<std::string> known(label_columns.begin(), label_columns.end());
  known.insert(known.end(), companion_columns.begin(), companion_columns.end());
  for (const QuantityColumn& column : quantity_columns) known.emplace_back(column.name);
  return known;
}

double unit_of(MeasuredQuantity quantity) {
  switch (quantity) {
    case MeasuredQuantity::mass_rate:
      return unit_size("g/s", Dimension::mass_rate);
    case MeasuredQuantity::mass_curve:
      return unit_size("g", Dimension::mass);
    case MeasuredQuantity::fraction_curve:
      return unit_size("%", Dimension::fraction);
    case MeasuredQuantity::seed_rate:
    case MeasuredQuantity::seed_curve:
      break;
  }
  return 1;
}

/// Reads the rows of one file. Column indices are found once, in the header.
class Reader {
 public:
  explicit Reader(const CsvLines& csv) : csv_(csv) { read_header(); }

  MeasuredTable read() {
    for (const CsvLines::Row& row : csv_.rows) read_row(row);
    MeasuredTable table;
    table.quantity = quantity_->quantity;
    for (const auto& [index, key] : conditions_) table.condition_keys.push_back(key);
    for (const Gathered& one : gathered_) table.series.push_back(average(one));
    return table;
  }

 private:
  /// Values of one series before repeats are averaged; a rate stands at time 0.
  struct Reading {
    std::string repeat;
    double value;  // SI
  };
  struct Gathered {
    MeasuredSeries series;
    int line;
    std::map<double, std::vector<Reading>> values_at;
    std::map<double, int> line_at;                     // of the first row of a time
    std::set<std::pair<double, std::string>> repeats;  // that have a name
  };

  [[noreturn]] void fail(int line, std::string_view column, std::string_view message) const {
    throw InputError(fmt::format("{}:{}: {}: {}", csv_.file, line, column, message));
  }

  const std::string& header(std::size_t index) const { return csv_.header.fields[index]; }

  std::optional<std::size_t> column(std::string_view name) const {
    const auto found = std::ranges::find(csv_.header.fields, name);
    if (found == csv_.header.fields.end()) return std::nullopt;
    return static_cast<std::size_t>(found - csv_.header.fields.begin());
  }

  void read_header() {
    const int line = csv_.header.line;
    const std::vector<std::string> known = known_plain_columns();
    for (std::size_t i = 0; i < csv_.header.fields.size(); ++i) {
      if (*column(header(i)) != i) fail(line, header(i), "stands twice");
      if (std::ranges::count(known, header(i)) > 0) continue;
      const auto key = key_of_column(header(i));
      if (!key) fail_unknown(line, header(i), known);
      conditions_.emplace_back(i, *key);
    }
    find_quantity(line);
    hole_ = column("hole");
    lot_ = column("lot");
    repeat_ = column("repeat");
  }

  [[noreturn]] void fail_unknown(int line, const std::string& name, const std::vector<std::string>& plain) const {
    const bool dotted = name.find('.') != std::string::npos;
    if (dotted && column_unit(name))
      fail(line, name, fmt::format("a column carries its unit: {}", condition_column(name)));
    if (const auto near = nearest(name, dotted ? columns_beside(name) : plain))
      fail(line, name, fmt::format("unknown column; nearest: {}", *near));
    fail(line, name,
         fmt::format("unknown column; known are {}, and full keys with their unit such as tray.motion.frequency_Hz",
                     fmt::join(plain, ", ")));
  }

  void find_quantity(int line) {
    for (const QuantityColumn& candidate : quantity_columns) {
      if (!column(candidate.name)) continue;
      if (quantity_) fail(line, candidate.name, one_quantity_needed);
      quantity_ = &candidate;
    }
    if (!quantity_) fail(line, "columns", one_quantity_needed);
    for (const std::string_view companion : companion_columns) {
      const bool wanted = quantity_->beside == companion;
      if (wanted && !column(companion)) fail(line, quantity_->name, fmt::format("needs a column {}", companion));
      if (!wanted && column(companion)) fail(line, companion, fmt::format("does not belong to {}", quantity_->name));
    }
    value_ = *column(quantity_->name);
    if (!quantity_->beside.empty()) companion_ = column(quantity_->beside);
  }

  std::optional<double> number(const std::string& text) const { return csv_number(text, csv_.decimal_comma); }

  /// Zero, or from `least` to `most`.
  double required_number(const CsvLines::Row& row, std::size_t index, double least, double most) const {
    const std::string& text = row.fields[index];
    const auto value = number(text);
    if (!value)
      fail(row.line, header(index),
           fmt::format("\"{}\" is not a number with a decimal {}", text,
                       csv_.decimal_comma ? "comma, as the others of the file have" : "point"));
    if (*value < 0) fail(row.line, header(index), fmt::format("{} is negative", text));
    check_range(row.line, header(index), *value, least, most);
    return *value;
  }

  void check_range(int line, std::string_view column, double value, double least, double most) const {
    if (value == 0 || (value >= least && value <= most)) return;
    fail(line, column, fmt::format("{:g} is out of range; expected zero, or from {:g} to {:g}", value, least, most));
  }

  Condition condition(const CsvLines::Row& row, std::size_t index, const std::string& key) const {
    const std::string& text = row.fields[index];
    if (text.empty()) fail(row.line, header(index), "is empty; a column left out means the value of the base");
    if (const auto value = number(text)) return {key, fmt::format("{}", *value), value};
    if (column_unit(key)) fail(row.line, header(index), fmt::format("\"{}\" is not a number", text));
    return {key, text, std::nullopt};
  }

  std::string hole(const CsvLines::Row& row) const {
    if (!hole_ || row.fields[*hole_] == "all") return "all";
    const std::string& text = row.fields[*hole_];
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value < 1)
      fail(row.line, "hole", fmt::format("\"{}\" is neither a hole's number (1 is the leftmost) nor \"all\"", text));
    return fmt::format("{}", value);
  }

  std::string lot(const CsvLines::Row& row) const {
    if (!lot_) return "all";
    if (row.fields[*lot_].empty()) fail(row.line, "lot", "is empty; write the name of the seeds or \"all\"");
    return row.fields[*lot_];
  }

  double value(const CsvLines::Row& row) const {
    const double stated = required_number(row, value_, least_value, most_value);
    if (quantity_->quantity == MeasuredQuantity::fraction_curve && stated > 100)
      fail(row.line, header(value_), fmt::format("{} is more than 100 %", row.fields[value_]));
    const double si = stated * unit_of(quantity_->quantity);
    if (quantity_->beside != "duration_s") return si;
    const double duration = required_number(row, *companion_, shortest_span, latest);
    if (duration == 0) fail(row.line, "duration_s", "must be greater than zero");
    check_range(row.line, column_of(quantity_->quantity), stated / duration, least_value, most_value);
    return si / duration;
  }

  void read_row(const CsvLines::Row& row) {
    MeasuredSeries series;
    for (const auto& [index, key] : conditions_) series.conditions.push_back(condition(row, index, key));
    series.hole = hole(row);
    series.lot = lot(row);
    series.where = fmt::format("{}:{}", csv_.file, row.line);
    const double time = is_curve(quantity_->quantity) ? required_number(row, *companion_, earliest, latest) : 0;
    Gathered& of_series = gathered(series, row.line);
    const std::string repeat = repeat_ ? row.fields[*repeat_] : "";
    if (!repeat.empty() && !of_series.repeats.emplace(time, repeat).second)
      fail(row.line, "repeat", fmt::format("repeat {} stands twice", repeat));
    of_series.values_at[time].push_back({repeat, value(row)});
    of_series.line_at.try_emplace(time, row.line);
  }

  Gathered& gathered(const MeasuredSeries& series, int line) {
    std::vector<std::string> of = {series.hole, series.lot};
    for (const Condition& condition : series.conditions) of.push_back(condition.text);
    const auto [known, is_new] = places_.try_emplace(std::move(of), gathered_.size());
    if (is_new) gathered_.push_back({series, line, {}, {}, {}});
    return gathered_[known->second];
  }

  MeasuredSeries average(const Gathered& one) const {
    MeasuredSeries series = one.series;
    const std::map<std::string, double> firsts = first_readings(one);
    for (const auto& [time, readings] : one.values_at) {
      if (is_curve(quantity_->quantity)) series.times.push_back(time);
      std::vector<double> values;
      for (const Reading& reading : readings) values.push_back(cumulative(reading, firsts));
      series.values.push_back(mean_with_interval(values));
      series.repeats.push_back(static_cast<int>(values.size()));
    }
    double largest = 0;
    for (const MeanWithInterval& value : series.values) largest = std::max(largest, value.mean);
    if (largest == 0 && quantity_->balance == Balance::not_tared && series.values.back().mean < 0)
      fail(one.line, quantity_->name, "falls; a balance under the vessel has the column remaining_g");
    if (largest == 0)
      fail(one.line, quantity_->name,
           is_curve(quantity_->quantity) ? "the curve never leaves zero: it has no misfit"
                                         : "a rate of zero has no relative misfit; leave the row out");
    if (is_curve(quantity_->quantity)) check_curve(one, series, largest);
    return series;
  }

  /// Of each repeat, what a balance that does not show what has left showed at first. Repeats begin at one time.
  std::map<std::string, double> first_readings(const Gathered& one) const {
    std::map<std::string, double> firsts;
    if (quantity_->balance == Balance::of_what_left) return firsts;
    const auto& [begin, readings] = *one.values_at.begin();
    double least = readings.front().value, most = least;
    for (const Reading& reading : readings) {
      firsts.emplace(reading.repeat, reading.value);
      least = std::min(least, reading.value), most = std::max(most, reading.value);
    }
    constexpr double trembling = 0.01;
    if (firsts.size() < readings.size() && most - least > trembling * most)
      fail(one.line_at.at(begin), quantity_->name,
           fmt::format("{} readings at {:g} s differ; give a column repeat, so that each is of its own fill",
                       readings.size(), begin));
    for (const auto& [time, later] : one.values_at)
      for (const Reading& reading : later)
        if (!firsts.contains(reading.repeat))
          fail(one.line_at.at(time), "repeat",
               fmt::format("repeat {} has no reading at {:g} s, where the others begin", reading.repeat, begin));
    return firsts;
  }

  /// What has left since its repeat's first reading.
  double cumulative(const Reading& reading, const std::map<std::string, double>& firsts) const {
    if (quantity_->balance == Balance::of_what_left) return reading.value;
    const double since = reading.value - firsts.at(reading.repeat);
    return quantity_->balance == Balance::not_tared ? since : -since;
  }

  /// Refuses a curve that cannot be of what has left. A balance trembles: a hundredth of the largest value is let pass.
  void check_curve(const Gathered& one, const MeasuredSeries& series, double largest) const {
    const auto stated = [&](double si) { return fmt::format("{:.4g}", to_column_unit(quantity_->quantity, si)); };
    std::vector<int> lines;
    for (const auto& [time, line] : one.line_at) lines.push_back(line);
    const double trembling = 0.01 * largest;
    for (std::size_t i = 1; i < series.values.size(); ++i) {
      const double before = series.values[i - 1].mean, now = series.values[i].mean;
      if (now >= before - trembling) continue;
      if (quantity_->balance == Balance::of_what_is_left_behind)
        fail(lines[i], quantity_->name,
             fmt::format("rises by {} from the reading before; of a balance under the vessel it can only fall",
                         stated(before - now)));
      fail(lines[i], quantity_->name,
           fmt::format("falls from {} to {}; the curve is of all that has left so far.{}", stated(before), stated(now),
                       quantity_->quantity == MeasuredQuantity::mass_curve
                           ? " A balance under the vessel has the column remaining_g"
                           : ""));
    }
    check_beginning(series, lines.front(), largest, stated);
  }

  /// A curve begins near nothing: at time zero with a twentieth of all at most, later with what three times its mean
  /// rate may have brought until then.
  template <class Stated>
  void check_beginning(const MeasuredSeries& series, int line, double largest, Stated stated) const {
    const double first = series.values.front().mean, time = series.times.front();
    const double rise = series.values.back().mean - first, span = series.times.back() - time;
    const double may_have_left = 0.05 * largest + (span > 0 ? 3 * rise / span * time : largest);
    if (first <= may_have_left) return;
    fail(
        line, quantity_->name,
        fmt::format("begins with {} at {:g} s; a curve is of what has left since its time zero.{}", stated(first), time,
                    quantity_->quantity == MeasuredQuantity::mass_curve
                        ? " A balance under what catches that was not tared has the column gross_g"
                        : ""));
  }

  const CsvLines& csv_;
  std::vector<std::pair<std::size_t, std::string>> conditions_;  // column and key
  const QuantityColumn* quantity_ = nullptr;
  std::size_t value_ = 0;
  std::optional<std::size_t> companion_, hole_, lot_, repeat_;
  std::vector<Gathered> gathered_;
  std::map<std::vector<std::string>, std::size_t> places_;  // among these, by hole, lot and conditions
};

}  // namespace

bool is_curve(MeasuredQuantity quantity) {
  return quantity != MeasuredQuantity::mass_rate && quantity != MeasuredQuantity::seed_rate;
}

std::string_view column_of(MeasuredQuantity quantity) {
  switch (quantity) {
    case MeasuredQuantity::mass_rate:
      return "rate_g_per_s";
    case MeasuredQuantity::seed_rate:
      return "seeds_per_s";
    case MeasuredQuantity::mass_curve:
      return "mass_g";
    case MeasuredQuantity::seed_curve:
      return "seeds";
    case MeasuredQuantity::fraction_curve:
      return "discharged_percent";
  }
  return "";
}

double to_column_unit(MeasuredQuantity quantity, double value_in_si) {
  return value_in_si / unit_of(quantity);
}

Override override_of(const Condition& condition, const std::string& where) {
  return {condition.key, value_of_column(condition.key, condition.text, condition.number), where};
}

MeasuredTable read_measured(const CsvLines& csv) {
  return Reader(csv).read();
}

}  // namespace vibrosow
