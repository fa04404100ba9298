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
  /// Throw InputError "FILE: .." or "FILE:LINE: .." when the file is not there, cannot be read or is not valid.
  const TomlTable& toml(const std::filesystem::path& file);
  const CsvLines& csv(const std::filesystem::path& file);

  int reads() const { return reads_; }  // of files, so far

 private:
  std::string read(const std::filesystem::path& file);

  std::map<std::filesystem::path, TomlTable> toml_;
  std::map<std::filesystem::path, CsvLines> csv_;
  int reads_ = 0;
};

}  // namespace vibrosow
