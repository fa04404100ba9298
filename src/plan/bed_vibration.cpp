#include "plan/bed_vibration.hpp"

#include <algorithm>
#include <cmath>

#include "grains/random.hpp"
#include "plan/meeting.hpp"
#include "portable_math/functions.hpp"
#include "scene/cross_product.hpp"

namespace vibrosow {
namespace {

using Vector = Eigen::Vector3d;

constexpr double margin_of_bed = 9.0 / 16, margin_of_lattice = 9.0 / 10;  // of h^2 K / 4 + h C / 2

/// A spring and a dashpot side by side, and how much a force of 1 on both changes the speed of what they hold together.
struct Hold {
  double stiffness = 0, dashpot = 0;  // N/m and N s/m, of turning N m and N m s
  double yield = 0;                   // 1/kg, of turning 1/(kg m2)

  /// What it adds to h^2 K / 4 + h C / 2.
  double weight(double dt) const {
    return (0.25 * dt * dt * stiffness + 0.5 * dt * dashpot) / (1 + 0.5 * dt * dashpot * yield);
  }
};

/// Of two that touch, against each movement.
struct Holds {
  Hold approach, sliding, rolling, twisting;
};

Hold turning_hold(double arm, double secant, double damping, double inertia, double yield) {
  const double stiffness = 2.25 * secant * arm * arm;
  return {stiffness, damping * 2 * std::sqrt(inertia * stiffness), yield};
}

/// As the kernels have it, where the contact is as steep as it becomes.
Holds holds_of(const StepBasis& basis, const Meeting& meeting, const SurfaceParameters& surface, const GrainKind& a,
               const GrainKind* b) {
  const EffectSet& effects = basis.effects;
  Holds holds;
  const double slope = steepest_slope(basis, meeting, b ? std::max(a.mass, b->mass) : a.mass);
  const double pair = std::sqrt(slope * meeting.inverse_mass);
  const auto of_both = [&](auto value) { return value(a) + (b ? value(*b) : 0.0); };
  const double masses = meeting.inverse_mass + of_both([](const GrainKind& g) { return g.lever_yield; });
  holds.approach = {slope, 2 * basis.law.damping_ratio(surface, pair) * slope / pair, masses};
  const double turning = of_both([](const GrainKind& g) { return g.inverse_inertia; });
  if (effects.tangential_spring) {
    const double rims = of_both([](const GrainKind& g) { return g.radius * g.radius * g.inverse_inertia; });
    holds.sliding = {surface.tangential_ratio / basis.law.slope_over_secant * slope,
                     surface.tangential_damping * holds.approach.dashpot, masses + rims};
  }
  if (effects.rolling == Rolling::spring) {
    const double curvatures = of_both([](const GrainKind& g) { return 1 / g.radius; });
    const double secant = slope / basis.law.slope_over_secant;
    const double about_contact = of_both([](const GrainKind& g) {
      const double per = g.inverse_inertia;
      return per * g.inverse_mass / (g.inverse_mass + per * g.radius * g.radius);
    });
    const auto hold = [&](double friction, double yield) {
      return yield > 0 ? turning_hold(friction / curvatures, secant, surface.rolling_damping, 1 / yield, turning)
                       : Hold{};
    };
    holds.rolling = hold(surface.rolling_friction, about_contact);
    holds.twisting = hold(surface.twisting_friction, turning);
  }
  return holds;
}

/// A contact of the bed: which seeds, where from their centres (m), and what holds them.
struct HeldContact {
  int a, b;
  Vector normal, arm_a, arm_b;
  Holds holds;
};

std::vector<HeldContact> held_contacts(const StepBasis& basis, const PackedBed& bed) {
  std::vector<HeldContact> contacts;
  for (const BedContact& c : bed.contacts) {
    const BedSeed& seed = bed.seeds[static_cast<std::size_t>(c.a)];
    const BedDisc& disc = seed.discs[static_cast<std::size_t>(c.disc_a)];
    HeldContact held{c.a, c.b, c.normal, disc.arm + disc.kind.radius * c.normal, Vector::Zero(), {}};
    if (c.b == BedContact::plate) {
      held.holds = holds_of(basis, on_wall(basis, disc.kind), basis.contacts.wall(seed.lot), disc.kind, nullptr);
    } else {
      const BedSeed& other = bed.seeds[static_cast<std::size_t>(c.b)];
      const BedDisc& touched = other.discs[static_cast<std::size_t>(c.disc_b)];
      held.arm_b = touched.arm - touched.kind.radius * c.normal;
      held.holds = holds_of(basis, with_grain(basis, disc.kind, touched.kind), basis.contacts.pair(seed.lot, other.lot),
                            disc.kind, &touched.kind);
    }
    contacts.push_back(held);
  }
  return contacts;
}

/// How seeds move, each coordinate times the root of what is inert in it: then K and C over mass are symmetric.
struct Motion6 {
  Vector velocity, spin;
};

class Vibration {
 public:
  Vibration(const StepBasis& basis, const PackedBed& bed)
      : plane_(basis.scene.space == Space::two_dimensional), contacts_(held_contacts(basis, bed)) {
    Random random(2);
    for (const BedSeed& seed : bed.seeds) {
      Inertia inertia{std::sqrt(seed.kind.inverse_mass), Eigen::Matrix3d::Zero()};
      for (std::size_t k = 0; k < 3; ++k)
        inertia.per_root_moment +=
            std::sqrt(seed.kind.inverse_inertia / seed.kind.moments[k]) * seed.axes[k] * seed.axes[k].transpose();
      inertias_.push_back(inertia);
      const auto any = [&random] { return random.uniform(-1, 1); };
      mode_.push_back({{any(), any(), plane_ ? 0 : any()}, {plane_ ? 0 : any(), plane_ ? 0 : any(), any()}});
    }
  }

