#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "picture/chart.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {

/// Names of the charts that the kept data of a page (page_text) have: of a run "outflow", of an accuracy study
/// "precision", of a calibration "fit". Those of studies are drawn from their answers (study_chart).
std::vector<std::string> chart_names(const nlohmann::ordered_json& data);

/// One of them, with the sentence that the page begins with. Throws InputError, which names those there are, for
/// another name; nlohmann::json::exception for what are no such data.
Chart page_chart(const nlohmann::ordered_json& data, const std::string& name);

/// What is said of a name that is none of those there are.
InputError no_such_chart(const std::string& name, const std::vector<std::string>& names);

}  // namespace vibrosow
