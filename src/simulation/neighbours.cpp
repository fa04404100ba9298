#include "simulation/neighbours.hpp"

#include <algorithm>
#include <atomic>
#include <boost/iterator/counting_iterator.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

#include "vessel/nearest_on_face.hpp"
#include "vessel/nearest_point.hpp"
#include "vessel/vessel_faces.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

void keep_unflagged(std::vector<double>& array, const std::vector<char>& removed) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < array.size(); ++i)
    if (!removed[i]) array[kept++] = array[i];
  array.resize(kept);
}

/// Returns which entries are kept, ascending.
std::vector<std::size_t> renumber(PairList& list, const std::vector<char>& removed, const std::vector<int>& new_index) {
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(list.grain[k]), j = static_cast<std::size_t>(list.partner[k]);
    if (removed[i] || removed[j]) continue;
    list.grain[kept.size()] = new_index[i], list.partner[kept.size()] = new_index[j];
    kept.push_back(k);
  }
  list.grain.resize(kept.size()), list.partner.resize(kept.size());
  return kept;
}

void renumber(PairList& list, ContactHistories& histories, const std::vector<char>& removed,
              const std::vector<int>& new_index) {
  const std::vector<std::size_t> kept = renumber(list, removed, new_index);
  if (!histories.touched.empty()) histories.keep_entries(kept);
}

/// Keeps the candidates of a list for which `keep` is true, with their histories.
template <class Keep>
void keep_candidates(std::vector<WallCandidate>& list, ContactHistories& histories, Keep keep) {
  std::vector<std::size_t> kept_entries;
  for (std::size_t c = 0; c < list.size(); ++c) {
    if (!keep(list[c])) continue;
    list[kept_entries.size()] = list[c];
    kept_entries.push_back(c);
  }
  list.resize(kept_entries.size());
  histories.keep_entries(kept_entries);
}

void renumber(std::vector<WallCandidate>& list, ContactHistories& histories, const std::vector<char>& removed,
              const std::vector<int>& new_index) {
  keep_candidates(list, histories, [&](const WallCandidate& c) { return !removed[static_cast<std::size_t>(c.grain)]; });
  for (WallCandidate& c : list) c.grain = new_index[static_cast<std::size_t>(c.grain)];
}

/// A pair with a history, whichever of the two comes first in its list.
struct ActivePair {
  int low, high;
  const ContactHistories* histories;
  std::size_t entry;
  bool from_low;  // whether the lower number is its list's first grain
};
bool operator<(const ActivePair& a, const ActivePair& b) {
  return a.low != b.low ? a.low < b.low : a.high < b.high;
}

void add_active_pairs(const PairList& list, const ContactHistories& histories, std::vector<ActivePair>& active) {
  for (std::size_t k = 0; k < list.size(); ++k)
    if (histories.has_history(k))
      active.push_back({std::min(list.grain[k], list.partner[k]), std::max(list.grain[k], list.partner[k]), &histories,
                        k, list.grain[k] < list.partner[k]});
}

/// Of all lists, sorted: a grain carried from one side to the other takes its contacts from one list to the other.
std::vector<ActivePair> active_pairs(const PairList& pairs, const ContactHistories& histories,
                                     const std::vector<BoundaryContacts>& boundaries) {
  std::vector<ActivePair> active;
  add_active_pairs(pairs, histories, active);
  for (const BoundaryContacts& boundary : boundaries) add_active_pairs(boundary.pairs, boundary.histories, active);
  std::sort(active.begin(), active.end());
  return active;
}

/// Seen from the pair's other grain: in 3D vectors change their sign, in 2D nothing does.
void reverse(ContactHistories& histories, std::size_t k) {
  const std::size_t length = histories.kinds.record_length(), twist = histories.kinds.roll ? length - 1 : length;
  if (length == 0 || histories.place[k] == ContactHistories::no_record) return;
  double* record = histories.record(k);
  for (std::size_t n = 0; n < length; ++n)
    if (n != twist) record[n] = -record[n];
}

