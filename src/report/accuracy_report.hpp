#pragma once

#include <optional>
#include <string>
#include <vector>

#include "accuracy/accuracy.hpp"
#include "accuracy/promise.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"

namespace vibrosow {

/// One row per setting; a setting that gave no rate has its cells empty.
std::string accuracy_csv(const AccuracyResult& result, CsvFormat format = {});

/// One row per run, in the order in which they were begun.
std::string accuracy_runs_csv(const AccuracyResult& result, CsvFormat format = {});

/// One row per part of a setting that was varied, and one of chance; the header alone without a fit.
std::string accuracy_errors_csv(const AccuracyResult& result, CsvFormat format = {});

/// CPU times of this machine, mean of a setting's runs.
std::string accuracy_timing_csv(const AccuracyResult& result, CsvFormat format = {});

/// The settings for a terminal, scheme by scheme, with the reason where a setting gave no rate; then the errors by
/// their sources.
std::string accuracy_table(const AccuracyResult& result);

/// How near the finest setting is to the limit, and what 1 % of outflow costs: the cheapest setting whose fitted error
/// and band together make up at most 1 %.
std::string accuracy_sentence(const AccuracyResult& result);

/// "velocity-verlet, 20 steps a contact, shell compression 0.001"
std::string setting_text(const AccuracySetting& setting);

/// A line of the account of errors: what changing a part of a setting, from its finest level to its coarsest, does to
/// the rate, percent.
struct ErrorRow {
  std::string source, from, to;
  double percent;
  std::optional<double> band{};  // half width of its 95 % interval
};
std::vector<ErrorRow> error_rows(const AccuracyResult& result);

/// Settings, fit and runs of a promise, as a table has them.
AccuracyResult result_of(const Promise& promise);

/// What was promised, or why nothing was; a paragraph each.
std::vector<std::string> promise_paragraphs(const Promise& promise, const PromiseGoal& goal);

/// The CPU time that it took, in a sentence.
std::string promise_cost(const Promise& promise);

/// Both for a terminal, with what speaks against its runs and the scene.
std::string promise_text(const Scene& scene, const Promise& promise, const PromiseGoal& goal);

/// The keys of a seeder that set the scene to an offer's setting, as TOML: also of lots with a softness of their own.
std::string promised_numerics(const Scene& scene, const Promise& promise, const PromiseGoal& goal);

/// What the files of the command hold.
std::vector<FileText> accuracy_file_texts();

/// What the command took.
struct AccuracyTiming {
  double wall_time = 0;  // s, from beginning to end
  int jobs = 1;
};

/// accuracy.csv, accuracy_runs.csv, accuracy_errors.csv, accuracy_timing.csv and timing.json.
std::vector<OutputFile> accuracy_files(const AccuracyResult& result, const AccuracyTiming& timing,
                                       CsvFormat format = {});

/// The same of a promise's runs, promise.json and, where there is an offer, numerics.toml.
std::vector<OutputFile> promise_files(const Scene& scene, const Promise& promise, const PromiseGoal& goal,
                                      const AccuracyTiming& timing, CsvFormat format = {});

}  // namespace vibrosow
