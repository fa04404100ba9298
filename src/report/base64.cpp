#include "report/base64.hpp"

#include <algorithm>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <string_view>

namespace vibrosow {

using namespace boost::archive::iterators;

std::string base64(const std::string& bytes) {
  using Encoded = base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
  std::string text(Encoded(bytes.begin()), Encoded(bytes.end()));
  text.append((3 - bytes.size() % 3) % 3, '=');
  return text;
}

std::optional<std::string> from_base64(std::string text) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t end = std::min(text.find('='), text.size()), padding = text.size() - end;
  if (text.size() % 4 != 0 || padding > 2 || text.find_first_not_of(alphabet) < end ||
      text.find_first_not_of('=', end) != std::string::npos)
    return std::nullopt;
  std::fill(text.begin() + static_cast<std::ptrdiff_t>(end), text.end(), 'A');
  using Decoded = transform_width<binary_from_base64<std::string::const_iterator>, 8, 6>;
  std::string bytes(Decoded(text.begin()), Decoded(text.end()));
  bytes.resize(bytes.size() - std::min(padding, bytes.size()));
  return bytes;
}

}  // namespace vibrosow