void carry_over(const std::vector<ActivePair>& active, const PairList& list, ContactHistories& histories) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    const bool from_low = list.grain[k] < list.partner[k];
    const ActivePair wanted{std::min(list.grain[k], list.partner[k]), std::max(list.grain[k], list.partner[k]), nullptr,
                            0, from_low};
    const auto found = std::lower_bound(active.begin(), active.end(), wanted);
    if (found == active.end() || wanted < *found) continue;
    histories.copy_entry(k, *found->histories, found->entry);
    if (found->from_low != from_low) reverse(histories, k);
  }
}

/// Nothing touches at the entries [from, to).
void forget(ContactHistories& histories, std::size_t from, std::size_t to) {
  const auto clear = [](auto& array, std::size_t begin, std::size_t end, int value = 0) {
    if (!array.empty())
      std::fill(array.begin() + static_cast<std::ptrdiff_t>(begin), array.begin() + static_cast<std::ptrdiff_t>(end),
                value);
  };
  clear(histories.slip, from, to), clear(histories.roll, from, to);
  clear(histories.place, from, to, ContactHistories::no_record);
  clear(histories.touched, from, to);
}

void drop_pairs_within_clumps(const std::vector<int>& clump, PairList& list) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (clump[static_cast<std::size_t>(list.grain[k])] == clump[static_cast<std::size_t>(list.partner[k])]) continue;
    list.grain[kept] = list.grain[k], list.partner[kept++] = list.partner[k];
  }
  list.grain.resize(kept), list.partner.resize(kept);
}

/// The same where both lists know each pair by the same order, for entries [from, to) of the new one: one search.
void carry_over(const PairList& old, const ContactHistories& old_histories, const PairList& list, std::size_t from,
                std::size_t to, ContactHistories& histories) {
  const auto pair_of = [](const PairList& pairs, std::size_t k) {
    return std::int64_t{pairs.grain[k]} << 32 | std::int64_t{pairs.partner[k]};
  };
  if (from == to) return;
  const std::size_t end = old.size();
  using Entry = boost::counting_iterator<std::size_t>;
  std::size_t k = *std::partition_point(Entry(0), Entry(end),
                                        [&](std::size_t entry) { return pair_of(old, entry) < pair_of(list, from); });
  for (std::size_t m = from; m < to && k < end; ++m) {
    const std::int64_t pair = pair_of(list, m);
    while (k < end && pair_of(old, k) < pair) ++k;
    if (k < end && pair_of(old, k) == pair && old_histories.touched[k]) histories.copy_entry(m, old_histories, k);
  }
}

/// By how much longer than the last list held the next is to last.
constexpr double longer = 1.5;

/// Where a vessel is displaced to (m), relative to the first.
Eigen::Vector3d place_of(const std::vector<Pose>& poses, std::size_t v) {
  const Eigen::Vector2d moved = poses[v].displacement - poses.front().displacement;
  return {moved.x(), moved.y(), poses[v].across - poses.front().across};
}

/// How far a wall is from a grain's centre, and on which side of it the grain stands.
struct SeenWall {
  double distance2, side;  // m2; its sign
};
SeenWall seen_in_plane(const Grains& grains, std::size_t i, const Walls& walls, int wall) {
  const NearestPoint nearest = nearest_point(walls.placed()[static_cast<std::size_t>(wall)], grains.x[i], grains.y[i]);
  return {nearest.distance2, nearest.side};
}
SeenWall seen_3d(const Grains& grains, std::size_t i, const Walls& walls, int wall) {
  const NearestOnFace nearest =
      nearest_on_face(walls.placed_faces()[static_cast<std::size_t>(wall)], {grains.x[i], grains.y[i], grains.z[i]});
  return {nearest.distance2, nearest.side};
}

}  // namespace

