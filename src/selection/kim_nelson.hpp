#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "selection/procedure.hpp"
#include "selection/sequential_tests.hpp"

namespace vibrosow {

/// KN, the fully sequential procedure of Kim & Nelson (2001), ACM TOMACS 11(3), doi 10.1145/502109.502111, with c = 1
/// and the variances of the differences of its first observations; constraints are tested on the way (Andradottir & Kim
/// 2010, Naval Research Logistics 57(5); Batur & Kim 2010, ACM TOMACS 20(3), doi 10.1145/1842713.1842716). A system
/// that is behind one of which it is not known yet whether it meets the constraints rests, and goes on should that one
/// fail them (Healey, Andradottir & Kim 2013, European Journal of Operational Research 224(2)).
///
/// What is proven, for normal observations: where every other system that meets the constraints is worse than the best
/// by the margin or more, the best is chosen with at least the confidence asked for. That it is, with that confidence,
/// within the margin of the best where others are nearer is seen in experiments and not proven (Eckman & Henderson
/// 2021, ACM TOMACS 31(2)). The margin is a share of the least mean after the first observations: a number that the
/// proof takes as given.
///
/// Of the error, a fifth is for the constraints where there are any: half of that for systems that fail them and are
/// taken, shared out among systems and constraints, half for the best being left out.
class KimNelson : public Procedure {
 public:
  static constexpr int first_observations = 10;

  /// Throws std::invalid_argument for fewer than two systems.
  explicit KimNelson(const Question& question);

  void request_next_round() override;
  void take(std::size_t system, const Observation& observation) override;
  int least_observations() const override;
  Decision decision() const override;

 private:
  enum class Stage { contending, behind, misses_the_rate, clogs, failed };
  struct System {
    std::vector<double> goals{};  // by observation; not a number where it clogged
    Moments mean{};               // of those that flowed
    std::optional<BandTest> rate{};
    std::optional<ShareTest> clogging{};
    Stage stage = Stage::contending;
  };
  /// Two systems by the observations in which both flowed.
  struct Pair {
    SideTest test;
    std::size_t seen = 0;  // observations
  };

  bool is_feasible(const System& system) const;
  bool is_behind(std::size_t system, std::size_t other) const;
  bool rests(std::size_t system) const;
  std::vector<std::size_t> contending() const;
  std::vector<std::size_t> awake() const;
  std::optional<std::size_t> least_of(const std::vector<std::size_t>& systems) const;
  void judge_constraints();
  void set_margin();
  void compare();
  void leave_behind();
  void more_of(const std::vector<std::size_t>& systems, std::vector<int>& wanted) const;
  Pair& pair(std::size_t lower, std::size_t higher);
  const Pair& pair(std::size_t lower, std::size_t higher) const;

  Question question_;
  double selection_error_;    // of a pair
  double error_of_left_out_;  // of a constraint: that the best is called wrong by it
  double error_of_taken_;     // of a system and a constraint: that it is called right by it
  std::optional<double> margin_;
  std::vector<System> systems_;
  std::vector<Pair> pairs_;
};

}  // namespace vibrosow
