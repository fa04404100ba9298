// Tries every file of the given folders, in the order of their names, where there is no libFuzzer.
// Usage: corpus_TARGET FOLDER...

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz/try_bytes.hpp"

int main(int count, char** arguments) {
  std::vector<std::filesystem::path> files;
  for (int i = 1; i < count; ++i)
    for (const auto& entry : std::filesystem::directory_iterator(arguments[i]))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::ranges::sort(files);
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    try {
      vibrosow::try_bytes(bytes);
    } catch (...) {
      std::fprintf(stderr, "%s:\n", file.c_str());
      throw;  // ends the program with what it was
    }
  }
  std::printf("%zu files tried\n", files.size());
  return files.empty() ? 1 : 0;
}
