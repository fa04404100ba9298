#pragma once

#include <optional>
#include <string>
#include <vector>

#include "agronomy/sowing_plan.hpp"
#include "agronomy/weighed_plan.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"

namespace vibrosow {

/// A plan and what was asked for, as far as a reader is told of it.
struct PlanSource {
  SowingPlan plan;
  std::string crop;                       // as it was asked for
  SeedLot lot;                            // its seeds
  bool own_mass = false;                  // their mass was given beside the crop
  std::optional<double> plants{};         // 1/m2, where the rate was asked for by plants
  std::optional<double> establishment{};  // fraction, then
  std::optional<int> rows{};              // of the drill
};

/// The need, the risk of clogging, the best layouts and how far to trust them; for a terminal.
std::string plan_text(const PlanSource& source);

/// One row per layout that gives the rate, the best first.
std::string plan_csv(const SowingPlan& plan, CsvFormat format = {});

/// The best layout in an endless tray in space, as a seeder file. Throws std::invalid_argument without a
/// layout.
std::string planned_seeder(const PlanSource& source);

/// What a tray that was weighed is to be set to, and how sure that is; for a terminal.
std::string weighed_text(const SowingTask& task, int rows, const WeighedPlan& plan);

/// What the files of the command hold.
std::vector<FileText> plan_file_texts();

/// settings.csv, of the frequencies that give what is needed, and weighed.csv.
std::vector<OutputFile> weighed_files(const WeighedPlan& plan, CsvFormat format = {});

/// plan.csv, and with a layout seeder.toml.
std::vector<OutputFile> plan_files(const PlanSource& source, CsvFormat format = {});

}  // namespace vibrosow
