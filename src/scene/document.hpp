#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scene/override.hpp"
#include "units/quantity.hpp"

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

namespace vibrosow {

/// A parsed TOML file with overrides laid over it, which knows for every key where it was written.
class Document {
 public:
  /// Throws InputError when the file cannot be read or parsed, or when an override does not parse or runs through a value.
  static std::shared_ptr<const Document> read(const std::filesystem::path& file,
                                              const std::vector<Override>& overrides = {});
  const toml::table& root() const { return root_; }
  const std::filesystem::path& file() const { return file_; }
  /// "FILE:LINE: KEY", or the override's origin and the key.
  std::string where(const std::string& full_key) const;

 private:
  std::filesystem::path file_;
  toml::table root_;
  std::map<std::string, std::string> override_origin_;
};

/// One table of a document, read key by key. Every key asked for counts as known; `reject_unknown_keys` then names each key
/// that was written and never asked for, with the nearest known one. A table may have a fallback (a preset): keys missing
/// here are taken from there, with the preset's own file and line in messages.
class Table {
 public:
  explicit Table(std::shared_ptr<const Document> document);  // the root table

  void set_fallback(Table preset);

  bool has(const std::string& key) const;                 // here or in the fallback
  bool has_here(const std::string& key) const;            // written in this document
  std::optional<Table> table(const std::string& key);     // absent: nullopt; not a table: InputError
  Table required_table(const std::string& key);
  std::vector<std::string> keys() const;                  // in order of the file
  std::vector<Table> tables(const std::string& key);      // array of tables ([[layout]]); absent: empty

  std::optional<std::string> text(const std::string& key);
  std::string required_text(const std::string& key);
  std::optional<bool> boolean(const std::string& key);
  std::optional<std::int64_t> whole_number(const std::string& key, std::int64_t least, std::int64_t most);
  std::optional<double> number(const std::string& key, double least, double most);  // plain, no unit
  std::optional<double> quantity(const std::string& key, Dimension dimension, double least, double most);
  std::vector<double> quantities(const std::string& key, Dimension dimension, double least, double most);  // one or a list
  /// One of `choices` by name, as its index; anything else: InputError with the list and the nearest.
  std::optional<std::size_t> choice(const std::string& key, const std::vector<std::string>& choices);
  /// The value of `key` as TOML text, for an Override.
  std::optional<std::string> toml_text(const std::string& key);

  std::string full_key(const std::string& key) const;
  std::string where(const std::string& key) const;        // for messages
  std::filesystem::path directory() const;                // of the file that holds this table
  /// Throws InputError "FILE:LINE: KEY: message".
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;
  void reject_unknown_keys() const;

 private:
  // implementation to be chosen
};

/// The nearest of `known` by edit distance when it is near enough to be meant.
std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& known);

}  // namespace vibrosow
