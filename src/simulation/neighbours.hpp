#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "box2d/broadphase.hpp"
#include "box2d/space_broadphase.hpp"
#include "contact/contact_state.hpp"
#include "grains/grains.hpp"
#include "loops/execution.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {

/// Margins of the two lists, in diameters of the largest grain; the narrow one is where a run begins, and is then
/// chosen from how long the lists last. They change the time of a run and never its result.
struct NeighbourMargins {
  double wide = 2;
  double narrow = 0.15;
  double wide_in_space = 0.9;  // a wide list grows with its cube there
};

/// Who may touch whom. A wide list comes from Box2D, seldom; the narrow ones of a ContactState are pruned from it,
/// often; both are renewed just when a grain has moved so far that a contact could be missed (a dual pair list).
/// Contacts keep their histories through every renewal. Nothing here is state of a run: made anew, it gives the same
/// contacts.
class Neighbours {
 public:
  /// In space where the histories' kinds are.
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

  /// How the first grains of pairs across a periodic boundary are moved (m), for each list of ContactState::boundaries.
  struct Image {
    double x, z;
  };
  const std::vector<Image>& images() const { return images_; }
  std::int64_t searches() const { return searches_; }
  std::int64_t prunes() const { return prunes_; }
  /// Throws std::logic_error in space.
  Broadphase& broadphase() {
    if (!in_plane_) throw std::logic_error("a broadphase of the plane, in space");
    return *in_plane_;
  }

 private:
  /// Where the grains (relative to the first vessel) and the other vessels were when a list was made.
  struct Reference {
    std::vector<double> x, y, z;
    std::vector<Pose> poses;
  };
  static void note(const Grains& grains, const Walls& walls, Reference& reference);
  bool any_moved(const Reference& from, const Grains& grains, const Pose& first, double limit) const;
  bool moved(const Reference& from, const Grains& grains, const Walls& walls, double limit) const;
  static void remove_flagged(Reference& reference, const std::vector<char>& removed);

  void choose_narrow_margin();
  void search(const Grains& grains, const Walls& walls);
  void prune(const Grains& grains, const Walls& walls, ContactState& contacts);
  void prune_pairs(const Grains& grains, const PairList& wide, const Image& shift, PairList& narrow);
  void prune_range(const Grains& grains, const PairList& wide, std::size_t from, std::size_t to, const Image& shift,
                   PairList& narrow) const;
  void carry_histories_over(ContactState& contacts);
  void prune_walls(const Grains& grains, const Walls& walls, ContactState& contacts);

  Execution& execution_;
  std::optional<Broadphase> in_plane_;
  std::optional<SpaceBroadphase> in_space_;
  std::vector<double> largest_radius_;          // m, by vessel, of its walls about its frame's zero
  std::vector<double> largest_radius_in_plan_;  // m, the same about the upright axis, in space
  double diameter_;                             // m, of the largest grain
  double wide_margin_, narrow_margin_;          // m
  std::int64_t updates_since_prune_ = 0;
  HistoryKinds kinds_;
  std::vector<Image> images_;
  PairList wide_;
  std::vector<PairList> wide_boundaries_;  // by image
  std::vector<WallCandidate> wide_walls_;
  std::vector<PairList> parts_;  // by thread
  PairList old_;                 // the narrow lists before, while histories are carried over
  std::vector<BoundaryContacts> old_boundaries_;
  ContactHistories old_histories_;
  Reference wide_reference_, narrow_reference_;
  bool wide_is_valid_ = false;
  std::int64_t searches_ = 0, prunes_ = 0;
};

}  // namespace vibrosow
