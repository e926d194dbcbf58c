// SPDX-License-Identifier: GPL-3.0-or-later
// help.cpp  Formats the lines of help.
#include "host/cli/terminal/help.hpp"

#include <fmt/format.h>

#include <regex>
#include <sstream>

namespace macadam {
namespace {

constexpr std::size_t width = 100, column = 32;
const std::string examples_title = "Examples:";

/// Returns `left`, followed by the text, which begins at `column` and is wrapped to the width of a line.
std::string entry(const std::string& left, const std::string& text) {
  std::string out = "  " + left;
  if (out.size() + 2 > column)
    out += '\n' + std::string(column, ' ');
  else
    out.resize(column, ' ');
  std::size_t at = column;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (at > column && at + 1 + word.size() > width) out += '\n' + std::string(column, ' '), at = column;
    if (at > column) out += ' ', ++at;
    out += word;
    at += word.size();
  }
  return out + '\n';
}

std::string shown_value(const CLI::Option& option) {
  const std::string value = value_of(option);
  if (value.empty()) return "";
  return " " + value + (option.get_expected_max() == CLI::detail::expected_max_vector_size ? " ..." : "");
}

}  // namespace

std::string value_of(const CLI::Option& option) {
  return option.get_type_size() == 0 || option.get_expected_max() == 0 ? "" : option.get_type_name();
}

std::string description_of(const CLI::Option& option) {
  std::string text = option.get_description();
  if (option.get_required() && !option.get_positional()) text += " (required)";
  if (!option.get_default_str().empty()) text += fmt::format(" [{}]", option.get_default_str());
  std::string others;
  for (const CLI::Option* other : option.get_excludes()) others += (others.empty() ? "" : ", ") + other->get_name();
  return others.empty() ? text : text + "; not with " + others;
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool positional) const {
  constexpr std::size_t longest = 80;  // a longer list of choices goes into the description, whose lines are wrapped
  std::string value = shown_value(*option), text = description_of(*option);
  if (value.size() > longest) {
    text += "; one of" + std::regex_replace(value, std::regex("\\|"), ", ");
    value = " NAME";
  }
  return entry(option->get_name(positional, !positional) + value, text);
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  return entry(command->get_name(), command->get_description());
}

std::string HelpFormatter::make_group(std::string group, bool positional,
                                      std::vector<const CLI::Option*> options) const {
  std::string out = (group == "Options" || positional ? "\n" : "") + (positional ? "Arguments" : group) + ":\n";
  for (const CLI::Option* option : options) out += make_option(option, positional);
  return out;
}

std::string HelpFormatter::make_subcommands(const CLI::App* command, CLI::AppFormatMode) const {
  std::string out;
  for (const CLI::App* below : command->get_subcommands(nullptr)) out += make_subcommand(below);
  return out.empty() ? out : "\nCommands:\n" + out;
}

std::string HelpFormatter::make_usage(const CLI::App* command, std::string name) const {
  std::string out = "\nUsage: " + name;
  for (const CLI::Option* option : command->get_options()) {
    const bool many = option->get_expected_max() == CLI::detail::expected_max_vector_size;
    if (option->get_positional())
      out += (option->get_required() ? " " : " [") + option->get_name(true) + (many ? "..." : "") +
             (option->get_required() ? "" : "]");
    else if (option->get_required())
      out += " " + option->get_name() + shown_value(*option);
  }
  if (!command->get_subcommands(nullptr).empty()) out += " COMMAND";
  return out + " [OPTIONS]\n";
}

void add_examples(CLI::App& command, const std::vector<std::string>& lines) {
  command.footer(fmt::format("{}\n  {}", examples_title, fmt::join(lines, "\n  ")));
}

std::vector<std::string> examples_of(const CLI::App& command) {
  const std::string footer = command.get_footer();
  std::vector<std::string> out;
  std::istringstream lines(footer);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  macadam")) out.push_back(line.substr(2));
  return out;
}

}  // namespace macadam
