#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "input/input_file.hpp"
#include "input/override.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"
#include "storage/asked_question.hpp"
#include "units/quantity.hpp"

namespace vibrosow {

/// Of KEY=VALUE each. Throws InputError.
std::vector<Override> overrides_of(const std::vector<std::string>& sets);

/// What every command that simulates takes.
struct CommonOptions {
  std::string file;
  std::string out;
  std::vector<std::string> sets;  // KEY=VALUE
  std::uint64_t random_seed = 1;
  int jobs = 1;
  bool quiet = false;
  bool html = false;
  std::size_t replays = 0;  // in the page of a study
  CsvFormat csv;

  std::vector<Override> overrides() const { return overrides_of(sets); }
  /// Where the reports go, in the name of this command: --out, or out/ and the file's name with `suffix`.
  OutputFolder output_folder(const std::string& command, const std::vector<FileText>& files,
                             const std::string& suffix = "") const;
  /// The template of report.html, with the simulator where that is wanted and was built; empty without --html. Throws
  /// InputError where there is none.
  std::string page_template(bool with_simulator = false) const;
};

/// Adds the file and --set.
void add_input_options(CLI::App& command, CommonOptions& options, const std::string& file_help);

/// Adds --jobs.
void add_jobs_option(CLI::App& command, CommonOptions& options);

/// Adds --random-seed.
void add_random_seed_option(CLI::App& command, CommonOptions& options);

/// Adds --csv.
void add_csv_option(CLI::App& command, CommonOptions& options);

/// Adds --html.
void add_html_option(CLI::App& command, CommonOptions& options);

/// Adds --replays.
void add_replays_option(CLI::App& command, CommonOptions& options);

/// Adds --out, --random-seed, --jobs and --quiet too.
void add_common_options(CLI::App& command, CommonOptions& options, const std::string& file_help);

/// A time in s that an option was given. Throws InputError where it is none or not above 0.
double time_option(const std::string& option, const std::string& text);

/// A quantity from `least` to `most` (SI), in SI. Throws InputError, with an `example` where that is not empty.
double quantity_option(const std::string& option, const std::string& text, Dimension dimension, double least,
                       double most, std::string_view example = {});

/// A share in a range. Throws InputError.
double share_option(const std::string& option, const std::string& text, AskedRange<double> range);

/// Each on stderr.
void print_warnings(const std::vector<std::string>& warnings);
void print_notes(const std::vector<std::string>& notes);

/// What is to be said of the files that were read, after all was.
void tell_of_files(const InputFile& file);

}  // namespace vibrosow
