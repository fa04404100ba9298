#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

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
  /// Files of a plan, by the names that it gives them, each a path from the working directory or of what is shipped
  /// (`path_of_planned`). Of others, which somebody else's plan may name, only what is shipped is read.
  static std::shared_ptr<SourceFiles> of_plan(const std::map<std::string, std::string>& texts);

  /// What was read so far by names for a plan of a study: each from the study's folder, or, of what is shipped, from
  /// the shipped data. So they say nothing of the machine.
  std::map<std::string, std::string> planned_texts(const std::filesystem::path& study) const;

  /// Throw InputError "FILE: .." or "FILE:LINE: .." when the file is not there, cannot be read or is not valid.
  const TomlTable& toml(const std::filesystem::path& file);
  const CsvLines& csv(const std::filesystem::path& file);
  const std::string& text(const std::filesystem::path& file);

  /// Whether there is such a plain file.
  bool has(const std::filesystem::path& file) const;

  /// Keeps a sentence about what was read, once.
  void note(const std::string& sentence);
  const std::vector<std::string>& notes() const { return notes_; }

  int reads() const { return reads_; }  // of files, so far
  /// What was read so far, by absolute path.
  const std::map<std::string, std::string>& texts() const { return texts_; }

 private:
  const std::string& read(const std::filesystem::path& file);

  std::map<std::string, std::string> frozen_, texts_;
  bool is_of_plan_ = false;
  std::map<std::filesystem::path, TomlTable> toml_;
  std::map<std::filesystem::path, CsvLines> csv_;
  std::vector<std::string> notes_;
  int reads_ = 0;
};

/// The name of a file in the plan of a study, and the path that is read for it.
std::string name_in_plan(const std::filesystem::path& file, const std::filesystem::path& study);
std::filesystem::path path_of_planned(const std::string& name);

/// A sentence for each file that was read from elsewhere than these folders, those below them, and what is shipped: a
/// seeder that somebody else wrote may name any file, and a study's folder keeps what it reads.
std::vector<std::string> warnings_of_files_outside(const SourceFiles& files,
                                                   const std::vector<std::filesystem::path>& folders);

}  // namespace vibrosow
