// Kept runs. The bytes are edits: first of what is compressed, which is then compressed and hashed anew, since no
// fuzzer would guess a hash; and of the file itself.

#include <xxhash.h>
#include <zstd.h>

#include <cstdio>

#include "fuzz/edits.hpp"
#include "fuzz/try_bytes.hpp"
#include "scene/input_error.hpp"
#include "storage/case_file.hpp"

namespace vibrosow {
namespace {

constexpr std::size_t hash_at = 16, hash_size = 16,
                      content_at = hash_at + 2 * hash_size + 2;  // after "vibrosow case 4 "

std::string good_case() {
  Scene scene;
  scene.lots = {{"a", 6e-3, 2e-4, Shape::ball, 1}};
  Run run;
  for (int k = 0; k < 20; ++k) run.events.push_back({0.1 * k, 1 + k % 3, 0, k, 2e-4, 0.01 * k, 1.5, 0});
  run.snapshots.resize(1);
  run.snapshots[0].x = {1, 2, 3};
  return case_bytes(case_identity(scene, 1), run);
}

std::string hash_of(const std::string& bytes) {
  char digits[hash_size + 1];
  std::snprintf(digits, sizeof digits, "%016llx",
                static_cast<unsigned long long>(XXH3_64bits(bytes.data(), bytes.size())));
  return digits;
}

/// With the right hash of the compressed bytes, which is also of the content's hash.
std::string with_right_hash(std::string file) {
  if (file.size() < content_at) return file;
  const std::string hash = hash_of(file.substr(hash_at, hash_size) + file.substr(content_at));
  return file.replace(hash_at + hash_size + 1, hash_size, hash);
}

std::string content_of(const std::string& file) {
  const char* bytes = file.data() + content_at;
  const std::size_t size = file.size() - content_at;
  std::string content(ZSTD_getFrameContentSize(bytes, size), '\0');
  ZSTD_decompress(content.data(), content.size(), bytes, size);
  return content;
}

std::string file_of(const std::string& good, const std::string& content) {
  std::string bytes(ZSTD_compressBound(content.size()), '\0');
  bytes.resize(ZSTD_compress(bytes.data(), bytes.size(), content.data(), content.size(), 1));
  return with_right_hash(good.substr(0, content_at).replace(hash_at, hash_size, hash_of(content)) + bytes);
}

void read_or_refuse(const std::string& file) {
  try {
    read_case(file);
  } catch (const InputError&) {
  }
}

}  // namespace

void try_bytes(const std::string& bytes) {
  static const std::string good = good_case(), content = content_of(good);
  read_or_refuse(edited(good, bytes));
  read_or_refuse(with_right_hash(edited(good, bytes)));
  read_or_refuse(file_of(good, edited(content, bytes)));
}

}  // namespace vibrosow
