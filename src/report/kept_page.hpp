#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report/output_folder.hpp"

namespace vibrosow {

/// What a page of accuracy shows of the machine's clock, which report.json holds nothing of.
inline constexpr const char* page_times_name = "timing.json";

/// `page_files` with what page_times_name holds.
std::vector<OutputFile> timed_page_files(const std::string& page_template, const std::string& data,
                                         const std::string& times);

/// What the page of a folder shows: its report.json and, of accuracy, its times where it has any. None where there is
/// no report.json. Throws InputError for what the program has not written.
std::optional<nlohmann::ordered_json> kept_page_data(const std::filesystem::path& folder);

}  // namespace vibrosow
