#include "report/mixture_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

std::string in_percent(double part) {
  return to_digits(100 * part, 4) + " %";
}

std::string heading(const LotShare& share) {
  const Vessel& vessel = *share.vessel;
  if (share.source == SeedSource::rain)
    return fmt::format("mixture of the {}'s rain, drawn at random: on average\n", vessel.name);
  return fmt::format("{} in the {}'s fill of {} seeds{}\n", share.size ? "sizes" : "mixture", vessel.name,
                     vessel.fill->count, is_kept(vessel) ? ", topped up at random as asked" : "");
}

std::string name_of(const LotShare& share, const Scene& scene) {
  const std::string& lot = scene.lots[share.lot].name;
  return share.size ? fmt::format("{} of {} mm", lot, to_digits(1e3 * *share.size, 4)) : lot;
}

bool share_a_heading(const LotShare& a, const LotShare& b) {
  return a.vessel == b.vessel && a.source == b.source && a.size.has_value() == b.size.has_value();
}

}  // namespace

std::string mixture_text(const Scene& scene, const std::vector<DrawnSeeds>& drawn) {
  std::vector<LotShare> shares = lot_shares(scene, drawn);
  std::ranges::copy(size_shares(scene, drawn), std::back_inserter(shares));
  std::size_t width = 0;
  for (const LotShare& share : shares) width = std::max(width, name_of(share, scene).size());
  std::string text;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const LotShare& share = shares[k];
    if (k == 0 || !share_a_heading(shares[k - 1], share)) text += heading(share);
    text += wrapped_beside(
        fmt::format("  {:<{}}  ", name_of(share, scene), width),
        fmt::format("{} seeds, {} by number (asked {}), {} by mass (asked {})", to_digits(share.seeds, 6),
                    in_percent(share.of_number), in_percent(share.asked_number), in_percent(share.of_mass),
                    in_percent(share.asked_mass)));
  }
  return text;
}

}  // namespace vibrosow
