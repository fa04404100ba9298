#include "input/input_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "files/whole_file.hpp"
#include "input/read_scene.hpp"
#include "input/table.hpp"
#include "input/wording.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> shipped_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(data_directory() / "seeders"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

fs::path shipped_file(const std::string& name, FileKind wanted, const std::shared_ptr<SourceFiles>& source) {
  std::vector<fs::path> found;
  std::vector<std::string> names;
  for (const fs::path& file : shipped_files()) {
    names.push_back(file.stem().string());
    if (names.back() == name) found.push_back(file);
  }
  if (found.empty())
    throw InputError(fmt::format("{}: there is no such file, and no seeder or study of that name is shipped{}",
                                 shortened(name), did_you_mean(shortened(name), names)));
  const auto of_kind = std::ranges::find(found, wanted, [&](const fs::path& file) { return kind_of(file, source); });
  return of_kind != found.end() ? *of_kind : found.front();
}

bool is_bare_name(const std::string& name) {
  return !name.empty() && name.find('/') == std::string::npos && !has_extension(name, ".toml");
}

}  // namespace

FileKind kind_of(const fs::path& file, const std::shared_ptr<SourceFiles>& files) {
  return Table(Document::read(file, {}, files)).has("base") ? FileKind::study : FileKind::seeder;
}

std::vector<std::string> warnings_of_files_outside(const InputFile& file) {
  std::vector<fs::path> folders = {file.path.parent_path()};
  if (file.kind == FileKind::study)
    if (const auto base = Table(Document::read(file.path, {}, file.files)).text("base"))
      folders.push_back((file.path.parent_path() / *base).parent_path());
  return warnings_of_files_outside(*file.files, folders);
}

InputFile input_file(const std::string& name, std::optional<FileKind> wanted) {
  const auto files = std::make_shared<SourceFiles>();
  std::error_code none;
  const bool shipped = is_bare_name(name) && !fs::exists(name, none);
  const fs::path path = shipped ? shipped_file(name, wanted.value_or(FileKind::seeder), files) : fs::path(name);
  InputFile file{path, kind_of(path, files), files};
  if (!wanted || file.kind == *wanted) return file;
  throw InputError(
      *wanted == FileKind::seeder
          ? fmt::format("{}: this is a study: use vibrosow sweep", path.string())
          : fmt::format("{}: this is a seeder, not a study: use vibrosow run; a study names its seeder with "
                        "the key base",
                        path.string()));
}

}  // namespace vibrosow
