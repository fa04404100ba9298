#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "answer/answer.hpp"
#include "outflow/statistics.hpp"
#include "study/study.hpp"

namespace vibrosow {

/// What a layout is, on a screen: its name, or the values that tell it apart: "count 5, frequency 9 Hz".
std::string described(const Study& study, const Layout& layout);

/// How its unit is written beside a value: seeds/s of what are 1/s.
std::string_view unit_of(const Metric& metric);

/// "38 worse, 12 misses the rate", of the layouts that are not told one by one; empty for none.
std::string counted_standings(const Answer& answer, const std::function<bool(const AnsweredLayout&)>& is_told);

/// "at the end of the range of frequency and width: better ones may lie beyond"; empty for no keys.
std::string edge_text(const std::vector<std::string>& keys);

/// "12.34 +- 0.56", in units of `unit`; empty for none. A page writes another sign than a terminal.
std::string with_interval(const std::optional<MeanWithInterval>& value, double unit,
                          std::string_view plus_minus = "+-");

}  // namespace vibrosow
