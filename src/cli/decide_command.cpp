#include <memory>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/help_text.hpp"
#include "cli/reused_cases.hpp"
#include "cli/selection_study.hpp"
#include "input/input_file.hpp"

namespace vibrosow {
namespace {

struct DecideCommandOptions {
  CommonOptions common;
  DecideWords words;
  BatchFlags batch;
  std::vector<std::string> reuse;
};

int run_decide(const DecideCommandOptions& command) {
  const CommonOptions& common = command.common;
  const InputFile file = input_file(common.file, FileKind::study);
  SelectionStudy decision(plan_study(file.path, common.sets, common.random_seed, file.files),
                          read_question(command.words));
  tell_of_files(file);
  return answer(decision, common, command.batch, command.reuse);
}

}  // namespace

void add_decide_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<DecideCommandOptions>();
  CLI::App* command = app.add_subcommand(
      "decide", "find the best layout of a study: adds replicates where they matter, up to the requested confidence");
  add_common_options(*command, options->common, "study file (.toml)");
  add_question_options(*command, options->words);
  add_html_option(*command, options->common);
  add_replays_option(*command, options->common);
  add_making_flags(*command, options->batch);
  add_reuse_option(*command, options->reuse);
  add_examples(*command, {"vibrosow decide wheat-demo --goal rate --out best",
                          "vibrosow decide wheat-demo --goal unevenness --within \"20 %\" --out even",
                          "vibrosow decide wheat-demo --goal rate --procedure posterior --out likely"});
  command->callback([options, &exit_code] { exit_code = run_decide(*options); });
}

}  // namespace vibrosow
