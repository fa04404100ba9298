#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agronomy/drill.hpp"
#include "input/measured.hpp"
#include "input/override.hpp"
#include "input/source_files.hpp"
#include "scene/scene.hpp"
#include "study/replicates.hpp"

namespace vibrosow {

/// One combination of a study: a named design at one point of the grid.
struct Layout {
  int number = 0;    // 1.., in the order of the study
  std::string name;  // of its [[layout]]; empty without
  std::map<std::string, std::string>
      values;                        // of Study::keys, in the unit of the key's column, as printed; "unset": taken out
  std::vector<Override> overrides;   // what makes it out of the base
  std::optional<std::size_t> scene;  // index in Study::scenes; none: it cannot be built
  std::string invalid;               // why it cannot
  std::optional<Drill> drill;        // what its outflow is to sow, where the seeder says it
};

/// How simulated outflow is made comparable with measured.
enum class MeasuredScale {
  none,   // as it is
  depth,  // times tray.depth over the diameter of the plane slice
  free,   // one factor for the whole table, fitted
};

/// A measured series that was taken under the conditions of a layout.
struct MeasuredMatch {
  std::size_t layout;  // index in Study::layouts
  std::size_t series;  // index in MeasuredTable::series
};

struct MeasuredPart {
  std::filesystem::path file;
  MeasuredScale scale = MeasuredScale::none;
  std::optional<double> time_zero;  // s of the run, at which a curve's time is zero; none: when the first hole opens
  MeasuredTable table;
  std::vector<MeasuredMatch> matches;  // by layout, then series
};

/// How many of a table's series were measured under the conditions of a layout.
std::size_t compared_series(const MeasuredPart& part);

struct Study {
  std::string title;
  std::filesystem::path base;  // of the seeder file
  Replicates replicates;
  std::vector<std::string> keys;    // that tell the layouts apart, in the order of the study
  std::vector<std::string> varied;  // of these those of [vary], which no layout's name tells
  std::vector<Layout> layouts;
  std::vector<Scene> scenes;  // each different scene once, in the order of the layouts
  std::optional<MeasuredPart> measured;
};

/// Reads a study and every scene in it. `overrides` whose first word is a key of a study (vary.tray.holes.count) change
/// the study; any other changes each of its seeders. A combination that `read_scene` refuses, or whose step is too
/// long, is a layout with the reason in `invalid`. Throws InputError for anything wrong in the study itself, when no
/// layout is valid, when a key is both varied and set, or when no measured row fits a layout.
/// Every file is read once, through `files`.
Study read_study(const std::filesystem::path& file, const std::vector<Override>& overrides = {},
                 const std::shared_ptr<SourceFiles>& files = std::make_shared<SourceFiles>());

/// The keys of a study's [vary], how many values each has (VariedSpace), and how many `proposals` it asks for.
struct StudySpace {
  std::vector<std::string> keys;
  std::vector<std::size_t> values;
  std::optional<std::size_t> proposals;
};

/// Throws InputError as `read_study` does, and where there is no [vary], or there are named designs beside it.
StudySpace read_study_space(const std::filesystem::path& file, const std::vector<Override>& overrides,
                            const std::shared_ptr<SourceFiles>& files);

/// The study whose layouts are at these points of its space, in place of its grid or proposals. Other than of
/// `read_study`, no layout need be valid.
Study read_study_at(const std::filesystem::path& file, const std::vector<Override>& overrides,
                    const std::shared_ptr<SourceFiles>& files, const std::vector<std::vector<double>>& points);

/// What `scene_warnings` says of the scenes of a study, each sentence once, with the layouts that it is about.
std::vector<std::string> study_warnings(const Study& study);

}  // namespace vibrosow
