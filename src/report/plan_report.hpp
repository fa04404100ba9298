#pragma once

#include <optional>
#include <string>
#include <vector>

#include "agronomy/sowing_plan.hpp"
#include "agronomy/weighed_plan.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"

namespace vibrosow {

/// A crop of a plan.
struct PlannedLot {
  std::string crop;                   // as it was asked for
  SownLot sown;                       // its seeds and their part of the rate
  std::optional<double> crop_mass{};  // kg, of a seed of the crop, where another was given beside it
};

/// The contact of the seeds, for which the table's outflows were multiplied (SowingPlan::table_times).
struct PlannedContact {
  SeedContact seed;
  bool is_beyond = false;  // of no contact that was tried: the nearest of these was taken
};

/// A plan and what was asked for, as far as a reader is told of it.
struct PlanSource {
  SowingPlan plan;
  std::optional<PlannedContact> contact{};  // none: the crop names no contact model
  std::vector<PlannedLot> lots;             // several: a mixture
  std::optional<double> plants{};           // 1/m2, where the rate was asked for by plants
  std::optional<double> establishment{};    // fraction, then
  std::optional<int> rows{};                // of the drill
};

/// The need, the risk of clogging, the best layouts and how far to trust them; for a terminal.
std::string plan_text(const PlanSource& source);

/// One row per layout that gives the rate, the best first.
std::string plan_csv(const SowingPlan& plan, CsvFormat format = {});

/// The best layout in an endless tray in 3D, as a seeder file. Throws std::invalid_argument without a
/// layout.
std::string planned_seeder(const PlanSource& source);

/// What is sown: every crop with kg/ha and seeds/m2; sentences.
std::vector<std::string> need_sentences(const PlanSource& source);

/// How likely the best layout's holes clog, and how sure its rate is; sentences.
std::string risk_sentence(const SowingPlan& plan);
std::vector<std::string> trust_sentences(const PlanSource& source);

/// What a tray that was weighed is to be set to, and how sure that is: sentences, and the same for a terminal.
std::vector<std::string> weighed_sentences(const PlanSource& source, int rows, const WeighedPlan& plan);
std::string weighed_text(const PlanSource& source, int rows, const WeighedPlan& plan);

/// What the files of the command hold.
std::vector<FileText> plan_file_texts();

/// settings.csv, of the frequencies that give what is needed, weighed.csv and lots.csv.
std::vector<OutputFile> weighed_files(const PlanSource& source, const WeighedPlan& plan, CsvFormat format = {});

/// plan.csv, lots.csv, and with a layout seeder.toml.
std::vector<OutputFile> plan_files(const PlanSource& source, CsvFormat format = {});

}  // namespace vibrosow
