#pragma once

#include <array>
#include <vector>

#include "agronomy/hole_table.hpp"
#include "agronomy/seed_contact.hpp"

namespace vibrosow {

/// How a hole's outflow changes with the contact of its seeds. Fitted by least squares for each shape to runs of one
/// hole: ln(outflow) = what belongs to the setting + a ln(friction) + b friction on the tray + c rolling friction
/// + e restitution. Between two shapes a to e are linear in the aspect, and beyond the last those of the last.
class ContactSlopes {
 public:
  /// Throws std::invalid_argument for a shape whose records do not determine all slopes, and without records.
  explicit ContactSlopes(const std::vector<HoleRecord>& records);

  /// From one contact to another. Beyond the contacts of the records the nearest of them are taken.
  /// `error`: of `to`, its parts being independent.
  ContactFactor between(double aspect, const SeedContact& from, const SeedContact& to,
                        const SeedContactError& error = {}) const;
  /// Whether a contact lies within those of the records, part by part.
  bool holds(const SeedContact& contact) const;

 private:
  static constexpr std::size_t count = 4;
  using Values = std::array<double, count>;
  struct Fit {
    double aspect = 0;
    Values slopes{};
    std::array<Values, count> covariance{};
  };

  static Fit fitted(double aspect, const std::vector<const HoleRecord*>& records);
  static Values terms_of(const SeedContact& contact);
  Values nearest(const SeedContact& contact) const;
  Fit at(double aspect) const;

  std::vector<Fit> fits_;          // by aspect, ascending
  std::array<Span, count> known_;  // of the terms
};

}  // namespace vibrosow
