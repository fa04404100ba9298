#include "cli/common_options.hpp"

#include "input/presets.hpp"

#include "cli/console.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>
#include <thread>

#include "input/wording.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

/// CLI11 alone takes -1 and numbers of thirty digits, and makes other numbers of them.
std::string whole_number(const std::string& text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole ? "" : fmt::format("\"{}\" is not a whole number from 0 to 18446744073709551615", text);
}

}  // namespace

std::vector<Override> overrides_of(const std::vector<std::string>& sets) {
  std::vector<Override> result;
  for (const std::string& set : sets) result.push_back(parse_override(set));
  return result;
}

OutputFolder CommonOptions::output_folder(const std::string& command, const std::vector<FileText>& files,
                                          const std::string& suffix) const {
  std::vector<std::string> names;
  for (const FileText& text : files) {
    names.push_back(text.name);
    if (const auto number = names.back().find("NNN"); number != std::string::npos) names.back().replace(number, 3, "*");
  }
  const std::string stem = std::filesystem::path(file).stem().string() + suffix;
  const bool has_cases = command == "sweep" || command == "decide" || command == "optimise" ||
                         command == "bench-sheet" || command == "calibrate" || command == "accuracy";
  return {out.empty() ? std::filesystem::path("out") / stem : std::filesystem::path(out), command, names, has_cases};
}

void add_input_options(CLI::App& command, CommonOptions& options, const std::string& file_help) {
  command.add_option("FILE", options.file, file_help)->required();
  command
      .add_option("--set", options.sets, "change a key of the file: --set \"tray.motion.frequency=12 Hz\"; repeatable")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_common_options(CLI::App& command, CommonOptions& options, const std::string& file_help) {
  add_input_options(command, options, file_help);
  command.add_option("--out", options.out, "directory for the reports; default out/ and the file's name")
      ->type_name("DIR");
  add_random_seed_option(command, options);
  add_jobs_option(command, options);
  command.add_flag("--quiet", options.quiet, "no progress and no table");
  add_csv_option(command, options);
}

void add_jobs_option(CLI::App& command, CommonOptions& options) {
  options.jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  command.add_option("--jobs", options.jobs, "runs in parallel; a single run takes one core")
      ->type_name("N")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
}

void add_random_seed_option(CLI::App& command, CommonOptions& options) {
  command.add_option("--random-seed", options.random_seed, "random seed; of replicates, the first")
      ->type_name("N")
      ->check(whole_number)
      ->capture_default_str();
}

std::string CommonOptions::page_template(bool with_simulator) const {
  if (replays > 0 && !html) throw InputError("--replays: goes with --html, whose page they are in");
  if (!html) return "";
  std::optional<std::string> page;
  if (with_simulator) page = shipped_page("report-with-simulator.html");
  if (!page) page = shipped_page("report.html");
  if (!page) throw InputError("there is no pages/report.html in the shipped data (VIBROSOW_DATA)");
  return *page;
}

void add_html_option(CLI::App& command, CommonOptions& options) {
  command.add_flag("--html", options.html, "also write report.html, a page for any browser, offline");
}

void add_replays_option(CLI::App& command, CommonOptions& options) {
  command
      .add_option("--replays", options.replays,
                  "replays of the N best layouts in the page; one run of each is simulated again")
      ->type_name("N")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
}

void add_csv_option(CLI::App& command, CommonOptions& options) {
  command
      .add_option_function<std::string>(
          "--csv",
          [&options](const std::string& name) { options.csv = name == "semicolon" ? semicolon_csv : CsvFormat{}; },
          "how CSV files are written: comma, or semicolon with decimal commas, for spreadsheets")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"comma", "semicolon"}))
      ->default_str("comma");
}

double time_option(const std::string& option, const std::string& text) {
  try {
    if (const double time = parse_quantity(text, Dimension::time); time > 0) return time;
  } catch (const UnitError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
  throw InputError(fmt::format("{}: \"{}\" is no time to wait", option, text));
}

double quantity_option(const std::string& option, const std::string& text, Dimension dimension, double least,
                       double most, std::string_view example) {
  try {
    const double value = parse_quantity(text, dimension, example);
    if (value >= least && value <= most) return value;
  } catch (const UnitError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
  const std::string unit = split_quantity(text).unit;
  throw InputError(fmt::format("{}: \"{}\" is out of range, which is from {} to {}", option, shortened(text),
                               shown(least, dimension, unit), shown(most, dimension, unit)));
}

double share_option(const std::string& option, const std::string& text, AskedRange<double> range) {
  return quantity_option(option, text, Dimension::fraction, range.least, range.most);
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) complain("warning: " + warning);
}

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) complain("note: " + note);
}

void tell_of_files(const InputFile& file) {
  print_notes(file.files->notes());
  print_warnings(warnings_of_files_outside(file));
}

}  // namespace vibrosow
