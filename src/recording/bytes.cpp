#include "recording/bytes.hpp"

#include <zlib.h>

#include <new>

namespace vibrosow {

void append_planes(std::string& bytes, const std::vector<std::uint32_t>& values) {
  for (int shift = 0; shift < 32; shift += 8)
    for (const std::uint32_t value : values) bytes.push_back(static_cast<char>(value >> shift & 0xff));
}

std::string packed(const std::string& bytes) {
  z_stream stream{};
  // "Filtered": for small numbers that scatter, of which little repeats.
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS, MAX_MEM_LEVEL, Z_FILTERED) != Z_OK)
    throw std::bad_alloc();
  std::string result(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<z_const Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  deflate(&stream, Z_FINISH);  // whole at once: there is room
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

}  // namespace vibrosow
