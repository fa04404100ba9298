// Studies, in a folder beside the shipped seeders.

#include <filesystem>

#include "fuzz/try_bytes.hpp"
#include "input/read_scene.hpp"
#include "input/temporary_file.hpp"
#include "scene/input_error.hpp"
#include "study/study.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

/// seeders/studies in a folder of its own, with links to what shipped studies name.
class StudyFolder {
 public:
  StudyFolder() {
    const fs::path seeders = folder_.path("seeders");
    fs::create_directories(seeders / "studies");
    for (const auto& entry : fs::directory_iterator(data_directory() / "seeders"))
      if (entry.path().filename() != "studies") fs::create_symlink(entry.path(), seeders / entry.path().filename());
    for (const auto& entry : fs::directory_iterator(data_directory() / "seeders" / "studies"))
      fs::create_symlink(entry.path(), seeders / "studies" / entry.path().filename());
  }
  fs::path write(const std::string& bytes) const { return folder_.write("seeders/studies/fuzzed.toml", bytes); }

 private:
  TemporaryFolder folder_;
};

}  // namespace

void try_bytes(const std::string& bytes) {
  static const StudyFolder folder;
  try {
    study_warnings(read_study(folder.write(bytes)));
  } catch (const InputError&) {
  }
}

}  // namespace vibrosow
