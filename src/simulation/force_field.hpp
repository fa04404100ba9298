#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/pair_forces.hpp"
#include "contact/wall_contacts.hpp"
#include "contact/wall_contacts_3d.hpp"
#include "grains/clump_discs.hpp"
#include "loops/execution.hpp"
#include "loops/forces_3d.hpp"
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

  /// Where the next evaluation, and it alone, reads how balls in 3D lie and move, if whoever moves them sets it. Not
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
  /// The same on each ball in 3D, those of clumps one by one.
  std::vector<GrainVector> wall_forces_3d();

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

  const Forces& forces() const { return part_2d_.on_grains; }
  /// The same of balls in 3D: forces (N) and torques (N m), the latter without rotation empty.
  const std::vector<GrainVector>& forces_3d() const { return part_3d_.on_grains.forces; }
  const std::vector<GrainVector>& torques_3d() const { return part_3d_.on_grains.torques; }
  const Walls& walls() const { return walls_; }
  Neighbours& neighbours() { return neighbours_; }
  const Neighbours& neighbours() const { return neighbours_; }

 private:
  /// What the plane and space have each of their own.
  struct Discs2d {
    using Moving = Motion;
    using Sums = Forces;
    using Foreign = ForeignForce;
    using Finder = WallContactFinder;
    using WallContacts = vibrosow::WallContacts;
    using Kernels = VectorKernels;
    using Energies = EnergyKernel;
    static const auto& walls_of(const Walls& walls) { return walls.placed(); }
  };
  struct Balls3d {
    using Moving = Motion3d;
    using Sums = Forces3d;
    using Foreign = ForeignForce3d;
    using Finder = WallFinder3d;
    using WallContacts = WallContacts3d;
    using Kernels = VectorKernels3d;
    using Energies = EnergyKernel3d;
    static const auto& walls_of(const Walls& walls) { return walls.placed_faces(); }
  };
  /// With what one of the two is worked out.
  template <class In>
  struct Part {
    /// With what one thread works on its range of pairs or of wall candidates, and what it leaves for the others.
    struct Range {
      std::vector<typename In::Foreign> foreign;
      typename In::Finder finder;
      typename In::WallContacts contacts;
    };
    typename In::Kernels kernels;
    typename In::Energies energies;
    std::vector<Range> ranges;
    typename In::Sums on_grains, on_discs;  // the second of clumps
  };
  /// A thread's grains, and the entries of the list that are theirs.
  struct PairShare {
    GrainRange grains;
    PairRange entries;
  };
  /// Of wall candidates, with its place among them; a grain's are all in one range.
  struct WallRange {
    std::size_t first;
    std::span<WallCandidate> candidates;
  };

  /// Calls `work` with the part of the plane or of space.
  template <class Work>
  auto with_part(const Work& work) {
    return state_.grains.is_3d ? work(part_3d_) : work(part_2d_);
  }
  const Grains& place_discs();
  double energy_of_springs();
  /// They move as they do where they are, not as in the middle of the step of the last evaluation.
  void see_walls_as_they_are() { place_walls(state_.vessels.placed_at); }
  Motion motion_of(const Part<Discs2d>& part, const Grains& discs) const;
  Motion3d motion_of(const Part<Balls3d>& part, const Grains& balls);
  Motion across(const Motion& at, const Grains& discs, const Neighbours::Image& image);
  Motion3d across(const Motion3d& at, const Grains& balls, const Neighbours::Image& image);
  void set_rows(const Grains& balls);
  PairShare pair_share(std::size_t range, std::size_t grains) const;
  WallRange wall_range(std::size_t range);
  void add_up_ranges(ContactStatistics& statistics) const;
  void gather(Part<Discs2d>& part);
  void gather(Part<Balls3d>& part);

  template <class In>
  void set_pair_forces(Part<In>& part, const Grains& discs, const typename In::Moving& at, const ContactStep& step,
                       typename In::Sums& sums, ContactStatistics& statistics);
  template <class In>
  void add_walls(Part<In>& part, const Grains& discs, const typename In::Moving& at, const ContactStep& step,
                 typename In::Sums& sums, ContactStatistics& statistics);
  template <class In>
  void run_kernels(Part<In>& part, const Grains& discs, const ContactStep& step, typename In::Sums& sums,
                   ContactStatistics& statistics);
  template <class In>
  typename In::WallContacts& find_walls(Part<In>& part, const Grains& discs);
  template <class In>
  typename In::WallContacts& press_walls(Part<In>& part, const Grains& discs);
  template <class In>
  double energy_of_springs(Part<In>& part, const Grains& discs);
  template <class In>
  void add_contacts(Part<In>& part, const Grains& discs, const typename In::Moving& at, const PairList& pairs,
                    ContactHistories& histories, const Neighbours::Image& image, std::vector<GrainContact>& contacts);
  template <class In>
  std::vector<GrainContact> contacts_of(Part<In>& part, const Grains& discs);
  void add_wall_contacts(const WallContacts& touching, const Grains& discs, std::vector<GrainContact>& contacts) const;
  void add_wall_contacts(const WallContacts3d& touching, const Grains& balls,
                         std::vector<GrainContact>& contacts) const;
  std::int64_t id_of_disc(const Grains& discs, std::size_t i) const;

  const Model& model_;
  SimulationState& state_;
  Execution& execution_;
  Walls walls_;
  Neighbours neighbours_;
  std::optional<ClumpDiscs> clumps_;
  bool clumps_are_current_ = false;
  Part<Discs2d> part_2d_;
  Part<Balls3d> part_3d_;
  std::vector<ContactStatistics> of_ranges_;
  std::vector<double> shifted_x_;                     // m, across the periodic boundary
  std::vector<GrainVector> places_, shifted_places_;  // the same of balls in 3D
  std::vector<BallMotion> motions_;
  bool rows_are_set_ = false;
};

}  // namespace vibrosow
