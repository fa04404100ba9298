#pragma once

#include <CLI/CLI.hpp>

namespace vibrosow {

/// What the program ends with; the help and docs/reference/stable.md list it.
enum ExitCode {
  exit_done = 0,
  exit_wrong_input = 2,
  exit_stopped_by_guard = 3,
  exit_defect = 4,
  exit_interrupted = 130
};

// Each adds its subcommand, whose callback does the work and sets `exit_code`.
void add_run_command(CLI::App& app, int& exit_code);
void add_sweep_command(CLI::App& app, int& exit_code);
void add_decide_command(CLI::App& app, int& exit_code);
void add_optimise_command(CLI::App& app, int& exit_code);
void add_accuracy_command(CLI::App& app, int& exit_code);
void add_bench_sheet_command(CLI::App& app, int& exit_code);
void add_calibrate_command(CLI::App& app, int& exit_code);
void add_work_command(CLI::App& app, int& exit_code);
void add_submit_command(CLI::App& app, int& exit_code);
void add_pack_command(CLI::App& app, int& exit_code);
void add_report_command(CLI::App& app, int& exit_code);
void add_export_command(CLI::App& app, int& exit_code);
void add_status_command(CLI::App& app, int& exit_code);
void add_verify_command(CLI::App& app, int& exit_code);
void add_new_crop_command(CLI::App& app, int& exit_code);
void add_new_seeder_command(CLI::App& app, int& exit_code);
void add_demo_command(CLI::App& app, int& exit_code);
void add_draw_command(CLI::App& app, int& exit_code);
void add_check_command(CLI::App& app, int& exit_code);
void add_plan_command(CLI::App& app, int& exit_code);
void add_studio_command(CLI::App& app, int& exit_code);
void add_presets_command(CLI::App& app, int& exit_code);
/// `help COMMAND`, for those that were added before, and `columns`, an older name of `help columns`.
void add_help_command(CLI::App& app, int& exit_code);

}  // namespace vibrosow
