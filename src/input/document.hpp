#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "input/override.hpp"
#include "input/source_files.hpp"
#include "input/toml_value.hpp"

namespace vibrosow {

/// A TOML file with overrides laid over a copy of what was parsed, which knows for every key where it was written.
class Document {
 public:
  /// Throws InputError when the file cannot be read or parsed, or when an override runs through a value, or takes out a
  /// key that is not there. `files` is kept, for the files that this one names.
  static std::shared_ptr<const Document> read(const std::filesystem::path& file,
                                              const std::vector<Override>& overrides = {},
                                              std::shared_ptr<SourceFiles> files = std::make_shared<SourceFiles>());

  const std::filesystem::path& file() const { return file_; }
  const TomlTable& root() const { return root_; }
  const std::shared_ptr<SourceFiles>& files() const { return files_; }

  /// "FILE:LINE", or an override's origin; "FILE" for nowhere.
  std::string origin(const SourcePlace& place) const;

 private:
  Document(std::filesystem::path file, std::shared_ptr<SourceFiles> files);

  std::filesystem::path file_;
  std::shared_ptr<SourceFiles> files_;
  TomlTable root_;
};

}  // namespace vibrosow
