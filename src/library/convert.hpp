#pragma once

#include "study/evaluate.hpp"
#include "vibrosow/evaluate.hpp"

namespace vibrosow::api {

/// From the program's own values to those of the public headers.
Balance converted(const vibrosow::Balance& own);
Evaluation converted(const vibrosow::Evaluation& own);

}  // namespace vibrosow::api
