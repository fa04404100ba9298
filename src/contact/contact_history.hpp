#pragma once

#include <cstddef>
#include <vector>

namespace vibrosow {

/// What one contact remembers; signs do not depend on which of the two grains comes first.
struct ContactMemory {
  double slip = 0, slip_speed = 0;  // m, m/s: displacement of the tangential spring, last sliding speed
  double roll = 0, roll_speed = 0;  // rad, rad/s: the same of the rolling spring
};

/// What touching contacts remember, one entry a candidate of a list; all zero where nothing touches. Arrays of an
/// absent effect are empty.
struct ContactHistory {
  std::vector<double> slip, slip_speed, roll, roll_speed;
  std::vector<unsigned char> touched;  // 1 where there may be something to forget

  bool remembers(std::size_t k) const {
    return (!slip.empty() && (slip[k] != 0 || slip_speed[k] != 0)) ||
           (!roll.empty() && (roll[k] != 0 || roll_speed[k] != 0));
  }

  void clear() { slip.clear(), slip_speed.clear(), roll.clear(), roll_speed.clear(), touched.clear(); }

  void resize(std::size_t candidates, bool tangential, bool rolling) {
    slip.resize(tangential ? candidates : 0), slip_speed.resize(slip.size());
    roll.resize(rolling ? candidates : 0), roll_speed.resize(roll.size());
    touched.resize(tangential || rolling ? candidates : 0);
  }
};

/// How the memory moves on in one evaluation of the forces. The displacement at which a force is wanted is the stored
/// one plus `trial` seconds of the speed, which is taken between the stored (0) and the present one (1) at `present`.
/// What is stored for the next step is `commit` seconds on; 0: an evaluation that leaves no trace.
struct HistoryAdvance {
  double trial = 0, commit = 0;  // s
  double present = 1;
};

}  // namespace vibrosow
