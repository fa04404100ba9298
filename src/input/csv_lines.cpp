#include "input/csv_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <sstream>

#include <csv.h>
#include <fmt/format.h>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

/// Owns libcsv's parser and gathers what it reports.
class Parser {
 public:
  explicit Parser(unsigned char separator) {
    if (csv_init(&parser_, CSV_STRICT | CSV_STRICT_FINI) != 0) throw std::bad_alloc();
    csv_set_delim(&parser_, separator);
  }
  ~Parser() { csv_free(&parser_); }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  bool between_rows() const { return between_rows_; }  // not inside a quoted field that spans lines

  /// False when quotes are misplaced.
  bool feed(const std::string& line, int number) {
    if (between_rows_) row_.line = number;
    between_rows_ = false;
    return csv_parse(&parser_, line.data(), line.size(), on_field, on_row, this) == line.size();
  }
  bool finish() { return csv_fini(&parser_, on_field, on_row, this) == 0; }
  int begun_on_line() const { return row_.line; }
  std::vector<CsvLines::Row> take_rows() { return std::move(rows_); }

 private:
  static void on_field(void* text, std::size_t length, void* self) {
    static_cast<Parser*>(self)->row_.fields.emplace_back(static_cast<const char*>(text), length);
  }
  static void on_row(int, void* self) {
    auto& parser = *static_cast<Parser*>(self);
    const auto has_value = [](const std::string& field) { return !field.empty(); };
    if (std::ranges::any_of(parser.row_.fields, has_value)) parser.rows_.push_back(parser.row_);
    parser.row_.fields.clear();
    parser.between_rows_ = true;
  }

  csv_parser parser_;
  bool between_rows_ = true;
  CsvLines::Row row_;
  std::vector<CsvLines::Row> rows_;
};

/// A comment, or nothing but space.
bool is_skipped(const std::string& line) {
  return line.starts_with('#') || line.find_first_not_of(" \t\r") == std::string::npos;
}

/// The header line decides: column names hold neither comma nor semicolon.
bool has_semicolons(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!is_skipped(line)) return line.find(';') != std::string::npos;
  return false;
}

/// Columns after the last one that has a name, where they hold nothing: spreadsheets append them.
void drop_empty_columns(CsvLines& csv) {
  while (csv.header.fields.size() > 1 && csv.header.fields.back().empty()) csv.header.fields.pop_back();
  for (CsvLines::Row& row : csv.rows)
    while (row.fields.size() > csv.header.fields.size() && row.fields.back().empty()) row.fields.pop_back();
}

}  // namespace

CsvLines parse_csv_lines(std::string text, const std::string& file) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  CsvLines csv;
  csv.file = file;
  csv.decimal_comma = has_semicolons(text);

  Parser parser(csv.decimal_comma ? ';' : ',');
  const auto fail_on_quotes = [&] {
    throw InputError(
        fmt::format("{}:{}: a quote is opened and not closed, or stands inside a field", file, parser.begun_on_line()));
  };
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (parser.between_rows() && is_skipped(line)) continue;
    if (!parser.feed(line + '\n', number)) fail_on_quotes();
  }
  if (!parser.finish()) fail_on_quotes();

  std::vector<CsvLines::Row> rows = parser.take_rows();
  if (rows.empty()) throw InputError(file + ": is empty; a header line and at least one row are needed");
  csv.header = std::move(rows.front());
  csv.rows.assign(std::make_move_iterator(rows.begin() + 1), std::make_move_iterator(rows.end()));
  if (csv.rows.empty())
    throw InputError(fmt::format("{}:{}: only a header; at least one row is needed", file, csv.header.line));
  drop_empty_columns(csv);
  for (const CsvLines::Row& row : csv.rows)
    if (row.fields.size() != csv.header.fields.size())
      throw InputError(fmt::format("{}:{}: {} fields where the header has {}", file, row.line, row.fields.size(),
                                   csv.header.fields.size()));
  return csv;
}

std::optional<double> csv_number(std::string text, bool decimal_comma) {
  if (decimal_comma) {
    if (text.find('.') != std::string::npos) return std::nullopt;
    std::ranges::replace(text, ',', '.');
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace vibrosow
