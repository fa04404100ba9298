#pragma once

#include <functional>
#include <string>

#include "result/snapshot.hpp"

namespace vibrosow {

/// Calls `look` with the bed of every frame of a recording (Recording::file), in order: its time, and of its grains
/// id, lot, radius, place and how clumps lie; nothing else of a Snapshot is set. Contacts and maps are passed over.
/// Throws InputError for what is no recording, or a damaged one.
void read_recording(const std::string& file, const std::function<void(const Snapshot&)>& look);

}  // namespace vibrosow
