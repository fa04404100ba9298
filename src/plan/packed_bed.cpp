#include "plan/packed_bed.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>
#include <numbers>
#include <utility>

#include "grains/clump_discs.hpp"
#include "grains/orientation.hpp"
#include "grains/random.hpp"
#include "grains/size_distribution.hpp"
#include "portable_math/functions.hpp"
#include "scene/cross_product.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

using Vector = Eigen::Vector3d;

constexpr double wanted_depth = 0.01;  // of contacts, over a diameter
constexpr int most_iterations = 500;

/// A disc of a seed in the seed's own frame.
struct OwnDisc {
  std::size_t seed;
  int number;
  Vector own;  // m
  double radius;
};

/// Where and how a seed lies, and how it moves while the bed is pressed together.
struct Body {
  Vector place{0, 0, 0}, velocity{0, 0, 0}, spin{0, 0, 0};
  Vector force{0, 0, 0}, torque{0, 0, 0};
  Orientation orientation;
  double per_gyration2 = 0;  // 1/m2; 0: it does not turn
};

/// Seeds between a plate at y = 0 and one at y = top, periodic along x and z. Forces are overlaps, masses 1: the units
/// of time follow from that. What is looked for is the place where all is at rest, by FIRE (Bitzek et al., Phys. Rev.
/// Lett. 97, 170201, 2006).
class Press {
 public:
  explicit Press(const StepBasis& basis) : basis_(basis), plane_(basis.scene.space == Space::two_dimensional) {
    draw_seeds();
    fill();
  }

  PackedBed packed() {
    for (int k = 0; k < most_iterations && !is_at_rest(); ++k) iterate();
    return as_it_lies();
  }

 private:
  void draw_seeds() {
    const std::vector<SeedLot>& lots = basis_.scene.lots;
    clumps_ = std::ranges::any_of(lots, [](const SeedLot& lot) { return !lot.discs.empty(); });
    std::size_t discs = 1;
    for (const SeedLot& lot : lots) discs = std::max(discs, lot.discs.size());
    const double count = clumps_ ? std::clamp(400.0 / static_cast<double>(discs), 8.0, 40.0) : plane_ ? 48 : 80;
    const double fewest = count / std::max(8.0, static_cast<double>(lots.size()));
    for (std::size_t l = 0; l < lots.size(); ++l) {
      const double share = std::max(lots[l].number_fraction * count, fewest);
      for (int k = 0; k < static_cast<int>(std::ceil(share)); ++k) add_seed(static_cast<int>(l));
    }
  }

  void add_seed(int lot_index) {
    const SeedLot& lot = basis_.scene.lots[static_cast<std::size_t>(lot_index)];
    const double size = draw_size(lot, random_);
    BedSeed& seed = bed_.seeds.emplace_back();
    seed.lot = lot_index, seed.size = size;
    seed.kind = sized_kind(lot, basis_.law, basis_.seeds[static_cast<std::size_t>(lot_index)], size);
    Body& body = bodies_.emplace_back();
    body.orientation = turned(draw_turn(lot, random_));
    const auto& moments = seed.kind.moments;
    const double mean_moment = (moments[0] + moments[1] + moments[2]) / 3;
    body.per_gyration2 = seed.kind.inverse_inertia * seed.kind.mass / mean_moment;
    const auto add = [&](const GrainKind& kind, const Vector& own) {
      discs_.push_back({bed_.seeds.size() - 1, static_cast<int>(seed.discs.size()), own, kind.radius});
      seed.discs.push_back({kind, own});
    };
    if (lot.discs.empty()) add(seed.kind, Vector::Zero());
    for (const ClumpDisc& disc : lot.discs)
      add(kind_of_disc(seed.kind, disc, size, basis_.law), size * Vector(disc.x, disc.y, disc.z));
  }

  Orientation turned(const Turn& turn) const {
    if (!plane_) return turn.orientation;
    const auto [sine, cosine] = portable_math::sine_cosine(0.5 * turn.angle);
    return {cosine, 0, 0, sine};
  }

  /// As dense as a loose heap, anyhow: seeds lie through each other at first.
  void fill() {
    double volume = 0, widest = 0, deepest = 0;
    for (const OwnDisc& disc : discs_) {
      const double d = 2 * disc.radius, of_seed = static_cast<double>(bed_.seeds[disc.seed].discs.size());
      volume += std::numbers::pi * (plane_ ? d * d / 4 : d * d * d / 6) / (0.5 + 0.5 * of_seed);
      widest = std::max(widest, d), deepest += d / static_cast<double>(discs_.size());
    }
    const double loose = volume / (plane_ ? 0.82 : 0.62);
    period_ = std::max(3 * widest, plane_ ? std::sqrt(loose) : portable_math::cbrt(loose));
    const double area = plane_ ? period_ : period_ * period_;
    top_ = loose / area;
    for (Body& body : bodies_)
      body.place = {random_.uniform(0, period_), random_.uniform(0, top_), plane_ ? 0 : random_.uniform(0, period_)};
    // The forces times the distances of centres add up to 3 P V, in 2D to 2 P V: of three contacts a seed, or
    // two, each as deep as wanted.
    const double depth = wanted_depth * deepest, seeds = static_cast<double>(bodies_.size());
    load_ = seeds * depth * deepest / top_;
    rest_ = 0.02 * depth;
    skin_ = 0.3 * deepest;
    list_pairs();
  }

