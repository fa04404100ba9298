#include "input/document.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <system_error>
#include <tuple>

#include "input/toml_lib.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {

struct Document::Contents {
  std::filesystem::path file;
  toml::table root;
  std::map<std::string, std::string> override_origin;  // full key -> Override::where
};

namespace {

std::string joined(const std::string& prefix, const std::string& key) {
  if (prefix.empty()) return key;
  return key.empty() ? prefix : prefix + "." + key;
}

/// Parts of a dotted key; an empty part is an empty string.
std::vector<std::string> split(const std::string& dotted) {
  std::vector<std::string> parts;
  std::istringstream stream(dotted);
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  return parts;
}

std::string read_file(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& reason) { throw InputError(file.string() + ": " + reason); };
  std::error_code error;
  const auto kind = std::filesystem::status(file, error).type();
  if (kind == std::filesystem::file_type::not_found) fail("there is no such file");
  if (error) fail("cannot be read: " + error.message());
  if (kind == std::filesystem::file_type::directory) fail("cannot be read: it is a directory");
  if (kind != std::filesystem::file_type::regular) fail("cannot be read: it is not a plain file");
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(std::string("cannot be read: ") + std::strerror(errno));
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

toml::table parse_file(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}:{}: not valid TOML: {}", file.string(), error.source().begin.line, error.description()));
  }
}

const toml::node* find_node(const toml::table& table, const std::string& key) {
  return table.get(key);
}

/// Where a key of a table is written: the override that set it or a table around it, else file and line.
std::string origin_of(const std::filesystem::path& file, const std::map<std::string, std::string>& override_origin,
                      const toml::table& table, const std::string& prefix, const std::string& key) {
  for (std::string around = joined(prefix, key); !around.empty();) {
    const auto origin = override_origin.find(around);
    if (origin != override_origin.end()) return origin->second;
    const auto dot = around.rfind('.');
    around = dot == std::string::npos ? "" : around.substr(0, dot);
  }
  auto line = table.source().begin.line;
  for (const auto& [name, node] : table) {
    if (name.str() == key && name.source().begin.line > 0) line = name.source().begin.line;
  }
  // The root table counts as line 1 although a key that is missing from it stands nowhere.
  if (line == 0 || (prefix.empty() && find_node(table, key) == nullptr)) return file.string();
  return fmt::format("{}:{}", file.string(), line);
}

/// As origin_of, for a dotted key below `table`; every part but the last names a table.
std::string origin_below(const std::filesystem::path& file, const std::map<std::string, std::string>& override_origin,
                         const toml::table* table, std::string prefix, std::string key) {
  for (auto dot = key.find('.'); dot != std::string::npos; dot = key.find('.')) {
    const toml::node* next = table->get(key.substr(0, dot));
    if (next == nullptr || !next->is_table()) break;
    table = next->as_table();
    prefix = joined(prefix, key.substr(0, dot));
    key = key.substr(dot + 1);
  }
  return origin_of(file, override_origin, *table, prefix, key);
}

void apply(toml::table& root, std::map<std::string, std::string>& origins, const Override& change) {
  toml::table parsed;
  try {
    parsed = toml::parse("value = " + change.toml_value);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}: {}: not a TOML value: {}", change.where, change.key, error.description()));
  }
  const std::vector<std::string> parts = split(change.key);
  const bool empty_part = std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part.empty(); });
  if (parts.empty() || empty_part || change.key.ends_with('.') || parsed.size() != 1) {
    throw InputError(fmt::format("{}: \"{}\" is not one key and one value", change.where, change.key));
  }
  toml::table* table = &root;
  std::string prefix;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    prefix = joined(prefix, parts[i]);
    toml::node* next = table->get(parts[i]);
    if (next == nullptr) {
      next = &table->insert(parts[i], toml::table{}).first->second;
      origins.emplace(prefix, change.where);
    }
    table = next->as_table();
    if (table == nullptr) {
      throw InputError(
          fmt::format("{}: {} is a value, not a table, so {} cannot be set", change.where, prefix, change.key));
    }
  }
  table->insert_or_assign(parts.back(), std::move(*parsed.get("value")));
  origins[change.key] = change.where;
}

