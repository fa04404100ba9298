#include "scene/mixture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

double rained_seeds(const Rain& rain, double duration) {
  return rain.rate * std::max(0.0, std::min(rain.stop, duration) - rain.start);
}

/// The shares of one source, from its seeds of each lot.
void add_shares(std::vector<LotShare>& shares, const Vessel& vessel, SeedSource source,
                const std::vector<SeedLot>& lots, const std::vector<double>& seeds) {
  double number = 0, mass = 0, asked_mass = 0;
  for (std::size_t lot = 0; lot < lots.size(); ++lot) {
    number += seeds[lot];
    mass += seeds[lot] * mean_mass(lots[lot]);
    asked_mass += lots[lot].number_fraction * mean_mass(lots[lot]);
  }
  for (std::size_t lot = 0; lot < lots.size(); ++lot) {
    const double of_one = mean_mass(lots[lot]), asked = lots[lot].number_fraction;
    shares.push_back({&vessel, source, lot, seeds[lot], number > 0 ? seeds[lot] / number : 0,
                      mass > 0 ? seeds[lot] * of_one / mass : 0, asked, asked * of_one / asked_mass});
  }
}

void add_shares(std::vector<LotShare>& shares, const Scene& scene, const Vessel& vessel) {
  if (vessel.fill) {
    const std::vector<int> counts = lot_counts(scene.lots, vessel.fill->count);
    add_shares(shares, vessel, SeedSource::fill, scene.lots, {counts.begin(), counts.end()});
  }
  if (!vessel.rain) return;
  std::vector<double> seeds;
  for (const SeedLot& lot : scene.lots)
    seeds.push_back(lot.number_fraction * rained_seeds(*vessel.rain, scene.run.duration));
  add_shares(shares, vessel, SeedSource::rain, scene.lots, seeds);
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

std::vector<LotShare> lot_shares(const Scene& scene) {
  std::vector<LotShare> shares;
  if (scene.lots.size() < 2) return shares;
  add_shares(shares, scene, scene.tray);
  if (scene.hopper) add_shares(shares, scene, *scene.hopper);
  return shares;
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
