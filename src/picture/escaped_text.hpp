#pragma once

#include <string>

namespace vibrosow {

/// Text as it stands in an XML or HTML document, also in an attribute. For characters that such a document must not
/// hold stands the sign of an unknown one.
std::string escaped_text(const std::string& text);

}  // namespace vibrosow
