#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "input/override.hpp"

namespace vibrosow {

/// What every command that simulates takes.
struct CommonOptions {
  std::string file;
  std::string out;                // empty: out/<stem of the file>
  std::vector<std::string> sets;  // KEY=VALUE
  std::uint64_t random_seed = 1;
  int jobs = 1;
  bool quiet = false;

  std::vector<Override> overrides() const;
  std::filesystem::path out_directory() const;
};

/// Adds the file and --set.
void add_input_options(CLI::App& command, CommonOptions& options, const std::string& file_help);

/// Adds --out, --random-seed, --jobs and --quiet too.
void add_common_options(CLI::App& command, CommonOptions& options, const std::string& file_help);

/// Each on stderr.
void print_warnings(const std::vector<std::string>& warnings);

/// Makes the directory now, so that a long simulation does not end at a directory that cannot be made or
/// written into. Throws InputError.
void make_out_directory(const std::filesystem::path& directory);

}  // namespace vibrosow
