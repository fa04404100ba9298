#pragma once

#include "agronomy/prediction_error.hpp"
#include "input/csv_lines.hpp"

namespace vibrosow {

/// The model's error from rates that were measured and predicted without fitting: columns material, measured and
/// predicted, others are for a reader. A material with several rows counts once, with the mean of its logarithms.
/// Throws InputError "FILE:LINE: COLUMN: .." for a column that is missing and a rate that is not above zero.
ModelError read_model_error(const CsvLines& csv);

/// The shipped one, models/held-out.csv. Throws InputError where it is not there.
ModelError shipped_model_error();

}  // namespace vibrosow
