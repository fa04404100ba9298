#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <new>
#include <system_error>

#include "cli/commands.hpp"
#include "scene/input_error.hpp"

int main(int argument_count, char** arguments) {
  using namespace vibrosow;
  std::signal(SIGXFSZ, SIG_IGN);  // a file over the size limit is a failed write, told as one
  CLI::App app("Vibrosow designs vibrating-tray seeders: it simulates every seed and counts what leaves each hole.",
               "vibrosow");
  app.set_version_flag("--version", "vibrosow " VIBROSOW_VERSION);
  app.require_subcommand(1);
  int exit_code = exit_done;
  add_run_command(app, exit_code);
  add_sweep_command(app, exit_code);
  add_accuracy_command(app, exit_code);
  add_check_command(app, exit_code);
  add_presets_command(app, exit_code);
  add_columns_command(app, exit_code);
  try {
    app.parse(argument_count, arguments);  // runs the chosen command
    if (std::fflush(stdout) != 0) throw std::system_error(errno, std::generic_category(), "standard output");
    return exit_code;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_done : exit_wrong_input;  // --help and --version are "errors" of exit code 0
  } catch (const InputError& error) {
    fmt::print(stderr, "vibrosow: {}\n", error.what());
  } catch (const std::system_error& error) {  // of the file system, or a printed table that cannot be written
    fmt::print(stderr, "vibrosow: {}\n", error.what());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "vibrosow: out of memory: the scene has more grains than this machine holds\n");
  }
  return exit_wrong_input;
}