Neighbours::Neighbours(const std::vector<Vessel>& vessels, double largest_disc_diameter, NeighbourMargins margins,
                       HistoryKinds kinds, Execution& execution)
    : execution_(execution),
      diameter_(largest_disc_diameter),
      wide_level_{(kinds.is_3d ? margins.wide_3d : margins.wide) * largest_disc_diameter},
      narrow_level_{margins.narrow * largest_disc_diameter},
      kinds_(kinds) {
  if (kinds.is_3d)
    broadphase_3d_.emplace(vessels, largest_disc_diameter, execution.instructions());
  else
    broadphase_2d_.emplace(vessels, largest_disc_diameter, execution.instructions());
  const Vessel& tray = vessels.front();
  const bool along = tray.sides == Sides::periodic, across = kinds.is_3d && tray.front_and_back == Sides::periodic;
  if (along) images_.push_back({tray.length, 0});
  if (across) images_.push_back({0, *tray.depth});
  if (along && across) images_.push_back({tray.length, *tray.depth}), images_.push_back({tray.length, -*tray.depth});
  wide_boundaries_.resize(images_.size()), old_boundaries_.resize(images_.size());
  for (const Vessel& vessel : vessels) {
    largest_radius_.push_back(largest_radius(vessel, Eigen::Vector2d::Zero()));
    largest_radius_in_plan_.push_back(kinds.is_3d ? largest_radius_in_plan(vessel, Eigen::Vector2d::Zero()) : 0);
  }
  course_.vessels.assign(vessels.size(), Eigen::Vector3d::Zero());
}

Eigen::Vector3d Neighbours::Course::mean() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) sum += of(i);
  return x.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(x.size()));
}

void Neighbours::note(const Grains& grains, const Walls& walls, double time, Reference& reference) {
  const Pose& first = walls.poses().front();
  reference.time = time, reference.poses = walls.poses();
  reference.x = grains.x, reference.y = grains.y, reference.z = grains.z;
  for (double& x : reference.x) x -= first.displacement.x();
  for (double& y : reference.y) y -= first.displacement.y();
  for (double& z : reference.z) z -= first.across;
}

/// How they moved on the mean since the last search. Those that are new go with the first vessel until the next one;
/// one that was carried to the other side of a periodic vessel goes on as it did.
void Neighbours::learn_course(const Grains& grains, const Walls& walls, double time) {
  const Reference& from = wide_level_.from;
  const double elapsed = time - from.time, far = 2 * wide_level_.margin;
  const auto learn = [&](const std::vector<double>& now, double shift, const std::vector<double>& was,
                         std::vector<double>& speed) {
    speed.resize(now.size());
    for (std::size_t i = 0; i < was.size(); ++i) {
      const double moved = now[i] - shift - was[i];
      if (std::abs(moved - elapsed * speed[i]) < far) speed[i] = moved / elapsed;
    }
  };
  const Pose& first = walls.poses().front();
  if (from.poses.empty() || !(elapsed > 0)) {
    course_.x.resize(grains.x.size()), course_.y.resize(grains.y.size()), course_.z.resize(grains.z.size());
    return;
  }
  learn(grains.x, first.displacement.x(), from.x, course_.x);
  learn(grains.y, first.displacement.y(), from.y, course_.y);
  learn(grains.z, first.across, from.z, course_.z);
  for (std::size_t v = 0; v < from.poses.size(); ++v)
    course_.vessels[v] = 1 / elapsed * (place_of(walls.poses(), v) - place_of(from.poses, v));
}

