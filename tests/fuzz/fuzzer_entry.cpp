// libFuzzer's way in.

#include <cstddef>
#include <cstdint>

#include "fuzz/try_bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  vibrosow::try_bytes(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
