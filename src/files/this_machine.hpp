#pragma once

#include <string>

namespace vibrosow {

/// Name of the machine.
std::string host_name();

/// A machine's name and which numbers of processes it means: containers of one machine have numbers of their own.
std::string place_of_processes();

}  // namespace vibrosow