/// Keys of a table in order of the file; those an override added come last, by name.
std::vector<std::string> ordered_keys(const toml::table& table) {
  std::vector<std::tuple<bool, toml::source_index, toml::source_index, std::string>> positions;
  for (const auto& [key, node] : table) {
    const auto at = key.source().begin;
    positions.emplace_back(at.line == 0, at.line, at.column, std::string(key.str()));
  }
  std::sort(positions.begin(), positions.end());
  std::vector<std::string> keys;
  for (const auto& position : positions) keys.push_back(std::get<3>(position));
  return keys;
}

/// A node as TOML text, tables inline.
std::string text_of(const toml::node& node) {
  if (node.is_floating_point()) {
    // toml++ writes 1.1 as 1.1000000000000001.
    const std::string digits = fmt::format("{}", *node.value<double>());
    return digits.find_first_of(".en") == std::string::npos ? digits + ".0" : digits;
  }
  toml::table holder;
  holder.insert("v", node);
  if (toml::table* table = holder.get("v")->as_table()) table->is_inline(true);
  std::ostringstream out;
  out << toml::toml_formatter(holder);
  return out.str().substr(std::string("v = ").size());
}

void collect_values(const toml::table& table, const std::string& prefix,
                    std::vector<std::tuple<toml::source_index, toml::source_index, std::string>>& found) {
  for (const auto& [key, node] : table) {
    const std::string name = joined(prefix, std::string(key.str()));
    const toml::table* below = node.as_table();
    if (below != nullptr && !below->is_inline()) {
      collect_values(*below, name, found);
    } else {
      const auto at = node.source().begin;  // the value's, because a dotted key fractions its first parts with others
      found.emplace_back(at.line, at.column, name);
    }
  }
}

std::string show(double value, Dimension dimension) {
  switch (dimension) {
    case Dimension::length:
      return value < 0.1 && value > -0.1 && value != 0 ? fmt::format("{:g} mm", value * 1000)
                                                       : fmt::format("{:g} m", value);
    case Dimension::angle:
      return fmt::format("{:g} degree", value * 180 / std::numbers::pi);
    case Dimension::fraction:
      return fmt::format("{:g} %", value * 100);
    default:
      return fmt::format("{:g} {}", value, si_unit(dimension));
  }
}

std::string list_of(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& known) {
  std::optional<std::string> best;
  std::size_t best_distance = (word.size() + 2) / 3 + 1;  // farther than this is another word
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::optional<std::string> meant = nearest(word, known);
  return meant ? fmt::format("; did you mean \"{}\"?", *meant) : "";
}

Document::Document(std::unique_ptr<Contents> contents) : contents_(std::move(contents)) {}
Document::~Document() = default;

std::shared_ptr<const Document> Document::read(const std::filesystem::path& file,
                                               const std::vector<Override>& overrides) {
  auto contents = std::make_unique<Contents>();
  contents->file = file;
  contents->root = parse_file(file);
  for (const Override& change : overrides) apply(contents->root, contents->override_origin, change);
  return std::shared_ptr<const Document>(new Document(std::move(contents)));
}

const std::filesystem::path& Document::file() const {
  return contents_->file;
}

std::string Document::where(const std::string& full_key) const {
  return origin_below(contents_->file, contents_->override_origin, &contents_->root, "", full_key) + ": " + full_key;
}

struct Table::State {
  std::shared_ptr<const Document> document;
  const toml::table* node;
  std::string prefix;
  std::shared_ptr<State> fallback;
  std::set<std::string> known;
  std::map<std::string, std::shared_ptr<State>> children;

  State(std::shared_ptr<const Document> from, const toml::table* table, std::string full_key)
      : document(std::move(from)), node(table), prefix(std::move(full_key)) {}

  void know(const std::string& key) {
    known.insert(key);
    if (fallback) fallback->know(key);
  }

  /// The table here or in the fallback that holds `key`; nullptr when none does.
  const State* holder(const std::string& key) const {
    if (node->contains(key)) return this;
    return fallback ? fallback->holder(key) : nullptr;
  }

