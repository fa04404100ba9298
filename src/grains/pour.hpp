#pragma once

#include <optional>
#include <vector>

#include "compute/stop_request.hpp"
#include "grains/packing.hpp"
#include "grains/places.hpp"
#include "grains/random.hpp"
#include "scene/scene.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {

/// Drops seeds of the lots `order` one by one, see `pack`.
std::vector<PackedGrain> pour(const Vessel& vessel, const std::vector<SeedLot>& lots, const std::vector<int>& order,
                              Random& random, StopRequest stop);

/// The same in 3D: each ball is dropped again a little aside, at random, nearer and nearer, and stays where it comes
/// lowest, which is where it would roll to; a clump so too, turned a little each time. In the vessel's frame.
std::vector<PackedGrain> pour_3d(const Vessel& vessel, const std::vector<SeedLot>& lots, const std::vector<int>& order,
                                 Random& random, StopRequest stop);

/// Part of a vessel's plan, m, along it and across.
struct Plot {
  FloorPlace low, high;
};

/// Drops a seed again that came down where no seed belongs: above or beside the walls, or reaching out of a drum. Where
/// that happens again and again it is dropped where the pieces are, and so are all after it: of a vessel without a box
/// they may take up little.
class Drops {
 public:
  Drops(const Vessel& vessel, Space space);

  /// What `drop(plot)` first gives that `lies_well`, no plot being all of the plan; nothing: too often none did.
  template <class Drop, class LiesWell>
  auto until(LiesWell lies_well, Drop drop) -> std::optional<decltype(drop(std::optional<Plot>()))> {
    constexpr int most = 100;
    for (;;) {
      for (int k = 0; k < most; ++k)
        if (auto at = drop(is_narrow_ ? over_pieces_ : std::nullopt); lies_well(at)) return at;
      if (is_narrow_ || !over_pieces_) return std::nullopt;
      is_narrow_ = true;
    }
  }

 private:
  std::optional<Plot> over_pieces_;  // none of a vessel with a box
  bool is_narrow_ = false;
};

/// Whether a seed of these discs about a place of the vessel's frame (m) reaches out of a drum, if there is one.
bool reaches_out(const std::optional<DrumCircle>& drum, const Eigen::Vector2d& centre,
                 const std::vector<ClumpDisc>& discs);

/// Throws InputError: the fill rises above the vessel's walls.
[[noreturn]] void refuse_fill(const Vessel& vessel);

}  // namespace vibrosow
