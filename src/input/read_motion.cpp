#include "input/read_motion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "input/wording.hpp"
#include "portable_math/functions.hpp"
#include "scene/input_error.hpp"
#include "scene/list_limits.hpp"
#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

constexpr std::size_t fewest_rows = 4;  // that the interpolation needs
// Bounds of a table, beyond any vessel, within which steps and speeds stay finite.
constexpr double latest = 1e6;                                // s
constexpr double fastest = 1000;                              // m/s
constexpr double fastest_turn = 1000 * 2 * std::numbers::pi;  // rad/s
constexpr double farthest = 1000;                             // m
constexpr double farthest_turn = 1e6 * 2 * std::numbers::pi;  // rad

/// When a motion grows and fades.
struct Course {
  double ramp, stop, stop_ramp;  // s
};

/// `period` (s) of the slowest motion: it fades over that time unless the file says otherwise, never at once.
Course read_course(Table& table, double period) {
  Course course{};
  course.ramp = table.quantity("ramp", Dimension::time, 0, 1e6).value_or(0);
  const std::optional<double> stop = table.quantity("stop", Dimension::time, 0, 1e6);
  const std::optional<double> stop_ramp = table.quantity("stop_ramp", Dimension::time, 1e-4, 1e6);
  if (stop_ramp && !stop) table.fail("stop_ramp", "goes with stop, the time at which the motion begins to fade");
  course.stop = stop.value_or(never);
  course.stop_ramp = stop ? stop_ramp.value_or(period) : 0;
  return course;
}

/// An angle in 2D, or in 3D a list of three numbers: how far along, up and across.
void read_direction(Table& table, HarmonicMotion& motion) {
  if (!table.is_list("direction")) {
    motion.direction = table.quantity("direction", Dimension::angle, -360 * degree, 360 * degree).value_or(0);
    return;
  }
  const std::vector<double> parts = table.numbers("direction", -1e9, 1e9);
  if (parts.size() != 3) table.fail("direction", "expected an angle, or three numbers: along, up and across");
  const double in_plane = portable_math::hypot(parts[0], parts[1]);
  if (portable_math::hypot(in_plane, parts[2]) == 0) table.fail("direction", "[0, 0, 0] has no direction");
  motion.direction = portable_math::atan2(parts[1], parts[0]);
  motion.across = portable_math::atan2(parts[2], in_plane);
}

HarmonicMotion read_oscillation(Table& table) {
  HarmonicMotion motion;
  read_direction(table, motion);
  motion.amplitude = table.required_quantity("amplitude", Dimension::length, 1e-9, 10);
  motion.frequency = table.required_quantity("frequency", Dimension::frequency, 1e-6, 1e4);
  motion.phase = table.quantity("phase", Dimension::angle, -360 * degree, 360 * degree).value_or(0);
  return motion;
}

void follow(HarmonicMotion& motion, const Course& course) {
  motion.ramp = course.ramp, motion.stop = course.stop, motion.stop_ramp = course.stop_ramp;
}

HarmonicMotion read_harmonic(Table& table) {
  HarmonicMotion motion = read_oscillation(table);
  follow(motion, read_course(table, 1 / motion.frequency));
  return motion;
}

SumMotion read_sum(Table& table) {
  SumMotion sum;
  double longest_period = 0;
  std::vector<Table> components = table.tables("components");
  table.refuse_more("components", components.size(), list_limits::components);
  for (Table& component : components) {
    sum.components.push_back(read_oscillation(component));
    longest_period = std::max(longest_period, 1 / sum.components.back().frequency);
  }
  if (sum.components.empty()) {
    table.fail("components", "is missing; expected a list such as [{ amplitude = \"1 mm\", frequency = \"9 Hz\" }]");
  }
  const Course course = read_course(table, longest_period);
  for (HarmonicMotion& component : sum.components) follow(component, course);
  return sum;
}

RockingMotion read_rocking(Table& table) {
  RockingMotion motion;
  const std::vector<double> pivot = table.quantities("pivot", Dimension::length, -100, 100);
  if (pivot.size() != 2) {
    table.fail("pivot", "expected the point it turns about, in the vessel's frame, such as [\"25 cm\", \"0 cm\"]");
  }
  motion.pivot = {pivot[0], pivot[1]};
  motion.angle = table.required_quantity("angle", Dimension::angle, 1e-6 * degree, 30 * degree);
  motion.frequency = table.required_quantity("frequency", Dimension::frequency, 1e-6, 1e4);
  const Course course = read_course(table, 1 / motion.frequency);
  motion.ramp = course.ramp, motion.stop = course.stop, motion.stop_ramp = course.stop_ramp;
  return motion;
}

/// The speed counts turns in time.
TurningMotion read_turning(Table& table) {
  TurningMotion motion;
  const double turns_per_second = table.required_quantity("speed", Dimension::frequency, -1000, 1000);
  if (!(std::abs(turns_per_second) >= 1e-6))
    table.fail("speed", "is nothing; expected turns in time such as \"6 rpm\"");
  motion.angular_velocity = 2 * std::numbers::pi * turns_per_second;
  motion.axis =
      table.choice("axis", {"across", "upright"}).value_or(0) == 0 ? TurningAxis::across : TurningAxis::upright;
  const std::vector<double> pivot = table.quantities("pivot", Dimension::length, -100, 100);
  if (pivot.size() != 2) {
    table.fail(
        "pivot",
        "expected where the axis passes in the vessel's frame, such as [\"10 cm\", \"10 cm\"]: along and up, of an "
        "upright axis along and across");
  }
  motion.pivot = {pivot[0], pivot[1]};
  const Course course = read_course(table, 1 / std::abs(turns_per_second));
  motion.ramp = course.ramp, motion.stop = course.stop, motion.stop_ramp = course.stop_ramp;
  return motion;
}

