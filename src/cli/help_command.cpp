#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "input/wording.hpp"
#include "report/documentation.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

void help(const CLI::App& app, const std::string& topic) {
  // App::help would print that of the command that was given, which is this one.
  if (topic.empty())
    return print_text(app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal));
  if (topic == "columns") return print("{}", output_documentation());
  std::vector<std::string> names = {"columns"};
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == topic) return print_text(command->help(app.get_name()));
    names.push_back(command->get_name());
  }
  throw InputError(fmt::format("there is no command \"{}\"{}", shortened(topic), did_you_mean(topic, names)));
}

}  // namespace

void add_help_command(CLI::App& app, int& exit_code) {
  auto topic = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("help", "explain a command; help columns: the columns of the files");
  command->group("Start");
  command->add_option("COMMAND", *topic, "of the list; or columns");
  command->callback([&app, topic, &exit_code] {
    help(app, *topic);
    exit_code = exit_done;
  });
  app.add_subcommand("columns", "help columns")->group("")->callback([&exit_code] {
    print("{}", output_documentation());
    exit_code = exit_done;
  });
}

}  // namespace vibrosow
