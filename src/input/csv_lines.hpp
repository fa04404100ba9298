#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vibrosow {

/// A CSV file as read: fields are text, trimmed.
struct CsvLines {
  std::string file;  // its name, for messages
  struct Row {
    int line = 0;  // of the file, where the row begins
    std::vector<std::string> fields;
  };
  bool decimal_comma = false;  // never where commas stand between the fields
  Row header;
  std::vector<Row> rows;  // each as long as the header
};

/// Reads text with commas, semicolons or tabs between its fields, as the header shows or a first line "sep=;" says
/// (RFC 4180 quotes; any line ends; UTF-8 with or without its mark, or UTF-16 with it). Between semicolons and tabs
/// numbers have a decimal comma, unless none has one and some have a point. Lines that begin with # and rows without
/// any value are skipped, and so are columns without name and values after the last, which spreadsheets append. Throws
/// InputError "FILE:LINE: .." when the text has no rows, a quote that does not end or a row of another length than the
/// header. `file` names it in messages.
CsvLines parse_csv_lines(std::string text, const std::string& file);

/// A finite number in the file's dialect; none when the text is anything else.
std::optional<double> csv_number(std::string text, bool decimal_comma);

}  // namespace vibrosow
