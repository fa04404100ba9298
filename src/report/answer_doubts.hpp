#pragma once

#include <cstddef>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "answer/answer.hpp"
#include "outflow/doubts.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"

namespace vibrosow {

/// How many doubts are told where a table beside them has each layout's.
inline constexpr std::size_t most_doubts = 6;
/// Where no table has them.
inline constexpr std::size_t all_doubts = std::numeric_limits<std::size_t>::max();

/// A remark each, and beyond `most` one that counts the rest; none where there are none.
std::vector<Remark> doubt_remarks(const std::vector<SharedDoubt>& doubts, std::string_view noun = "layout",
                                  std::size_t most = most_doubts);

/// The same for a terminal, wrapped; empty where there are none.
std::string doubts_paragraph(const std::vector<SharedDoubt>& doubts, std::string_view noun = "layout",
                             std::size_t most = most_doubts);

/// Why layouts are not compared, a remark for each reason: those that cannot be built or failed, and of a sweep all
/// that are not compared. At most six, and one that counts the rest.
std::vector<Remark> left_out_remarks(const Answer& answer);
/// The same for a terminal, wrapped.
std::string left_out_paragraph(const Answer& answer);

/// What a JSON file says of a doubt.
nlohmann::ordered_json doubt_json(const Doubt& doubt);
nlohmann::ordered_json doubts_json(const std::vector<SharedDoubt>& doubts, const std::string& noun = "layout");
/// What the keys mean.
inline constexpr const char* doubts_description =
    "what speaks against the runs of the layouts that the answer names: each with its kind, whether it is serious, the "
    "layouts, in how many of their runs, what happened first and what to do";

/// doubts.json, of answers that have no other JSON file.
FileText doubts_file_text(std::string_view noun = "layout");
OutputFile doubts_file(const std::vector<SharedDoubt>& doubts, const std::string& noun = "layout");

}  // namespace vibrosow
