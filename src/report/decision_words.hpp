#pragma once

#include <string>

#include "optimise/decide.hpp"
#include "optimise/draft_screen.hpp"

namespace vibrosow {

// What is said of a decision, on a terminal and on a page: sentences without line ends.

/// "2 %"
std::string percent_text(double fraction);

/// "meets the rate and clogs in fewer than 5 % of runs"; empty without constraints.
std::string constraints_text(const DecisionResult& result);

/// "confidence of 95 %"
std::string sureness_text(const DecideOptions& options);

/// What holds of a best layout, with what confidence.
std::string promise_sentence(const DecisionResult& result);

/// Whether the procedure is one whose promise is proved.
bool is_guaranteed(const DecisionResult& result);

/// What the posterior rule does not promise.
std::string weakness_sentence();

/// Why it is undecided.
std::string undecided_sentence(const DecisionResult& result);

/// Whether the layouts that are left are to follow that sentence, which then ends with a colon.
bool tells_who_is_left(const DecisionResult& result);

/// "CV of a run 8.2 +- 0.4 %, unevenness (CV) 7.1 % (6.2 to 8.3 %), 43.2 +- 0.5 seeds/s of the tray, clogged in 0 of
/// 203 runs". A page writes another sign than a terminal.
std::string metrics_sentence(const DecisionResult& result, std::size_t scene, std::string_view plus_minus = "+-");

/// Of a decision that is sure that there is no best.
std::string no_best_sentence(const DecisionResult& result);

/// Runs and grain-steps, and those of a grid that is run without looking.
std::string cost_sentence(const DecisionResult& result);

/// Whether common random numbers helped; empty where that is not known.
std::string correlation_sentence(const DecisionResult& result);

std::string drafts_sentence(const DraftFindings& drafts);

std::string clogging_untested_sentence();

}  // namespace vibrosow
