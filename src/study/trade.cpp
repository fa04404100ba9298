#include "study/trade.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>
#include <variant>

namespace vibrosow {
namespace {

/// A key that is followed, and its value in a scene, in SI; none where the scene has none.
struct Followed {
  std::string_view key;
  std::optional<double> (*of)(const Scene&);
  bool is_slope = false;
};

std::optional<double> frequency_of(const Scene& scene) {
  if (!scene.tray.motion) return std::nullopt;
  if (const auto* harmonic = std::get_if<HarmonicMotion>(&*scene.tray.motion)) return harmonic->frequency;
  if (const auto* rocking = std::get_if<RockingMotion>(&*scene.tray.motion)) return rocking->frequency;
  return std::nullopt;
}

std::optional<double> amplitude_of(const Scene& scene) {
  const auto* harmonic = scene.tray.motion ? std::get_if<HarmonicMotion>(&*scene.tray.motion) : nullptr;
  return harmonic ? std::optional(harmonic->amplitude) : std::nullopt;
}

constexpr std::array followed = {
    Followed{"tray.motion.frequency", frequency_of}, Followed{"tray.motion.amplitude", amplitude_of},
    Followed{"tray.tilt", [](const Scene& scene) { return std::optional(scene.tray.tilt); }, true}};

/// What tells a layout apart but for one key.
using Others = std::pair<std::string, std::map<std::string, std::string>>;

Others others_of(const Layout& layout, std::string_view key) {
  Others others{layout.name, layout.values};
  others.second.erase(std::string(key));
  return others;
}

/// Those that differ in the key alone, of seeders with a drill.
std::vector<std::vector<std::size_t>> lines_along(const StudyResult& result, const Followed& along) {
  std::vector<std::vector<std::size_t>> lines;
  std::map<Others, std::size_t> known;
  for (std::size_t i = 0; i < result.layouts.size(); ++i) {
    const Layout& layout = result.study.layouts[i];
    if (!layout.drill || !along.of(result.study.scenes[*layout.scene])) continue;
    const auto [place, is_new] = known.try_emplace(others_of(layout, along.key), lines.size());
    if (is_new) lines.emplace_back();
    lines[place->second].push_back(i);
  }
  std::erase_if(lines, [](const auto& line) { return line.size() < 2; });
  return lines;
}

/// Mean rate of a layout whose runs all went to their end as they should; none of any other.
std::optional<MeanWithInterval> rate_of(const LayoutResult& layout) {
  return is_compared(layout.status) ? layout.metrics["rate_g_per_s"] : std::nullopt;
}

/// Whether something serious speaks against single runs, so that their rate may not be the tray's.
bool has_doubted_runs(const LayoutResult& layout) {
  return std::ranges::any_of(layout.doubts, [](const CountedDoubt& doubt) {
    return doubt.runs > 0 && words_of(doubt.kind).severity == Severity::serious;
  });
}

bool has_sound_rate(const LayoutResult& layout) {
  return layout.stopped_flowing == 0 && rate_of(layout) && !has_doubted_runs(layout);
}

/// Whether nothing is known of it as a setting; of what stopped flowing it is known that it will not do.
bool is_unsound(const LayoutResult& layout) {
  return layout.stopped_flowing == 0 && !has_sound_rate(layout);
}

Setting setting_of(const LayoutResult& layout, const Drill& drill, double value) {
  const std::optional<MeanWithInterval> rate = rate_of(layout);
  if (!rate) return {.value = value, .flowed = false};
  Setting setting{.value = value, .rate = rate->mean, .flowed = has_sound_rate(layout)};
  if (drill.streams() < 2) return setting;  // nothing to differ from
  const RowMeans& all = layout.rows.back();
  const auto& low = all["unevenness_cv_percent_low"];
  const auto& high = all["unevenness_cv_percent_high"];
  setting.cv_low = low ? low->mean : 0;
  setting.cv_high = high ? std::optional(high->mean) : std::nullopt;
  return setting;
}

TradeLine line_of(const StudyResult& result, const Followed& along, const std::vector<std::size_t>& layouts) {
  TradeLine line{.key = std::string(along.key), .layouts = layouts, .is_slope = along.is_slope};
  const auto value_of = [&](std::size_t i) { return *along.of(result.study.scenes[*result.study.layouts[i].scene]); };
  if (along.is_slope) {
    std::vector<TiltedRate> rates;
    for (const std::size_t i : layouts) {
      if (!has_sound_rate(result.layouts[i])) continue;
      const MeanWithInterval rate = *rate_of(result.layouts[i]);
      rates.push_back({value_of(i), rate.mean, rate.half_width_95});
    }
    line.unsound = layouts.size() - rates.size();
    line.slope = slope_sensitivity(rates);
    return line;
  }
  std::vector<Setting> settings;
  for (const std::size_t i : layouts) {
    settings.push_back(setting_of(result.layouts[i], *result.study.layouts[i].drill, value_of(i)));
    line.unsound += is_unsound(result.layouts[i]) ? 1 : 0;
  }
  const double limit = result.study.layouts[layouts.front()].drill->cv_limit;
  line.shown = turn_down(settings, limit, Proof::shown);
  line.not_excluded = turn_down(settings, limit, Proof::not_excluded);
  return line;
}

}  // namespace

std::vector<TradeLine> trade_lines(const StudyResult& result) {
  std::vector<TradeLine> found;
  for (const std::string& key : result.study.keys) {
    const auto along = std::ranges::find(followed, key, &Followed::key);
    if (along == followed.end()) continue;
    for (const std::vector<std::size_t>& layouts : lines_along(result, *along))
      found.push_back(line_of(result, *along, layouts));
  }
  return found;
}

}  // namespace vibrosow
