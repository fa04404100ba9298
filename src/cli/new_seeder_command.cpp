#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "files/atomic_file.hpp"
#include "files/whole_file.hpp"
#include "input/input_file.hpp"
#include "report/terminal_text.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

struct NewSeederOptions {
  std::string from, out;
};

int write_seeder(const NewSeederOptions& options) {
  const std::filesystem::path out = options.out.empty() ? "my-" + options.from + ".toml" : options.out;
  if (!has_extension(out, ".toml")) throw InputError(fmt::format("--out: {} does not end in .toml", out.string()));
  if (std::filesystem::exists(out))
    throw InputError(fmt::format("{}: is there already; give another --out", out.string()));
  const InputFile shipped = input_file(options.from, FileKind::seeder);
  if (out.has_parent_path()) std::filesystem::create_directories(out.parent_path());
  write_file_atomically(out, text_of_file(shipped.path).value());
  print_text(
      wrapped(fmt::format("{}: edit it; then vibrosow check {} and vibrosow run {}; every key is in "
                          "seeders/FORMAT.md",
                          out.string(), out.string(), out.string())));
  return exit_done;
}

}  // namespace

void add_new_seeder_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<NewSeederOptions>();
  CLI::App* command = app.add_subcommand("new-seeder", "copy a shipped seeder, with its comments, to edit");
  command->add_option("NAME", options->from, "of vibrosow presets seeders")->required();
  command->add_option("--out", options->out, "its file; default my-NAME.toml")->type_name("FILE");
  add_examples(*command, {"vibrosow new-seeder wheat-tray", "vibrosow new-seeder wheat-tray-3d --out trays/mine.toml",
                          "vibrosow new-seeder one-hole --out first.toml"});
  command->callback([options, &exit_code] { exit_code = write_seeder(*options); });
}

}  // namespace vibrosow