bool Neighbours::any_strayed(const Reference& from, const Grains& grains, const Pose& first, double elapsed,
                             double limit) const {
  std::atomic<bool> any = false;
  const double shift[] = {first.displacement.x(), first.displacement.y(), first.across};
  execution_.share(from.x.size(), [&](std::size_t a, std::size_t b) {
    const bool here =
        kinds_.is_3d ? execution_.loops_3d().any_moved(b - a, {&grains.x[a], &grains.y[a], &grains.z[a]}, shift,
                                                       {&from.x[a], &from.y[a], &from.z[a]},
                                                       {&course_.x[a], &course_.y[a], &course_.z[a]}, elapsed, limit)
                     : execution_.loops().any_moved(b - a, grains.x.data() + a, grains.y.data() + a, shift[0], shift[1],
                                                    from.x.data() + a, from.y.data() + a, course_.x.data() + a,
                                                    course_.y.data() + a, elapsed, limit);
    if (here) any = true;
  });
  return any;
}

/// Whether a grain or a vessel is farther than `limit` (m) from where its course would have taken it.
bool Neighbours::strayed(const Reference& from, const Grains& grains, const Walls& walls, double time,
                         double limit) const {
  const double elapsed = time - from.time;
  if (any_strayed(from, grains, walls.poses().front(), elapsed, limit)) return true;
  for (std::size_t v = 0; v < from.poses.size(); ++v) {
    const Pose &now = walls.poses()[v], &then = from.poses[v];
    const double turned = std::abs(now.angle - then.angle) * largest_radius_[v] +
                          std::abs(now.turn - then.turn) * largest_radius_in_plan_[v];
    const Eigen::Vector3d moved = place_of(walls.poses(), v) - place_of(from.poses, v);
    if ((moved - elapsed * course_.vessels[v]).norm() + turned > limit) return true;
  }
  return false;
}

void Neighbours::update(const Grains& grains, const Walls& walls, double time, ContactState& contacts) {
  // Two that were further apart than a list looks have touched only if they strayed half its margin each.
  ++updates_since_prune_;
  Level &wide = wide_level_, &narrow = narrow_level_;
  if (wide_is_valid_ && narrow.elapsed(time) <= narrow.lasts &&
      !strayed(narrow.from, grains, walls, time, 0.5 * narrow.margin))
    return;
  choose_narrow_margin();
  if (wide_is_valid_) narrow.lasts = longer * narrow.elapsed(time);
  const double left = wide.lasts - wide.elapsed(time);
  if (!wide_is_valid_ || left < 0.5 * narrow.lasts ||
      strayed(wide.from, grains, walls, time, 0.5 * (wide.margin - narrow.margin)))
    search(grains, walls, time);
  narrow.lasts = std::min(narrow.lasts, wide.lasts - wide.elapsed(time));
  prune(grains, walls, time, contacts);
}

/// A margin m costs c m at every update, in pairs looked at for nothing, and P every T updates, when the list is
/// pruned; T grows as m, so that both are least together where they are alike: m^2 = P m_before / (c T_before). Counted
/// in updates, not in seconds: a run's lists are the same wherever it runs.
void Neighbours::choose_narrow_margin() {
  constexpr double prune_per_candidate_cost = 6;  // P / c, in diameters; measured on shaken trays and slot hoppers
  constexpr double least = 0.02, most = 0.35;     // diameters
  double& margin = narrow_level_.margin;
  if (updates_since_prune_ > 1) {
    const double before = margin / diameter_;
    const double best = std::sqrt(prune_per_candidate_cost * before / static_cast<double>(updates_since_prune_));
    margin = std::min(std::clamp(best, least, most) * diameter_, 0.5 * wide_level_.margin);
  }
  updates_since_prune_ = 0;
}

/// Somewhat longer than the last one held, and not so long that a usual grain's course takes it farther than the
/// margin.
void Neighbours::choose_wide_time(double elapsed, bool outlived) {
  Level& wide = wide_level_;
  if (outlived || wide.lasts == std::numeric_limits<double>::max()) wide.lasts = longer * elapsed;
  double square = 0;
  for (std::size_t i = 0; i < course_.x.size(); ++i) square += (course_.of(i) - mean_course_).squaredNorm();
  const double usual = std::sqrt(square / std::max<double>(1, static_cast<double>(course_.x.size())));
  if (usual > 0) wide.lasts = std::min(wide.lasts, 0.5 * wide.margin / usual);
}

