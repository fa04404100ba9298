#pragma once

#include <nlohmann/json_fwd.hpp>

namespace vibrosow {

/// Throws InputError, which names the key, where the kept data of a run's page (run_page_data) lack what they have, or
/// a value is of another type or no number that a run can have. Their scene is checked where it is read.
void check_run_data(const nlohmann::ordered_json& data);

}  // namespace vibrosow
