#include "report/mixture_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/terminal_text.hpp"
#include "scene/mixture.hpp"

namespace vibrosow {
namespace {

std::string in_percent(double part) {
  return to_digits(100 * part, 4) + " %";
}

std::string heading(const LotShare& share) {
  const Vessel& vessel = *share.vessel;
  if (share.source == SeedSource::rain)
    return fmt::format("mixture of the {}'s rain, drawn at random: on average\n", vessel.name);
  return fmt::format("mixture in the {}'s fill of {} seeds{}\n", vessel.name, vessel.fill->count,
                     is_kept(vessel) ? ", topped up at random as asked" : "");
}

}  // namespace

std::string mixture_text(const Scene& scene) {
  std::size_t width = 0;
  for (const SeedLot& lot : scene.lots) width = std::max(width, lot.name.size());
  std::string text;
  for (const LotShare& share : lot_shares(scene)) {
    if (share.lot == 0) text += heading(share);
    text += wrapped_beside(
        fmt::format("  {:<{}}  ", scene.lots[share.lot].name, width),
        fmt::format("{} seeds, {} by number (asked {}), {} by mass (asked {})", to_digits(share.seeds, 6),
                    in_percent(share.of_number), in_percent(share.asked_number), in_percent(share.of_mass),
                    in_percent(share.asked_mass)));
  }
  return text;
}

}  // namespace vibrosow
