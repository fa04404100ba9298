#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "input/source_files.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Decisions by chance, each with a name. Those named in `plain` fall on 0, the plainest, as the others do by chance:
/// taking one back leaves the rest as they were, so that a scene that fails can be made plainer decision by decision.
class Draw {
 public:
  Draw(std::uint64_t seed, std::set<std::string> plain) : seed_(seed), plain_(std::move(plain)) {}

  /// 0 .. n - 1.
  int below(const std::string& name, int n);
  bool one_in(const std::string& name, int n) { return below(name, n) == n - 1; }
  /// One of 21 even steps; `from` is the plainest.
  double number(const std::string& name, double from, double to) { return from + (to - from) * below(name, 21) / 20; }

  /// The decisions that did not fall on 0, in the order in which they fell.
  const std::vector<std::string>& taken() const { return taken_; }

 private:
  std::uint64_t seed_;
  std::set<std::string> plain_;
  std::vector<std::string> taken_;
};

/// A seeder drawn over all features at once: small, short, and of soft seeds, so that it runs in some milliseconds.
/// Some of them contradict themselves, or do not fit, as those of users do.
class DrawnScene {
 public:
  using Key = std::pair<std::string, std::string>;  // "tray.length", "\"8 cm\""

  explicit DrawnScene(std::uint64_t seed, std::set<std::string> plain = {});

  std::uint64_t seed() const { return seed_; }
  const std::vector<Key>& keys() const { return keys_; }
  std::string toml() const;
  /// The same to be read by people, with the files that it names.
  std::string told() const;
  /// The seeder and what it names, by path, in a folder that is on no disk; and that folder with another seeder in it.
  std::map<std::string, std::string> texts() const;
  std::shared_ptr<SourceFiles> files_with(const std::string& text) const;
  static const char* path() { return "/drawn/scene.toml"; }

  /// Through the reader that every command uses. Throws InputError.
  Scene read() const;

  /// The same with some decisions taken back: many at once first.
  std::vector<DrawnScene> plainer() const;

 private:
  std::uint64_t seed_;
  std::set<std::string> plain_;
  std::vector<std::string> taken_;
  std::vector<Key> keys_;
  std::map<std::string, std::string> files_;  // tables of motion and contact models, by path
};

}  // namespace vibrosow
