#include "cli/help_text.hpp"

#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

/// "N", of which CLI11 makes "N:INT in [1 - 4096]".
std::string value_name(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  return name.substr(0, name.find(':'));
}

}  // namespace

std::string HelpText::entry(const std::string& name, const std::string& description) const {
  std::string label = "  " + name + " ";
  const bool beside = label.size() <= get_column_width();
  label.resize(std::max(label.size(), get_column_width()), ' ');
  return beside ? wrapped_beside(label, description) : "  " + name + '\n' + wrapped(description, get_column_width());
}

std::string HelpText::make_description(const CLI::App* app) const {
  return wrapped(app->get_description());
}

std::string HelpText::make_subcommand(const CLI::App* command) const {
  return entry(command->get_name(), command->get_description());
}

std::string HelpText::make_option(const CLI::Option* option, bool is_positional) const {
  std::string name = make_option_name(option, is_positional), description = option->get_description();
  const bool takes_value = option->get_type_size() != 0;
  if (takes_value && !is_positional) name += " " + value_name(*option);
  if (option->get_expected_max() == CLI::detail::expected_max_vector_size) name += ",...";
  if (takes_value && !option->get_default_str().empty()) description += "; default " + option->get_default_str();
  return entry(name, description);
}

void add_examples(CLI::App& command, const std::vector<std::string>& lines) {
  std::string text = "Examples:";
  for (const std::string& line : lines) text += "\n  " + line;
  command.footer(text);
}

}  // namespace vibrosow