  Vector apart(const Vector& from, const Vector& to) const {
    return {to_nearest_image(to.x() - from.x()), to.y() - from.y(), to_nearest_image(to.z() - from.z())};
  }
  double to_nearest_image(double between) const {
    if (std::abs(between) < 0.49 * period_) return between;  // most are; and round() is a call
    return between - period_ * std::round(between / period_);
  }

  Vector arm_of(const OwnDisc& disc) const {
    if (disc.own.isZero(0)) return disc.own;
    return rotation_matrix(bodies_[disc.seed].orientation) * disc.own;
  }

  void place_discs() {
    places_.resize(discs_.size()), arms_.resize(discs_.size());
    for (std::size_t k = 0; k < discs_.size(); ++k) {
      arms_[k] = arm_of(discs_[k]);
      places_[k] = bodies_[discs_[k].seed].place + arms_[k];
    }
  }

  void list_pairs() {
    place_discs();
    listed_at_ = places_;
    pairs_.clear();
    for (std::size_t i = 0; i < discs_.size(); ++i)
      for (std::size_t j = i + 1; j < discs_.size(); ++j) {
        if (discs_[i].seed == discs_[j].seed) continue;
        const double reach = discs_[i].radius + discs_[j].radius + skin_;
        if (apart(places_[i], places_[j]).squaredNorm() < reach * reach) pairs_.emplace_back(i, j);
      }
  }

  bool has_moved_far() const {
    for (std::size_t k = 0; k < places_.size(); ++k)
      if ((places_[k] - listed_at_[k]).squaredNorm() > 0.25 * skin_ * skin_) return true;
    return false;
  }

  /// Calls `visit(disc, other or none, normal, overlap)` for all that touch, towards the other or the plate.
  template <class Visit>
  void for_each_contact(Visit visit) const {
    for (const auto& [i, j] : pairs_) {
      const double reach = discs_[i].radius + discs_[j].radius;
      if (std::abs(places_[j].y() - places_[i].y()) >= reach) continue;
      const Vector between = apart(places_[i], places_[j]);
      const double distance2 = between.squaredNorm();
      if (distance2 >= reach * reach) continue;
      const double distance = std::sqrt(distance2);
      visit(i, static_cast<int>(j), distance > 0 ? Vector(between / distance) : Vector(Vector::UnitX()),
            reach - distance);
    }
    for (std::size_t i = 0; i < discs_.size(); ++i) {
      const double below = discs_[i].radius - places_[i].y(), above = discs_[i].radius + places_[i].y() - top_;
      if (below > 0) visit(i, BedContact::plate, Vector(-Vector::UnitY()), below);
      if (above > 0) visit(i, BedContact::plate, Vector(Vector::UnitY()), above);
    }
  }

  void set_forces() {
    place_discs();
    if (has_moved_far()) list_pairs();
    for (Body& body : bodies_) body.force = body.torque = Vector::Zero();
    push_ = -load_;
    for_each_contact([this](std::size_t i, int j, const Vector& normal, double overlap) {
      const auto push = [this](std::size_t disc, const Vector& force) {
        Body& body = bodies_[discs_[disc].seed];
        body.force += force, body.torque += cross(arms_[disc], force);
      };
      const Vector force = -overlap * normal;
      push(i, force);
      if (j != BedContact::plate)
        push(static_cast<std::size_t>(j), -force);
      else if (normal.y() > 0)
        push_ += overlap;
    });
  }

  /// Calls `visit(velocity, push, mass)` for everything that moves.
  template <class Visit>
  void for_each_motion(Visit visit) {
    for (Body& body : bodies_) {
      visit(body.velocity, body.force, 1.0);
      if (body.per_gyration2 > 0) visit(body.spin, body.torque, 1 / body.per_gyration2);
    }
    visit(top_velocity_, push_, plate_mass());
  }
  double plate_mass() const { return 0.1 * static_cast<double>(bodies_.size()); }

  bool is_at_rest() {
    set_forces();
    double most = std::abs(push_) / std::max(1.0, load_ / rest_);
    for (const Body& body : bodies_) most = std::max(most, body.force.norm());
    return most < rest_;
  }

  static double dot(const Vector& a, const Vector& b) { return a.dot(b); }
  static double dot(double a, double b) { return a * b; }

