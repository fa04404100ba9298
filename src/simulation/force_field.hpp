#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/pair_forces.hpp"
#include "contact/space_wall_contacts.hpp"
#include "contact/wall_contacts.hpp"
#include "grains/clump_discs.hpp"
#include "loops/execution.hpp"
#include "loops/space_forces.hpp"
#include "result/frame.hpp"
#include "simulation/neighbours.hpp"
#include "simulation/state.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {

/// Of all contacts the one with the largest relative overlap: which grain, against which other; -1: a wall, or, of the
/// grain, none at all.
struct DeepestContact {
  int grain = -1, partner = -1;
  double relative_overlap = 0;  // overlap c_i / (c_i + c_j) / r_i, compliances c
  double overlap = 0;           // m
  double stiffness = 0;         // of the law, of these two
  double inverse_mass = 0;      // 1/kg, of both
};

/// Contact forces on all grains of a state at a time: walls are placed, neighbours brought up to date, the chosen
/// kernels run. Where grains are clumps, lists and kernels see their discs, and the forces are gathered.
class ForceField {
 public:
  /// Both live as long as the field. Walls stand as they do in the state, and lists are made from it.
  ForceField(const Model& model, SimulationState& state, NeighbourMargins margins, Execution& execution);
  ForceField(const ForceField&) = delete;
  ForceField& operator=(const ForceField&) = delete;

  /// Where the next evaluation, and it alone, reads how balls in space lie and move, if whoever moves them sets it. Not
  /// of clumps.
  BallRows rows_to_set();

  /// Forces on the grains where they are now, with the vessels where they are at `time`. Statistics are added up, but
  /// for the walls' power, which is this evaluation's. `step` moves the histories of contacts on.
  void evaluate(double time, const ContactStep& step) { evaluate(time, step, state_.statistics); }
  /// The same with other statistics, of a look ahead.
  void evaluate(double time, const ContactStep& step, ContactStatistics& statistics);

  /// Walls are where they are at `time` until the next evaluation.
  void place_walls(double time) { walls_.place(state_.vessels.placed_at = time); }

  /// Energy of all springs in contacts, J.
  double elastic_energy();

  /// Forces of the walls alone on each grain, where grains and walls are now; nothing moves on by it.
  Forces wall_forces();
  /// The same on each ball in space, those of clumps one by one.
  std::vector<GrainVector> wall_forces_in_space();

  DeepestContact deepest_contact();

  /// All contacts, with the forces in them where grains and walls are now; nothing moves on by it.
  std::vector<GrainContact> contacts();

  /// Which grains touch another one.
  std::vector<char> touching();

  /// Grains were put in: the next evaluation looks for neighbours afresh.
  void grains_added();
  /// Grains were moved by a period: neighbours are looked for at once.
  void grains_wrapped();
  /// These grains (one flag each) are being taken out.
  void remove_flagged(const std::vector<char>& removed);
  /// Takes a wall away at once; nothing touches it any more.
  void remove_wall(std::size_t wall);
  /// Puts it back where its vessel is now.
  void restore_wall(std::size_t wall);
  void set_motion(std::size_t vessel, const std::optional<VesselMotion>& motion, const Eigen::Vector2d& shift);

  const Forces& forces() const { return forces_; }
  /// The same of balls in space: forces (N) and torques (N m), the latter without rotation empty.
  const std::vector<GrainVector>& forces_in_space() const { return space_forces_.forces; }
  const std::vector<GrainVector>& torques_in_space() const { return space_forces_.torques; }
  const Walls& walls() const { return walls_; }
  Neighbours& neighbours() { return neighbours_; }
  const Neighbours& neighbours() const { return neighbours_; }

