#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace vibrosow {

/// The least and the most that a number of a question may be.
template <class Number>
struct AskedRange {
  Number least, most;
};

inline constexpr AskedRange<double> clogging_range{0.001, 1}, spilled_range{0.0001, 1}, margin_range{0.0001, 0.5},
    confidence_range{0.6, 0.9999};
inline constexpr AskedRange<int> most_runs_range{2, 1'000'000}, search_runs_range{8, 1'000'000};
inline constexpr double most_wanted_rate = 1e9;  // seeds/s or kg/s

/// A rate of the whole tray that is wanted, within a band.
struct WantedRate {
  bool is_of_seeds = true;   // false: of mass
  double low = 0, high = 0;  // seeds/s or kg/s
  bool operator==(const WantedRate&) const = default;
};

enum class SelectionRule { guaranteed, posterior };

/// What `decide` is asked. The numbers lie in their ranges.
struct DecideQuestion {
  static constexpr std::string_view command = "decide";
  std::string goal;                   // its name
  std::optional<WantedRate> rate{};   // none: any
  double clogging_limit = 0;          // share of runs that may clog; 1: all may
  double margin = 0, confidence = 0;  // shares
  SelectionRule rule = SelectionRule::guaranteed;
  int most = 0;  // runs of a layout
  bool drafts = false;
  bool operator==(const DecideQuestion&) const = default;
};

/// What `optimise` is asked. The numbers lie in their ranges.
struct OptimiseQuestion {
  static constexpr std::string_view command = "optimise";
  std::vector<std::string> goals;  // names, one at least
  std::optional<WantedRate> rate{};
  double clogging_limit = 0;
  std::optional<double> spilled_limit{};  // share of the seeds that left the tray; none: any
  double confidence = 0;
  int runs = 0;  // that it may take
  bool operator==(const OptimiseQuestion&) const = default;
};

/// What a study is asked; nothing, where it is swept.
using AskedQuestion = std::variant<std::monostate, DecideQuestion, OptimiseQuestion>;

/// The command that asks it; empty where nothing is asked.
std::string_view command_of(const AskedQuestion& question);

/// As a plan keeps it; null where nothing is asked.
nlohmann::ordered_json json_of(const AskedQuestion& question);

/// Throws InputError, or nlohmann's exceptions, for what `json_of` does not write: another key, or a number out of its
/// range. Whether there are goals of such names is left open.
AskedQuestion question_in(const nlohmann::json& json);

}  // namespace vibrosow
