#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "box2d/broadphase.hpp"
#include "box2d/broadphase_3d.hpp"
#include "contact/contact_state.hpp"
#include "grains/grains.hpp"
#include "loops/execution.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {

/// Margins of the two lists, in diameters of the largest disc or ball; the narrow one is where a run begins, and is
/// then chosen from how long the lists last. They change the time of a run and never its result.
struct NeighbourMargins {
  double wide = 1.4;
  double narrow = 0.15;
  double wide_3d = 0.5;  // a wide list grows with its cube there
};

/// Who may touch whom. A wide list comes from Box2D, seldom; the narrow ones of a ContactState are pruned from it,
/// often; both are renewed just when a contact could be missed (a dual pair list). Grains are taken to go on as they
/// moved since the search before, so that lists outlive a bed that slides and seeds that fall: two are near if they are
/// nearer than a margin, and by as much more as they may come nearer while the list lasts. It lasts until that time is
/// over, or until a grain has strayed half the margin from its course. Contacts keep their histories through every
/// renewal. Nothing here is state of a run: made anew, it gives the same contacts.
class Neighbours {
 public:
  /// In 3D where the histories' kinds are.
  Neighbours(const std::vector<Vessel>& vessels, double largest_disc_diameter, NeighbourMargins margins,
             HistoryKinds kinds, Execution& execution);

  /// Renews the lists if the grains or walls have moved too far for them by `time` (s).
  void update(const Grains& grains, const Walls& walls, double time, ContactState& contacts);

  /// The grains have changed in number: the next update starts afresh.
  void start_afresh() { wide_is_valid_ = false; }
  /// The same where grains were moved by a period: their contacts are in other lists then.
  void start_afresh_across() { wide_is_valid_ = false, changed_lists_ = true; }

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
  /// Throws std::logic_error in 3D.
  Broadphase& broadphase() {
    if (!broadphase_2d_) throw std::logic_error("a 2D broadphase for a 3D scene");
    return *broadphase_2d_;
  }

 private:
  /// Where the grains (relative to the first vessel) and the vessels were when a list was made.
  struct Reference {
    double time = 0;              // s
    std::vector<double> x, y, z;  // m
    std::vector<Pose> poses;
  };
  /// Pairs, and how fast each of them may come nearer, m/s.
  struct WideList {
    PairList pairs;
    std::vector<float> speed;
  };
  /// A kind of list: how much farther than touching it looks, and for how long.
  struct Level {
    double margin;                                      // m
    double lasts = std::numeric_limits<double>::max();  // s
    Reference from{};

    double elapsed(double time) const { return std::abs(time - from.time); }
  };
  /// How all go on from there, m/s relative to the first vessel.
  struct Course {
    std::vector<double> x, y, z;           // by grain
    std::vector<Eigen::Vector3d> vessels;  // by vessel
    Eigen::Vector3d of(std::size_t i) const { return {x[i], y[i], z.empty() ? 0 : z[i]}; }
    Eigen::Vector3d mean() const;  // of the grains
  };
  static void note(const Grains& grains, const Walls& walls, double time, Reference& reference);
  bool any_strayed(const Reference& from, const Grains& grains, const Pose& first, double elapsed, double limit) const;
  bool strayed(const Reference& from, const Grains& grains, const Walls& walls, double time, double limit) const;
  static void remove_flagged(const std::vector<char>& removed, std::vector<double>& x, std::vector<double>& y,
                             std::vector<double>& z);

  void choose_narrow_margin();
  void learn_course(const Grains& grains, const Walls& walls, double time);
  void choose_wide_time(double elapsed, bool outlived);
  Reaches reaches(const Grains& grains) const;
  void set_pair_speeds();
  void search(const Grains& grains, const Walls& walls, double time);
  void prune(const Grains& grains, const Walls& walls, double time, ContactState& contacts);
  void prune_pairs(const Grains& grains, const WideList& wide, const Image& shift, PairList& narrow);
  void prune_range(const Grains& grains, const WideList& wide, std::size_t from, std::size_t to, const Image& shift,
                   PairList& narrow) const;
  void carry_histories_over(ContactState& contacts);
  void prune_walls(const Grains& grains, const Walls& walls, ContactState& contacts);

  Execution& execution_;
  std::optional<Broadphase> broadphase_2d_;
  std::optional<Broadphase3d> broadphase_3d_;
  std::vector<double> largest_radius_;          // m, by vessel, of its walls about its frame's zero
  std::vector<double> largest_radius_in_plan_;  // m, the same about the upright axis, in 3D
  double diameter_;                             // m, of the largest disc or ball
  Level wide_level_, narrow_level_;
  Course course_;
  Eigen::Vector3d mean_course_ = Eigen::Vector3d::Zero();  // m/s, of the grains
  std::int64_t updates_since_prune_ = 0;
  HistoryKinds kinds_;
  std::vector<Image> images_;
  WideList wide_;
  std::vector<WideList> wide_boundaries_;  // by image
  std::vector<WallCandidate> wide_walls_;
  std::vector<PairList> parts_;  // by thread
  PairList old_;                 // the narrow lists before, while histories are carried over
  std::vector<BoundaryContacts> old_boundaries_;
  ContactHistories old_histories_;
  bool wide_is_valid_ = false;
  bool changed_lists_ = false;  // whether a contact may be in another list than before
  std::int64_t searches_ = 0, prunes_ = 0;
};

}  // namespace vibrosow
