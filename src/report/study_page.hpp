#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "answer/answer.hpp"
#include "optimise/goal.hpp"
#include "picture/chart.hpp"
#include "report/decision_report.hpp"
#include "report/output_folder.hpp"
#include "report/replay.hpp"
#include "report/sweep_report.hpp"

namespace vibrosow {

/// What the page of a study shows: an answer, and the sentences about it.
struct StudyPage {
  Answer answer;
  std::string headline{};
  std::vector<Remark> remarks{};
  std::vector<std::pair<std::string, std::string>> asked{};  // what was asked, by name
  std::vector<std::string> cost{};
  std::optional<WantedRate> wanted{};  // of the tray
  std::string confidence{};            // of a decision
};

/// `timing`: of the runs that were made for it just now. The results outlive the page.
StudyPage study_page(const StudyResult& result, std::uint64_t first_random_seed);
StudyPage study_page(const DecisionReport& report, const SweepTiming& timing);
StudyPage study_page(const OptimiseResult& result, const SweepTiming& timing);

/// Its data (page_text): numbers and texts, the layouts with their figures, how each is built, and replays.
std::string page_data(const StudyPage& page, const Replays& replays = {});

/// The first run of each of the best layouts, at most so many, in their order.
std::vector<WantedReplay> best_to_replay(const Answer& answer, std::size_t most);

/// The charts of a study: "ranking" and, of a search with two goals or more, "front".
std::vector<std::string> chart_names(const StudyPage& page);

/// One of them, with the page's headline. Throws InputError, which names those there are, for another name, and where
/// no layout has a value.
Chart study_chart(const StudyPage& page, const std::string& name);

/// "The 120 runs of this command took 31 s on 2 cores."; empty where it made none.
std::string page_timing(const SweepTiming& timing);

/// What the files hold.
FileText sweep_page_text();
FileText decision_page_text();
FileText front_page_text();

}  // namespace vibrosow
