#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace vibrosow {

/// Adds --reuse: folders of other sweeps or decisions.
void add_reuse_option(CLI::App& command, std::vector<std::string>& folders);

/// Where their runs are. Throws InputError for a folder without runs.
std::vector<std::filesystem::path> cases_to_reuse(const std::vector<std::string>& folders);

}  // namespace vibrosow
