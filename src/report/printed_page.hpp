#pragma once

#include <string>

namespace vibrosow {

/// A page to print on A4, that a phone shows as well: HTML that needs no script and no other file. `body` is HTML;
/// `title` is text, which heads it too.
std::string printed_page(const std::string& title, const std::string& body);

/// Parts of its body: text as a paragraph; a line to write on by hand, after a word.
std::string paragraph(const std::string& text);
std::string line_to_write(const std::string& word);

}  // namespace vibrosow
