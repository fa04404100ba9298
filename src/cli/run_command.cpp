#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "agronomy/row_metrics.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/drill_table.hpp"
#include "cli/help_text.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/run_answer.hpp"
#include "cli/threads.hpp"
#include "files/atomic_file.hpp"
#include "files/whole_file.hpp"
#include "input/input_file.hpp"
#include "input/read_scene.hpp"
#include "outflow/outflow.hpp"
#include "plan/effects.hpp"
#include "plan/fill_warnings.hpp"
#include "plan/model.hpp"
#include "plan/scene_warnings.hpp"
#include "recording/recording.hpp"
#include "report/expected_report.hpp"
#include "report/kept_page.hpp"
#include "report/mixture_text.hpp"
#include "report/number_text.hpp"
#include "report/output_folder.hpp"
#include "report/page.hpp"
#include "report/run_page.hpp"
#include "report/run_report.hpp"
#include "report/terminal_text.hpp"
#include "report/vtk_report.hpp"
#include "report/xyz_report.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_json.hpp"
#include "simulation/checkpoint.hpp"
#include "simulation/simulate.hpp"
#include "simulation/state.hpp"
#include "study/expected_rate.hpp"

namespace vibrosow {
namespace {

/// A run that ended before its measuring window has no rates.
std::string metric_text(double value) {
  return number_text(value);
}

void print_holes(const Outflow& outflow) {
  const auto millimetres = [](const std::optional<double>& at) {
    return at ? fmt::format("{:.1f}", *at * 1e3) : std::string();
  };
  const bool rows_of_holes = has_rows_of_holes(outflow);
  std::size_t width = 3;  // of the names of lots
  for (const HoleOutflow& row : outflow.holes) width = std::max(width, row.lot.size());
  print("{:>6}  {:<{}} {:>12}", "hole", "lot", width, "position mm");
  if (rows_of_holes) print(" {:>9}", "across mm");
  print(" {:>8} {:>9} {:>9} {:>9}\n", "seeds", "seeds/s", "g/s", "pause s");
  for (const HoleOutflow& row : outflow.holes) {
    print("{:>6}  {:<{}} {:>12}", row.hole, row.lot, width, millimetres(row.centre));
    if (rows_of_holes) print(" {:>9}", millimetres(row.across));
    print(" {:>8} {:>9} {:>9} {:>9}\n", row.grains, metric_text(row.seeds_per_s), metric_text(row.mass_rate * 1e3),
          metric_text(row.longest_pause));
  }
}

void print_summary(const Scene& scene, const Run& run, const Outflow& outflow,
                   const std::optional<ExpectedRate>& expected) {
  print("{}\n", wrapped(scene.title));
  for (const Doubt& doubt : outflow.doubts) print_text(wrapped(sentence_of(remark_of(doubt))));
  if (!outflow.doubts.empty()) print("\n");
  print_holes(outflow);
  if (const std::string mixture = mixture_text(scene, run.drawn); !mixture.empty()) print_text("\n" + mixture);
  const HoleOutflow& all = *find_row(outflow, "all", "all");
  const bool is_3d = scene.space == Space::three_dimensional;
  if (const auto& depth = outflow.depth_factor)
    print_text("\n" +
               wrapped(fmt::format("whole tray{}: {} g/s = {} g/min, {} seeds/s{}",
                                   is_3d ? "" : fmt::format(", {:.4g} times the slice", *depth),
                                   metric_text(all.mass_rate * 1e3 * *depth), metric_text(all.mass_rate * 6e4 * *depth),
                                   metric_text(all.seeds_per_s * *depth), of_plane(scene.space))));
  if (expected) print_text(wrapped(expected_sentence(*expected)));
  if (const auto unevenness = unevenness_of({&outflow}))
    print_text("\n" + wrapped(unevenness_sentence(*unevenness, "hole")));
  const Balance& balance = run.balance;
  print("\n{}put in {} = inside {} + counted {} + spilled {} + lost {}\n",
        wrapped(window_sentence(outflow.window, scene.run.measure_from)), balance.put_in, balance.inside,
        balance.counted, balance.spilled, balance.lost);
}

void print_profile(const Run& run) {
  print("\n{:<14} {:>8} {:>8} {:>20}\n", "time spent on", "s", "share", "ns per grain-step");
  const auto row = [&](std::string_view phase, double time) {
    print("{:<14} {:>8.3f} {:>6.1f} % {:>20.2f}\n", phase, time, 100 * time / run.wall_time,
          1e9 * time / static_cast<double>(run.grain_steps));
  };
  for (std::size_t k = 0; k < phase_names.size(); ++k) row(phase_names[k], (*run.phase_times)[k]);
  row("all", run.wall_time);
}

struct RunOptions : CommonOptions {
  int threads = 1;
  bool profile = false;
  std::string checkpoint_every;
  bool resume = false;
  bool vtk = false, xyz = false;
};

/// The snapshots of a run with their contacts, which the run itself does not keep.
class RecordedFrames {
 public:
  /// Throws InputError where they cannot be had.
  RecordedFrames(const RunOptions& options, const Scene& scene) : options_(options) {
    if (!wanted()) return;
    const char* option = options.vtk ? "--vtk" : "--xyz";
    if (!scene.record) throw InputError(fmt::format("{}: the seeder has no [record], which says when", option));
    if (options.resume)
      throw InputError(
          fmt::format("{}: a checkpoint keeps no contacts of earlier snapshots; leave out --resume", option));
  }
  bool wanted() const { return options_.vtk || options_.xyz; }

