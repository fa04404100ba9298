#include "storage/case_file.hpp"

#include <fmt/format.h>
#include <xxhash.h>
#include <zstd.h>

#include <cereal/types/string.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "result/archive.hpp"
#include "result/results_version.hpp"
#include "result/run_check.hpp"
#include "scene/checked_json.hpp"
#include "scene/input_error.hpp"
#include "scene/printable.hpp"
#include "scene/scene_json.hpp"

namespace vibrosow {

template <class Archive>
void serialize(Archive& archive, ToleratedViolations& l) {
  archive(l.deep_steps, l.strides, l.energy_accounts);
}
/// A run but for its times. (A checkpoint has another form of a Run, so this one has a type of its own.)
struct WholeRun {
  Run& run;
};
template <class Archive>
void serialize(Archive& archive, WholeRun& whole) {
  Run& r = whole.run;
  archive(r.status, r.stop_reason, r.end_reason, r.warnings, r.outside_the_model, r.random_seed, r.dt, r.steps,
          r.end_time, r.grain_steps, r.force_evaluations, r.slip_speed_raised, r.let_pass, r.max_relative_overlap,
          r.tray_at_begin, r.tray_at_end, r.tray_empty_since, r.energy, r.balance, r.events, r.snapshots);
}

namespace {

/// Then come the hash of the content, a blank, the hash of all that follows it and a line's end; and the content,
/// compressed.
constexpr std::string_view signature = "vibrosow case 4 ";
constexpr std::size_t hash_digits = 16;
constexpr int compression_level = 3;

[[noreturn]] void refuse(const std::string& reason) {
  throw InputError("the case does not fit: " + reason);
}

using Compressor = std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)>;

std::string compressed(const std::string& text) {
  const Compressor compressor(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  ZSTD_CCtx_setParameter(compressor.get(), ZSTD_c_compressionLevel, compression_level);
  std::string bytes(ZSTD_compressBound(text.size()), '\0');
  const std::size_t size = ZSTD_compress2(compressor.get(), bytes.data(), bytes.size(), text.data(), text.size());
  if (ZSTD_isError(size)) throw InputError(fmt::format("a run cannot be compressed: {}", ZSTD_getErrorName(size)));
  bytes.resize(size);
  return bytes;
}

std::string hash_of(std::string_view bytes) {
  return fmt::format("{:0{}x}", XXH3_64bits(bytes.data(), bytes.size()), hash_digits);
}

/// The first line, and what it says of the rest.
std::string head(const std::string& content_hash, std::string_view compressed) {
  XXH3_state_t* const state = XXH3_createState();
  XXH3_64bits_reset(state);
  XXH3_64bits_update(state, content_hash.data(), content_hash.size());
  XXH3_64bits_update(state, compressed.data(), compressed.size());
  const XXH64_hash_t hash = XXH3_64bits_digest(state);
  XXH3_freeState(state);
  return fmt::format("{}{} {:0{}x}\n", signature, content_hash, hash, hash_digits);
}
constexpr std::size_t head_size = signature.size() + 2 * hash_digits + 2;

/// What so many compressed bytes may become: a run's numbers shrink to a third, a bed at rest to a tenth. Somebody
/// else's could become the ten thousandfold.
std::size_t most_of(std::size_t compressed) {
  constexpr std::size_t at_least = std::size_t{1} << 26, most_times = 50;
  return at_least + most_times * compressed;
}

/// Piece by piece, so that a damaged size asks for no memory.
std::string decompressed(std::string_view bytes) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> decompressor(ZSTD_createDCtx(), &ZSTD_freeDCtx);
  std::string text, piece(ZSTD_DStreamOutSize(), '\0');
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  std::size_t left = 1;
  for (bool full = false; left != 0 && (full || in.pos < in.size);) {
    ZSTD_outBuffer out{piece.data(), piece.size(), 0};
    left = ZSTD_decompressStream(decompressor.get(), &out, &in);
    if (ZSTD_isError(left) || text.size() + out.pos > most_of(bytes.size())) refuse("it is damaged");
    text.append(piece, 0, out.pos);
    full = out.pos == out.size;
  }
  if (left != 0 || in.pos != in.size) refuse("it is damaged");
  return text;
}

/// Whether the steps of a run make up its time, and no more grains took them than were put in.
bool has_its_steps(const Run& run) {
  const auto steps = static_cast<double>(run.steps);
  return std::abs(run.end_time - steps * run.dt) <= 1e-12 * run.end_time &&
         static_cast<double>(run.grain_steps) <= steps * static_cast<double>(run.balance.put_in);
}

/// Whether a run may be the one of an identity.
bool is_run_of(const std::string& identity, const Run& run) {
  const auto json = parse_json<nlohmann::json>(identity);
  const auto& scene = json.at("scene");
  const RunBounds bounds{scene.at("lots").size(), scene.at("tray").at("holes").size(),
                         scene.at("run").at("duration_s")};
  return run.random_seed == json.at("random_seed") && is_possible(run, bounds) && is_balanced(run.balance) &&
         has_its_steps(run);
}

/// Its texts as they may be shown and written.
void make_printable(Run& run) {
  for (std::string* text : {&run.stop_reason, &run.end_reason}) *text = printable(*text);
  for (Doubt& warning : run.warnings) warning.text = printable(warning.text);
}

}  // namespace

std::string untitled_json(const Scene& scene) {
  Scene untitled = scene;
  untitled.title.clear();
  return scene_to_json(untitled);
}

std::string case_identity(const Scene& scene, std::uint64_t random_seed) {
  return case_identity(untitled_json(scene), random_seed);
}

std::string case_identity(const std::string& untitled_json, std::uint64_t random_seed) {
  return fmt::format(R"({{"results_version":{},"random_seed":{},"scene":{}}})", results_version, random_seed,
                     untitled_json);
}

std::string case_name(std::string_view identity) {
  const XXH128_hash_t hash = XXH3_128bits(identity.data(), identity.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string case_bytes(std::string_view identity, const Run& run) {
  std::ostringstream text;
  {
    cereal::PortableBinaryOutputArchive archive(text);
    Run copy = run;
    WholeRun whole{copy};
    archive(std::string(identity), whole);
  }
  const std::string content = text.str(), small = compressed(content);
  return head(hash_of(content), small) + small;
}

std::string content_of_case(std::string_view bytes) {
  if (bytes.size() < head_size) return "";
  const std::string content_hash(bytes.substr(signature.size(), hash_digits));
  return bytes.substr(0, head_size) == head(content_hash, bytes.substr(head_size)) ? content_hash : "";
}

bool is_case_of_other_version(std::string_view bytes) {
  return bytes.starts_with("vibrosow case ") && !bytes.starts_with(signature);
}

Case read_case(std::string_view bytes) {
  if (!bytes.starts_with(signature)) refuse("it is no case of this version of Vibrosow");
  const std::string content_hash = content_of_case(bytes);
  if (content_hash.empty()) refuse("it is damaged");
  const std::string content = decompressed(bytes.substr(head_size));
  if (hash_of(content) != content_hash) refuse("it is damaged");
  std::istringstream text(content);
  try {
    InputArchive archive(text);
    Case read;
    WholeRun whole{read.run};
    archive(read.identity, whole);
    if (!is_run_of(read.identity, read.run)) refuse("no run of its scene is such");
    make_printable(read.run);
    return read;
  } catch (const cereal::Exception&) {
    refuse("it ends too early");
  } catch (const nlohmann::json::exception&) {
    refuse("its scene is none");
  }
}

}  // namespace vibrosow
