#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "files/whole_file.hpp"
#include "input/input_file.hpp"
#include "input/presets.hpp"
#include "input/read_crop.hpp"
#include "input/read_scene.hpp"
#include "report/output_folder.hpp"
#include "report/studio_page.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

StudioSeeder studio_seeder(const fs::path& file) {
  return {file.stem().string(), text_of_wanted_file(file), read_scene(file)};
}

/// Each with its own contact model, in the first shipped seeder's place.
std::vector<StudioCrop> studio_crops(const fs::path& data, const fs::path& seeder) {
  std::vector<StudioCrop> crops;
  for (const fs::path& file : toml_files(data / "models/crops")) {
    const Crop crop = read_crop(file);
    const std::string &name = crop.name, &model = crop.contact.name;
    const Scene scene = read_scene(seeder, {parse_override(fmt::format("seeds={{{0}={{crop=\"{0}\"}}}}", name)),
                                            parse_override(fmt::format("contact={{model=\"{}\"}}", model))});
    crops.push_back({name, crop.title, model, scene});
  }
  return crops;
}

StudioPage studio_of(const std::string& asked) {
  const fs::path data = data_directory();
  StudioPage page;
  page.crops = studio_crops(data, data / "seeders/wheat-tray.toml");
  for (const char* room : {"seeders", "seeders/papers"})
    for (const fs::path& file : toml_files(data / room)) page.seeders.push_back(studio_seeder(file));
  page.opened = "wheat-tray";
  if (asked.empty()) return page;
  const fs::path file = input_file(asked, FileKind::seeder).path;
  StudioSeeder wanted = studio_seeder(file);
  page.opened = wanted.name;
  const auto shipped = std::ranges::find(page.seeders, wanted.name, &StudioSeeder::name);
  wanted.own = shipped == page.seeders.end() || wanted.text != shipped->text;
  if (shipped == page.seeders.end())
    page.seeders.insert(page.seeders.begin(), std::move(wanted));
  else
    *shipped = std::move(wanted);
  return page;
}

/// Shows a file in the desktop's browser. False where there is no desktop.
bool open_in_browser(const fs::path& file) {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return false;
  std::string opener = "xdg-open", path = fs::absolute(file).string();
  const std::array<char*, 3> arguments = {opener.data(), path.data(), nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, opener.c_str(), nullptr, nullptr, arguments.data(), environ) != 0) return false;
  int status = 0;
  return waitpid(child, &status, 0) == child && status == 0;
}

int run_studio(const std::string& asked, const std::string& out) {
  const StudioPage page = studio_of(asked);
  const std::optional<std::string> empty_page = shipped_page("studio.html");
  if (!empty_page) throw InputError("the studio's page is not built yet; this makes it: scripts/web --build-only");
  const std::string html = studio_page(*empty_page, page);
  const OutputFolder folder(out, "studio", {studio_page_text().name});
  folder.write({{studio_page_text().name, html}});
  const fs::path file = folder.path() / studio_page_text().name;
  print("studio: {}\n", file.string());
  if (!open_in_browser(file)) print("open it in a browser\n");
  return exit_done;
}

}  // namespace

void add_studio_command(CLI::App& app, int& exit_code) {
  auto asked = std::make_shared<std::string>();
  auto out = std::make_shared<std::string>("out/studio");
  CLI::App* command = app.add_subcommand(
      "studio", "write a page that simulates: move holes, set frequency and amplitude, watch it sow");
  command->add_option("SEEDER", *asked, "seeder to open, a file or the name of a shipped one; default wheat-tray");
  command->add_option("--out", *out, "directory for the page")->type_name("DIR")->capture_default_str();
  add_examples(*command,
               {"vibrosow studio", "vibrosow studio pea-tray", "vibrosow studio my-wheat-tray.toml --out look-at-it"});
  command->callback([asked, out, &exit_code] { exit_code = run_studio(*asked, *out); });
}

}  // namespace vibrosow