/// From where on a grain is near while the wide list lasts: by pairs' common course, and by each vessel's.
Reaches Neighbours::reaches(const Grains& grains) const {
  Reaches all = reaches_at_rest(grains);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const Eigen::Vector3d own = course_.of(i);
    double past_walls = 0;
    for (const Eigen::Vector3d& vessel : course_.vessels) past_walls = std::max(past_walls, (own - vessel).norm());
    all.pair[i] += wide_level_.lasts * (own - mean_course_).norm();
    all.wall[i] += wide_level_.lasts * past_walls;
  }
  return all;
}

void Neighbours::search(const Grains& grains, const Walls& walls, double time) {
  execution_.stop_if_asked();  // a search among millions takes seconds
  const double elapsed = time - wide_level_.from.time;
  learn_course(grains, walls, time);
  mean_course_ = course_.mean();
  if (!wide_level_.from.poses.empty() && elapsed > 0) choose_wide_time(elapsed, wide_is_valid_);
  const Reaches near = reaches(grains);
  const double margin = wide_level_.margin;
  const Ranges ranges{execution_.threads(), [this](const auto& work) {
                        execution_.stop_if_asked();
                        execution_.for_each_range(work);
                      }};
  if (broadphase_2d_)
    broadphase_2d_->find(grains, walls.poses(), near, margin, ranges, wide_.pairs, wide_walls_);
  else
    broadphase_3d_->find(grains, walls.poses(), near, margin, ranges, wide_.pairs, wide_walls_);
  for (std::size_t k = 0; k < images_.size(); ++k) {
    if (broadphase_2d_)
      broadphase_2d_->find_across(images_[k].x, margin, ranges, wide_boundaries_[k].pairs);
    else
      broadphase_3d_->find_across(images_[k].x, images_[k].z, margin, ranges, wide_boundaries_[k].pairs);
  }
  if (!grains.clump.empty()) {
    drop_pairs_within_clumps(grains.clump, wide_.pairs);
    for (WideList& boundary : wide_boundaries_) drop_pairs_within_clumps(grains.clump, boundary.pairs);
  }
  set_pair_speeds();
  note(grains, walls, time, wide_level_.from);
  wide_is_valid_ = true;
  ++searches_;
}

void Neighbours::set_pair_speeds() {
  const auto set = [this](WideList& list) {
    list.speed.resize(list.pairs.size());
    execution_.share(list.pairs.size(), [&](std::size_t from, std::size_t to) {
      for (std::size_t k = from; k < to; ++k) {
        const Eigen::Vector3d apart = course_.of(static_cast<std::size_t>(list.pairs.grain[k])) -
                                      course_.of(static_cast<std::size_t>(list.pairs.partner[k]));
        list.speed[k] = static_cast<float>((1 + 1e-6) * apart.norm());  // never rounded to less
      }
    });
  };
  set(wide_);
  for (WideList& boundary : wide_boundaries_) set(boundary);
}

/// Of the entries [from, to) of a wide list, keeps the pairs that are near while the narrow one lasts, with the rows'
/// grains moved by `shift`.
void Neighbours::prune_range(const Grains& grains, const WideList& wide, std::size_t from, std::size_t to,
                             const Image& shift, PairList& narrow) const {
  const PerGrain radius{grains.polydisperse ? grains.radius.data() : nullptr, grains.kinds.front().radius};
  constexpr std::size_t chunk = 4096;  // of the wide list: the narrow one is never much longer than it must be
  std::size_t near = 0;
  for (; from < to; from += chunk) {
    const std::size_t count = std::min(chunk, to - from);
    if (narrow.grain.size() < near + count + 16)
      narrow.grain.resize(near + count + 16), narrow.partner.resize(near + count + 16);
    const int *grain = &wide.pairs.grain[from], *partner = &wide.pairs.partner[from];
    const float* speed = &wide.speed[from];
    int *near_grain = &narrow.grain[near], *near_partner = &narrow.partner[near];
    const auto [margin, lasts] = std::pair(narrow_level_.margin, narrow_level_.lasts);
    near += kinds_.is_3d ? execution_.loops_3d().near_pairs(
                               count, grain, partner, speed, {grains.x.data(), grains.y.data(), grains.z.data()},
                               shift.x, shift.z, radius, margin, lasts, near_grain, near_partner)
                         : execution_.loops().near_pairs(count, grain, partner, speed, grains.x.data(), grains.y.data(),
                                                         shift.x, radius, margin, lasts, near_grain, near_partner);
  }
  narrow.grain.resize(near), narrow.partner.resize(near);
}

