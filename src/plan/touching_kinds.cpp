#include "plan/touching_kinds.hpp"

#include "grains/clump_discs.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {

std::vector<GrainKind> touching_kinds(const std::vector<SeedLot>& lots, const std::vector<GrainKind>& kinds,
                                      const LawTraits& law) {
  std::vector<GrainKind> touching;
  for (std::size_t l = 0; l < lots.size(); ++l) {
    const SeedLot& lot = lots[l];
    const bool scatter = lot.sizes.kind != SizeDistribution::Kind::single;
    std::vector<double> sizes{1};
    if (scatter) sizes = {1, least_size(lot), most_size(lot)};
    for (const double size : sizes) {
      const GrainKind whole = sized_kind(lot, law, kinds[l], size);
      if (lot.discs.empty()) touching.push_back(whole);
      for (const ClumpDisc& disc : lot.discs) touching.push_back(kind_of_disc(whole, disc, size, law));
    }
  }
  return touching;
}

}  // namespace vibrosow
