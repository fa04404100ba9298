#include "cli/slurm.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>

#include "cli/console.hpp"
#include "scene/input_error.hpp"
#include "scene/printable.hpp"

namespace vibrosow {
namespace {

struct Output {
  std::string text;  // without the last line's end
  bool succeeded = false;
};

/// What a command prints on standard output.
Output output_of(const std::vector<std::string>& words) {
  std::string command;
  for (const std::string& word : words) command.append(shell_quoted(word)).push_back(' ');
  FILE* const pipe = popen(command.c_str(), "re");
  if (!pipe) return {};
  Output output;
  std::array<char, 4096> part;
  while (const std::size_t size = fread(part.data(), 1, part.size(), pipe)) output.text.append(part.data(), size);
  const int status = pclose(pipe);
  output.succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  while (output.text.ends_with('\n')) output.text.pop_back();
  return output;
}

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

/// Of a task of an array "ARRAY_TASK": its own SLURM_JOB_ID may be that of the whole array.
std::string own_job() {
  const std::string array = variable("SLURM_ARRAY_JOB_ID"), task = variable("SLURM_ARRAY_TASK_ID");
  return array.empty() || task.empty() ? variable("SLURM_JOB_ID") : fmt::format("{}_{}", array, task);
}

}  // namespace

void requeue_in_slurm() {
  const std::string job = own_job();
  if (job.empty()) return;
  // A cancelled job is "COMPLETING" by now, and would come back if it were requeued.
  if (output_of({"squeue", "-h", "-j", job, "-o", "%T"}).text != "RUNNING") return;
  if (!output_of({"scontrol", "requeue", job}).succeeded)
    complain(fmt::format("warning: Slurm does not take job {} back into its queue", job));
}

std::string submit_to_slurm(const std::string& script, const std::vector<std::string>& options) {
  std::vector<std::string> words = {"sbatch", "--parsable"};
  words.insert(words.end(), options.begin(), options.end());
  words.push_back(script);
  const Output output = output_of(words);
  if (output.text.empty())  // with --wait it also fails where a task has
    throw InputError(fmt::format("sbatch did not take {}: is this a machine that submits to Slurm?", script));
  return output.text.substr(0, output.text.find(';'));  // "12;CLUSTER" where there are several
}

}  // namespace vibrosow
