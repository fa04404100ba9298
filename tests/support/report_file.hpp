#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace vibrosow {

/// Writes a table that a test has made to a file below $VIBROSOW_REPORTS; does nothing where that is not set.
inline void write_report(const std::filesystem::path& file, const std::string& table) {
  const char* folder = std::getenv("VIBROSOW_REPORTS");
  if (!folder) return;
  const std::filesystem::path path = folder / file;
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << table;
}

}  // namespace vibrosow
