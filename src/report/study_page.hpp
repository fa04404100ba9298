#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "design/study.hpp"
#include "outflow/figures.hpp"
#include "outflow/statistics.hpp"
#include "report/replay.hpp"
#include "report/sweep_report.hpp"

namespace vibrosow {

// What the pages of studies share.

/// {mean, half width of its 95 % interval}, in `unit`; null where there is none.
nlohmann::ordered_json page_interval(const std::optional<MeanWithInterval>& value, double unit);

/// The page's kind, program, title, space and keys, to which the rest is added.
nlohmann::ordered_json page_of_study(std::string_view kind, const Study& study);

/// What is told of a figure of sweep.csv.
nlohmann::ordered_json page_figure(const Figure& figure);

/// Number, name, what it is in words, values of the keys, vessels, the command that runs it alone, and its replay if
/// there is one; the rest is added.
nlohmann::ordered_json page_layout(const Study& study, const Layout& layout, std::uint64_t first_random_seed,
                                   const Replays& replays);

/// "The 120 runs of this command took 31 s on 2 cores."; empty where it made none.
std::string page_timing(const SweepTiming& timing);

}  // namespace vibrosow
