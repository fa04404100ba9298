// Tables of measured outflow.

#include "input/measured.hpp"
#include "fuzz/try_bytes.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {

void try_bytes(const std::string& bytes) {
  try {
    const MeasuredTable table = read_measured(parse_csv_lines(bytes, "measured.csv"));
    for (const MeasuredSeries& series : table.series)
      for (const Condition& condition : series.conditions) override_of(condition, series.where);
  } catch (const InputError&) {
  }
}

}  // namespace vibrosow
