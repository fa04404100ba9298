#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/drawn_chart.hpp"
#include "cli/drawn_frames.hpp"
#include "cli/help_text.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "compute/stop_request.hpp"
#include "files/atomic_file.hpp"
#include "files/whole_file.hpp"
#include "input/input_file.hpp"
#include "input/read_scene.hpp"
#include "picture/chart.hpp"
#include "picture/picture.hpp"
#include "plan/model.hpp"
#include "scene/input_error.hpp"
#include "simulation/simulation.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

struct DrawOptions {
  CommonOptions common;
  std::string at, from, to, every = "0.05 s";
  std::string chart;  // empty: a picture or a film
  bool film = false;
  PictureOptions picture;
};

/// The times of the frames that are wanted, s. Throws InputError.
std::vector<double> wanted_times(const DrawOptions& options, double duration) {
  const auto time = [&](const char* option, const std::string& text) {
    return quantity_option(option, text, Dimension::time, 0, duration);
  };
  if (!options.film) return {options.at.empty() ? duration : time("--at", options.at)};
  const double from = options.from.empty() ? 0 : time("--from", options.from);
  const double to = options.to.empty() ? duration : time("--to", options.to);
  const double every = time_option("--every", options.every);
  if (from > to) throw InputError("--from: is after --to");
  constexpr double most = 2000;
  const double frames = std::floor((to - from) / every * (1 + 1e-12)) + 1;
  if (frames > most) throw InputError(fmt::format("--every: {:g} frames are more than {:g}", frames, most));
  std::vector<double> times;
  for (int k = 0; k < static_cast<int>(frames); ++k) times.push_back(std::min(to, from + k * every));
  return times;
}

/// Where the picture goes; its name's end says what it is.
fs::path picture_path(const DrawOptions& options) {
  fs::path named = fs::absolute(options.common.file).lexically_normal();  // "." has a name too
  if (!named.has_filename()) named = named.parent_path();
  const fs::path stem = fs::is_directory(named) ? named.filename() : named.stem();
  const std::string of_chart = options.chart.empty() ? "" : "-" + options.chart;
  if (options.common.out.empty()) return stem.string() + of_chart + (options.film ? ".gif" : ".png");
  fs::path path = options.common.out;
  if (options.film ? !has_extension(path, ".gif") : !has_extension(path, ".png") && !has_extension(path, ".svg"))
    throw InputError(fmt::format("--out: \"{}\" does not end in {}", path.string(),
                                 options.film ? ".gif, which --gif makes" : ".png or .svg; a .gif is made with --gif"));
  return path;
}

struct Drawn {
  Scene scene;
  std::vector<Frame> frames;  // as far as it came
  int exit_code = exit_done;
};

/// Runs to each of the times.
Drawn simulated(const DrawOptions& options) {
  const InputFile file = input_file(options.common.file, FileKind::seeder);
  const Model model = prepare_to_run(read_seeder(file.path, options.common.overrides(), file.files).scene);
  const std::vector<double> times = wanted_times(options, model.scene.run.duration);
  Drawn drawn{model.scene, {}};
  const StopRequest stop(&watch_for_interrupt());
  Progress progress(text_unless(options.common.quiet), times.back(), "s simulated");
  try {
    Simulation simulation(model, starting_state(model, options.common.random_seed, stop), {.stop = stop});
    constexpr double between_looks = 1e-3;  // s
    for (const double time : times) {
      while (simulation.time() < time && !simulation.at_end()) {
        if (stop.is_set()) return {model.scene, {}, exit_interrupted};
        if (!simulation.run_until(std::min(time, simulation.time() + between_looks))) {
          complain(fmt::format("the run ended at {:g} s: {}", simulation.time(),
                               simulation.state().guard.stop_reason.value_or(simulation.state().run.end_reason)));
          drawn.exit_code = simulation.state().guard.stop_reason ? exit_stopped_by_guard : exit_done;
          drawn.frames.push_back(simulation.frame());
          return drawn;
        }
        if (times.back() > 0) progress.update(simulation.time() / times.back());
      }
      drawn.frames.push_back(simulation.frame());
    }
  } catch (const Interrupted&) {
    drawn.exit_code = exit_interrupted;
  }
  return drawn;
}

/// Throws InputError where a time that was asked for lies beyond what a page keeps of its run, which was cut short.
void refuse_beyond(const std::vector<Frame>& frames, const std::vector<double>& times, const DrawOptions& options) {
  double gap = 0;
  for (std::size_t k = 1; k < frames.size(); ++k) gap = std::max(gap, frames[k].bed.time - frames[k - 1].bed.time);
  const double from = frames.front().bed.time, to = frames.back().bed.time;
  const bool early = !(options.at.empty() && options.from.empty()) && times.front() < from - gap;
  const bool late = !(options.at.empty() && options.to.empty()) && times.back() > to + gap;
  if (early || late)
    throw InputError(fmt::format("{}: its page keeps the run from {:.3f} to {:.3f} s, not at {:g} s",
                                 options.common.file, from, to, early ? times.front() : times.back()));
}

