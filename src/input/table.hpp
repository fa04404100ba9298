#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/document.hpp"
#include "units/quantity.hpp"

namespace vibrosow {

/// One table of a document, read key by key. Every key asked for counts as known; `reject_unknown_keys` then
/// names each key that was written and never asked for, with the nearest known one. A table may have a
/// fallback (a preset): keys missing here are taken from there, with the preset's own file and line in
/// messages. Copies share what is known.
class Table {
 public:
  explicit Table(const std::shared_ptr<const Document>& document);  // the root table

  /// Before any key is read.
  void set_fallback(const Table& preset);

  bool has(const std::string& key) const;              // here or in the fallback
  bool has_here(const std::string& key) const;         // written in this document
  bool is_laid_over(const std::string& key) const;     // by --set or by a study, not written in the file
  std::optional<Table> table(const std::string& key);  // absent: nullopt; not a table: InputError
  Table required_table(const std::string& key);
  Table table_or_empty(const std::string& key);  // absent: one that a preset may lie behind
  /// The same table as it is written: nothing behind it, no key asked for yet.
  Table anew() const;
  std::vector<std::string> keys() const;              // written in this document, in order of the file
  std::vector<Table> tables(const std::string& key);  // array of tables ([[layout]]); absent: empty

  std::optional<std::string> text(const std::string& key);
  std::string required_text(const std::string& key);
  std::optional<bool> boolean(const std::string& key);
  std::optional<std::int64_t> whole_number(const std::string& key, std::int64_t least, std::int64_t most);
  std::vector<std::int64_t> whole_numbers(const std::string& key, std::int64_t least,
                                          std::int64_t most);                       // one, or a list; absent: empty
  std::optional<double> number(const std::string& key, double least, double most);  // plain, no unit
  std::vector<double> numbers(const std::string& key, double least, double most);   // a list of such; absent: empty
  /// Ranges are in SI and include their ends.
  std::optional<double> quantity(const std::string& key, Dimension dimension, double least, double most);
  double required_quantity(const std::string& key, Dimension dimension, double least, double most);
  std::vector<double> quantities(const std::string& key, Dimension dimension, double least,
                                 double most);  // one or a list
  /// A list of points, each a list of two quantities; absent: empty.
  std::vector<std::array<double, 2>> points(const std::string& key, Dimension dimension, double least, double most);
  std::vector<TomlValue> values_of(const std::string& key);  // one, or a list that is not empty; absent: empty
  /// The text of a value, or of each element of a list of texts; absent: empty. `what` is expected, for
  /// messages.
  std::vector<std::string> texts(const std::string& key, std::string_view what = "a text");
  bool is_list(const std::string& key) const;
  bool is_table(const std::string& key) const;
  /// Throws InputError where a list of so many is longer than `most`.
  void refuse_more(const std::string& key, std::size_t count, std::size_t most) const;
  void skip(const std::string& key);  // known, with all below it, without being read
  /// One of `choices` by name, as its index; anything else: InputError with the list and the nearest.
  std::optional<std::size_t> choice(const std::string& key, const std::vector<std::string>& choices);

  /// For tables of full keys, as [set] and [vary] of a study: every value, list and inline table below this table by
  /// its dotted key ("tray.holes.count"), in order of the file. All of them count as known.
  std::vector<Override> dotted_values();

  std::string full_key(const std::string& key) const;
  std::string where(const std::string& key) const;                // for messages
  std::string origin(const std::string& key) const;               // "FILE:LINE" alone, for an Override's `where`
  const std::shared_ptr<SourceFiles>& files() const;              // those read for this document
  std::filesystem::path directory() const;                        // of the file that holds this table
  std::filesystem::path directory(const std::string& key) const;  // of the file that holds this key, maybe the preset's
  /// Throws InputError "FILE:LINE: KEY: message". A key that is not written but nearly so is called
  /// misspelled instead.
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;
  [[noreturn]] void fail_to_read(const std::string& key, const std::string& message) const;  // with UnreadableValue
  /// At once, for a table whose misspelled key would otherwise show as something missing elsewhere.
  void reject_keys_other_than(const std::vector<std::string>& known) const;
  /// Also in the tables that were read from this one, and in fallbacks.
  void reject_unknown_keys() const;

 private:
  struct State;
  explicit Table(std::shared_ptr<State> state);
  std::shared_ptr<State> state_;
};

}  // namespace vibrosow