void Neighbours::prune_pairs(const Grains& grains, const WideList& wide, const Image& shift, PairList& narrow) {
  const std::size_t pairs = wide.pairs.size();
  const std::size_t threads = static_cast<std::size_t>(execution_.threads());
  if (threads == 1) return prune_range(grains, wide, 0, pairs, shift, narrow);
  parts_.resize(threads);
  execution_.for_each_range([&](int range) {
    const std::size_t k = static_cast<std::size_t>(range);
    prune_range(grains, wide, pairs * k / threads, pairs * (k + 1) / threads, shift, parts_[k]);
  });
  narrow.clear();
  for (const PairList& part : parts_) {
    narrow.grain.insert(narrow.grain.end(), part.grain.begin(), part.grain.end());
    narrow.partner.insert(narrow.partner.end(), part.partner.begin(), part.partner.end());
  }
}

void Neighbours::prune(const Grains& grains, const Walls& walls, double time, ContactState& contacts) {
  execution_.stop_if_asked();
  contacts.boundaries.resize(images_.size());
  std::swap(contacts.pairs, old_), std::swap(contacts.pair_histories, old_histories_);
  std::swap(contacts.boundaries, old_boundaries_);
  prune_pairs(grains, wide_, {0, 0}, contacts.pairs);
  for (std::size_t k = 0; k < images_.size(); ++k)
    prune_pairs(grains, wide_boundaries_[k], images_[k], contacts.boundaries[k].pairs);
  if (kinds_.any()) carry_histories_over(contacts);
  prune_walls(grains, walls, contacts);
  note(grains, walls, time, narrow_level_.from);
  ++prunes_;
}

void Neighbours::carry_histories_over(ContactState& contacts) {
  const auto begin = [this](const PairList& list, ContactHistories& histories) {
    histories.resize(list.size(), kinds_);
    execution_.share(list.size(), [&](std::size_t from, std::size_t to) { forget(histories, from, to); });
  };
  begin(contacts.pairs, contacts.pair_histories);
  for (BoundaryContacts& boundary : contacts.boundaries) begin(boundary.pairs, boundary.histories);
  if (!std::exchange(changed_lists_, false)) {
    execution_.share(contacts.pairs.size(), [&](std::size_t from, std::size_t to) {
      carry_over(old_, old_histories_, contacts.pairs, from, to, contacts.pair_histories);
    });
    for (std::size_t k = 0; k < old_boundaries_.size(); ++k) {
      auto& [pairs, histories] = contacts.boundaries[k];
      carry_over(old_boundaries_[k].pairs, old_boundaries_[k].histories, pairs, 0, pairs.size(), histories);
    }
    return;
  }
  const std::vector<ActivePair> active = active_pairs(old_, old_histories_, old_boundaries_);
  carry_over(active, contacts.pairs, contacts.pair_histories);
  for (BoundaryContacts& boundary : contacts.boundaries) carry_over(active, boundary.pairs, boundary.histories);
}

