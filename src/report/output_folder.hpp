#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vibrosow {

struct OutputFile {
  std::string name;  // within the folder
  std::string content;
};

/// The folder that one command writes its set of files into, which `files.json` lists with the command's name. A later
/// run of the command replaces the set whole, files that it has no more included. What no list names is foreign and
/// never touched.
///
/// How whole: the set is written and brought down to the disk in a folder beside this one (".NAME." and digits). Where
/// the folder holds nothing but a former set, the new one takes its place in a single rename, so at any moment, a loss
/// of power included, there is one set or the other. Where it holds foreign files as well, or cannot be exchanged (the
/// working directory, a mount point, a file system without such a rename), the files are moved in one after the other;
/// files.json says `"complete": false` until the last one is there.
class OutputFolder {
 public:
  /// Makes the folder now and looks whether `files` (names, of which * stands for any digits) may be written there, so
  /// that a long simulation does not end at a folder that cannot be used. Throws InputError: it cannot be made or
  /// written into, it belongs to another command, or a file of such a name is foreign.
  /// `holds_more`: there is always something else in it, which a late listing of a network file system may hide.
  OutputFolder(std::filesystem::path folder, std::string command, const std::vector<std::string>& files,
               bool holds_more = false);

  /// Replaces the set. Throws InputError "PATH: cannot be written: REASON" or for what the constructor refuses; the
  /// former set is then as it was (but where files are moved one by one and that fails halfway).
  void write(const std::vector<OutputFile>& files) const;

  /// Adds a file to the set that is there, or replaces it in that. Throws as `write` does.
  void add(const OutputFile& file) const;

  /// Takes the set away; false where there is none. Throws as `write` does.
  bool clear() const;

  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
  std::string command_;
  bool holds_more_;
};

}  // namespace vibrosow
