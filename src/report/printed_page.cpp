#include "report/printed_page.hpp"

#include <fmt/format.h>

#include "picture/escaped_text.hpp"

namespace vibrosow {
namespace {

constexpr const char* style =
    "@page { size: A4; margin: 15mm } body { font: 10pt sans-serif; max-width: 180mm } h1 { font-size: 15pt } "
    "h2 { font-size: 12pt; break-after: avoid } table { border-collapse: collapse; width: 100% } "
    "tr { break-inside: avoid } th, td { border: 1px solid black; padding: 1.2mm 2mm; text-align: right } "
    "td.write { width: 35mm } td.say { text-align: left } .table { overflow-x: auto } code { overflow-wrap: anywhere } "
    ".line { display: inline-block; width: 45mm; border-bottom: 1px solid black; margin-right: 6mm } "
    "@media screen and (max-width: 600px) { body { font-size: 12pt } th, td { padding: 1mm } td.write { width: 15mm } "
    "}";

}  // namespace

std::string printed_page(const std::string& title, const std::string& body) {
  const std::string heading = escaped_text(title);
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>{0}</title>\n"
      "<style>{1}</style></head><body>\n<h1>{0}</h1>\n{2}</body></html>\n",
      heading, style, body);
}

std::string paragraph(const std::string& text) {
  return fmt::format("<p>{}</p>\n", escaped_text(text));
}

std::string line_to_write(const std::string& word) {
  return fmt::format("{} <span class=\"line\"></span>\n", escaped_text(word));
}

}  // namespace vibrosow
