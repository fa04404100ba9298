#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/help_text.hpp"
#include "input/document.hpp"
#include "input/presets.hpp"
#include "input/read_crop.hpp"
#include "input/read_scene.hpp"
#include "input/table.hpp"
#include "report/terminal_text.hpp"
#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

void print_entry(const std::filesystem::path& file, const std::string& text) {
  print_text(wrapped_beside(fmt::format("  {:<24} ", file.stem().string()), text));
}

std::string size_text(const Crop& crop) {
  if (crop.length == crop.thickness) return fmt::format("{:.3g} mm", crop.length * 1e3);
  return fmt::format("{:.3g} x {:.3g} x {:.3g} mm", crop.length * 1e3, crop.width * 1e3, crop.thickness * 1e3);
}

std::string crop_text(const Crop& crop) {
  std::string text =
      fmt::format("{}: {} of {}, {:.4g} g a thousand", crop.title, crop.shape, size_text(crop), crop.mass * 1e6);
  if (crop.bulk.bulk_density) text += fmt::format(", {:.3g} kg/m3 poured", *crop.bulk.bulk_density);
  if (crop.bulk.angle_of_repose) text += fmt::format(", repose {:.3g} degree", *crop.bulk.angle_of_repose / degree);
  if (crop.reference.angle_of_repose)
    text += fmt::format(" ({:.3g} to {:.3g} over sources)", crop.reference.angle_of_repose->front() / degree,
                        crop.reference.angle_of_repose->back() / degree);
  return text;
}

void print_crops(const std::filesystem::path& data) {
  print("crops (seeds.NAME.crop = \"...\"), in {}\n", (data / "models/crops").string());
  for (const auto& file : toml_files(data / "models/crops")) print_entry(file, crop_text(read_crop(file)));
}

void print_titles(const std::filesystem::path& directory) {
  for (const auto& file : toml_files(directory))
    print_entry(file, Table(Document::read(file)).text("title").value_or(""));
}

void print_contacts(const std::filesystem::path& data) {
  print("contact models (contact.model = \"...\"), in {}\n", (data / "models/contacts").string());
  print_titles(data / "models/contacts");
}

void print_seeders(const std::filesystem::path& data) {
  constexpr std::pair<const char*, const char*> rooms[] = {
      {"seeders", "seeders to start from"},
      {"seeders/papers", "seeders of published papers"},
      {"seeders/verification", "scenes that verify the program"},
  };
  for (const auto& [room, meaning] : rooms) {
    print("{}, in {}\n", meaning, (data / room).string());
    print_titles(data / room);
    print("their studies, in {}\n", (data / room / "studies").string());
    print_titles(data / room / "studies");
  }
}

}  // namespace

void add_presets_command(CLI::App& app, int& exit_code) {
  auto kind = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("presets", "list the shipped crops, contact models and seeders");
  command->add_option("KIND", *kind, "crops, contacts or seeders; default all")
      ->check(CLI::IsMember({"crops", "contacts", "seeders"}));
  add_examples(*command, {"vibrosow presets", "vibrosow presets crops", "vibrosow presets seeders"});
  command->callback([kind, &exit_code] {
    const std::filesystem::path data = data_directory();
    const auto wanted = [&](std::string_view one) { return kind->empty() || *kind == one; };
    if (wanted("crops")) print_crops(data);
    if (wanted("contacts")) print_contacts(data);
    if (wanted("seeders")) print_seeders(data);
    exit_code = exit_done;
  });
}

}  // namespace vibrosow
