#include "cli/compare_spaces.hpp"

#include <cmath>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "outflow/doubts.hpp"
#include "plan/model.hpp"
#include "report/number_text.hpp"
#include "report/terminal_text.hpp"
#include "study/evaluate.hpp"

namespace vibrosow {
namespace {

Evaluation run_once(const Scene& scene) {
  const Model model = prepare_to_run(scene);
  SimulationOptions options;
  options.interrupt = &watch_for_interrupt();
  Progress progress(ProgressStyle::text, static_cast<double>(model.step.steps), "steps");
  options.progress = [&progress](double fraction) { progress.update(fraction); };
  return evaluate(model, options);
}

/// Of the whole tray; the plane's slice times its slices.
struct TrayRate {
  double seeds = 0, mass = 0;  // 1/s, kg/s
  std::int64_t counted = 0;
};

TrayRate tray_rate(const Evaluation& evaluation) {
  const HoleOutflow& all = *find_row(evaluation.outflow, "all", "all");
  const double slices = evaluation.outflow.depth_factor.value();
  return {all.seeds_per_s * slices, all.mass_rate * slices, all.grains};
}

void print_rate(std::string_view space, const TrayRate& rate, const Evaluation& evaluation) {
  print("  {:<6} {:>9} g/s {:>9} seeds/s of the tray, from {} counted; run in {}\n", space,
        number_text(rate.mass * 1e3), number_text(rate.seeds), rate.counted, duration_text(evaluation.wall_time));
  for (const Doubt& doubt : evaluation.outflow.doubts)
    print_text(wrapped_beside("         ", sentence_of(remark_of(doubt))));
}

}  // namespace

void print_space_advice(const Scene& scene) {
  const bool flat = scene.space == Space::two_dimensional;
  print("{}\n", flat ? "2D: discs in a slice one seed thick" : "3D: balls");
  print_text(wrapped_beside(
      "  ", flat ? "use 2D to compare layouts and frequencies of slots; an absolute rate or round holes need space = "
                   "\"3d\": through the one measured slot 2D is 13 % too fast, 3D 5 %"
                 : "use 3D for absolute rates and round holes; to compare many layouts of slots, 2D is far faster"));
  print("  check --both runs both and prints the ratio of their rates\n");
}

int run_in_both_spaces(const BothSpaces& scenes) {
  const auto& [plane, space] = scenes;
  const Evaluation flat = run_once(plane);
  if (flat.status == EvaluationStatus::interrupted) return exit_interrupted;
  const Evaluation deep = run_once(space);
  if (deep.status == EvaluationStatus::interrupted) return exit_interrupted;
  for (const Evaluation* one : {&flat, &deep})
    if (!one->finished()) {
      complain(one->reason);
      return exit_stopped_by_guard;
    }
  const TrayRate of_slice = tray_rate(flat), of_tray = tray_rate(deep);
  print("2D and 3D, one run each, window {:.4g} to {:.4g} s\n", deep.outflow.window.from, deep.outflow.window.to);
  print_rate("2D", of_slice, flat);
  print_rate("3D", of_tray, deep);
  if (flat.outside_the_model || deep.outside_the_model)
    print("  outside the model: no ratio of it\n");
  else if (of_tray.counted > 0)
    print("  2D over 3D {}\n", to_digits(of_slice.seeds / of_tray.seeds, 3));
  return exit_done;
}

}  // namespace vibrosow
