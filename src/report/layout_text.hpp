#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "design/study.hpp"
#include "outflow/statistics.hpp"

namespace vibrosow {

/// What a layout is, on a screen: its name, or the values that tell it apart: "count 5, frequency 9 Hz".
std::string described(const Study& study, const Layout& layout);

/// "12.34 +- 0.56", in units of `unit`; empty for none. A page writes another sign than a terminal.
std::string with_interval(const std::optional<MeanWithInterval>& value, double unit,
                          std::string_view plus_minus = "+-");

}  // namespace vibrosow