  const toml::node* find(const std::string& key) const {
    const State* holds = holder(key);
    return holds != nullptr ? find_node(*holds->node, key) : nullptr;
  }

  const toml::node* find_dotted(const std::string& dotted) const {
    const toml::node* at = node;
    for (const std::string& part : split(dotted)) {
      const toml::table* table = at->as_table();
      at = table != nullptr ? table->get(part) : nullptr;
      if (at == nullptr) return nullptr;
    }
    return at;
  }

  std::string origin(const std::string& key) const {
    const auto& contents = *document->contents_;
    return origin_of(contents.file, contents.override_origin, *node, prefix, key);
  }

  [[noreturn]] void unknown(const std::string& key, const std::vector<std::string>& expected_keys) const {
    throw InputError(
        fmt::format("{}: {}: unknown key{}", origin(key), joined(prefix, key), did_you_mean(key, expected_keys)));
  }

  /// A key that is missing may be there under a wrong name.
  void check_misspelled(const std::string& missing) const {
    for (const std::string& written : ordered_keys(*node)) {
      if (!known.contains(written) && nearest(written, {missing})) unknown(written, {missing});
    }
    if (fallback) fallback->check_misspelled(missing);
  }

  void reject_unknown_keys() const {
    for (const std::string& key : ordered_keys(*node)) {
      if (!known.contains(key)) unknown(key, {known.begin(), known.end()});
      const auto child = children.find(key);
      if (child != children.end()) child->second->reject_unknown_keys();
    }
    for (const auto& [name, element] : children) {
      if (!node->contains(name)) element->reject_unknown_keys();
    }
    if (fallback) fallback->reject_unknown_keys();
  }

  /// The table under `key`, with the fallback's of the same name behind it; made once, so that what is known
  /// is kept.
  std::shared_ptr<State> child(const std::string& key) {
    const auto made = children.find(key);
    if (made != children.end()) return made->second;
    std::shared_ptr<State> behind = fallback ? fallback->child(key) : nullptr;
    const toml::node* here = find_node(*node, key);
    if (here == nullptr) return behind;
    if (!here->is_table()) {
      throw InputError(
          fmt::format("{}: {}: must be a table, not {}", origin(key), joined(prefix, key), text_of(*here)));
    }
    auto state = std::make_shared<State>(document, here->as_table(), joined(prefix, key));
    state->fallback = behind;
    children.emplace(key, state);
    return state;
  }
};

Table::Table(std::shared_ptr<const Document> document)
    : state_(std::make_shared<State>(document, &document->contents_->root, "")) {}

Table::Table(std::shared_ptr<State> state) : state_(std::move(state)) {}

void Table::set_fallback(const Table& preset) {
  state_->fallback = preset.state_;
}

bool Table::has(const std::string& key) const {
  return state_->holder(key) != nullptr;
}

