#include "input/read_crop_lot.hpp"

#include <filesystem>
#include <map>
#include <memory>

#include "input/document.hpp"
#include "input/override.hpp"
#include "input/read_lot.hpp"
#include "input/source_files.hpp"
#include "input/table.hpp"

namespace vibrosow {

SeedLot read_crop_lot(const std::string& crop, const std::string& where) {
  const std::filesystem::path nowhere = std::filesystem::current_path() / where;
  const auto files = std::make_shared<SourceFiles>(std::map<std::string, std::string>{{nowhere.string(), ""}});
  Table seeds(Document::read(nowhere, {{"crop", TomlValue{crop}, where}}, files));
  const std::string name = std::filesystem::path(crop).stem().string();
  SeedLot lot = read_lot(seeds, name, Space::three_dimensional);
  for (const char* material : {"shell_compression", "youngs_modulus", "poisson_ratio"}) seeds.skip(material);
  seeds.reject_unknown_keys();
  return lot;
}

}  // namespace vibrosow
