#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "input/wording.hpp"
#include "scene/input_error.hpp"
#include "scene/printable.hpp"

namespace vibrosow {
namespace {

/// Of a misspelled one the library only says that a command is required.
void require_command(const CLI::App& app, const std::string& first) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (first.starts_with('-') || std::ranges::find(names, first) != names.end()) return;
  throw InputError(fmt::format("there is no command \"{}\"{}", shortened(first), did_you_mean(first, names)));
}

int run_program(int argument_count, char** arguments) {
  CLI::App app("Vibrosow designs vibrating-tray seeders: it simulates every seed and counts what leaves each hole.",
               "vibrosow");
  app.formatter(std::make_shared<HelpText>());
  app.set_version_flag("--version", "vibrosow " VIBROSOW_VERSION);
  app.footer("Exit codes: 0 done, 2 wrong input, 3 stopped by the guard,\n4 a defect of the program, 130 interrupted.");
  app.require_subcommand(1);
  int exit_code = exit_done;
  add_plan_command(app, exit_code);
  add_run_command(app, exit_code);
  add_sweep_command(app, exit_code);
  add_decide_command(app, exit_code);
  add_optimise_command(app, exit_code);
  add_work_command(app, exit_code);
  add_submit_command(app, exit_code);
  add_status_command(app, exit_code);
  add_report_command(app, exit_code);
  add_export_command(app, exit_code);
  add_draw_command(app, exit_code);
  add_verify_command(app, exit_code);
  add_pack_command(app, exit_code);
  add_accuracy_command(app, exit_code);
  add_new_command(app, exit_code);
  add_bench_sheet_command(app, exit_code);
  add_calibrate_command(app, exit_code);
  add_check_command(app, exit_code);
  add_studio_command(app, exit_code);
  add_presets_command(app, exit_code);
  add_columns_command(app, exit_code);
  if (argument_count > 1) require_command(app, arguments[1]);
  try {
    app.parse(argument_count, arguments);  // runs the chosen command
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, wrong;
    const int code = app.exit(error, out, wrong);  // --help and --version are "errors" of exit code 0
    print_text(out.str());
    std::fputs(printable_lines(wrong.str()).c_str(), stderr);
    output_error();
    return code == 0 ? exit_done : exit_wrong_input;
  }
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
  try {
    return run_program(argument_count, arguments);
  } catch (const InputError& error) {
    complain(error.what());
  } catch (const std::system_error& error) {  // of the file system
    complain(error.what());
  } catch (const std::exception& error) {
    complain(fmt::format("a defect of the program, please report it with your file: {}", error.what()));
    return exit_defect;
  } catch (...) {
    complain("a defect of the program, please report it with your file");
    return exit_defect;
  }
  return exit_wrong_input;
}