/// What a run's folder keeps.
Drawn kept(const DrawOptions& options) {
  const fs::path folder = options.common.file;
  if (!options.common.sets.empty()) throw InputError("--set: goes with a seeder, not with the folder of a run");
  const PictureOptions& picture = options.picture;
  if (picture.force_chains || picture.colour_by == ColourBy::force)
    throw InputError(fmt::format(
        "{}: forces are not read from a run's folder, whose page keeps them rounded; draw its seeder instead",
        folder.string()));
  const Scene scene = scene_of_run(folder);
  const std::vector<double> times = wanted_times(options, scene.run.duration);
  KeptFrames all = kept_frames(folder, scene);
  if (picture.colour_by == ColourBy::speed && !all.have_speeds)
    throw InputError(fmt::format("{}: its page keeps no speeds; draw its seeder instead", folder.string()));
  if (!all.have_speeds) refuse_beyond(all.frames, times, options);
  return {scene, nearest_frames(std::move(all.frames), times)};
}

int draw_chart(const DrawOptions& options) {
  const bool has_more = options.film || !options.at.empty() || !options.from.empty() || !options.to.empty() ||
                        !options.common.sets.empty() || options.picture.force_chains ||
                        options.picture.colour_by != ColourBy::lot;
  if (has_more) throw InputError("--chart: goes with --out, --width and --jobs alone");
  const std::string& folder = options.common.file;
  if (!fs::is_directory(folder))
    throw InputError(fmt::format("{}: is no folder; --chart draws what the folder of run or of a study holds", folder));
  const fs::path path = picture_path(options);
  const Chart chart = drawn_chart(folder, options.chart, options.common.jobs);
  const int width = options.picture.width;
  write_file_atomically(path, has_extension(path, ".svg") ? chart_svg(chart, width) : chart_png(chart, width));
  if (!options.common.quiet) print("{}: {}\n", path.string(), options.chart);
  return exit_done;
}

int draw(const DrawOptions& options) {
  if (!options.chart.empty()) return draw_chart(options);
  if (options.film ? !options.at.empty() : !options.from.empty() || !options.to.empty())
    throw InputError("--at is for a picture, --from and --to are for a film: --gif");
  const fs::path path = picture_path(options);
  const Drawn drawn = is_run_folder(options.common.file) ? kept(options) : simulated(options);
  if (drawn.frames.empty()) return drawn.exit_code;
  const Picture picture(drawn.scene, drawn.frames, options.picture);
  const Frame& last = drawn.frames.back();
  write_file_atomically(path, options.film                  ? picture.gif(drawn.frames)
                              : has_extension(path, ".svg") ? picture.svg(last)
                                                            : picture.png(last));
  if (!options.common.quiet)
    print("{}: {}\n", path.string(),
          options.film ? fmt::format("{} frames from {:.3f} to {:.3f} s", drawn.frames.size(),
                                     drawn.frames.front().bed.time, last.bed.time)
                       : fmt::format("the run at {:.3f} s", last.bed.time));
  return drawn.exit_code;
}

}  // namespace

void add_draw_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<DrawOptions>();
  CLI::App* command = app.add_subcommand("draw", "draw a picture or a film of a run, or a chart of a folder's results");
  const auto text = [command](const char* name, std::string& value, const char* type, const char* help) {
    command->add_option(name, value, help)->type_name(type);
  };
  add_input_options(*command, options->common, "seeder file (.toml), run up to that time; or the folder of a run");
  text("--at", options->at, "TIME", "time of the run; default its end; of a folder, the nearest kept frame");
  command->add_flag("--gif", options->film, "a film instead");
  text("--from", options->from, "TIME", "start of a film; default 0");
  text("--to", options->to, "TIME", "end of a film; default the run's end");
  text("--chart", options->chart, "NAME",
       "chart of a folder: outflow (of run), ranking (of sweep, decide, optimise), front (of optimise), precision (of "
       "accuracy), fit (of calibrate)");
  text("--every", options->every, "TIME",
       "time between a film's frames; below \"20 ms\" the film is slower than the run");
  text("--out", options->common.out, "FILE",
       "file to write, .png or .svg, of a film .gif; default the seeder's name and .png or .gif");
  command
      ->add_option_function<std::string>(
          "--colour",
          [options](const std::string& name) {
            options->picture.colour_by = name == "speed"   ? ColourBy::speed
                                         : name == "force" ? ColourBy::force
                                                           : ColourBy::lot;
          },
          "colour of the seeds: by lot, speed in the lab, or the sum of the normal forces on a seed")
      ->type_name("BY")
      ->check(CLI::IsMember({"lot", "speed", "force"}))
      ->default_str("lot");
  command->add_flag("--chains", options->picture.force_chains,
                    "draw contacts, wider where their normal force is larger");
  command->add_option("--width", options->picture.width, "width of the picture, pixels")
      ->type_name("N")
      ->check(CLI::Range(160, 8000))
      ->capture_default_str();
  add_random_seed_option(*command, options->common);
  add_jobs_option(*command, options->common);
  command->add_flag("--quiet", options->common.quiet, "no progress and no line about the picture");
  add_examples(*command, {"vibrosow draw wheat-section --at \"0.3 s\"",
                          "vibrosow draw my-wheat-tray.toml --gif --to \"0.4 s\" --every \"20 ms\"",
                          "vibrosow draw 11-hz --chart outflow"});
  command->callback([options, &exit_code] { exit_code = draw(*options); });
}

}  // namespace vibrosow
