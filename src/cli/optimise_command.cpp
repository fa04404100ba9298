#include <memory>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/help_text.hpp"
#include "cli/pareto_study.hpp"
#include "cli/reused_cases.hpp"
#include "input/input_file.hpp"

namespace vibrosow {
namespace {

struct OptimiseCommandOptions {
  CommonOptions common;
  OptimiseWords words;
  BatchFlags batch;
  std::vector<std::string> reuse;
};

int run_optimise(const OptimiseCommandOptions& command) {
  const CommonOptions& common = command.common;
  const InputFile file = input_file(common.file, FileKind::study);
  ParetoStudy front(file.path, common.sets, common.random_seed, file.files, read_question(command.words));
  tell_of_files(file);
  return answer(front, common, command.batch, command.reuse);
}

}  // namespace

void add_optimise_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<OptimiseCommandOptions>();
  CLI::App* command =
      app.add_subcommand("optimise", "find Pareto-optimal layouts for several goals, in the ranges of a study");
  add_common_options(*command, options->common, "study file (.toml)");
  add_question_options(*command, options->words);
  add_html_option(*command, options->common);
  add_replays_option(*command, options->common);
  add_making_flags(*command, options->batch);
  add_reuse_option(*command, options->reuse);
  add_examples(*command, {"vibrosow optimise wheat-front --goals unevenness,power --out front",
                          "vibrosow optimise wheat-front --goals rate,unevenness --runs 60 --out rate",
                          "vibrosow optimise wheat-front --goals unevenness,power --html --out shown"});
  command->callback([options, &exit_code] { exit_code = run_optimise(*options); });
}

}  // namespace vibrosow
