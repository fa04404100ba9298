#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "input/override.hpp"
#include "input/source_files.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// A number of a seeder that is fitted, or set, and the range in which it lies. Of one that is fitted every value is as
/// likely beforehand as any other, of its logarithm where it is a stiffness.
struct KeyRange {
  std::string key;           // "contact.friction"
  double low = 0, high = 0;  // in the unit of the key's column
  bool logarithmic = false;

  double at(double part) const;        // the value at 0..1 of the range
  double part_of(double value) const;  // the other way round
  Override override_at(double part) const;
};

/// What --fit says: "contact.friction=0.2..0.8", with units where the key has one: "contact.youngs_modulus=5 MPa..50
/// MPa". Throws InputError for another form, a key that is not of [contact], or a range that does not rise.
KeyRange parse_fitted_key(const std::string& key_is_range);

/// What --try says: the same of any key.
KeyRange parse_setting(const std::string& key_is_range);

/// What is fitted unless a user says otherwise: friction 0.1..0.9 and restitution 0.2..0.9 of seeds, and of walls where
/// theirs are their own; rolling friction 0..0.3 where it is in the scene; the law's stiffness, three times less to
/// three times more, where no accuracy level sets it. Keys that `overrides` set are left out.
std::vector<KeyRange> usual_fitted_keys(const std::filesystem::path& seeder, const std::vector<Override>& overrides,
                                        const std::shared_ptr<SourceFiles>& files);

/// What is set at the bench unless a user says otherwise: frequency and amplitude of a tray's harmonic motion, by a
/// quarter less to a quarter more. None for another tray.
std::vector<KeyRange> usual_settings(const Scene& scene);

}  // namespace vibrosow
