#pragma once

#include <string>

namespace vibrosow {

/// Every file that the program writes and every column and key in it, as Markdown: docs/reference/output.md.
std::string output_documentation();

}  // namespace vibrosow
