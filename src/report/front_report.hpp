#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "optimise/optimise.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"

namespace vibrosow {

/// Why layouts may be on the front and are not shown to be; empty where none is so.
std::string why_unsure(const OptimiseResult& result);

/// What the standings promise and what they do not; a paragraph.
std::string front_promise(const OptimiseResult& result);

/// Layouts, runs and grain-steps; a sentence.
std::string front_cost(const OptimiseResult& result);

/// One row per layout.
std::string pareto_csv(const OptimiseResult& result, CsvFormat format = {});

/// What was asked for and what it cost.
std::string optimise_json(const OptimiseResult& result);

/// A study of the layouts that lead, each as a [[layout]], to be read from `folder`.
std::string front_study(const OptimiseResult& result, const std::filesystem::path& folder);

std::vector<FileText> optimise_file_texts();

/// pareto.csv, optimise.json and, where a layout leads, front.toml.
std::vector<OutputFile> optimise_files(const OptimiseResult& result, const std::filesystem::path& folder,
                                       CsvFormat format = {});

}  // namespace vibrosow
