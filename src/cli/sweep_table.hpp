#pragma once

#include "study/sweep.hpp"

namespace vibrosow {

/// A study's layouts with their figures, on standard output.
void print_sweep_table(const StudyResult& result);

}  // namespace vibrosow
