#pragma once

#include <string>
#include <vector>

#include "report/columns.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// A seeder to begin with.
struct StudioSeeder {
  std::string name;
  std::string text;  // of its file
  Scene scene;       // as it is written, before an accuracy level counts
  bool own = false;  // the user's: a link carries the whole of it
};

/// A crop that any seeder can be given: lots and contact of `scene` are what `[seeds.NAME] crop = "NAME"` and
/// `[contact] model` make of it.
struct StudioCrop {
  std::string name, title, model;
  Scene scene;
};

struct StudioPage {
  std::vector<StudioSeeder> seeders;
  std::vector<StudioCrop> crops;
  std::string opened;  // name of the seeder that is shown first
};

/// studio.html: the template with these in it (filled_page).
std::string studio_page(const std::string& page_template, const StudioPage& page);

/// What the file holds.
FileText studio_page_text();

}  // namespace vibrosow