  void note(Simulation& now) { contacts_.resize(now.state().run.snapshots.size(), now.field().contacts()); }

  std::vector<OutputFile> files(const Scene& scene, const std::vector<Snapshot>& snapshots) const {
    if (!wanted()) return {};
    std::vector<Frame> frames;
    for (std::size_t k = 0; k < snapshots.size(); ++k) frames.push_back({snapshots[k], contacts_[k]});
    std::vector<OutputFile> files;
    if (options_.vtk) files = vtk_files(scene, frames);
    if (options_.xyz) files.push_back({"grains.xyz", grains_xyz(scene, frames)});
    return files;
  }

 private:
  const RunOptions& options_;
  std::vector<std::vector<GrainContact>> contacts_;  // by snapshot
};

/// A run's checkpoint lies beside its folder, "out/wheat-tray.checkpoint", until the run is finished.
class CheckpointFile {
 public:
  explicit CheckpointFile(const std::filesystem::path& folder) : path_(folder) { path_ += ".checkpoint"; }

  /// What cannot be written is told once: the run goes on, and is saved the next time.
  void write(const Model& model, const SimulationState& state) {
    try {
      write_file_atomically(path_, save(model, state));
    } catch (const CannotWrite& error) {
      if (!told_) complain(fmt::format("warning: {}; the run continues unsaved", error.what()));
      told_ = true;
    }
  }

  /// What is there to go on from. Throws InputError where it does not fit.
  std::optional<SimulationState> read(const Model& model, std::uint64_t random_seed) const {
    const std::optional<std::string> bytes = text_of_file(path_);
    if (!bytes) {
      complain(fmt::format("there is no {}: the run starts from the beginning", path_.string()));
      return std::nullopt;
    }
    try {
      SimulationState state = restore(model, *bytes);
      if (state.run.random_seed == random_seed) return state;
      throw InputError(fmt::format("the checkpoint does not fit: its random seed was {}, and now {} is asked for",
                                   state.run.random_seed, random_seed));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}; leave out --resume to start again", path_.string(), error.what()));
    }
  }

  void remove() const {
    std::error_code none;
    std::filesystem::remove(path_, none);
  }

