#pragma once

#include <map>
#include <string>
#include <vector>

#include "study/study_runs.hpp"

namespace vibrosow {

/// The two most even layouts of a study while its runs come in: where holes differ least from one another.
class LeadingLayouts {
 public:
  void add(const WantedRun& wanted, const Run& run);

  /// "CV of layout 3: 4.1 +- 0.6, 5: 4.9 +- 0.8 %", raw; empty before any has two runs.
  std::string text() const;

 private:
  std::map<int, std::vector<double>> raw_cvs_;  // %, of each run, by layout
};

}  // namespace vibrosow