 private:
  const Grains& place_discs();
  double energy_of_springs();
  /// They move as they do where they are, not as in the middle of the step of the last evaluation.
  void see_walls_as_they_are() { place_walls(state_.vessels.placed_at); }
  void set_pair_forces(const Grains& discs, const Motion& at, const ContactStep& step, Forces& forces,
                       ContactStatistics& statistics);
  Motion motion_of(const Grains& discs) const;
  Motion across_boundary(const Grains& discs, double period);
  WallContacts& find_wall_contacts(const Grains& discs);
  void run_kernels(const Grains& discs, const ContactStep& step, Forces& forces, ContactStatistics& statistics);
  SpaceMotion motion_in_space(const Grains& balls);
  void set_rows(const Grains& balls);
  SpaceMotion motion_of_image(const SpaceMotion& at, const Neighbours::Image& image);
  void run_kernels_in_space(const Grains& balls, const ContactStep& step, SpaceForces& forces,
                            ContactStatistics& statistics);
  void set_pair_forces_in_space(const Grains& balls, const SpaceMotion& at, const ContactStep& step,
                                SpaceForces& forces, ContactStatistics& statistics);
  SpaceWallContacts& find_wall_contacts_in_space(const Grains& balls);
  double elastic_energy_in_space(const Grains& balls);
  Eigen::Vector3d force_of_pair(const Grains& discs, const Motion& at, const PairList& pairs,
                                ContactHistories& histories, std::size_t k);
  Eigen::Vector3d force_of_pair_in_space(const Grains& balls, const SpaceMotion& at, const PairList& pairs,
                                         ContactHistories& histories, std::size_t k);
  void add_contacts(const Grains& discs, const PairList& pairs, ContactHistories& histories,
                    const Neighbours::Image& image, std::vector<GrainContact>& contacts);
  void add_wall_contacts(const Grains& discs, std::vector<GrainContact>& contacts);
  void add_face_contacts(const Grains& balls, std::vector<GrainContact>& contacts);
  std::int64_t id_of_disc(const Grains& discs, std::size_t i) const;

  const Model& model_;
  SimulationState& state_;
  Execution& execution_;
  Walls walls_;
  Neighbours neighbours_;
  PairKernel pair_kernel_;
  WallKernel wall_kernel_;
  std::optional<ClumpDiscs> clumps_;
  bool clumps_are_current_ = false;
  Forces forces_, disc_forces_;
  SpacePairKernel space_pair_kernel_;
  SpaceWallKernel space_wall_kernel_;
  SpaceForces space_forces_, ball_forces_;

  /// A finder of contacts with walls, and those that it found.
  template <class Finder, class Contacts>
  struct WallWork {
    Finder finder;
    Contacts contacts;
  };
  /// With what one thread works on its range of pairs or of wall candidates, and what it leaves for the others.
  struct RangeWork {
    std::vector<ForeignForce> foreign;
    std::vector<ForeignSpaceForce> foreign_in_space;
    ContactStatistics statistics;
    WallWork<WallContactFinder, WallContacts> walls;
    WallWork<SpaceWallFinder, SpaceWallContacts> space_walls;
  };
  /// A thread's grains, and the entries of the list that are theirs.
  struct PairShare {
    GrainRange grains;
    PairRange entries;
  };
  PairShare pair_share(std::size_t range, std::size_t grains) const;
  /// Of wall candidates, with its place among them; a grain's are all in one range.
  struct WallRange {
    std::size_t first;
    std::span<WallCandidate> candidates;
  };
  WallRange wall_range(std::size_t range);
  void add_up_ranges(ContactStatistics& statistics) const;
  template <class Work, class Placed, class Kernel, class At, class Add>
  void add_walls(Work RangeWork::*work, const Grains& grains, const Placed& walls, Kernel kernel, const At& at,
                 const ContactStep& step, const Add& add_forces, ContactStatistics& statistics);

  std::vector<RangeWork> ranges_;
  std::vector<double> shifted_x_;                     // m, across the periodic boundary
  std::vector<GrainVector> places_, shifted_places_;  // the same of balls in space
  std::vector<BallMotion> motions_;
  bool rows_are_set_ = false;
};

/// A grain's walls are all in one range, so its forces are added up alike for any number of ranges.
template <class Work, class Placed, class Kernel, class At, class Add>
void ForceField::add_walls(Work RangeWork::*work, const Grains& grains, const Placed& walls, Kernel kernel,
                           const At& at, const ContactStep& step, const Add& add_forces,
                           ContactStatistics& statistics) {
  ContactHistories& histories = state_.contacts.wall_histories;
  const GrainSurfaces surfaces = surfaces_of(grains);
  execution_.for_each_range([&](int k) {
    const auto [first, candidates] = wall_range(static_cast<std::size_t>(k));
    RangeWork& own = ranges_[static_cast<std::size_t>(k)];
    auto& [finder, contacts] = own.*work;
    own.statistics = {};
    finder.find(grains, candidates, first, walls, contacts);
    finder.watch_crossings(candidates, own.statistics.crossed);
    if (step.commit != 0) finder.touches().renew(histories);
    add_figures(kernel(surfaces, at, model_.contacts, step, histories, contacts), own.statistics);
    if (step.commit != 0) finder.touches().share(histories);
    add_forces(contacts);
    own.statistics.contacts = contacts.count;
  });
  add_up_ranges(statistics);
  for (const RangeWork& own : ranges_) add_wall_power((own.*work).contacts, statistics.wall_power);
}

}  // namespace vibrosow