  void iterate() {
    const double longest = clumps_ ? 0.2 : 0.35;  // arms make contacts of clumps stiffer
    double power = 0, speed2 = 0, push2 = 0;
    for_each_motion([&](auto& velocity, const auto& push, double mass) {
      power += dot(velocity, push);
      speed2 += mass * dot(velocity, velocity), push2 += dot(push, push) / mass;
    });
    if (power > 0) {
      const double along = push2 > 0 ? mixing_ * std::sqrt(speed2 / push2) : 0;
      for_each_motion([&](auto& velocity, const auto& push, double mass) {
        velocity = (1 - mixing_) * velocity + (along / mass) * push;
      });
      if (++downhill_ > 5) step_ = std::min(1.1 * step_, longest), mixing_ *= 0.99;
    } else {
      for_each_motion([](auto& velocity, const auto&, double) { velocity *= 0; });
      step_ *= 0.5, mixing_ = first_mixing, downhill_ = 0;
    }
    for_each_motion([&](auto& velocity, const auto& push, double mass) { velocity += (step_ / mass) * push; });
    for (Body& body : bodies_) {
      body.place += step_ * body.velocity;
      const Vector half = 0.5 * step_ * body.spin;
      body.orientation = of_unit_length(Orientation{1, half.x(), half.y(), half.z()} * body.orientation);
    }
    top_ += step_ * top_velocity_;
  }

  PackedBed as_it_lies() {
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
      const Eigen::Matrix3d axes = rotation_matrix(bodies_[s].orientation);
      bed_.seeds[s].axes = {axes.col(0), axes.col(1), axes.col(2)};
    }
    for (std::size_t k = 0; k < discs_.size(); ++k)
      bed_.seeds[discs_[k].seed].discs[static_cast<std::size_t>(discs_[k].number)].arm = arms_[k];
    for_each_contact([this](std::size_t i, int j, const Vector& normal, double) {
      const OwnDisc &a = discs_[i], &b = discs_[j == BedContact::plate ? i : static_cast<std::size_t>(j)];
      const int other = j == BedContact::plate ? BedContact::plate : static_cast<int>(b.seed);
      bed_.contacts.push_back({static_cast<int>(a.seed), other, a.number, b.number, normal});
    });
    return std::move(bed_);
  }

  static constexpr double first_mixing = 0.1;

  const StepBasis& basis_;
  const bool plane_;
  bool clumps_ = false;
  Random random_{1};
  PackedBed bed_;
  std::vector<Body> bodies_;
  std::vector<OwnDisc> discs_;
  std::vector<Vector> places_, arms_, listed_at_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
  double period_ = 0, top_ = 0, top_velocity_ = 0;  // m
  double load_ = 0, push_ = 0, rest_ = 0, skin_ = 0;
  double step_ = 0.1, mixing_ = first_mixing;
  int downhill_ = 0;
};

}  // namespace

namespace {

/// What a bed's places and contacts follow from: all of its seeds but how stiff they are.
struct Pressed {
  Space space;
  std::vector<SeedLot> lots;
  std::vector<GrainKind> seeds;  // by lot, of no compliance

  explicit Pressed(const StepBasis& basis) : space(basis.scene.space), lots(basis.scene.lots), seeds(basis.seeds) {
    for (GrainKind& kind : seeds) kind.compliance = 0;
  }
  bool operator==(const Pressed&) const = default;
};

/// The same bed of seeds as stiff as these.
PackedBed of_stiffness(PackedBed bed, const StepBasis& basis) {
  for (BedSeed& seed : bed.seeds) {
    const SeedLot& lot = basis.scene.lots[static_cast<std::size_t>(seed.lot)];
    seed.kind = sized_kind(lot, basis.law, basis.seeds[static_cast<std::size_t>(seed.lot)], seed.size);
    if (lot.discs.empty()) seed.discs.front().kind = seed.kind;
    for (std::size_t k = 0; k < lot.discs.size(); ++k)
      seed.discs[k].kind = kind_of_disc(seed.kind, lot.discs[k], seed.size, basis.law);
  }
  return bed;
}

}  // namespace

PackedBed packed_bed(const StepBasis& basis) {
  constexpr std::size_t most_kept = 8;
  static std::mutex mutex;
  static std::deque<std::pair<Pressed, PackedBed>> kept;
  Pressed pressed(basis);
  {
    const std::lock_guard lock(mutex);
    const auto known = std::ranges::find(kept, pressed, &std::pair<Pressed, PackedBed>::first);
    if (known != kept.end()) return of_stiffness(known->second, basis);
  }
  PackedBed bed = Press(basis).packed();
  const std::lock_guard lock(mutex);
  if (kept.size() == most_kept) kept.pop_front();
  kept.emplace_back(std::move(pressed), bed);
  return bed;
}

}  // namespace vibrosow
