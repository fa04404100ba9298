#include "input/read_crop.hpp"

#include "files/whole_file.hpp"
#include "input/presets.hpp"

namespace vibrosow {
namespace {

constexpr double smallest = 5e-5, largest = 1;  // m

std::map<std::string, std::string> read_sources(Table& crop) {
  std::map<std::string, std::string> sources;
  auto table = crop.table("sources");
  if (!table) return sources;
  for (const std::string& key : table->keys()) sources[key] = table->required_text(key);
  return sources;
}

}  // namespace

Crop read_crop(const std::filesystem::path& file) {
  Table table(Document::read(file));
  Crop crop;
  crop.name = file.stem().string();
  crop.title = table.text("title").value_or(crop.name);
  for (const char* key : {"shell_compression", "youngs_modulus", "poisson_ratio"}) table.skip(key);
  const SeedLot lot = read_lot(table, crop.name, Space::two_dimensional);
  crop.shape = table.text("shape").value_or("ball");
  const auto size = [&](const char* key, double otherwise) {
    return table.has(key) ? table.required_quantity(key, Dimension::length, smallest, largest) : otherwise;
  };
  crop.length = size("length", lot.diameter);
  crop.width = size("width", crop.length);
  crop.thickness = size("thickness", crop.width);
  crop.mass = lot.mass;
  crop.reference = read_reference(table);
  crop.bulk = read_bulk_properties(table);
  crop.contact = lot.contact;
  crop.sources = read_sources(table);
  table.reject_unknown_keys();
  return crop;
}

Crop find_crop(const std::string& name_or_path) {
  return read_crop(has_extension(name_or_path, ".toml") ? std::filesystem::path(name_or_path)
                                                        : shipped_preset(name_or_path, "crops"));
}

}  // namespace vibrosow