 private:
  std::filesystem::path path_;
  bool told_ = false;
};

/// Reports of another setting, which this run will replace, are told of.
void tell_of_replaced(const OutputFolder& folder, const Scene& scene) {
  std::optional<nlohmann::ordered_json> kept;
  try {
    kept = kept_page_data(folder.path());
  } catch (const InputError&) {  // from elsewhere: the folder itself says whose it is
  }
  if (kept && kept->contains("scene") && kept->at("scene") != nlohmann::ordered_json::parse(scene_to_json(scene)))
    complain(fmt::format("note: {} holds a run of another setting, which this one replaces; --out DIR keeps both",
                         folder.path().string()));
}

/// Of a fill by its height, which is put in here for that. A run that is resumed tells of it as well.
void warn_of_fill(const Model& model, SimulationOptions& options, std::vector<std::string>& warnings) {
  if (!has_fill_to_height(model.scene)) return;
  try {
    SimulationState start = starting_state(model, options.random_seed, StopRequest(options.interrupt));
    const std::vector<std::string> of_fill = fill_warnings(model.scene, start.grains);
    print_warnings(of_fill);
    std::ranges::copy(of_fill, std::back_inserter(warnings));
    if (!options.from) options.from = std::move(start);
  } catch (const Interrupted&) {  // as the run will be
  }
}

int run_scene(const RunOptions& options) {
  const InputFile file = input_file(options.file, FileKind::seeder);
  const auto [read, drill, drawings] = read_seeder(file.path, options.overrides(), file.files);
  std::vector<std::string> warnings = scene_warnings(read);
  if (!options.quiet)
    for (const Drawing& drawing : drawings) print_text(wrapped(drawing_text(drawing, read)));
  print_warnings(warnings);
  tell_of_files(file);
  const Model model = prepare_to_run(read);
  const Scene& scene = model.scene;
  const std::string page_template = options.page_template(scene.space == Space::two_dimensional);
  std::optional<RateKnowledge> knowledge;
  if (scene.space == Space::three_dimensional) knowledge = shipped_rate_knowledge();
  RecordedFrames recorded(options, scene);
  const OutputFolder folder = options.output_folder("run", run_file_texts());
  if (!options.quiet) tell_of_replaced(folder, scene);
  SimulationOptions simulation;
  simulation.random_seed = options.random_seed;
  simulation.threads = threads_to_be_had(options.threads);
  simulation.profile = options.profile;
  simulation.interrupt = &watch_for_interrupt();
  CheckpointFile checkpoint(folder.path());
  if (!options.checkpoint_every.empty()) {
    simulation.checkpoint_every = time_option("--checkpoint-every", options.checkpoint_every);
    simulation.on_checkpoint = [&](const SimulationState& state) { checkpoint.write(model, state); };
  }
  if (options.resume) simulation.from = checkpoint.read(model, options.random_seed);
  const bool is_resumed = simulation.from.has_value();
  warn_of_fill(model, simulation, warnings);
  if (recorded.wanted()) simulation.on_record = [&](Simulation& now) { recorded.note(now); };
  Recording recording(model);
  const bool records = options.html && !is_resumed;  // of the rest alone it would be taken for the run's
  if (records) simulation.observers = recording.observers();
  if (options.html && !records && !options.quiet)
    print_notes({fmt::format("the page of a resumed run has no replay and no map; {} makes the run again for them",
                             typed_line({"report", folder.path().string()}))});
  Run run;
  {
    Progress progress(text_unless(options.quiet), static_cast<double>(model.step.steps), "steps");
    simulation.progress = [&](double fraction) { progress.update(fraction); };
    run = run_model(model, simulation);
  }
  const RunAnswer answer = answer_of_run(scene, run, warnings, knowledge, drill);
  std::vector<OutputFile> files =
      files_of_run(model, run, answer, options.csv, page_template, records ? recording.file() : "");
  std::ranges::move(recorded.files(scene, run.snapshots), std::back_inserter(files));
  write_then_print(
      options.quiet, [&] { folder.write(files); },
      [&] {
        print_summary(scene, run, answer.outflow, answer.expected);
        if (answer.sown) print_drill(*answer.sown, scene.space);
        if (run.phase_times) print_profile(run);
      });
  if (run.status == RunStatus::finished && (options.resume || simulation.on_checkpoint)) checkpoint.remove();
  if (!options.quiet) print("reports: {}\n", folder.path().string());
  for (const Doubt& warning : run.warnings) print_warnings({warning.text});
  if (run.status == RunStatus::stopped_by_guard) {
    complain("the guard stopped the run: " + run.stop_reason);
    return exit_stopped_by_guard;
  }
  return run.status == RunStatus::interrupted ? exit_interrupted : exit_done;
}

}  // namespace

void add_run_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "simulate a seeder once; show the outflow of each hole");
  add_common_options(*command, *options, "seeder file (.toml)");
  command->add_option("--threads", options->threads, "threads of one run; worth it from about 10000 seeds")
      ->type_name("N")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--profile", options->profile, "show where the time went; also in timing.json");
  command
      ->add_option("--checkpoint-every", options->checkpoint_every,
                   "simulated time between checkpoints, such as \"1 s\"; they are saved beside the run's folder")
      ->type_name("TIME");
  command->add_flag("--resume", options->resume,
                    "resume from the checkpoint, with the same results as an uninterrupted run");
  add_html_option(*command, *options);
  command->add_flag("--vtk", options->vtk,
                    "also write snapshots of [record] for ParaView: grains.pvd, contacts.pvd, ..");
  command->add_flag("--xyz", options->xyz, "also write snapshots of [record] for OVITO: grains.xyz");
  add_examples(*command, {"vibrosow run wheat-section", "vibrosow run my-wheat-tray.toml --html",
                          "vibrosow run wheat-section --set \"tray.motion.frequency=11 Hz\" --out 11-hz"});
  command->callback([options, &exit_code] { exit_code = run_scene(*options); });
}

}  // namespace vibrosow
