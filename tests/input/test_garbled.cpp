// Whatever a file holds is read or refused with a message that names it: no crash, no other exception.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "input/read_scene.hpp"
#include "scene/input_error.hpp"
#include "temporary_file.hpp"

namespace vibrosow {
namespace {

std::vector<std::string> shipped_texts() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data_directory()))
    if (entry.path().extension() == ".toml" && (entry.path().string().find("/seeders/") != std::string::npos ||
                                                entry.path().string().find("/models/") != std::string::npos))
      files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<std::string> texts;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return texts;
}

class Garbled : public testing::Test {
 protected:
  void expect_read_or_refused(const std::string& text) {
    const auto file = folder_.write("seeder.toml", text);
    try {
      read_scene(file);
      ++read_;
    } catch (const InputError& error) {
      ++refused_;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << text;
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << "\n" << text;
    }
  }

  TemporaryFolder folder_;
  std::mt19937 random_{1};
  int read_ = 0, refused_ = 0;
};

TEST_F(Garbled, CutOff) {
  for (const std::string& text : shipped_texts())
    for (std::size_t length = random_() % 100; length < text.size(); length += 40 + random_() % 120)
      expect_read_or_refused(text.substr(0, length));
  EXPECT_GT(refused_, 100);
}

TEST_F(Garbled, BytesChangedTakenOutOrDoubled) {
  const std::string bytes = "=.,[]{}\"'#\n-+e0\\\x1b\xff";
  for (const std::string& text : shipped_texts()) {
    for (int variant = 0; variant < 12; ++variant) {
      std::string garbled = text;
      for (int change = 0; change < 3; ++change) {
        const std::size_t at = random_() % garbled.size(), length = 1 + random_() % 20;
        switch (random_() % 3) {
          case 0:
            garbled[at] = bytes[random_() % bytes.size()];
            break;
          case 1:
            garbled.erase(at, length);
            break;
          default:
            garbled.insert(at, garbled.substr(at, length));
        }
      }
      expect_read_or_refused(garbled);
    }
  }
  EXPECT_GT(read_, 10);
  EXPECT_GT(refused_, 100);
}

}  // namespace
}  // namespace vibrosow
