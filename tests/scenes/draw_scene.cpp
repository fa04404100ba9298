// Writes the drawn scene of a number, and the tables that it names, into a folder. Usage: draw_scene NUMBER FOLDER
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "scenes/drawn_scene.hpp"

int main(int argument_count, char** arguments) {
  if (argument_count != 3) return std::fputs("usage: draw_scene NUMBER FOLDER\n", stderr), 2;
  const vibrosow::DrawnScene drawn(std::strtoull(arguments[1], nullptr, 10));
  for (const auto& [path, text] : drawn.texts())
    std::ofstream(std::filesystem::path(arguments[2]) / std::filesystem::path(path).filename()) << text;
  return 0;
}