/// A grain that was near a wall before keeps the side it came from: renewing the list must not hide a crossing.
void Neighbours::prune_walls(const Grains& grains, const Walls& walls, ContactState& contacts) {
  const auto before = [](const WallCandidate& a, const WallCandidate& b) {
    return a.grain != b.grain ? a.grain < b.grain : a.wall < b.wall;
  };
  const std::vector<WallCandidate> old = std::move(contacts.walls);
  const ContactHistories old_histories = std::move(contacts.wall_histories);
  std::vector<std::pair<std::size_t, std::size_t>> known_before;  // old entry, new entry
  contacts.walls.clear();
  auto known = old.begin();
  for (const WallCandidate& candidate : wide_walls_) {
    const std::size_t i = static_cast<std::size_t>(candidate.grain);
    const std::size_t wall = static_cast<std::size_t>(candidate.wall);
    const auto [distance2, side] =
        broadphase_2d_ ? seen_in_plane(grains, i, walls, candidate.wall) : seen_3d(grains, i, walls, candidate.wall);
    const double past = (course_.of(i) - course_.vessels[walls.vessel_of(wall)]).norm();
    const double reach = grains.kind(i).radius + narrow_level_.margin + narrow_level_.lasts * past;
    if (distance2 >= reach * reach) continue;
    while (known != old.end() && before(*known, candidate)) ++known;
    const bool was_near = known != old.end() && !before(candidate, *known);
    if (was_near) known_before.emplace_back(static_cast<std::size_t>(known - old.begin()), contacts.walls.size());
    contacts.walls.push_back({candidate.grain, candidate.wall, was_near ? known->side : side});
  }
  contacts.wall_histories = {};
  contacts.wall_histories.resize(contacts.walls.size(), kinds_);
  for (const auto& [old_entry, entry] : known_before)
    contacts.wall_histories.copy_entry(entry, old_histories, old_entry);
}

void Neighbours::remove_flagged(const std::vector<char>& removed, std::vector<double>& x, std::vector<double>& y,
                                std::vector<double>& z) {
  for (std::vector<double>* one : {&x, &y, &z}) keep_unflagged(*one, removed);
}

void Neighbours::remove_wall(int wall, ContactState& contacts) {
  broadphase_2d_ ? broadphase_2d_->remove_wall(wall) : broadphase_3d_->remove_wall(wall);
  std::erase_if(wide_walls_, [wall](const WallCandidate& candidate) { return candidate.wall == wall; });
  keep_candidates(contacts.walls, contacts.wall_histories,
                  [wall](const WallCandidate& candidate) { return candidate.wall != wall; });
}

void Neighbours::restore_wall(int wall) {
  broadphase_2d_ ? broadphase_2d_->restore_wall(wall) : broadphase_3d_->restore_wall(wall);
  start_afresh();
}

void Neighbours::remove_flagged(const std::vector<char>& removed, ContactState& contacts) {
  std::vector<int> new_index(removed.size());
  int next = 0;
  for (std::size_t i = 0; i < removed.size(); ++i) new_index[i] = removed[i] ? -1 : next++;
  renumber(contacts.pairs, contacts.pair_histories, removed, new_index);
  for (BoundaryContacts& boundary : contacts.boundaries)
    renumber(boundary.pairs, boundary.histories, removed, new_index);
  renumber(contacts.walls, contacts.wall_histories, removed, new_index);
  for (Reference* from : {&wide_level_.from, &narrow_level_.from}) remove_flagged(removed, from->x, from->y, from->z);
  remove_flagged(removed, course_.x, course_.y, course_.z);
  if (!wide_is_valid_) return;
  const auto renumber_wide = [&](WideList& list) {
    const std::vector<std::size_t> kept = renumber(list.pairs, removed, new_index);
    for (std::size_t k = 0; k < kept.size(); ++k) list.speed[k] = list.speed[kept[k]];
    list.speed.resize(kept.size());
  };
  renumber_wide(wide_);
  for (WideList& boundary : wide_boundaries_) renumber_wide(boundary);
  ContactHistories none;
  renumber(wide_walls_, none, removed, new_index);
}

}  // namespace vibrosow
