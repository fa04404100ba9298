#include "calibration/key_range.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "input/key_units.hpp"
#include "input/read_scene.hpp"
#include "input/wording.hpp"
#include "laws/law.hpp"
#include "portable_math/functions.hpp"
#include "scene/input_error.hpp"
#include "scene/trimmed.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

constexpr double stiffness_factor = 3;
constexpr double setting_share = 0.25;

bool is_stiffness(const std::string& key) {
  return key.ends_with(".shell_compression") || key.ends_with(".youngs_modulus");
}

/// In the unit of the key's column.
double end_of_range(const std::string& key, const std::string& text) {
  const Quantity quantity = split_quantity(text);
  if (const auto unit = column_unit(key)) return to_column_unit(key, in_si(quantity, unit->dimension));
  if (!quantity.unit.empty()) throw UnitError(fmt::format("{}: a plain number is expected", text));
  return quantity.number;
}

/// Looks at what keys of a seeder do.
class Trials {
 public:
  Trials(std::filesystem::path seeder, std::vector<Override> overrides, std::shared_ptr<SourceFiles> files)
      : seeder_(std::move(seeder)), overrides_(std::move(overrides)), files_(std::move(files)) {}

  Scene scene() const { return read_scene(seeder_, overrides_, files_); }

  Scene with(const std::string& key, double value) const {
    std::vector<Override> overrides = overrides_;
    overrides.push_back({key, value_of_column(key, "", value), key});
    return read_scene(seeder_, overrides, files_);
  }

  bool is_set(const std::string& key) const { return std::ranges::count(overrides_, key, &Override::key) > 0; }

 private:
  std::filesystem::path seeder_;
  std::vector<Override> overrides_;
  std::shared_ptr<SourceFiles> files_;
};

KeyRange parse_range(const std::string& option, const std::string& key_is_range) {
  const std::string where = fmt::format("{} {}", option, shortened(key_is_range));
  const auto equals = key_is_range.find('='), dots = key_is_range.find("..");
  if (equals == std::string::npos || dots == std::string::npos || dots < equals)
    throw InputError(fmt::format("{}: expected KEY=LOW..HIGH such as \"contact.friction=0.2..0.8\"", where));
  KeyRange range;
  range.key = trimmed(key_is_range.substr(0, equals));
  try {
    range.low = end_of_range(range.key, std::string(trimmed(key_is_range.substr(equals + 1, dots - equals - 1))));
    range.high = end_of_range(range.key, std::string(trimmed(key_is_range.substr(dots + 2))));
  } catch (const UnitError& error) {
    throw InputError(fmt::format("{}: {}", where, error.what()));
  }
  range.logarithmic = is_stiffness(range.key);
  if (!(range.low < range.high) || (range.logarithmic && range.low <= 0))
    throw InputError(fmt::format("{}: the range does not rise{}", where, range.logarithmic ? " from above 0" : ""));
  return range;
}

}  // namespace

double KeyRange::at(double part) const {
  return logarithmic ? low * portable_math::pow(high / low, part) : low + (high - low) * part;
}

double KeyRange::part_of(double value) const {
  return logarithmic ? portable_math::log(value / low) / portable_math::log(high / low) : (value - low) / (high - low);
}

Override KeyRange::override_at(double part) const {
  return {key, value_of_column(key, "", at(part)), fmt::format("the range of {}", key)};
}

KeyRange parse_fitted_key(const std::string& key_is_range) {
  KeyRange range = parse_range("--fit", key_is_range);
  if (!range.key.starts_with("contact."))
    throw InputError(fmt::format("--fit {}: only numbers of [contact] are fitted", shortened(key_is_range)));
  return range;
}

KeyRange parse_setting(const std::string& key_is_range) {
  return parse_range("--try", key_is_range);
}

std::vector<KeyRange> usual_fitted_keys(const std::filesystem::path& seeder, const std::vector<Override>& overrides,
                                        const std::shared_ptr<SourceFiles>& files) {
  const Trials trials(seeder, overrides, files);
  const Scene scene = trials.scene();
  const LawTraits& law = traits_of(scene.contact.law);
  std::vector<KeyRange> keys;
  const auto add = [&](const std::string& key, double low, double high) {
    if (!trials.is_set(key)) keys.push_back({key, low, high, is_stiffness(key)});
  };
  add("contact.friction", 0.1, 0.9);
  if (trials.with("contact.friction", 0.123).contact.wall == scene.contact.wall) add("contact.wall.friction", 0.1, 0.9);
  if (law.damping == LawDamping::restitution) {
    add("contact.restitution", 0.2, 0.9);
    if (trials.with("contact.restitution", 0.123).contact.wall == scene.contact.wall)
      add("contact.wall.restitution", 0.2, 0.9);
  }
  if (scene.contact.rolling != Rolling::none) add("contact.rolling_friction", 0, 0.3);
  if (scene.numerics.accuracy != AccuracyLevel::as_written) return keys;
  const std::string key(law.stiffness_key());
  const double own = law.material == LawMaterial::shell ? scene.contact.shell_compression
                                                        : to_column_unit(key, scene.contact.youngs_modulus);
  if (own > 0) add(key, own / stiffness_factor, own * stiffness_factor);
  return keys;
}

std::vector<KeyRange> usual_settings(const Scene& scene) {
  const auto* motion = scene.tray.motion ? std::get_if<HarmonicMotion>(&*scene.tray.motion) : nullptr;
  if (motion == nullptr) return {};
  std::vector<KeyRange> settings;
  for (const auto& [key, own] :
       {std::pair{"tray.motion.frequency", motion->frequency}, std::pair{"tray.motion.amplitude", motion->amplitude}}) {
    const double value = to_column_unit(key, own);
    settings.push_back({key, (1 - setting_share) * value, (1 + setting_share) * value});
  }
  return settings;
}

}  // namespace vibrosow
