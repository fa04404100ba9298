#include "storage/case_folder.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>

#include "scene/input_error.hpp"
#include "storage/atomic_file.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;
constexpr const char* extension = ".case";

}  // namespace

fs::path CaseFolder::file_of(const std::string& name) const {
  return path_ / name.substr(0, 2) / (name + extension);
}

std::optional<Run> CaseFolder::find(std::string_view identity) const {
  std::optional<Case> found = named(case_name(identity));
  if (!found || found->identity != identity) return std::nullopt;
  return std::move(found->run);
}

std::optional<Case> CaseFolder::named(const std::string& name) const {
  std::ifstream file(file_of(name), std::ios::binary);
  if (!file) return std::nullopt;
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  try {
    Case read = read_case(bytes);
    if (case_name(read.identity) == name) return read;
  } catch (const InputError&) {
  }
  return std::nullopt;
}

std::vector<std::string> CaseFolder::names() const {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(path_, error))
    if (entry.path().extension() == extension) names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

void CaseFolder::keep(std::string_view identity, const Run& run) const {
  const fs::path file = file_of(case_name(identity));
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) cannot_write(file, error.message());
  write_file_atomically(file, case_bytes(identity, run));
}

}  // namespace vibrosow