  /// The largest eigenvalue of h^2 K / 4 + h C / 2, from below; the mode of the last step is where it begins.
  double largest(double dt, int iterations) {
    std::vector<Weights> weights;
    for (const HeldContact& c : contacts_)
      weights.push_back({c.holds.approach.weight(dt), c.holds.sliding.weight(dt), c.holds.rolling.weight(dt),
                         c.holds.twisting.weight(dt)});
    double value = 0;
    for (int k = 0; k < iterations; ++k) value = iterate(weights);
    return value;
  }

 private:
  struct Inertia {
    double per_root_mass;
    Eigen::Matrix3d per_root_moment;
  };
  struct Weights {
    double approach, sliding, rolling, twisting;
  };

  double iterate(const std::vector<Weights>& weights) {
    std::vector<Motion6> moving(mode_.size()), pushed(mode_.size(), {Vector::Zero(), Vector::Zero()});
    for (std::size_t s = 0; s < mode_.size(); ++s)
      moving[s] = {inertias_[s].per_root_mass * mode_[s].velocity, inertias_[s].per_root_moment * mode_[s].spin};
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const HeldContact& c = contacts_[k];
      const auto at = [](const Motion6& m, const Vector& arm) { return Vector(m.velocity + cross(m.spin, arm)); };
      const std::size_t a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
      const bool on_plate = c.b == BedContact::plate;
      Vector u = at(moving[a], c.arm_a), turning = moving[a].spin;
      if (!on_plate) u -= at(moving[b], c.arm_b), turning -= moving[b].spin;
      const Weights& w = weights[k];
      const auto held = [&c](const Vector& value, double along, double across) {
        const Vector normal = value.dot(c.normal) * c.normal;
        return Vector(along * normal + across * (value - normal));
      };
      const Vector force = held(u, w.approach, w.sliding), torque = held(turning, w.twisting, w.rolling);
      pushed[a].velocity += force, pushed[a].spin += cross(c.arm_a, force) + torque;
      if (!on_plate) pushed[b].velocity -= force, pushed[b].spin -= cross(c.arm_b, force) + torque;
    }
    double along = 0, square = 0, before = 0;
    for (std::size_t s = 0; s < mode_.size(); ++s) {
      Motion6 next = {inertias_[s].per_root_mass * pushed[s].velocity, inertias_[s].per_root_moment * pushed[s].spin};
      if (plane_) next.velocity.z() = 0, next.spin.x() = next.spin.y() = 0;
      const Motion6& last = mode_[s];
      along += last.velocity.dot(next.velocity) + last.spin.dot(next.spin);
      before += last.velocity.squaredNorm() + last.spin.squaredNorm();
      square += next.velocity.squaredNorm() + next.spin.squaredNorm();
      mode_[s] = next;
    }
    const double per = square > 0 ? 1 / std::sqrt(square) : 0;
    for (Motion6& m : mode_) m.velocity *= per, m.spin *= per;
    return before > 0 ? along / before : 0;
  }

  bool plane_;
  std::vector<HeldContact> contacts_;
  std::vector<Inertia> inertias_;
  std::vector<Motion6> mode_;
};

/// Of equal seeds in the closest packing.
double largest_in_lattice(const StepBasis& basis, const GrainKind& kind, int lot, double dt) {
  const auto [normal, tangential, turning] = closest_packing(basis.scene.space);
  const Holds holds = holds_of(basis, with_grain(basis, kind, kind), basis.contacts.pair(lot, lot), kind, &kind);
  const double approach = holds.approach.weight(dt), sliding = holds.sliding.weight(dt);
  return std::max((normal * approach + tangential * sliding) * kind.inverse_mass,
                  2 * turning * kind.radius * kind.radius * kind.inverse_inertia * sliding);
}

/// Others do not pack so.
bool is_round_and_equal(const SeedLot& lot) {
  return lot.discs.empty() && lot.sizes.kind == SizeDistribution::Kind::single;
}

}  // namespace

double longest_stable_step(const StepBasis& basis, const PackedBed& bed) {
  constexpr int first_iterations = 40, iterations = 15, most_trials = 30;
  Vibration vibration(basis, bed);
  // Of what is allowed, at a step; it grows with the step to a power between 1 and 2.
  const auto used = [&](double dt, int count) {
    double most = vibration.largest(dt, count) / margin_of_bed;
    for (std::size_t lot = 0; lot < basis.seeds.size(); ++lot)
      if (is_round_and_equal(basis.scene.lots[lot]))
        most =
            std::max(most, largest_in_lattice(basis, basis.seeds[lot], static_cast<int>(lot), dt) / margin_of_lattice);
    return most;
  };
  const GrainKind& any = bed.seeds.front().discs.front().kind;
  const Meeting meeting = with_grain(basis, any, any);
  double dt = 0.3 / std::sqrt(steepest_slope(basis, meeting, any.mass) * meeting.inverse_mass);
  double most = used(dt, first_iterations);
  for (int k = 0; k < most_trials && most > 0 && std::abs(most - 1) > 0.005; ++k) {
    dt *= portable_math::pow(1 / most, 0.55);
    most = used(dt, iterations);
  }
  return dt;
}

}  // namespace vibrosow
