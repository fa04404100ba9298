#include "input/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

#include "input/key_units.hpp"
#include "input/wording.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

/// A key that had another name in an earlier version; `now` without its table.
struct RenamedKey {
  std::string_view was, now;
};
constexpr RenamedKey renamed_keys[] = {{"guard.warn_compression", "warn_relative_overlap"},
                                       {"guard.stop_compression", "stop_relative_overlap"}};

std::string joined(const std::string& prefix, const std::string& key) {
  if (prefix.empty()) return key;
  return key.empty() ? prefix : prefix + "." + key;
}

std::string message_text(const TomlValue& value) {
  return shortened(toml_text(value));
}

bool is_list_of_tables(const TomlValue::List& list) {
  return !list.empty() &&
         std::ranges::all_of(list, [](const TomlValue& one) { return one.get<TomlTable>() != nullptr; });
}

/// `key`: all of it, from the file's beginning.
std::string not_a_table(const std::string& key, const TomlValue& value) {
  const auto* list = value.get<TomlValue::List>();
  if (list != nullptr && is_list_of_tables(*list))
    return fmt::format("is a list of tables; there is one {0}, so write [{0}], not [[{0}]]", key);
  return fmt::format("must be a table, not {}", message_text(value));
}

struct Written {
  std::string key;
  const TomlValue* value;
  SourcePlace place;
};

/// Every value, list and inline table below a table, by its dotted key.
void collect_values(const TomlTable& table, const std::string& prefix, std::vector<Written>& found) {
  for (const TomlEntry& entry : table.entries) {
    const std::string name = joined(prefix, entry.key);
    const auto* below = entry.value.get<TomlTable>();
    if (below != nullptr && !below->is_inline) {
      collect_values(*below, name, found);
    } else {
      found.push_back({name, &entry.value, entry.place});
    }
  }
}

}  // namespace

struct Table::State {
  std::shared_ptr<const Document> document;
  const TomlTable* node;
  std::string prefix;
  std::shared_ptr<State> fallback;
  std::set<std::string> known;
  std::map<std::string, std::shared_ptr<State>> children;

  State(std::shared_ptr<const Document> from, const TomlTable* table, std::string full_key)
      : document(std::move(from)), node(table), prefix(std::move(full_key)) {}

  void know(const std::string& key) {
    known.insert(key);
    if (fallback) fallback->know(key);
  }

  /// The table here or in the fallback that holds `key`; nullptr when none does.
  const State* holder(const std::string& key) const {
    if (node->find(key) != nullptr) return this;
    return fallback ? fallback->holder(key) : nullptr;
  }

  const TomlValue* find(const std::string& key) const {
    const State* holds = holder(key);
    return holds != nullptr ? &holds->node->find(key)->value : nullptr;
  }

  /// Of a key, or a dotted key below; one that is not written: where its table is.
  std::string origin(std::string key) const {
    const TomlTable* table = node;
    for (auto dot = key.find('.'); dot != std::string::npos; dot = key.find('.')) {
      const TomlEntry* first = table->find(key.substr(0, dot));
      const auto* next = first != nullptr ? first->value.get<TomlTable>() : nullptr;
      if (next == nullptr) break;
      table = next;
      key.erase(0, dot + 1);
    }
    const TomlEntry* entry = table->find(key);
    return document->origin(entry != nullptr ? entry->place : table->place);
  }

  [[noreturn]] void unknown(const std::string& key, const std::vector<std::string>& expected_keys) const {
    const std::string name = joined(prefix, key);
    const auto* renamed = std::ranges::find(renamed_keys, name, &RenamedKey::was);
    const std::string hint = renamed != std::end(renamed_keys) ? fmt::format("; it is called {} now", renamed->now)
                                                               : did_you_mean(key, expected_keys);
    throw InputError(fmt::format("{}: {}: unknown key{}", origin(key), name,
                                 hint.empty() && !expected_keys.empty()
                                     ? fmt::format("; known here are {}", fmt::join(expected_keys, ", "))
                                     : hint));
  }

  /// A key that is missing may be there under a wrong name.
  void check_misspelled(const std::string& missing) const {
    for (const TomlEntry& written : node->entries) {
      if (!known.contains(written.key) && nearest(written.key, {missing})) unknown(written.key, {missing});
    }
    if (fallback) fallback->check_misspelled(missing);
  }

