#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "design/optimise.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"

namespace vibrosow {

/// "on the front", "may be on the front", "dominated", ..
std::string standing_text(const OptimiseResult& result, std::size_t layout);

/// Why layouts may be on the front and are not shown to be; empty where none is so.
std::string why_unsure(const OptimiseResult& result);

/// "at the end of the range of frequency and width: look beyond it"; empty of a layout within all ranges.
std::string edge_text(const FrontLayout& layout);

/// Whether it stands in front.toml: it is on the front, or it is first by its means.
bool leads(const FrontLayout& layout);

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
