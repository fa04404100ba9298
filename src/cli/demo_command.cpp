#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"

namespace vibrosow {
namespace {

struct DemoOptions {
  std::string out = "out/demo";
  bool quiet = false;
};

/// Prints a command as a user types it, and carries it out; its exit code.
int carried_out(std::vector<std::string> words) {
  print("$ {}\n", typed_line(words));
  CLI::App app;
  int exit_code = exit_done;
  add_run_command(app, exit_code);
  add_sweep_command(app, exit_code);
  std::ranges::reverse(words);  // as the library takes them
  app.parse(words);
  return exit_code;
}

int show(const DemoOptions& options) {
  const std::filesystem::path out = options.out;
  const auto command = [&](std::vector<std::string> words, const char* folder) {
    words.insert(words.end(), {"--html", "--out", (out / folder).string()});
    if (options.quiet) words.push_back("--quiet");
    return carried_out(words);
  };
  print("600 wheat grains in a shaken tray, in 3D, for 0.9 s:\n");
  if (const int exit_code = command({"run", "wheat-grains"}, "grains"); exit_code != exit_done) return exit_code;
  print("\nThree or five holes at two frequencies, of a 2D slice:\n");
  if (const int exit_code = command({"sweep", "wheat-demo"}, "sweep"); exit_code != exit_done) return exit_code;
  print("\nOpen in a browser:\n  {}\n  {}\n", (out / "grains/report.html").string(),
        (out / "sweep/report.html").string());
  return exit_done;
}

}  // namespace

void add_demo_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<DemoOptions>();
  CLI::App* command = app.add_subcommand("demo", "simulate a tray of wheat grains and a small study; pages to look at");
  command->add_option("--out", options->out, "directory for its two folders")->type_name("DIR")->capture_default_str();
  command->add_flag("--quiet", options->quiet, "no progress and no tables");
  add_examples(*command, {"vibrosow demo", "vibrosow demo --out look", "vibrosow demo --quiet --out look"});
  command->callback([options, &exit_code] { exit_code = show(*options); });
}

}  // namespace vibrosow
