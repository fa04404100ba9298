#pragma once

#include <vector>

#include "input/table.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Whether every lot's crop names its contact model, so that [contact] may be left out.
bool crops_have_contacts(const std::vector<SeedLot>& lots);

/// Reads [contact] with its walls and pairs of materials, and into `lots` the material keys of [seeds.NAME]. `seeds` is
/// the table [seeds]. Where the seeder itself makes a choice (a law, say), keys of a contact model or a crop that the
/// choice rules out are left out; written in the seeder they are an error. With model = "crop", and without a model in
/// a table that has neither a law nor both stiffness and friction, each lot has the contact model of its crop, over
/// which the table's keys lie; between two lots is the mean of both. What all seeds share, as drag, must be the same in
/// all models. Throws InputError like read_scene.
Contact read_contact(Table table, Table seeds, std::vector<SeedLot>& lots);

}  // namespace vibrosow
