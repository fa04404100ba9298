#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "box2d/broadphase.hpp"
#include "compute/execution.hpp"
#include "contact/contact_state.hpp"
#include "grains/grains.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {

/// Margins of the two lists, in diameters of the largest grain; the narrow one is where a run begins, and is then
/// chosen from how long the lists last. They change the time of a run and never its result.
struct NeighbourMargins {
  double wide = 2;
  double narrow = 0.15;
};

/// Who may touch whom. A wide list comes from Box2D, seldom; the narrow ones of a ContactState are pruned from it,
/// often; both are renewed just when a grain has moved so far that a contact could be missed (a dual pair list).
/// Contacts keep their histories through every renewal. Nothing here is state of a run: made anew, it gives the same
/// contacts.
class Neighbours {
 public:
  Neighbours(const std::vector<Vessel>& vessels, double largest_diameter, NeighbourMargins margins, HistoryKinds kinds,
             Execution& execution);

  /// Renews the lists if the grains or walls have moved too far for them.
  void update(const Grains& grains, const Walls& walls, ContactState& contacts);

  /// The grains have changed in number: the next update starts afresh.
  void start_afresh() { wide_is_valid_ = false; }

  /// Takes removed grains out of the lists without a search.
  void remove_flagged(const std::vector<char>& removed, ContactState& contacts);

  /// Takes a wall out of Box2D and of the lists.
  void remove_wall(int wall, ContactState& contacts);
  /// Puts it back; the next update starts afresh.
  void restore_wall(int wall);

  /// Length (m) after which a periodic tray comes again; 0 when it does not.
  double period() const { return period_; }
  std::int64_t searches() const { return searches_; }
  std::int64_t prunes() const { return prunes_; }
  Broadphase& broadphase() { return broadphase_; }

 private:
  /// Where the grains (relative to the first vessel) and the other vessels were when a list was made.
  struct Reference {
    std::vector<double> x, y;
    std::vector<Pose> poses;
  };
  static void note(const Grains& grains, const Walls& walls, Reference& reference);
  bool moved(const Reference& from, const Grains& grains, const Walls& walls, double limit) const;
  static void remove_flagged(Reference& reference, const std::vector<char>& removed);

  void choose_narrow_margin();
  void search(const Grains& grains, const Walls& walls);
  void prune(const Grains& grains, const Walls& walls, ContactState& contacts);
  void prune_pairs(const Grains& grains, const PairList& wide, double shift, PairList& narrow);
  void prune_range(const Grains& grains, const PairList& wide, std::size_t from, std::size_t to, double shift,
                   PairList& narrow) const;
  void prune_walls(const Grains& grains, const Walls& walls, ContactState& contacts);

  Execution& execution_;
  Broadphase broadphase_;
  std::vector<double> largest_radius_;  // m, by vessel, of its walls about its frame's zero
  double diameter_;                     // m, of the largest grain
  double wide_margin_, narrow_margin_;  // m
  std::int64_t updates_since_prune_ = 0;
  HistoryKinds kinds_;
  double period_;  // m
  PairList wide_, wide_boundary_;
  std::vector<WallCandidate> wide_walls_;
  std::vector<PairList> parts_;  // by thread
  PairList old_, old_boundary_;  // the narrow lists before, while histories are carried over
  ContactHistories old_histories_, old_boundary_histories_;
  Reference wide_reference_, narrow_reference_;
  bool wide_is_valid_ = false;
  std::int64_t searches_ = 0, prunes_ = 0;
};

}  // namespace vibrosow
