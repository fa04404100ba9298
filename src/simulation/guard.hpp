#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/integrator.hpp"

namespace vibrosow {

/// Kinetic (with spin) and potential energy of the grains, J; height counts from y = 0 of the lab, along `gravity`.
double kinetic_energy(const Grains& grains);
double potential_energy(const Grains& grains, const Eigen::Vector2d& gravity);
double mechanical_energy(const Grains& grains, std::size_t i,
                         const Eigen::Vector2d& gravity);  // of one grain, no contact

/// A grain that moves further than this in one step, in radii, could pass a wall between two looks at it.
inline constexpr double longest_stride_in_radii = 0.5;

/// Watches a run for what the model or the step cannot bear, and says why it stopped.
///
/// Energy: what is left of E_kin + E_pot + E_elastic after the walls' work and the grains put in and taken out can only
/// fall, by friction, damping and drag. Its largest rise above an earlier value was made by the numerics. It is
/// compared with the energy in play: the largest kinetic and elastic energy before that rise, what fell, and what the
/// walls did.
class Guard {
 public:
  Guard(const Model& model, GuardState& state);

  /// After each step; cheap. Takes the step's largest overlap out of the statistics.
  void watch_step(const Integration& s);
  /// Now and then; takes the account of energy.
  void watch_energy(const Integration& s, EnergyAccount& account);
  /// Stops the run for a reason found elsewhere.
  void stop(std::string reason);
  /// The centres of these went through a wall.
  void watch_lost(const Integration& s, const std::vector<int>& grains);

  const std::optional<std::string>& stop_reason() const { return state_.stop_reason; }
  std::vector<std::string> warnings() const;
  double max_relative_overlap() const { return state_.max_relative_overlap; }
  /// Whether the run is one that the usual limits forbid.
  bool outside_the_model() const;

 private:
  void watch_overlap(const Integration& s, double overlap);
  void watch_stride(const Integration& s);
  std::string stiff_enough(double relative_overlap, int lot) const;
  std::string shorter_step(double dt) const;

  const Model& model_;
  const GuardLimits& limits_;
  const LawTraits& law_;
  bool insisted_on_step_;
  GuardState& state_;
};

}  // namespace vibrosow
