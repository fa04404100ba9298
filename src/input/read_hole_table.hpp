#pragma once

#include <vector>

#include "agronomy/contact_slopes.hpp"
#include "agronomy/hole_table.hpp"
#include "input/csv_lines.hpp"

namespace vibrosow {

/// Rows of `scripts/figures hole-table`. Throws InputError "FILE:LINE: COLUMN: .." for a column that is missing,
/// unknown or there twice and for a value that is no number or out of range.
std::vector<HoleRecord> read_hole_records(const CsvLines& csv);

/// The table of one hole, of such rows. Throws InputError "FILE: .." where they make none.
HoleTable read_hole_table(const CsvLines& csv);

/// What other contacts change, of such rows. Throws InputError "FILE: .." where they do not tell.
ContactSlopes read_contact_slopes(const CsvLines& csv);

/// The shipped ones. Throw InputError where they are not there.
HoleTable shipped_hole_table();
ContactSlopes shipped_contact_slopes();

}  // namespace vibrosow
