#pragma once

#include <optional>
#include <string>
#include <vector>

#include "optimise/decide.hpp"
#include "optimise/draft_screen.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"

namespace vibrosow {

/// What stands in the files of a decision.
struct DecisionReport {
  DecisionResult result;
  std::optional<DraftFindings> drafts;
};

/// One row per layout.
std::string decision_csv(const DecisionReport& report, CsvFormat format = {});

/// The answer and what it cost.
std::string decision_json(const DecisionReport& report);

std::vector<FileText> decision_file_texts();

/// decision.csv and decision.json.
std::vector<OutputFile> decision_files(const DecisionReport& report, CsvFormat format = {});

}  // namespace vibrosow
