#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "grains/free_room.hpp"
#include "grains/grains.hpp"
#include "plan/model.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {

/// Of a seed's radius: deeper in nothing when it is put in.
inline constexpr double most_placing_overlap = 1e-9;

/// Where seeds may be put in while a scene runs, and whether those that were put in lie rightly. A place belongs to a
/// vessel where its `FreeRoom` holds it, and to no hopper that dips into the vessel.
class SeedPlaces {
 public:
  explicit SeedPlaces(const Model& model);

  /// What a message that no place was found in a vessel adds: how narrow ways are not looked for; mostly nothing.
  std::string unseen_ways(std::size_t vessel) const;

  /// Whether the centre of a seed (m, lab) of this half width (m, `half_width`) belongs to a vessel (0: the tray) as it
  /// stands now: in a tray one that comes there beside a hopper, too.
  bool belong(const Eigen::Vector3d& at, double half_width, std::size_t vessel, const Walls& walls) const;

  /// Whether it lies in the vessel's room for such seeds, a hopper in it or not. One that turns over and over and is no
  /// drum counts as it stands at rest, too.
  bool is_in_room(const Eigen::Vector3d& at, double half_width, std::size_t vessel, const Walls& walls) const;

  /// Whether a seed whose centre lies at `at` (m, lab), between the vessel's ends and no higher than its top, counts as
  /// the vessel's own, of whatever size: beneath the slopes of a hopper lie the tray's seeds, in a hopper that dips
  /// into the tray its own.
  bool counts_in(const Eigen::Vector3d& at, std::size_t vessel, const Walls& walls) const;

  /// Whether it lies in a hopper, or in an image of one, below its top.
  bool is_in_hopper(const Eigen::Vector3d& at, const Walls& walls) const { return lies_in_hopper_within(at, 0, walls); }

  /// m, by how much a ball at `at` (m, lab) reaches into the nearest wall of any vessel; negative: it is clear.
  double depth_in_walls(const Eigen::Vector3d& at, double radius, const Walls& walls) const;

  /// Whether a ball at `at` (m, lab), a hundredth larger, would touch no grain, a periodic tray's images included.
  bool is_clear_of_grains(const Eigen::Vector3d& at, double radius, const Grains& grains) const;

  /// Of the balls of grain `i`, how deep the deepest one lies in a wall, in parts of its radius; negative: all are
  /// clear.
  double relative_depth_in_walls(const Grains& grains, std::size_t i, const Walls& walls) const;

  /// What is wrong with how grain `i` was put into a vessel: it lies deeper than 1e-9 of its radius in another or in a
  /// wall, ball by ball, or out of the vessel's room. None: nothing.
  /// Not inlined, so that a profile shows what it costs.
  [[gnu::noinline]] std::optional<std::string> fault(const Grains& grains, std::size_t i, std::size_t vessel,
                                                     const Walls& walls) const;

  /// The same where no other grain is looked at.
  std::optional<std::string> fault_among_walls(const Grains& grains, std::size_t i, std::size_t vessel,
                                               const Walls& walls) const;

 private:
  bool lies_in_hopper_within(const Eigen::Vector3d& at, std::size_t vessel, const Walls& walls) const;
  Eigen::Vector3d own_place(const Eigen::Vector3d& at, std::size_t vessel, const Walls& walls) const;
  std::vector<ClumpDisc> balls_of(const Grains& grains, std::size_t i) const;
  Eigen::Vector3d apart(const Grains& grains, std::size_t i, const Eigen::Vector3d& at) const;
  std::optional<std::string> overlapped_grain(const Grains& grains, std::size_t i) const;

  const Model& model_;
  std::deque<FreeRooms> rooms_;             // by vessel
  std::optional<FreeRooms> beside_hopper_;  // of the tray, as it stands at first, where a hopper may shut its mouth
  double along_ = 0, across_ = 0;           // m, periods of the tray; 0: none
};

/// Why a run stops whose grain `i` was put in with this `fault`.
std::string placing_fault(const Model& model, const Grains& grains, std::size_t i, const std::string& fault);

/// "grain 17 (wheat) at x 12.3 mm, y 4.5 mm"
std::string grain_text(const Model& model, const Grains& grains, std::size_t i);

}  // namespace vibrosow
