// Reduces kept runs of seeders/atlas.toml to points of the atlas of repose: CSV.
// Usage: repose_atlas STUDY FOLDER [STUDY FOLDER]..

#include <iostream>
#include <vector>

#include "repose_runs.hpp"

int main(int argc, char** argv) {
  using namespace vibrosow;
  if (argc < 3 || argc % 2 == 0) {
    std::cerr << "usage: repose_atlas STUDY FOLDER [STUDY FOLDER]..\n";
    return 2;
  }
  try {
    std::vector<AtlasPoint> points;
    for (int k = 1; k + 1 < argc; k += 2)
      for (const ReposeMaterial& material : kept_materials(argv[k], argv[k + 1]))
        points.push_back(atlas_point(material.scene, material.runs));
    std::cout << atlas_csv(points);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
