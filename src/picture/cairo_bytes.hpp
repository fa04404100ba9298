#pragma once

#include <cairo.h>

#include <new>
#include <string>

namespace vibrosow {

/// What cairo calls to write into a std::string.
inline cairo_status_t append_bytes(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

/// With sizes of a picture that was made, the library knows of no error but that memory runs out.
inline void check_cairo(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw std::bad_alloc();
}

}  // namespace vibrosow