bool Table::has_here(const std::string& key) const {
  return state_->node->contains(key);
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

std::vector<std::string> Table::keys() const {
  return ordered_keys(*state_->node);
}

std::vector<Table> Table::tables(const std::string& key) {
  state_->know(key);
  const toml::node* found = state_->find(key);
  if (found == nullptr) return {};
  if (!found->is_array_of_tables()) fail(key, fmt::format("must be tables written as [[{}]]", full_key(key)));
  std::vector<Table> elements;
  for (const toml::node& element : *found->as_array()) {
    const std::string name = fmt::format("{}[{}]", key, elements.size() + 1);
    auto& child = state_->children[name];
    const State& holder = *state_->holder(key);  // maybe the preset's
    if (!child) child = std::make_shared<State>(holder.document, element.as_table(), joined(holder.prefix, name));
    elements.push_back(Table(child));
  }
  return elements;
}

std::optional<std::string> Table::text(const std::string& key) {
  state_->know(key);
  const toml::node* found = state_->find(key);
  if (found == nullptr) return std::nullopt;
  if (!found->is_string()) fail(key, fmt::format("must be a text in quotes, not {}", text_of(*found)));
  return found->value<std::string>();
}

std::string Table::required_text(const std::string& key) {
  const std::optional<std::string> found = text(key);
  if (!found) fail(key, "is missing");
  return *found;
}

std::optional<bool> Table::boolean(const std::string& key) {
  state_->know(key);
  const toml::node* found = state_->find(key);
  if (found == nullptr) return std::nullopt;
  if (!found->is_boolean()) fail(key, fmt::format("must be true or false, not {}", text_of(*found)));
  return found->value<bool>();
}

std::optional<std::int64_t> Table::whole_number(const std::string& key, std::int64_t least, std::int64_t most) {
  state_->know(key);
  const toml::node* found = state_->find(key);
  if (found == nullptr) return std::nullopt;
  const std::optional<std::int64_t> value = found->is_integer() ? found->value<std::int64_t>() : std::nullopt;
  if (!value || *value < least || *value > most) {
    fail(key, fmt::format("must be a whole number from {} to {}, not {}", least, most, text_of(*found)));
  }
  return value;
}

std::optional<double> Table::number(const std::string& key, double least, double most) {
  state_->know(key);
  const toml::node* found = state_->find(key);
  if (found == nullptr) return std::nullopt;
  const std::optional<double> value = found->is_number() ? found->value<double>() : std::nullopt;
  if (!value || !(*value >= least && *value <= most)) {
    fail(key, fmt::format("must be a number from {:g} to {:g}, without a unit, not {}", least, most, text_of(*found)));
  }
  return value;
}

std::optional<double> Table::quantity(const std::string& key, Dimension dimension, double least, double most) {
  if (is_list(key)) fail(key, fmt::format("must be one value: {}", expected(dimension)));
  const std::vector<double> found = quantities(key, dimension, least, most);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

double Table::required_quantity(const std::string& key, Dimension dimension, double least, double most) {
  const std::optional<double> found = quantity(key, dimension, least, most);
  if (!found) fail(key, fmt::format("is missing; expected {}", expected(dimension)));
  return *found;
}

namespace {

double quantity_of(const Table& table, const std::string& key, const toml::node& node, Dimension dimension,
                   double least, double most) {
  if (!node.is_string()) {
    table.fail(
        key, fmt::format("must be a quantity with its unit in quotes, {}, not {}", expected(dimension), text_of(node)));
  }
  const std::string text = *node.value<std::string>();
  double value = 0;
  try {
    value = parse_quantity(text, dimension);
  } catch (const UnitError& error) {
    table.fail(key, error.what());
  }
  // Limits such as 30 degree are not exact in SI, so a rounding error beyond them is still within.
  const double slack = 1e-12 * std::max(std::abs(least), std::abs(most));
  if (!(value >= least - std::min(slack, std::abs(least) * 1e-9) && value <= most + slack)) {
    table.fail(key, fmt::format("\"{}\" is out of range, which is from {} to {}", text, show(least, dimension),
                                show(most, dimension)));
  }
  return value;
}

}  // namespace

std::vector<double> Table::quantities(const std::string& key, Dimension dimension, double least, double most) {
  state_->know(key);
  const toml::node* found = state_->find(key);
  if (found == nullptr) return {};
  if (!found->is_array()) return {quantity_of(*this, key, *found, dimension, least, most)};
  if (found->as_array()->empty()) fail(key, "the list is empty");
  std::vector<double> values;
  for (const toml::node& element : *found->as_array())
    values.push_back(quantity_of(*this, key, element, dimension, least, most));
  return values;
}

std::vector<std::array<double, 2>> Table::points(const std::string& key, Dimension dimension, double least,
                                                 double most) {
  state_->know(key);
  const toml::node* found = state_->find(key);
  if (found == nullptr) return {};
  if (!found->is_array()) fail(key, fmt::format("must be a list of points, not {}", text_of(*found)));
  std::vector<std::array<double, 2>> values;
  for (const toml::node& element : *found->as_array()) {
    const toml::array* pair = element.as_array();
    if (pair == nullptr || pair->size() != 2)
      fail(key, fmt::format("each point is a list of two, such as [\"3 cm\", \"8 cm\"], not {}", text_of(element)));
    values.push_back({quantity_of(*this, key, *pair->get(0), dimension, least, most),
                      quantity_of(*this, key, *pair->get(1), dimension, least, most)});
  }
  return values;
}

std::vector<std::string> Table::texts(const std::string& key, std::string_view what) {
  state_->know(key);
  const toml::node* found = state_->find(key);
  if (found == nullptr) return {};
  const auto read = [&](const toml::node& node) {
    if (!node.is_string()) fail(key, fmt::format("must be {}, in quotes, not {}", what, text_of(node)));
    return *node.value<std::string>();
  };
  if (!found->is_array()) return {read(*found)};
  if (found->as_array()->empty()) fail(key, "the list is empty");
  std::vector<std::string> values;
  for (const toml::node& element : *found->as_array()) values.push_back(read(element));
  return values;
}

bool Table::is_list(const std::string& key) const {
  const toml::node* found = state_->find(key);
  return found != nullptr && found->is_array();
}

bool Table::is_table(const std::string& key) const {
  const toml::node* found = state_->find(key);
  return found != nullptr && found->is_table();
}

void Table::skip(const std::string& key) {
  state_->know(key);
}

std::optional<std::size_t> Table::choice(const std::string& key, const std::vector<std::string>& choices) {
  const std::optional<std::string> found = text(key);
  if (!found) return std::nullopt;
  const auto chosen = std::find(choices.begin(), choices.end(), *found);
  if (chosen == choices.end()) {
    fail(key, fmt::format("\"{}\" is not one of {}{}", *found, list_of(choices), did_you_mean(*found, choices)));
  }
  return static_cast<std::size_t>(chosen - choices.begin());
}

std::vector<std::string> Table::dotted_keys() const {
  std::vector<std::tuple<toml::source_index, toml::source_index, std::string>> found;
  collect_values(*state_->node, "", found);
  std::sort(found.begin(), found.end());
  std::vector<std::string> keys;
  for (const auto& value : found) keys.push_back(std::get<2>(value));
  return keys;
}

std::optional<std::string> Table::toml_text(const std::string& key) {
  if (key.empty()) return std::nullopt;
  state_->know(split(key).front());
  const toml::node* found = state_->find_dotted(key);
  return found != nullptr ? std::optional(text_of(*found)) : std::nullopt;
}

std::vector<std::string> Table::toml_elements(const std::string& key) {
  const std::optional<std::string> whole = toml_text(key);
  if (!whole) return {};
  const toml::array* list = state_->find_dotted(key)->as_array();
  if (list == nullptr) return {*whole};
  std::vector<std::string> elements;
  for (const toml::node& element : *list) elements.push_back(text_of(element));
  return elements;
}

std::optional<Table> Table::table_at(const std::string& dotted_key) {
  std::shared_ptr<State> at = state_;
  for (const std::string& part : split(dotted_key)) {
    at->know(part);
    const toml::node* next = at->find(part);
    if (next == nullptr || !next->is_table()) return std::nullopt;
    at = at->child(part);
  }
  return Table(at);
}

std::string Table::full_key(const std::string& key) const {
  const State* holds = state_->holder(key);
  return joined(holds != nullptr ? holds->prefix : state_->prefix, key);
}

std::string Table::origin(const std::string& key) const {
  if (key.find('.') != std::string::npos) {
    const auto& contents = *state_->document->contents_;
    return origin_below(contents.file, contents.override_origin, state_->node, state_->prefix, key);
  }
  const State* holds = state_->holder(key);
  return (holds != nullptr ? holds : state_.get())->origin(key);
}

std::string Table::where(const std::string& key) const {
  return origin(key) + ": " + full_key(key);
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

void Table::reject_keys_other_than(const std::vector<std::string>& known) const {
  for (const std::string& key : keys()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) state_->unknown(key, known);
  }
}

void Table::reject_unknown_keys() const {
  state_->reject_unknown_keys();
}

}  // namespace vibrosow