/// A CSV file of positions, column by column.
class MotionTableReader {
 public:
  explicit MotionTableReader(const CsvLines& csv) : csv_(csv) {}

  TableMotion read() {
    check_header();
    if (csv_.rows.size() < fewest_rows)
      fail(csv_.rows.back().line, "time_s", fmt::format("expected at least {} rows", fewest_rows));
    TableMotion motion;
    motion.times = column("time_s", 1, latest);
    for (std::size_t k = 1; k < motion.times.size(); ++k)
      if (!(motion.times[k] > motion.times[k - 1]))
        fail(csv_.rows[k].line, "time_s", fmt::format("{:g} is not later than the row before", motion.times[k]));
    motion.x = column("x_mm", 1e-3, farthest);
    motion.y = column("y_mm", 1e-3, farthest);
    motion.angle = column("angle_degree", degree, farthest_turn);
    if (has("z_mm")) motion.z = column("z_mm", 1e-3, farthest);
    check_speeds("x_mm", motion.times, motion.x, fastest);
    check_speeds("y_mm", motion.times, motion.y, fastest);
    if (has("z_mm")) check_speeds("z_mm", motion.times, motion.z, fastest);
    check_speeds("angle_degree", motion.times, motion.angle, fastest_turn);
    return motion;
  }

 private:
  [[noreturn]] void fail(int line, const std::string& name, const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}: {}", csv_.file, line, name, message));
  }

  std::size_t index_of(const std::string& name) const {
    return static_cast<std::size_t>(std::ranges::find(csv_.header.fields, name) - csv_.header.fields.begin());
  }
  bool has(const std::string& name) const { return index_of(name) < csv_.header.fields.size(); }

  void check_header() const {
    static const std::vector<std::string> known = {"time_s", "x_mm", "y_mm", "z_mm", "angle_degree"};
    for (std::size_t k = 0; k < csv_.header.fields.size(); ++k) {
      const std::string& name = csv_.header.fields[k];
      if (std::ranges::count(known, name) == 0)
        fail(csv_.header.line, name,
             fmt::format("unknown column; known are {}{}", fmt::join(known, ", "), did_you_mean(name, known)));
      if (index_of(name) != k) fail(csv_.header.line, name, "stands twice");
    }
    if (!has("time_s")) fail(csv_.header.line, "time_s", "is missing");
    if (csv_.header.fields.size() < 2)
      fail(csv_.header.line, "time_s", "stands alone; expected x_mm, y_mm, z_mm or angle_degree beside it");
  }

  void check_speeds(const std::string& name, const std::vector<double>& times, const std::vector<double>& places,
                    double most) const {
    for (std::size_t k = 1; k < times.size(); ++k)
      if (!(std::abs(places[k] - places[k - 1]) <= most * (times[k] - times[k - 1])))
        fail(csv_.rows[k].line, name,
             fmt::format("\"{}\" is too far from the row before: faster than {}", csv_.rows[k].fields[index_of(name)],
                         name == "angle_degree" ? fmt::format("{:g} turns a second", most / (2 * std::numbers::pi))
                                                : fmt::format("{:g} m/s", most)));
  }

  /// In SI, of a column in a unit; at most `most` (SI) either way.
  std::vector<double> column(const std::string& name, double unit, double most) const {
    if (!has(name)) return std::vector<double>(csv_.rows.size(), 0.0);
    std::vector<double> values;
    for (const CsvLines::Row& row : csv_.rows) {
      const std::string& text = row.fields[index_of(name)];
      const std::optional<double> value = csv_number(text, csv_.decimal_comma);
      if (!value) fail(row.line, name, fmt::format("\"{}\" is not a number", text));
      if (!(std::abs(*value * unit) <= most))
        fail(row.line, name,
             fmt::format("\"{}\" is out of range, which is from {:g} to {:g}", text, -most / unit, most / unit));
      values.push_back(*value * unit);
    }
    return values;
  }

  const CsvLines& csv_;
};

}  // namespace

TableMotion read_motion_table(const CsvLines& csv) {
  return MotionTableReader(csv).read();
}

VesselMotion read_motion(Table table) {
  const std::vector<std::string> kinds = {"harmonic", "sum", "rocking", "table", "turning"};
  const std::optional<std::size_t> kind = table.choice("kind", kinds);
  if (!kind) table.fail("kind", "is missing; expected \"harmonic\", \"sum\", \"rocking\", \"turning\" or \"table\"");
  if (*kind == 0) return read_harmonic(table);
  if (*kind == 1) return read_sum(table);
  if (*kind == 2) return read_rocking(table);
  if (*kind == 4) return read_turning(table);
  const std::string file = table.required_text("file");
  const std::filesystem::path path = table.directory("file") / file;
  if (!table.files()->has(path)) table.fail("file", fmt::format("there is no file {}", path.string()));
  return read_motion_table(table.files()->csv(path));
}

}  // namespace vibrosow
