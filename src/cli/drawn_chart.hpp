#pragma once

#include <filesystem>
#include <string>

#include "picture/chart.hpp"

namespace vibrosow {

/// A chart (page_chart) of what a folder of run, sweep, decide, optimise, accuracy or calibrate holds; of a study by
/// the runs that are kept, `jobs` of them read side by side. Throws InputError.
Chart drawn_chart(const std::filesystem::path& folder, const std::string& name, int jobs);

}  // namespace vibrosow
