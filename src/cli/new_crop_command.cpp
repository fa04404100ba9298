#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "calibration/new_crop.hpp"
#include "calibration/refine_crop.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "cli/make_runs.hpp"
#include "files/atomic_file.hpp"
#include "files/whole_file.hpp"
#include "report/crop_files.hpp"
#include "report/terminal_text.hpp"
#include "scene/input_error.hpp"
#include "scene/si_units.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

struct NewCropOptions {
  std::string crop, tkw, length, width, thickness, bulk_density, repose, moisture, out = ".";
  int refine = 0;  // runs; 0: none
  int jobs = 1;
};

std::optional<double> if_given(const char* option, const std::string& text, Dimension dimension, double least,
                               double most, std::string_view example = {}) {
  if (text.empty()) return std::nullopt;
  return quantity_option(option, text, dimension, least, most, example);
}

NewCrop crop_of(const NewCropOptions& options) {
  const bool plain = std::ranges::all_of(options.crop, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
  if (options.crop.empty() || options.crop.size() > 60 || !plain)
    throw InputError("--crop: the name of a file, up to 60 letters, digits, - and _");
  constexpr double smallest = 5e-5, largest = 1;  // m
  NewCrop crop;
  crop.name = options.crop;
  crop.mass = quantity_option("--tkw", options.tkw, Dimension::seed_mass, 1e-6, 1e3, "45 g") / 1e3;
  crop.length = quantity_option("--length", options.length, Dimension::length, smallest, largest, "6 mm");
  crop.width = if_given("--width", options.width, Dimension::length, smallest, largest, "3 mm").value_or(crop.length);
  crop.thickness =
      if_given("--thickness", options.thickness, Dimension::length, smallest, largest, "2 mm").value_or(crop.width);
  crop.thickness_assumed = options.thickness.empty();
  crop.bulk_density = if_given("--bulk-density", options.bulk_density, Dimension::bulk_density, 1, 3e4);
  crop.angle_of_repose = if_given("--repose", options.repose, Dimension::angle, 1 * degree, 89 * degree, "25 degree");
  crop.moisture = if_given("--moisture", options.moisture, Dimension::fraction, 0, 1, "12 %");
  return crop;
}

struct NewFile {
  fs::path path;
  std::string content;
};

/// A file that someone may have edited is never replaced.
void refuse_to_overwrite(const std::vector<NewFile>& files) {
  for (const NewFile& file : files)
    if (fs::exists(file.path) && text_of_file(file.path) != file.content)
      throw InputError(fmt::format("{}: is there already and says something else; give another --crop or --out",
                                   file.path.string()));
}

void write(const std::vector<NewFile>& files) {
  for (const NewFile& file : files) {
    std::error_code failed;
    fs::create_directories(file.path.parent_path(), failed);
    if (failed) cannot_write(file.path, failed.value());
    write_file_atomically(file.path, file.content);
  }
}

std::vector<NewFile> files_of(const NewCrop& crop, const CropEstimate& estimate, const fs::path& folder) {
  return {{folder / (crop.name + ".toml"), crop_toml(crop, estimate)},
          {folder / (crop.name + "-contact.toml"), contact_toml(crop, estimate)}};
}

/// Makes the runs, or goes on with them; false where that is interrupted.
bool refine(const NewCropOptions& options, const NewCrop& crop, const CropEstimate& estimate, ShippedAtlas& atlas) {
  const std::vector<RefiningRun> refining = refining_runs(crop, estimate, atlas, options.refine);
  std::vector<WantedRun> wanted;
  for (const RefiningRun& run : refining)
    wanted.push_back({&run.scene, run.random_seed, name_of_run(run.scene, run.random_seed)});
  StudyRuns runs(PathInFolder(fs::path(options.out)) / (crop.name + "-runs"));
  const BatchResult made = make_runs(runs, wanted, BatchFlags{}, options.jobs, false);
  if (made.batch.interrupted > 0) return false;
  atlas.to_space = refined_to_space(atlas.atlas, refining, runs.kept());
  return true;
}

int make_crop(const NewCropOptions& options) {
  const NewCrop crop = crop_of(options);
  ShippedAtlas atlas = shipped_atlas();
  CropEstimate estimated = estimate(crop, atlas);
  refuse_to_overwrite(files_of(crop, estimated, options.out));
  if (options.refine > 0) {
    if (!refine(options, crop, estimated, atlas)) return exit_interrupted;
    estimated = estimate(crop, atlas);
  }
  const std::vector<NewFile> files = files_of(crop, estimated, options.out);
  write(files);
  print_text(crop_table(crop, estimated, atlas));
  print("{}\n{}\n", files[0].path.string(), files[1].path.string());
  print_text(wrapped(fmt::format(
      "in a seeder beside them: seeds.NAME.crop = \"{}.toml\"; it names its contact model, so no [contact] is needed",
      crop.name)));
  return exit_done;
}

}  // namespace

void add_new_crop_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<NewCropOptions>();
  CLI::App* command =
      app.add_subcommand("new-crop", "make a crop and its contact model from what you weigh and measure");
  const auto add = [command](const char* name, std::string& value, const char* help) {
    return command->add_option(name, value, help)->type_name("QUANTITY");
  };
  command->add_option("--crop", options->crop, "name of the crop and of its files")->required()->type_name("NAME");
  add("--tkw", options->tkw, "weight of a thousand seeds, \"4.5 g\"")->required();
  add("--length", options->length, "of a seed, \"2.1 mm\"")->required();
  add("--width", options->width, "default: the length, a ball");
  add("--thickness", options->thickness, "default: the width");
  add("--bulk-density", options->bulk_density, "of the poured seed, \"680 kg/m3\"");
  add("--repose", options->repose, "angle of the heap that stays when a box drains, \"25 degree\"");
  add("--moisture", options->moisture, "share of the wet mass, \"9 %\"; kept for the record");
  command->add_option("--out", options->out, "folder for its two files; default: this one")->type_name("DIR");
  command
      ->add_option("--refine", options->refine,
                   "runs in 3D of its own shape that narrow the band, some minutes each; default: none")
      ->type_name("RUNS")
      ->check(CLI::Range(3, 1000));
  command->add_option("--jobs", options->jobs, "how many of those runs in parallel; default 1")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  add_examples(*command, {"vibrosow new-crop --crop mine --tkw 4.5g --length 2.1mm",
                          "vibrosow new-crop --crop long --tkw 40g --length 6mm --width 3.2mm",
                          "vibrosow new-crop --crop oil --tkw 5g --length 2mm --bulk-density 680kg/m3"});
  command->callback([options, &exit_code] { exit_code = make_crop(*options); });
}

}  // namespace vibrosow
