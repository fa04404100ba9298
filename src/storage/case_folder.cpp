#include "storage/case_folder.hpp"

#include <fstream>
#include <iterator>
#include <system_error>

#include "scene/input_error.hpp"
#include "storage/atomic_file.hpp"
#include "storage/case_file.hpp"

namespace vibrosow {

std::filesystem::path CaseFolder::file_of(std::string_view identity) const {
  const std::string name = case_name(identity);
  return path_ / name.substr(0, 2) / (name + ".case");
}

std::optional<Run> CaseFolder::find(std::string_view identity) const {
  std::ifstream file(file_of(identity), std::ios::binary);
  if (!file) return std::nullopt;
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  try {
    return case_run(bytes, identity);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

void CaseFolder::keep(std::string_view identity, const Run& run) const {
  const std::filesystem::path file = file_of(identity);
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error) cannot_write(file, error.message());
  write_file_atomically(file, case_bytes(identity, run));
}

}  // namespace vibrosow