  void reject_unknown_keys() const {
    for (const TomlEntry& written : node->entries) {
      if (!known.contains(written.key)) unknown(written.key, {known.begin(), known.end()});
      const auto child = children.find(written.key);
      if (child != children.end()) child->second->reject_unknown_keys();
    }
    for (const auto& [name, element] : children) {
      if (node->find(name) == nullptr) element->reject_unknown_keys();
    }
    if (fallback) fallback->reject_unknown_keys();
  }

  /// The table under `key`, with the fallback's of the same name behind it; made once, so that what is known
  /// is kept.
  std::shared_ptr<State> child(const std::string& key) {
    const auto made = children.find(key);
    if (made != children.end()) return made->second;
    std::shared_ptr<State> behind = fallback ? fallback->child(key) : nullptr;
    const TomlEntry* here = node->find(key);
    if (here == nullptr) return behind;
    const TomlTable* table = here->value.get<TomlTable>();
    if (table == nullptr)
      throw InputError(
          fmt::format("{}: {}: {}", origin(key), joined(prefix, key), not_a_table(joined(prefix, key), here->value)));
    auto state = std::make_shared<State>(document, table, joined(prefix, key));
    state->fallback = behind;
    children.emplace(key, state);
    return state;
  }
};

Table::Table(const std::shared_ptr<const Document>& document)
    : state_(std::make_shared<State>(document, &document->root(), "")) {}

Table::Table(std::shared_ptr<State> state) : state_(std::move(state)) {}

void Table::set_fallback(const Table& preset) {
  state_->fallback = preset.state_;
}

bool Table::has(const std::string& key) const {
  return state_->holder(key) != nullptr;
}

bool Table::has_here(const std::string& key) const {
  return state_->node->find(key) != nullptr;
}

bool Table::is_laid_over(const std::string& key) const {
  const TomlEntry* entry = state_->node->find(key);
  return entry != nullptr && !entry->place.origin.empty();
}

std::optional<Table> Table::table(const std::string& key) {
  state_->know(key);
  const std::shared_ptr<State> child = state_->child(key);
  return child ? std::optional<Table>(Table(child)) : std::nullopt;
}

Table Table::required_table(const std::string& key) {
  const std::optional<Table> found = table(key);
  if (!found) fail(key, "this table is missing");
  return *found;
}

Table Table::table_or_empty(const std::string& key) {
  static const TomlTable nothing;
  if (const std::optional<Table> found = table(key)) return *found;
  return Table(std::make_shared<State>(state_->document, &nothing, joined(state_->prefix, key)));
}

Table Table::anew() const {
  return Table(std::make_shared<State>(state_->document, state_->node, state_->prefix));
}

std::vector<std::string> Table::keys() const {
  std::vector<std::string> keys;
  for (const TomlEntry& entry : state_->node->entries) keys.push_back(entry.key);
  return keys;
}

std::vector<Table> Table::tables(const std::string& key) {
  state_->know(key);
  const TomlValue* found = state_->find(key);
  if (found == nullptr) return {};
  const auto* list = found->get<TomlValue::List>();
  if (list == nullptr || !is_list_of_tables(*list))
    fail(key, fmt::format("must be tables written as [[{}]]", full_key(key)));
  std::vector<Table> elements;
  for (const TomlValue& element : *list) {
    const std::string name = fmt::format("{}[{}]", key, elements.size() + 1);
    auto& child = state_->children[name];
    const State& holder = *state_->holder(key);  // maybe the preset's
    if (!child) child = std::make_shared<State>(holder.document, element.get<TomlTable>(), joined(holder.prefix, name));
    elements.push_back(Table(child));
  }
  return elements;
}

std::optional<std::string> Table::text(const std::string& key) {
  state_->know(key);
  const TomlValue* found = state_->find(key);
  if (found == nullptr) return std::nullopt;
  const auto* text = found->get<std::string>();
  if (text == nullptr) fail_to_read(key, fmt::format("must be a text in quotes, not {}", message_text(*found)));
  return *text;
}

std::string Table::required_text(const std::string& key) {
  const std::optional<std::string> found = text(key);
  if (!found) fail(key, "is missing");
  return *found;
}

std::optional<bool> Table::boolean(const std::string& key) {
  state_->know(key);
  const TomlValue* found = state_->find(key);
  if (found == nullptr) return std::nullopt;
  const bool* flag = found->get<bool>();
  if (flag == nullptr) fail_to_read(key, fmt::format("must be true or false, not {}", message_text(*found)));
  return *flag;
}

