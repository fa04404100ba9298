#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "result/run.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// What a run is of, as one line of JSON: the version of the results, the random seed and the canonical scene
/// without its title.
std::string case_identity(const Scene& scene, std::uint64_t random_seed);

/// The same of a scene's `untitled_json`, for many random seeds.
std::string case_identity(const std::string& untitled_json, std::uint64_t random_seed);
std::string untitled_json(const Scene& scene);

/// The name of its file: 32 hexadecimal digits, the 128-bit XXH3 of the identity.
std::string case_name(std::string_view identity);

/// A run with its identity as bytes, compressed and with a checksum. Holds nothing of clocks and hosts.
std::string case_bytes(std::string_view identity, const Run& run);

/// A run and what it is of.
struct Case {
  std::string identity;
  Run run;  // its times are 0
};

/// Whether such bytes are a case as another version of the program writes it.
bool is_case_of_other_version(std::string_view bytes);

/// What such bytes hold. Throws InputError with the reason where they are no case or are damaged.
Case read_case(std::string_view bytes);

/// Hash of what such bytes hold, whatever compressed them; 16 hexadecimal digits, empty where they are no case or are
/// damaged. Quick: nothing is decompressed.
std::string content_of_case(std::string_view bytes);

}  // namespace vibrosow
