// SPDX-License-Identifier: GPL-3.0-or-later
// completion.cpp  Makes completion scripts for shells from the command line.
#include <fmt/format.h>

#include <functional>

#include "host/cli/terminal/help.hpp"
#include "host/cli/shell_command.hpp"

namespace macadam {
namespace {

using Visit = std::function<void(const CLI::App&, const std::string& path)>;

void for_each_command(const CLI::App& command, const std::string& path, const Visit& visit) {
  visit(command, path);
  for (const CLI::App* below : command.get_subcommands(nullptr))
    for_each_command(*below, path + " " + below->get_name(), visit);
}

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

/// Returns "--help" and "-h" for "-h,--help".
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> out;
  for (const std::string& name : option.get_lnames()) out.push_back("--" + name);
  for (const std::string& name : option.get_snames()) out.push_back("-" + name);
  return out;
}

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> out;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : names_of(*option)) out.push_back(name);
  return out;
}

std::vector<std::string> commands_of(const CLI::App& command) {
  std::vector<std::string> out;
  for (const CLI::App* below : command.get_subcommands(nullptr)) out.push_back(below->get_name());
  return out;
}

/// Returns "cpu" and "cuda" for "cpu|cuda"; nothing for an option without choices.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string value = value_of(option);
  return value.find('|') == std::string::npos ? std::vector<std::string>{} : CLI::detail::split(value, '|');
}

/// Returns the bash code that completes the value of an option or of a positional argument; empty if nothing can be
/// offered.
std::string bash_values(const CLI::Option& option) {
  if (const auto choices = choices_of(option); !choices.empty())
    return fmt::format("COMPREPLY=($(compgen -W \"{}\" -- \"$cur\"))", joined(choices));
  const bool folder = value_of(option) == "FOLDER";
  if (folder || value_of(option) == "FILE")
    return fmt::format("compopt -o filenames; IFS=$'\\n'; COMPREPLY=($(compgen -{} -- \"$cur\"))", folder ? 'd' : 'f');
  return "";
}

constexpr const char* bash_script = R"(# bash completion for macadam; made by macadam completion bash
_macadam() {{
  local IFS=$' \t\n' cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} path=macadam word
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case "$path $word" in
      {}) path="$path $word" ;;
    esac
  done
  COMPREPLY=()
  case "$path $prev" in
{}  esac
  if [[ $cur == -* ]]; then
    case "$path" in
{}    esac
    return
  fi
  case "$path" in
{}  esac
}}
complete -F _macadam macadam
)";

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::vector<std::string> paths;
  std::string values, options, words;
  for_each_command(app, "macadam", [&](const CLI::App& command, const std::string& path) {
    if (&command != &app) paths.push_back('"' + path + '"');
    std::string positional;
    for (const CLI::Option* option : command.get_options()) {
      if (option->get_positional()) {
        positional = bash_values(*option);
      } else if (!value_of(*option).empty()) {
        const std::string offered = bash_values(*option);
        for (const std::string& name : names_of(*option))
          values += fmt::format("    \"{} {}\") {}return ;;\n", path, name, offered.empty() ? "" : offered + "; ");
      }
    }
    options += fmt::format("      \"{}\") COMPREPLY=($(compgen -W \"{}\" -- \"$cur\")) ;;\n", path,
                           joined(options_of(command)));
    if (const auto below = commands_of(command); !below.empty())
      words += fmt::format("    \"{}\") COMPREPLY=($(compgen -W \"{}\" -- \"$cur\")) ;;\n", path, joined(below));
    else if (!positional.empty())
      words += fmt::format("    \"{}\") {} ;;\n", path, positional);
  });
  return fmt::format(bash_script, fmt::join(paths, "|"), values, options, words);
}

std::string zsh_completion(const CLI::App& app) {
  return "#compdef macadam\n# made by macadam completion zsh. bashcompinit makes the bash functions below work in "
         "zsh.\n"
         "autoload -Uz bashcompinit && bashcompinit\n" +
         bash_completion(app) + "_bash_complete -F _macadam macadam\n";
}

std::string fish_completion(const CLI::App& app) {
  const auto quoted = [](std::string text) {
    for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 2) text.insert(at, "\\");
    return "'" + text + "'";
  };
  std::string out = "# fish completion for macadam; made by macadam completion fish\n";
  for_each_command(app, "macadam", [&](const CLI::App& command, const std::string& path) {
    // The condition under which fish offers the words below: this command was typed, and none of its subcommands.
    std::string when;
    for (const std::string& word : CLI::detail::split(path, ' '))
      if (word != "macadam") when += (when.empty() ? "" : "; and ") + ("__fish_seen_subcommand_from " + word);
    const auto below = commands_of(command);
    if (!below.empty())
      when += (when.empty() ? "not " : "; and not ") + ("__fish_seen_subcommand_from " + joined(below));
    const std::string begin = fmt::format("complete -c macadam -n {}", quoted(when));
    for (const CLI::App* one : command.get_subcommands(nullptr))
      out += fmt::format("{} -f -a {} -d {}\n", begin, one->get_name(), quoted(one->get_description()));
    for (const CLI::Option* option : command.get_options()) {
      if (option->get_positional() || option->get_lnames().empty()) continue;
      std::string value;
      if (const auto choices = choices_of(*option); !choices.empty())
        value = " -x -a " + quoted(joined(choices));
      else if (value_of(*option) == "FILE" || value_of(*option) == "FOLDER")
        value = " -r -F";
      else if (!value_of(*option).empty())
        value = " -x";
      out += fmt::format("{} -l {}{} -d {}\n", begin, option->get_lnames().front(), value,
                         quoted(option->get_description()));
    }
  });
  return out;
}

}  // namespace macadam
