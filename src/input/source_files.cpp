#include "input/source_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <system_error>

#include "files/whole_file.hpp"
#include "input/read_scene.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {

namespace {

std::string key_of(const std::filesystem::path& file) {
  std::error_code none;
  return std::filesystem::absolute(file, none).lexically_normal().string();
}

constexpr std::string_view shipped_prefix = "<shipped>/";

/// None where the program finds none.
std::optional<std::filesystem::path> shipped_folder() {
  try {
    return std::filesystem::weakly_canonical(data_directory());
  } catch (const InputError&) {
    return std::nullopt;
  }
}

bool is_below(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const std::filesystem::path from = file.lexically_relative(folder);
  return !from.empty() && *from.begin() != ".." && *from.begin() != ".";
}

/// Over whatever links.
std::filesystem::path real_path(const std::filesystem::path& file) {
  std::error_code none;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(std::filesystem::absolute(file, none), none);
  return none ? std::filesystem::path(key_of(file)) : whole;
}

/// The path of a shipped seeder, study or model from the data's folder; none of any other file.
std::optional<std::string> shipped_name(const std::filesystem::path& file) {
  const auto shipped = shipped_folder();
  const std::filesystem::path real = real_path(file);
  if (!shipped || !(is_below(real, *shipped / "models") || is_below(real, *shipped / "seeders"))) return std::nullopt;
  return real.lexically_relative(*shipped).string();
}

bool is_shipped(const std::filesystem::path& file) {
  return shipped_name(file).has_value();
}

}  // namespace

const std::string& SourceFiles::read(const std::filesystem::path& file) {
  ++reads_;
  const std::string key = key_of(file);
  const auto frozen = frozen_.find(key);
  if (frozen == frozen_.end() && is_of_plan_ && !is_shipped(file))
    throw InputError(file.string() + ": the plan keeps no such file");
  return texts_[key] = frozen != frozen_.end() ? frozen->second : text_of_wanted_file(file);
}

bool SourceFiles::has(const std::filesystem::path& file) const {
  std::error_code none;
  if (frozen_.contains(key_of(file))) return true;
  return (!is_of_plan_ || is_shipped(file)) && std::filesystem::is_regular_file(file, none);
}

const TomlTable& SourceFiles::toml(const std::filesystem::path& file) {
  const auto known = toml_.find(file);
  if (known != toml_.end()) return known->second;
  const std::string& text = read(file);
  try {
    return toml_.emplace(file, parse_toml(text)).first->second;
  } catch (const TomlError& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", file.string(), error.line, error.what()));
  }
}

const std::string& SourceFiles::text(const std::filesystem::path& file) {
  const auto known = texts_.find(key_of(file));
  return known != texts_.end() ? known->second : read(file);
}

const CsvLines& SourceFiles::csv(const std::filesystem::path& file) {
  const auto known = csv_.find(file);
  if (known != csv_.end()) return known->second;
  return csv_.emplace(file, parse_csv_lines(read(file), file.string())).first->second;
}

std::string name_in_plan(const std::filesystem::path& file, const std::filesystem::path& study) {
  if (const auto shipped = shipped_name(file)) return std::string(shipped_prefix) + *shipped;
  return std::filesystem::path(key_of(file))
      .lexically_relative(std::filesystem::path(key_of(study)).parent_path())
      .string();
}

std::filesystem::path path_of_planned(const std::string& name) {
  if (!name.starts_with(shipped_prefix)) return name;
  return shipped_folder().value_or("") / name.substr(shipped_prefix.size());
}

void SourceFiles::note(const std::string& sentence) {
  if (std::ranges::find(notes_, sentence) == notes_.end()) notes_.push_back(sentence);
}

std::shared_ptr<SourceFiles> SourceFiles::of_plan(const std::map<std::string, std::string>& texts) {
  auto files = std::make_shared<SourceFiles>();
  files->is_of_plan_ = true;
  for (const auto& [name, text] : texts) files->frozen_[key_of(path_of_planned(name))] = text;
  return files;
}

std::map<std::string, std::string> SourceFiles::planned_texts(const std::filesystem::path& study) const {
  std::map<std::string, std::string> planned;
  for (const auto& [path, text] : texts_) planned[name_in_plan(path, study)] = text;
  return planned;
}

std::vector<std::string> warnings_of_files_outside(const SourceFiles& files,
                                                   const std::vector<std::filesystem::path>& folders) {
  std::vector<std::string> warnings;
  for (const auto& [path, text] : files.texts()) {
    const std::filesystem::path file = real_path(path);
    const bool inside = std::ranges::any_of(folders, [&](const std::filesystem::path& folder) {
      return is_below(file, real_path(folder.empty() ? "." : folder));
    });
    if (!inside && !is_shipped(file))
      warnings.push_back(fmt::format("{} is read, which lies outside of the seeder's folder", file.string()));
  }
  return warnings;
}

}  // namespace vibrosow
