// How many promises of `vibrosow accuracy --within` are kept when their runs are drawn, with replacement, from runs
// that were really made: each FILE is an accuracy_runs.csv of a full grid of settings of one scene. The limit is that
// of the fit of all its runs; few runs of a setting have a mean of their own that is no main effect, so this is harder
// than real promises are.
//   promise_coverage COUNT PERCENT FILE...
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "accuracy/promise.hpp"
#include "grains/random.hpp"
#include "input/csv_lines.hpp"
#include "scene/input_error.hpp"
#include "scene/integrator_names.hpp"

namespace {

using namespace vibrosow;

/// Runs of every setting; settings of velocity Verlet alone.
struct Bank {
  std::vector<AccuracySetting> settings;
  std::vector<std::vector<AccuracyRun>> runs;
};

double number(const std::string& text) {
  return text.empty() ? 0 : std::strtod(text.c_str(), nullptr);
}

Bank read_bank(const std::string& path) {
  std::ifstream file(path);
  const CsvLines lines = parse_csv_lines({std::istreambuf_iterator<char>(file), {}}, path);
  Bank bank;
  for (const CsvLines::Row& row : lines.rows) {
    const auto field = [&](const char* name) {
      const auto place = std::ranges::find(lines.header.fields, name) - lines.header.fields.begin();
      return row.fields.at(static_cast<std::size_t>(place));
    };
    if (field("integrator") != integrator_name(Integrator::velocity_verlet) || field("rate_g_per_s").empty()) continue;
    AccuracySetting setting;
    setting.steps_per_contact = number(field("steps_per_contact"));
    setting.shell_compression = number(field("shell_compression"));
    setting.youngs_modulus = 1e6 * number(field("youngs_modulus_MPa"));
    setting.slip_speed = 1e-3 * number(field("slip_speed_mm_per_s"));
    setting.dt = number(field("dt_s"));
    setting.contact_duration = setting.dt * setting.steps_per_contact;
    setting.overlap_at_rest = setting.contact_duration * setting.contact_duration;  // of a shell; any factor will do
    const auto same = std::ranges::find(bank.settings, setting.dt, &AccuracySetting::dt);
    const auto place = static_cast<std::size_t>(same - bank.settings.begin());
    if (same == bank.settings.end()) bank.settings.push_back(setting), bank.runs.emplace_back();
    const double grain_steps = number(field("grain_steps"));
    bank.runs[place].push_back({.setting = place,
                                .mass_rate = 1e-3 * number(field("rate_g_per_s")),
                                .seeds = 1e9,
                                .grain_steps = grain_steps,
                                .cpu_time = 1e-8 * grain_steps});
  }
  return bank;
}

/// One round: what is soft and coarse costs little and is run more often, as in the program's own design.
AccuracyDesign design_of(const Bank& bank) {
  AccuracyGrid grid;
  grid.integrators = {Integrator::velocity_verlet};
  for (const AccuracySetting& setting : bank.settings) {
    for (auto [level, levels] : {std::pair(setting.steps_per_contact, &grid.steps_per_contact),
                                 std::pair(setting.shell_compression, &grid.shell_compressions)})
      if (std::ranges::find(*levels, level) == levels->end()) levels->push_back(level);
  }
  std::ranges::sort(grid.steps_per_contact);
  std::ranges::sort(grid.shell_compressions);
  const AccuracyDesign thrifty = screening_design(grid);
  AccuracyDesign design{bank.settings, std::vector<int>(bank.settings.size(), 0)};
  for (std::size_t i = 0; i < thrifty.settings.size(); ++i)
    for (std::size_t k = 0; k < bank.settings.size(); ++k)
      if (thrifty.settings[i].steps_per_contact == bank.settings[k].steps_per_contact &&
          thrifty.settings[i].shell_compression == bank.settings[k].shell_compression)
        design.runs[k] = thrifty.runs[i];
  return design;
}

void print_coverage(const std::string& file, int count, double percent) {
  const Bank bank = read_bank(file);
  std::vector<AccuracyRun> all;
  for (const std::vector<AccuracyRun>& runs : bank.runs) all.insert(all.end(), runs.begin(), runs.end());
  const std::optional<ErrorFit> fit = ErrorFit::of(bank.settings, all);
  if (!fit) throw InputError(file + ": too few runs");
  const PromiseChoices choices{.design = design_of(bank)};
  int made = 0, kept = 0;
  double bounds = 0, errors = 0;
  for (int i = 1; i <= count; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const Promise promised = promise(choices, {.within_percent = percent}, [&](const std::vector<SettingRuns>& wanted) {
      std::vector<AccuracyRun> drawn;
      for (const SettingRuns& of : wanted)
        for (int run = 0; run < of.runs; ++run)
          drawn.push_back(bank.runs[of.setting][random.below(bank.runs[of.setting].size())]);
      return drawn;
    });
    if (!promised.mass_rate) continue;
    const double error = 100 * std::abs(promised.mass_rate->mean / fit->limit().mean - 1);
    ++made;
    kept += error <= percent;
    bounds += promised.offer->error_bound();
    errors += error;
  }
  fmt::print("{},{:g},{},{},{},{:.3g},{:.3g}\n", std::filesystem::path(file).parent_path().filename().string(), percent,
             count, made, kept, made ? bounds / made : 0, made ? errors / made : 0);
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 4) {
    fmt::print(stderr, "usage: promise_coverage COUNT PERCENT FILE...\n");
    return 2;
  }
  fmt::print("scene,within_percent,asked,made,kept,mean_bound_percent,mean_error_percent\n");
  try {
    for (int i = 3; i < count; ++i) print_coverage(arguments[i], std::atoi(arguments[1]), number(arguments[2]));
  } catch (const InputError& error) {
    fmt::print(stderr, "promise_coverage: {}\n", error.what());
    return 2;
  }
}
