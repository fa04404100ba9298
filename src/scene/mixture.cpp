#include "scene/mixture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "portable_math/functions.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {

double rained_seeds(const Rain& rain, double duration) {
  return rain.rate * std::max(0.0, std::min(rain.stop, duration) - rain.start);
}

namespace {

/// What a lot's table of sizes is of, m, of a seed of its diameter: of a dipole the discs' diameter, of another clump
/// its longest measure.
double told_size(const SeedLot& lot) {
  if (lot.shape != Shape::clump) return lot.diameter;
  if (lot.discs.size() == 2) return 2 * lot.discs.front().radius;
  double longest = 0;
  for (const auto along : {&ClumpDisc::x, &ClumpDisc::y, &ClumpDisc::z}) {
    double least = 0, most = 0;
    for (const ClumpDisc& disc : lot.discs) {
      least = std::min(least, disc.*along - disc.radius);
      most = std::max(most, disc.*along + disc.radius);
    }
    longest = std::max(longest, most - least);
  }
  return longest;
}

/// Seeds of a lot, or of one of its sizes.
struct Amount {
  double seeds = 0, mass = 0;  // kg

  void add(const Amount& more) { seeds += more.seeds, mass += more.mass; }
  Amount over(const Amount& all) const {
    return {all.seeds > 0 ? seeds / all.seeds : 0, all.mass > 0 ? mass / all.mass : 0};
  }
};

Amount mean_seeds(const SeedLot& lot, double number) {
  return {number, number * mean_mass(lot)};
}

std::vector<Amount> mean_seeds(const std::vector<SeedLot>& lots, const std::vector<double>& numbers) {
  std::vector<Amount> amounts;
  for (std::size_t lot = 0; lot < lots.size(); ++lot) amounts.push_back(mean_seeds(lots[lot], numbers[lot]));
  return amounts;
}

/// What was drawn for a vessel's fill of a lot, all of it or one size.
Amount amount_of(const std::vector<DrawnSeeds>& drawn, std::size_t vessel, std::size_t lot,
                 std::optional<double> size = {}) {
  Amount amount;
  for (const DrawnSeeds& one : drawn)
    if (one.vessel == vessel && one.lot == lot && one.size == size.value_or(one.size))
      amount.add({static_cast<double>(one.seeds), one.mass});
  return amount;
}

std::vector<const Vessel*> vessels_of(const Scene& scene) {
  std::vector<const Vessel*> vessels = {&scene.tray};
  if (scene.hopper) vessels.push_back(&*scene.hopper);
  return vessels;
}

LotShare share_of(const Vessel& vessel, SeedSource source, std::size_t lot, const Amount& there, const Amount& of_all,
                  const Amount& asked) {
  const Amount part = there.over(of_all);
  return {&vessel, source, lot, there.seeds, part.seeds, part.mass, asked.seeds, asked.mass};
}

/// The shares of the lots in one source, from what it has of each.
void add_shares(std::vector<LotShare>& shares, const Vessel& vessel, SeedSource source,
                const std::vector<SeedLot>& lots, const std::vector<Amount>& amounts) {
  Amount all, asked;
  for (const Amount& amount : amounts) all.add(amount);
  for (const SeedLot& lot : lots) asked.add(mean_seeds(lot, lot.number_fraction));
  for (std::size_t lot = 0; lot < lots.size(); ++lot)
    shares.push_back(
        share_of(vessel, source, lot, amounts[lot], all, mean_seeds(lots[lot], lots[lot].number_fraction).over(asked)));
}

/// The shares of the sizes of a lot's table; one that stands there twice is one.
void add_sizes(std::vector<LotShare>& shares, const Vessel& vessel, std::size_t v, const std::vector<SeedLot>& lots,
               std::size_t l, const std::vector<DrawnSeeds>& drawn) {
  const SeedLot& lot = lots[l];
  const std::vector<double>& diameters = lot.sizes.diameter;
  const int power = mass_power(lot);
  const Amount all = amount_of(drawn, v, l), asked_of_all{1, size_moment(lot, power)};
  for (auto at = diameters.begin(); at != diameters.end(); ++at) {
    if (std::find(diameters.begin(), at, *at) != at) continue;
    const double size = *at / lot.diameter;
    double asked = 0;
    for (std::size_t k = 0; k < diameters.size(); ++k) asked += diameters[k] == *at ? lot.sizes.fraction[k] : 0;
    shares.push_back(share_of(vessel, SeedSource::fill, l, amount_of(drawn, v, l, size), all,
                              Amount{asked, asked * portable_math::pow(size, power)}.over(asked_of_all)));
    shares.back().size = size * told_size(lot);
  }
}

/// Less than this many seeds on average, and most runs have none of them.
constexpr double none_on_average = 0.5;

bool is_missing(const LotShare& share, const std::vector<LotShare>& all) {
  if (share.asked_number <= 0) return false;
  if (share.source == SeedSource::fill) return share.seeds < 1;
  double rained = 0;
  for (const LotShare& other : all) {
    if (other.source == SeedSource::fill) return false;  // which has the lot, or is refused itself
    if (other.lot == share.lot) rained += other.seeds;
  }
  return rained < none_on_average;
}

std::string message_of(const LotShare& share, const SeedLot& lot) {
  const std::string asked = fmt::format("{:.3g} % of the seeds, {:.3g} % of their mass, were asked for",
                                        100 * share.asked_number, 100 * share.asked_mass);
  if (share.source == SeedSource::rain)
    return fmt::format("the rain brings {:.2g} seeds of {} while the run lasts: {}; let more fall", share.seeds,
                       lot.name, asked);
  return fmt::format("of {} seeds none is of {}: {}; from {:.0f} seeds on there is one", share.vessel->fill->count,
                     lot.name, asked, std::ceil(1 / share.asked_number));
}

}  // namespace

