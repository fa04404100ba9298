#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "input/csv_lines.hpp"
#include "input/toml_value.hpp"

namespace vibrosow {

/// The files behind one scene or study: each is read and parsed once, however often it is asked for. Not for several
/// threads at a time.
class SourceFiles {
 public:
  SourceFiles() = default;
  /// Files as they were when another read them: its `texts`. What is not among them is read from the disk.
  explicit SourceFiles(std::map<std::string, std::string> texts) : frozen_(std::move(texts)) {}

  /// Throw InputError "FILE: .." or "FILE:LINE: .." when the file is not there, cannot be read or is not valid.
  const TomlTable& toml(const std::filesystem::path& file);
  const CsvLines& csv(const std::filesystem::path& file);
  const std::string& text(const std::filesystem::path& file);

  /// Whether there is such a plain file.
  bool has(const std::filesystem::path& file) const;

  int reads() const { return reads_; }  // of files, so far
  /// What was read so far, by absolute path.
  const std::map<std::string, std::string>& texts() const { return texts_; }

 private:
  const std::string& read(const std::filesystem::path& file);

  std::map<std::string, std::string> frozen_, texts_;
  std::map<std::filesystem::path, TomlTable> toml_;
  std::map<std::filesystem::path, CsvLines> csv_;
  int reads_ = 0;
};

}  // namespace vibrosow
