// Tables of the outflow of one hole, and of other contacts; what is read is asked in its own middle.

#include "fuzz/try_bytes.hpp"
#include "input/read_hole_table.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

double middle(const Span& span) {
  return 0.5 * (span.least + span.most);
}

}  // namespace

void try_bytes(const std::string& bytes) {
  try {
    const HoleTable table = read_hole_table(parse_csv_lines(bytes, "holes.csv"));
    const double aspect = middle(table.aspects());
    table.at({aspect, middle(table.widths(aspect)), middle(table.peak_speeds(aspect)), middle(table.depths(aspect))});
  } catch (const InputError&) {
  }
  try {
    const ContactSlopes slopes = read_contact_slopes(parse_csv_lines(bytes, "contacts.csv"));
    slopes.between(2, {0.4, 0.4, 0.05, 0.5}, {0.1, 0.9, 0.3, 0.1});
  } catch (const InputError&) {
  }
}

}  // namespace vibrosow