std::vector<int> lot_counts(const std::vector<SeedLot>& lots, int count) {
  std::vector<int> counts;
  std::vector<std::pair<double, std::size_t>> remainders;
  int placed = 0;
  for (std::size_t lot = 0; lot < lots.size(); ++lot) {
    const double wanted = lots[lot].number_fraction * count;
    counts.push_back(static_cast<int>(std::floor(wanted)));
    placed += counts.back();
    remainders.emplace_back(std::floor(wanted) - wanted, lot);
  }
  std::sort(remainders.begin(), remainders.end());
  for (std::size_t k = 0; placed < count; ++k, ++placed) ++counts[remainders[k % remainders.size()].second];
  return counts;
}

void count_drawn(std::vector<DrawnSeeds>& drawn, const std::vector<SeedLot>& lots, std::size_t vessel, std::size_t lot,
                 double size, double mass) {
  if (lots[lot].sizes.kind != SizeDistribution::Kind::table) size = 1;
  for (DrawnSeeds& one : drawn)
    if (one.vessel == vessel && one.lot == lot && one.size == size) {
      ++one.seeds, one.mass += mass;
      return;
    }
  drawn.push_back({vessel, lot, size, 1, mass});
}

std::vector<LotShare> lot_shares(const Scene& scene, const std::vector<DrawnSeeds>& drawn) {
  std::vector<LotShare> shares;
  const std::vector<SeedLot>& lots = scene.lots;
  if (lots.size() < 2) return shares;
  const std::vector<const Vessel*> vessels = vessels_of(scene);
  for (std::size_t v = 0; v < vessels.size(); ++v) {
    const Vessel& vessel = *vessels[v];
    if (vessel.fill) {
      const std::vector<int> counts = lot_counts(lots, vessel.fill->count);
      std::vector<Amount> amounts = mean_seeds(lots, {counts.begin(), counts.end()});
      for (std::size_t lot = 0; !drawn.empty() && lot < lots.size(); ++lot) amounts[lot] = amount_of(drawn, v, lot);
      add_shares(shares, vessel, SeedSource::fill, lots, amounts);
    }
    if (!vessel.rain) continue;
    std::vector<double> seeds;
    for (const SeedLot& lot : lots)
      seeds.push_back(lot.number_fraction * rained_seeds(*vessel.rain, scene.run.duration));
    add_shares(shares, vessel, SeedSource::rain, lots, mean_seeds(lots, seeds));
  }
  return shares;
}

std::vector<LotShare> size_shares(const Scene& scene, const std::vector<DrawnSeeds>& drawn) {
  std::vector<LotShare> shares;
  const std::vector<const Vessel*> vessels = vessels_of(scene);
  for (std::size_t v = 0; v < vessels.size(); ++v)
    for (std::size_t lot = 0; lot < scene.lots.size(); ++lot)
      if (amount_of(drawn, v, lot).seeds > 0 && scene.lots[lot].sizes.kind == SizeDistribution::Kind::table)
        add_sizes(shares, *vessels[v], v, scene.lots, lot, drawn);
  return shares;
}

double off_by(const LotShare& share) {
  return std::max(std::abs(share.of_number / share.asked_number - 1), std::abs(share.of_mass / share.asked_mass - 1));
}

std::vector<std::string> drawn_warnings(const Scene& scene, const std::vector<DrawnSeeds>& drawn) {
  std::vector<std::string> warnings;
  const auto warn = [&](const LotShare& share, const std::string& what) {
    warnings.push_back(fmt::format(
        "{}: {}: {:.3g} % by number instead of {:.3g} %, {:.3g} % by mass instead of {:.3g} %; sizes are drawn at "
        "random, and more seeds come nearer",
        key_of(*share.vessel, share.source), what, 100 * share.of_number, 100 * share.asked_number, 100 * share.of_mass,
        100 * share.asked_mass));
  };
  for (const LotShare& share : size_shares(scene, drawn)) {
    const double by_number = std::abs(share.of_number - share.asked_number),
                 by_mass = std::abs(share.of_mass - share.asked_mass);
    if (share.seeds > 0 && std::max(by_number, by_mass) <= far_off) continue;
    const std::string count = share.seeds > 0 ? fmt::format("{:.0f}", share.seeds) : "none";
    warn(share, fmt::format("{} of the seeds of {} {} of {:.3g} mm", count, scene.lots[share.lot].name,
                            share.seeds > 1 ? "are" : "is", 1e3 * *share.size));
  }
  const std::vector<LotShare> of_mean_seeds = lot_shares(scene), of_drawn = lot_shares(scene, drawn);
  for (std::size_t k = 0; k < of_drawn.size(); ++k)
    if (of_drawn[k].asked_number > 0 && off_by(of_mean_seeds[k]) <= far_off && off_by(of_drawn[k]) > far_off)
      warn(of_drawn[k], fmt::format("the {:.0f} seeds of {} are lighter or heavier than its mean seed",
                                    of_drawn[k].seeds, scene.lots[of_drawn[k].lot].name));
  return warnings;
}

std::optional<MissingLot> missing_lot(const Scene& scene) {
  const std::vector<LotShare> shares = lot_shares(scene);
  for (const LotShare& share : shares)
    if (is_missing(share, shares))
      return MissingLot{share.vessel, share.source, message_of(share, scene.lots[share.lot])};
  return std::nullopt;
}

std::string key_of(const Vessel& vessel, SeedSource source) {
  return vessel.name + (source == SeedSource::fill ? ".fill.count" : ".rain.rate");
}

}  // namespace vibrosow
