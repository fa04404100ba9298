#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "picture/chart.hpp"

namespace vibrosow {

/// Names of the charts that the data of a page (page_text) have: of a run "outflow", of a sweep or a decision
/// "ranking", of a search for a front "front" (of two goals) and "ranking", of an accuracy study "precision", of a
/// calibration "fit".
std::vector<std::string> chart_names(const nlohmann::ordered_json& data);

/// One of them, with the sentence that the page begins with. Throws InputError, which names those there are, for
/// another name; nlohmann::json::exception for what are no such data.
Chart page_chart(const nlohmann::ordered_json& data, const std::string& name);

}  // namespace vibrosow
