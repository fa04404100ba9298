// Tables of a vessel's positions over time.

#include "fuzz/try_bytes.hpp"
#include "input/read_motion.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {

void try_bytes(const std::string& bytes) {
  try {
    read_motion_table(parse_csv_lines(bytes, "motion.csv"));
  } catch (const InputError&) {
  }
}

}  // namespace vibrosow
