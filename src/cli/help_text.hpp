#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace vibrosow {

/// Help in lines of 80 columns, an option's values named without their ranges, which an error states.
class HelpText : public CLI::Formatter {
 public:
  HelpText() { column_width(26); }
  std::string make_description(const CLI::App* app) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;

 private:
  std::string entry(const std::string& name, const std::string& description) const;
};

/// Lines that can be typed as they stand, in this order, after those of the commands before: a test does.
void add_examples(CLI::App& command, const std::vector<std::string>& lines);

}  // namespace vibrosow
