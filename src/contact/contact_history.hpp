#pragma once

#include <cstddef>
#include <vector>

namespace vibrosow {

/// What touching contacts remember, one entry a candidate of a list; all zero where nothing touches. Arrays of an
/// absent effect are empty. Signs do not depend on which of the two grains comes first.
struct ContactHistory {
  std::vector<double> slip, slip_speed;  // m, m/s: displacement of the tangential spring, last sliding speed
  std::vector<double> roll, roll_speed;  // rad, rad/s: the same of the rolling spring

  bool remembers(std::size_t k) const {
    return (!slip.empty() && (slip[k] != 0 || slip_speed[k] != 0)) ||
           (!roll.empty() && (roll[k] != 0 || roll_speed[k] != 0));
  }

  void resize(std::size_t candidates, bool tangential, bool rolling) {
    slip.resize(tangential ? candidates : 0), slip_speed.resize(slip.size());
    roll.resize(rolling ? candidates : 0), roll_speed.resize(roll.size());
  }
};

/// How the memory moves on in one evaluation of the forces. The displacement at which a force is wanted is the stored
/// one plus `trial` seconds of the speed, which is taken between the stored (0) and the present one (1) at `present`.
/// What is stored for the next step is `commit` seconds on; 0: an evaluation that leaves no trace.
struct HistoryAdvance {
  double trial = 0, commit = 0;  // s
  double present = 1;
};

/// A displacement between two evaluations: read, moved on, and stored.
class MovingHistory {
 public:
  MovingHistory(double stored, double old_speed, double speed, const HistoryAdvance& advance)
      : displacement(stored + advance.trial * mean(old_speed, speed, advance)),
        mean_(mean(old_speed, speed, advance)) {}

  double displacement;  // at which the force is wanted; the law may shorten it

  double to_store(const HistoryAdvance& advance) const {
    return displacement + (advance.commit - advance.trial) * mean_;
  }

 private:
  static double mean(double old_speed, double speed, const HistoryAdvance& advance) {
    return old_speed + advance.present * (speed - old_speed);
  }
  double mean_;
};

}  // namespace vibrosow
