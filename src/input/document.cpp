#include "input/document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

#include "input/wording.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

/// Gives every key within a value the place of the override that brought it.
void move_to(TomlValue& value, const SourcePlace& place) {
  if (auto* list = std::get_if<TomlValue::List>(&value.data)) {
    for (TomlValue& element : *list) move_to(element, place);
  } else if (auto* table = std::get_if<TomlTable>(&value.data)) {
    table->place = place;
    for (TomlEntry& entry : table->entries) {
      entry.place = place;
      move_to(entry.value, place);
    }
  }
}

/// Lays one change over the root table.
class Change {
 public:
  Change(TomlTable& root, const Override& change) : root_(root), change_(change) {
    try {
      parts_ = key_parts(change.key);
    } catch (const TomlError& error) {
      fail(fmt::format("not one key and one value: {}", error.what()));
    }
  }

  void apply() const {
    if (change_.value) {
      set(*change_.value);
    } else {
      take_out();
    }
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}: {}: {}", change_.where, shortened(change_.key), message));
  }

  std::string first_parts(std::size_t count) const {
    return fmt::format("{}", fmt::join(std::span(parts_).first(count), "."));
  }

  void set(TomlValue value) const {
    const SourcePlace place{0, 0, change_.where};
    TomlTable* table = &root_;
    for (std::size_t i = 0; i + 1 < parts_.size(); ++i) {
      TomlEntry* next = table->find(parts_[i]);
      if (next == nullptr) next = &table->set(parts_[i], {TomlTable{{}, place, false}}, place);
      table = std::get_if<TomlTable>(&next->value.data);
      if (table == nullptr)
        fail(fmt::format("{} is a value, not a table, so {} cannot be set", first_parts(i + 1), change_.key));
    }
    move_to(value, place);
    table->set(parts_.back(), std::move(value), place);
  }

  void take_out() const {
    TomlTable* table = &root_;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      TomlEntry* next = table->find(parts_[i]);
      if (next == nullptr) {
        std::vector<std::string> written;
        for (const TomlEntry& entry : table->entries) written.push_back(entry.key);
        fail(fmt::format("cannot be taken out: {} is not written{}", first_parts(i + 1),
                         did_you_mean(parts_[i], written)));
      }
      if (i + 1 == parts_.size()) return table->erase(parts_[i]);
      table = std::get_if<TomlTable>(&next->value.data);
      if (table == nullptr) fail(fmt::format("cannot be taken out: {} is a value, not a table", first_parts(i + 1)));
    }
  }

  TomlTable& root_;
  const Override& change_;
  std::vector<std::string> parts_;
};

}  // namespace

Document::Document(std::filesystem::path file, std::shared_ptr<SourceFiles> files)
    : file_(std::move(file)), files_(std::move(files)), root_(files_->toml(file_)) {}

std::shared_ptr<const Document> Document::read(const std::filesystem::path& file,
                                               const std::vector<Override>& overrides,
                                               std::shared_ptr<SourceFiles> files) {
  const std::shared_ptr<Document> document(new Document(file, std::move(files)));
  for (const Override& change : overrides) Change(document->root_, change).apply();
  return document;
}

std::string Document::origin(const SourcePlace& place) const {
  if (!place.origin.empty()) return place.origin;
  return place.line > 0 ? fmt::format("{}:{}", file_.string(), place.line) : file_.string();
}

}  // namespace vibrosow
