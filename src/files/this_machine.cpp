#include "files/this_machine.hpp"

#include <unistd.h>

#include <array>
#include <filesystem>
#include <system_error>

namespace vibrosow {

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::string place_of_processes() {
  std::error_code none;
  return host_name() + " " + std::filesystem::read_symlink("/proc/self/ns/pid", none).string();
}

}  // namespace vibrosow
