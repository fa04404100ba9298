#pragma once

// Everything that reads TOML includes it through here, so that it is set up the same everywhere.
#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>
