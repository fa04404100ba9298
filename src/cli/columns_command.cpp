#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "report/documentation.hpp"

namespace vibrosow {

void add_columns_command(CLI::App& app, int& exit_code) {
  app.add_subcommand("columns", "what is in the files that the other commands write")->callback([&exit_code] {
    print("{}", output_documentation());
    exit_code = exit_done;
  });
}

}  // namespace vibrosow
