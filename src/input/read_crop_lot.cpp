#include "input/read_crop_lot.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "input/document.hpp"
#include "input/override.hpp"
#include "input/read_contact.hpp"
#include "input/read_lot.hpp"
#include "input/source_files.hpp"
#include "input/table.hpp"

namespace vibrosow {

namespace {

/// A seeder that names the crop and nothing else.
Table seeder_of(const std::string& crop, const std::string& where) {
  const std::filesystem::path nowhere = std::filesystem::current_path() / where;
  const auto files = std::make_shared<SourceFiles>(std::map<std::string, std::string>{{nowhere.string(), ""}});
  return Table(Document::read(nowhere, {{"seeds.seed.crop", TomlValue{crop}, where}}, files));
}

}  // namespace

SeedLot read_crop_lot(const std::string& crop, const std::string& where) {
  Table seeds = seeder_of(crop, where).required_table("seeds").required_table("seed");
  SeedLot lot = read_lot(seeds, std::filesystem::path(crop).stem().string(), Space::three_dimensional);
  for (const char* material : {"shell_compression", "youngs_modulus", "poisson_ratio"}) seeds.skip(material);
  seeds.reject_unknown_keys();
  return lot;
}

std::optional<CropContact> read_crop_contact(const std::string& crop, const std::string& where) {
  Table seeder = seeder_of(crop, where);
  Table seeds = seeder.required_table("seeds"), seed = seeds.required_table("seed");
  std::vector<SeedLot> lots{read_lot(seed, "seed", Space::three_dimensional)};
  if (!crops_have_contacts(lots)) return std::nullopt;
  Table file(Document::read(lots.front().contact.file));
  return CropContact{read_contact(seeder.table_or_empty("contact"), seeds, lots), read_reference(file)};
}

}  // namespace vibrosow
