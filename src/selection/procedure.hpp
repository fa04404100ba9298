#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace vibrosow {

/// What a run of a system was.
enum class RunEnd {
  flowed,   // with a goal and a rate
  clogged,  // counts for clogging alone
  failed,   // it cannot be run, or has no such goal: the system is out
};

/// One observation of a system.
struct Observation {
  RunEnd end = RunEnd::flowed;
  double goal = 0;  // the less the better
  double rate = 0;  // where a band is asked for
};

/// Where a mean is wanted, both ends included.
struct Band {
  double low, high;
  /// How far a mean lies outside, over the half width, or over the end where that is the only one.
  double outside_by(double mean) const;
};

/// Which of several systems has the least mean goal, among those that meet the constraints.
struct Question {
  std::size_t systems = 0;
  double margin = 0.02;                    // below which a difference does not matter, over the best's mean
  double confidence = 0.95;                // of a correct decision
  std::optional<Band> band{};              // of the mean rate
  std::optional<double> clogging_limit{};  // the share of runs that may clog, below 1; none: any, but not each
  int most = 400;                          // observations of a system, at which it is given up
  int batch = 4;                           // observations asked for at once, at least: they can be made side by side
};

enum class Standing {
  best,
  not_shown_worse,  // left behind, but not surely worse
  worse,
  misses_the_rate,
  clogs,
  failed,
  undecided,
};

struct Decision {
  std::optional<std::size_t> best;  // none: no system meets the constraints, or none is known to
  bool is_sure = false;             // with the confidence asked for; also that there is none
  bool has_margin = true;           // false: the best's mean is 0, and so is any share of it
  std::vector<Standing> standings;  // of each system
};

/// A procedure that asks for observations until it can decide. What it asks for and decides follows from the question
/// and the observations alone, round by round, so that it can be led again through observations that are kept. The
/// r-th observation of every system may be made with the same random numbers.
class Procedure {
 public:
  virtual ~Procedure() = default;
  Procedure() = default;
  Procedure(const Procedure&) = delete;
  Procedure& operator=(const Procedure&) = delete;

  /// Asks for more observations by all that were taken; for none where the decision is there.
  virtual void request_next_round() = 0;

  /// How many observations each system should have by what was asked for.
  const std::vector<int>& counts() const { return counts_; }

  /// The next observation of a system; the systems in any order.
  virtual void take(std::size_t system, const Observation& observation) = 0;

  /// How many the best needs at least, whatever comes of them.
  virtual int least_observations() const = 0;

  /// By what was taken until the last request.
  virtual Decision decision() const = 0;

 protected:
  std::vector<int> counts_;
};

}  // namespace vibrosow
