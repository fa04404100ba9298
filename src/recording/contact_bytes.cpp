#include "recording/contact_bytes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "portable_math/functions.hpp"
#include "recording/bytes.hpp"

namespace vibrosow {
namespace {

using Vector = Eigen::Vector3d;

constexpr double forces_per_decade = 64, places_per_radius = 100;

Vector as_vector(const std::array<double, 3>& values) {
  return {values[0], values[1], values[2]};
}

double normal_force(const GrainContact& contact) {
  return as_vector(contact.normal_force).norm();
}

/// How far below the largest, in steps of its logarithm.
std::uint8_t force_code(double force, double largest) {
  if (!(force > 0)) return 255;
  const double below = forces_per_decade * portable_math::log(largest / force) / std::numbers::ln10;
  return static_cast<std::uint8_t>(std::clamp(std::round(below), 0.0, 255.0));
}

/// A grain with another, or alone with a place of contact.
struct Pair {
  std::uint32_t grain, partner;
  std::uint8_t force;
};
struct Touch {
  std::uint32_t grain;
  std::array<std::int8_t, 3> place;
  std::uint8_t force;
};

class Contacts {
 public:
  Contacts(const Grains& grains, const std::vector<Neighbours::Image>& images) : grains_(grains) {
    for (const Neighbours::Image& image : images)
      along_ = std::max(along_, std::abs(image.x)), across_ = std::max(across_, std::abs(image.z));
  }

  void add(const GrainContact& contact, std::uint8_t force) {
    const std::size_t i = place_of(contact.grain);
    const Vector from = as_vector(contact.from), to = as_vector(contact.to);
    if (contact.partner < 0) {
      touches_.push_back({static_cast<std::uint32_t>(i), seen_from(i, to), force});
      return;
    }
    const std::size_t j = place_of(contact.partner);
    if (is_across(i, j)) {
      for (const std::size_t k : {i, j})
        touches_.push_back({static_cast<std::uint32_t>(k), seen_from(k, 0.5 * (from + to)), force});
      return;
    }
    const auto [first, second] = std::minmax(i, j);
    pairs_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second), force});
  }

  /// Each list by its grains, so that the differences are small.
  std::string bytes(double largest) {
    std::ranges::stable_sort(pairs_, {}, [](const Pair& p) { return std::pair(p.grain, p.partner); });
    std::ranges::stable_sort(touches_, {}, &Touch::grain);
    std::string bytes;
    append(bytes, largest);
    append(bytes, static_cast<std::uint32_t>(pairs_.size()));
    append(bytes, static_cast<std::uint32_t>(touches_.size()));
    append_grains(bytes, pairs_);
    std::vector<std::uint32_t> beyond;
    for (const Pair& pair : pairs_) beyond.push_back(pair.partner - pair.grain);
    append_planes(bytes, beyond);
    for (const Pair& pair : pairs_) append(bytes, pair.force);
    append_grains(bytes, touches_);
    for (std::size_t axis = 0; axis < (grains_.is_3d ? 3U : 2U); ++axis)
      for (const Touch& touch : touches_) append(bytes, touch.place[axis]);
    for (const Touch& touch : touches_) append(bytes, touch.force);
    return bytes;
  }

 private:
  std::size_t place_of(std::int64_t id) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(grains_.id, id) - grains_.id.begin());
  }
  Vector centre(std::size_t i) const { return {grains_.x[i], grains_.y[i], grains_.is_3d ? grains_.z[i] : 0.0}; }

  /// Whether two that touch do so across a periodic boundary.
  bool is_across(std::size_t i, std::size_t j) const {
    const Vector apart = centre(j) - centre(i);
    return (along_ > 0 && std::abs(apart.x()) > 0.5 * along_) || (across_ > 0 && std::abs(apart.z()) > 0.5 * across_);
  }

  /// A place in parts of the grain's radius from its centre, as the grain has it.
  std::array<std::int8_t, 3> seen_from(std::size_t i, const Vector& at) const {
    Vector arm = at - centre(i);
    if (along_ > 0) arm.x() -= along_ * std::round(arm.x() / along_);
    if (across_ > 0) arm.z() -= across_ * std::round(arm.z() / across_);
    arm *= places_per_radius / grains_.kind(i).radius;
    const auto coded = [](double part) {
      return static_cast<std::int8_t>(std::clamp(std::round(part), -127.0, 127.0));
    };
    return {coded(arm.x()), coded(arm.y()), coded(arm.z())};
  }

  template <class One>
  static void append_grains(std::string& bytes, const std::vector<One>& all) {
    std::vector<std::uint32_t> steps;
    std::uint32_t last = 0;
    for (const One& one : all) steps.push_back(one.grain - last), last = one.grain;
    append_planes(bytes, steps);
  }

  const Grains& grains_;
  double along_ = 0, across_ = 0;  // m, periods; 0: none
  std::vector<Pair> pairs_;
  std::vector<Touch> touches_;
};

}  // namespace

std::string contact_bytes(Simulation& simulation) {
  const std::vector<GrainContact> all = simulation.field().contacts();
  double largest = 0;
  for (const GrainContact& contact : all) largest = std::max(largest, normal_force(contact));
  Contacts contacts(simulation.grains(), simulation.field().neighbours().images());
  for (const GrainContact& contact : all) contacts.add(contact, force_code(normal_force(contact), largest));
  return contacts.bytes(largest);
}

}  // namespace vibrosow
