#include "input/csv_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <memory>
#include <sstream>
#include <utility>

#include <csv.h>
#include <fmt/format.h>
#include <iconv.h>

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

/// Excel's first line "sep=;" names the separator; otherwise the header line decides: column names hold none of them.
struct Dialect {
  char separator = ',';
  bool is_said = false;  // in a line of its own, the first
};

Dialect dialect_of(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (is_skipped(line)) continue;
    if (line.starts_with("sep=") && line.size() >= 5) return {line[4], true};
    for (const char separator : {';', '\t'})
      if (line.find(separator) != std::string::npos) return {separator};
    break;
  }
  return {};
}

/// A number with a mark in the place of its decimal point.
bool has_decimal(const std::string& field, char mark) {
  const auto at = field.find(mark);
  if (at == std::string::npos) return false;
  std::string digits = field.substr(0, at) + field.substr(at + 1);
  if (digits.starts_with('-') || digits.starts_with('+')) digits.erase(0, 1);
  return !digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos;
}

bool any_decimal(const CsvLines& csv, char mark) {
  return std::ranges::any_of(csv.rows, [&](const CsvLines::Row& row) {
    return std::ranges::any_of(row.fields, [&](const std::string& field) { return has_decimal(field, mark); });
  });
}

/// UTF-8 of a text that begins with a mark of UTF-16; any other text as it is, without the mark of UTF-8.
std::string in_utf8(std::string text, const std::string& file) {
  if (text.starts_with("\xEF\xBB\xBF")) return text.substr(3);
  if (!text.starts_with("\xFF\xFE") && !text.starts_with("\xFE\xFF")) return text;
  const std::unique_ptr<void, decltype(&iconv_close)> converter(iconv_open("UTF-8", "UTF-16"), &iconv_close);
  std::string converted(2 * text.size(), '\0');  // a unit of two bytes takes three at most
  char *from = text.data(), *to = converted.data();
  std::size_t from_left = text.size(), to_left = converted.size();
  if (iconv(converter.get(), &from, &from_left, &to, &to_left) == static_cast<std::size_t>(-1))
    throw InputError(file + ": begins as UTF-16 does, and is none");
  converted.resize(converted.size() - to_left);
  return converted;
}

/// Columns after the last one that has a name, where they hold nothing: spreadsheets append them.
void drop_empty_columns(CsvLines& csv) {
  while (csv.header.fields.size() > 1 && csv.header.fields.back().empty()) csv.header.fields.pop_back();
  for (CsvLines::Row& row : csv.rows)
    while (row.fields.size() > csv.header.fields.size() && row.fields.back().empty()) row.fields.pop_back();
}

}  // namespace

CsvLines parse_csv_lines(std::string text, const std::string& file) {
  text = in_utf8(std::move(text), file);
  CsvLines csv;
  csv.file = file;
  Dialect dialect = dialect_of(text);

  Parser parser(static_cast<unsigned char>(dialect.separator));
  const auto fail_on_quotes = [&] {
    throw InputError(
        fmt::format("{}:{}: a quote is opened and not closed, or stands inside a field", file, parser.begun_on_line()));
  };
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (parser.between_rows() && is_skipped(line)) continue;
    if (std::exchange(dialect.is_said, false)) continue;
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
  csv.decimal_comma = dialect.separator != ',' && (any_decimal(csv, ',') || !any_decimal(csv, '.'));
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