namespace {

std::int64_t whole_number_of(const Table& table, const std::string& key, const TomlValue& found, std::int64_t least,
                             std::int64_t most) {
  const auto* whole = found.get<std::int64_t>();
  if (whole == nullptr || *whole < least || *whole > most)
    table.fail(key, fmt::format("must be a whole number from {} to {}, not {}", least, most, message_text(found)));
  return *whole;
}

double number_of(const Table& table, const std::string& key, const TomlValue& found, double least, double most) {
  std::optional<double> value;
  if (const auto* whole = found.get<std::int64_t>()) value = static_cast<double>(*whole);
  if (const auto* number = found.get<double>()) value = *number;
  const std::string message =
      fmt::format("must be a number from {:g} to {:g}, without a unit, not {}", least, most, message_text(found));
  if (!value) table.fail_to_read(key, message);
  if (!(*value >= least && *value <= most)) table.fail(key, message);
  return *value;
}

}  // namespace

std::optional<std::int64_t> Table::whole_number(const std::string& key, std::int64_t least, std::int64_t most) {
  state_->know(key);
  const TomlValue* found = state_->find(key);
  if (found == nullptr) return std::nullopt;
  return whole_number_of(*this, key, *found, least, most);
}

std::vector<std::int64_t> Table::whole_numbers(const std::string& key, std::int64_t least, std::int64_t most) {
  std::vector<std::int64_t> values;
  for (const TomlValue& element : values_of(key)) values.push_back(whole_number_of(*this, key, element, least, most));
  return values;
}

std::optional<double> Table::number(const std::string& key, double least, double most) {
  state_->know(key);
  const TomlValue* found = state_->find(key);
  if (found == nullptr) return std::nullopt;
  return number_of(*this, key, *found, least, most);
}

std::vector<double> Table::numbers(const std::string& key, double least, double most) {
  std::vector<double> values;
  for (const TomlValue& element : values_of(key)) values.push_back(number_of(*this, key, element, least, most));
  return values;
}

