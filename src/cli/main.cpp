#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "input/wording.hpp"
#include "scene/input_error.hpp"
#include "scene/printable.hpp"

namespace vibrosow {
namespace {

/// By what a user is about, in the order of the help.
const std::vector<std::pair<const char*, std::vector<void (*)(CLI::App&, int&)>>> command_groups = {
    {"Start",
     {add_demo_command, add_presets_command, add_new_seeder_command, add_studio_command, add_check_command,
      add_plan_command}},
    {"Simulate", {add_run_command, add_draw_command, add_report_command}},
    {"Study", {add_sweep_command, add_decide_command, add_optimise_command, add_status_command, add_export_command}},
    {"Trust", {add_accuracy_command, add_calibrate_command, add_bench_sheet_command, add_new_crop_command}},
    {"Cluster and upkeep", {add_submit_command, add_work_command, add_verify_command, add_pack_command}}};

/// Of a misspelled one the library only says that a command is required.
void require_command(const CLI::App& app, const std::string& first) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (first.starts_with('-') || std::ranges::find(names, first) != names.end()) return;
  throw InputError(fmt::format("there is no command \"{}\"{}", shortened(first), did_you_mean(first, names)));
}

bool is_given(const CLI::App& command, const char* option) {
  const CLI::Option* found = command.get_option_no_throw(option);
  return found != nullptr && found->count() > 0;
}

/// The line that goes on where a command was interrupted; empty where none does.
std::string line_that_goes_on(const CLI::App& command, std::vector<std::string> words) {
  static const std::set<std::string> keep_their_runs = {"sweep",    "decide",      "optimise", "accuracy", "calibrate",
                                                        "new-crop", "bench-sheet", "work",     "verify"};
  const std::string& name = command.get_name();
  if (name == "run" && is_given(command, "--checkpoint-every")) {
    if (!is_given(command, "--resume")) words.push_back("--resume");
    return typed_line(words);
  }
  // What a budget buys is measured by runs that are made now.
  return keep_their_runs.contains(name) && !is_given(command, "--budget") ? typed_line(words) : "";
}

struct RenamedOption {
  std::string_view command, was, now;
};
constexpr RenamedOption renamed_options[] = {{"work", "--bundle", "--shard"}, {"submit", "--bundles", "--shards"}};

/// Takes names that commands and options had for those of today, with a hint.
std::vector<std::string> renamed(std::vector<std::string> words) {
  const auto rename = [](std::string& word, std::string_view was, std::string_view now) {
    complain(fmt::format("\"{}\" is called {} now", was, now));
    word.replace(0, was.size(), now);
  };
  if (words.empty()) return words;
  if (words.front() == "new") rename(words.front(), "new", "new-crop");
  for (const RenamedOption& option : renamed_options) {
    if (words.front() != option.command) continue;
    for (std::string& word : words)
      if (word.substr(0, word.find('=')) == option.was) rename(word, option.was, option.now);
  }
  return words;
}

/// "; did you mean --random-seed?" of an option that the command does not have, or nothing.
std::string meant_option(const CLI::App& app, const std::vector<std::string>& words) {
  const std::vector<const CLI::App*> chosen = app.get_subcommands([](const CLI::App* one) { return one->parsed(); });
  if (chosen.empty()) return "";
  std::vector<std::string> names;
  for (const CLI::Option* option : chosen.front()->get_options())
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  for (const std::string& word : words) {
    if (!word.starts_with("--")) continue;
    const std::string name = word.substr(2, word.find('=') - 2);
    if (name.empty() || std::ranges::find(names, name) != names.end()) continue;
    const auto holds_it =
        std::ranges::find_if(names, [&](const std::string& one) { return one.ends_with("-" + name); });
    const auto near = holds_it != names.end() ? std::optional(*holds_it) : nearest(name, names);
    if (near) return fmt::format("; did you mean --{}?", *near);
  }
  return "";
}

int run_program(const std::vector<std::string>& words) {
  CLI::App app("Vibrosow designs vibrating-tray seeders: it simulates every seed and counts what leaves each hole.",
               "vibrosow");
  app.formatter(std::make_shared<HelpText>());
  app.set_version_flag("--version", "vibrosow " VIBROSOW_VERSION);
  app.footer(
      "Exit codes: 0 done, 2 wrong input or an answer refused, 3 stopped by the guard,\n4 a defect of the program, 130 "
      "interrupted.");
  app.require_subcommand(1);
  int exit_code = exit_done;
  for (const auto& [group, commands] : command_groups)
    for (const auto add : commands) {
      add(app, exit_code);
      app.get_subcommands({}).back()->group(group);
    }
  add_help_command(app, exit_code);
  if (!words.empty()) require_command(app, words.front());
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // runs the chosen command
  } catch (const CLI::ExtrasError& error) {
    complain(fmt::format("{}{}", error.what(), meant_option(app, words)));
    return exit_wrong_input;
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, wrong;
    const int code = app.exit(error, out, wrong);  // --help and --version are "errors" of exit code 0
    print_text(out.str());
    std::fputs(printable_lines(wrong.str()).c_str(), stderr);
    output_error();
    return code == 0 ? exit_done : exit_wrong_input;
  }
  const CLI::App& command = *app.get_subcommands().front();
  if (const std::string line = line_that_goes_on(command, words); exit_code == exit_interrupted && !line.empty())
    complain("interrupted; to resume: " + line);
  const auto not_printed = output_error();
  if (!not_printed) return exit_code;
  complain("standard output: " + *not_printed);
  return exit_wrong_input;
}

}  // namespace
}  // namespace vibrosow

int main(int argument_count, char** arguments) {
  using namespace vibrosow;
  make_streams_safe();
  end_when_memory_runs_out();
  return exit_code_of([&] {
    return run_program(renamed({arguments + std::min(1, argument_count), arguments + argument_count}));
  });
}
