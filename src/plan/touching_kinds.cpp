#include "plan/touching_kinds.hpp"

#include "grains/clump_discs.hpp"

namespace vibrosow {

std::vector<GrainKind> touching_kinds(const std::vector<SeedLot>& lots, const std::vector<SeedSizes>& sizes,
                                      const std::vector<GrainKind>& kinds, const LawTraits& law) {
  std::vector<GrainKind> touching;
  for (std::size_t l = 0; l < lots.size(); ++l) {
    const SeedLot& lot = lots[l];
    std::vector<double> looked_at{1};
    if (lot.sizes.kind != SizeDistribution::Kind::single) looked_at = {1, sizes[l].least, sizes[l].most};
    for (const double size : looked_at) {
      const GrainKind whole = sized_kind(lot, law, kinds[l], size);
      if (lot.discs.empty()) touching.push_back(whole);
      for (const ClumpDisc& disc : lot.discs) touching.push_back(kind_of_disc(whole, disc, size, law));
    }
  }
  return touching;
}

}  // namespace vibrosow