std::optional<double> Table::quantity(const std::string& key, Dimension dimension, double least, double most) {
  if (is_list(key)) fail(key, fmt::format("must be one value: {}", expected_at(full_key(key), dimension)));
  const std::vector<double> found = quantities(key, dimension, least, most);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

double Table::required_quantity(const std::string& key, Dimension dimension, double least, double most) {
  const std::optional<double> found = quantity(key, dimension, least, most);
  if (!found) fail(key, fmt::format("is missing; expected {}", expected_at(full_key(key), dimension)));
  return *found;
}

namespace {

double in_si(const Table& table, const std::string& key, const TomlValue& value, Dimension dimension) {
  try {
    if (const auto* quantity = value.get<Quantity>()) return vibrosow::in_si(*quantity, dimension);
    if (const auto* text = value.get<std::string>())
      return parse_quantity(*text, dimension, example_at(table.full_key(key), dimension));
  } catch (const UnitError& error) {
    table.fail_to_read(key, error.what());
  }
  table.fail_to_read(key, fmt::format("must be a quantity with its unit in quotes, {}, not {}",
                                      expected_at(table.full_key(key), dimension), message_text(value)));
}

/// Of a quantity that was read.
std::string unit_of(const TomlValue& given) {
  const auto* quantity = given.get<Quantity>();
  return quantity != nullptr ? quantity->unit : split_quantity(*given.get<std::string>()).unit;
}

double quantity_of(const Table& table, const std::string& key, const TomlValue& given, Dimension dimension,
                   double least, double most) {
  const double value = in_si(table, key, given, dimension);
  // Limits such as 30 degree are not exact in SI, so a rounding error beyond them is still within.
  const double slack = 1e-12 * std::max(std::abs(least), std::abs(most));
  if (!(value >= least - std::min(slack, std::abs(least) * 1e-9) && value <= most + slack)) {
    table.fail(key, fmt::format("{} is out of range, which is from {} to {}", message_text(given),
                                shown(least, dimension, unit_of(given)), shown(most, dimension, unit_of(given))));
  }
  return value;
}

}  // namespace

std::vector<double> Table::quantities(const std::string& key, Dimension dimension, double least, double most) {
  std::vector<double> values;
  for (const TomlValue& element : values_of(key))
    values.push_back(quantity_of(*this, key, element, dimension, least, most));
  return values;
}

std::vector<std::array<double, 2>> Table::points(const std::string& key, Dimension dimension, double least,
                                                 double most) {
  state_->know(key);
  const TomlValue* found = state_->find(key);
  if (found == nullptr) return {};
  const auto* list = found->get<TomlValue::List>();
  if (list == nullptr) fail(key, fmt::format("must be a list of points, not {}", message_text(*found)));
  std::vector<std::array<double, 2>> values;
  for (const TomlValue& element : *list) {
    const auto* pair = element.get<TomlValue::List>();
    if (pair == nullptr || pair->size() != 2)
      fail(key,
           fmt::format("each point is a list of two, such as [\"3 cm\", \"8 cm\"], not {}", message_text(element)));
    values.push_back({quantity_of(*this, key, pair->front(), dimension, least, most),
                      quantity_of(*this, key, pair->back(), dimension, least, most)});
  }
  return values;
}

std::vector<TomlValue> Table::values_of(const std::string& key) {
  state_->know(key);
  const TomlValue* found = state_->find(key);
  if (found == nullptr) return {};
  const auto* list = found->get<TomlValue::List>();
  if (list == nullptr) return {*found};
  if (list->empty()) fail(key, "the list is empty");
  return *list;
}

std::vector<std::string> Table::texts(const std::string& key, std::string_view what) {
  std::vector<std::string> texts;
  for (const TomlValue& value : values_of(key)) {
    const auto* text = value.get<std::string>();
    if (text == nullptr) fail(key, fmt::format("must be {}, in quotes, not {}", what, message_text(value)));
    texts.push_back(*text);
  }
  return texts;
}

bool Table::is_list(const std::string& key) const {
  const TomlValue* found = state_->find(key);
  return found != nullptr && found->get<TomlValue::List>() != nullptr;
}

bool Table::is_table(const std::string& key) const {
  const TomlValue* found = state_->find(key);
  return found != nullptr && found->get<TomlTable>() != nullptr;
}

void Table::refuse_more(const std::string& key, std::size_t count, std::size_t most) const {
  if (count > most) fail(key, fmt::format("lists {}, more than {}", count, most));
}

void Table::skip(const std::string& key) {
  state_->know(key);
}

std::optional<std::size_t> Table::choice(const std::string& key, const std::vector<std::string>& choices) {
  const std::optional<std::string> found = text(key);
  if (!found) return std::nullopt;
  const auto chosen = std::find(choices.begin(), choices.end(), *found);
  if (chosen == choices.end()) {
    fail(key,
         fmt::format("\"{}\" is not one of {}{}", *found, fmt::join(choices, ", "), did_you_mean(*found, choices)));
  }
  return static_cast<std::size_t>(chosen - choices.begin());
}

std::vector<Override> Table::dotted_values() {
  std::vector<Written> found;
  collect_values(*state_->node, "", found);
  std::ranges::stable_sort(found, {}, [](const Written& one) {  // what an override added stands nowhere, and comes last
    return std::tuple(one.place.line == 0, one.place.line, one.place.column);
  });
  for (const TomlEntry& entry : state_->node->entries) skip(entry.key);
  std::vector<Override> values;
  for (const Written& one : found) values.push_back({one.key, *one.value, state_->document->origin(one.place)});
  return values;
}

std::string Table::full_key(const std::string& key) const {
  const State* holds = state_->holder(key);
  return joined(holds != nullptr ? holds->prefix : state_->prefix, key);
}

std::string Table::origin(const std::string& key) const {
  const State* holds = state_->holder(key.substr(0, key.find('.')));
  return (holds != nullptr ? holds : state_.get())->origin(key);
}

std::string Table::where(const std::string& key) const {
  return origin(key) + ": " + full_key(key);
}

const std::shared_ptr<SourceFiles>& Table::files() const {
  return state_->document->files();
}

std::filesystem::path Table::directory() const {
  return state_->document->file().parent_path();
}

std::filesystem::path Table::directory(const std::string& key) const {
  const State* holds = state_->holder(key);
  return (holds != nullptr ? holds : state_.get())->document->file().parent_path();
}

void Table::fail(const std::string& key, const std::string& message) const {
  if (!has(key)) state_->check_misspelled(key);
  throw InputError(where(key) + ": " + message);
}

void Table::fail_to_read(const std::string& key, const std::string& message) const {
  throw UnreadableValue(where(key) + ": " + message);
}

void Table::reject_keys_other_than(const std::vector<std::string>& known) const {
  for (const std::string& key : keys()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) state_->unknown(key, known);
  }
}

void Table::reject_unknown_keys() const {
  state_->reject_unknown_keys();
}

}  // namespace vibrosow
