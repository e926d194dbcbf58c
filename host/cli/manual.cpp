// SPDX-License-Identifier: GPL-3.0-or-later
// manual.cpp  Makes a manual page from the command line, in the macros of man(7).
#include <fmt/format.h>

#include "host/cli/terminal/help.hpp"
#include "host/cli/shell_command.hpp"
#include "macadam/version.hpp"

namespace macadam {
namespace {

/// Escapes the characters of a text that troff would interpret.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n'))
      out += std::string("\\&") + c;
    else if (c == '\'')
      out += "\\(aq";
    else
      out += c;
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }

std::string option_entry(const CLI::Option& option) {
  const bool positional = option.get_positional();
  std::string out = ".TP\n" + bold(option.get_name(positional, !positional));
  if (const std::string value = value_of(option); !value.empty() && !positional)
    out += " \\fI" + escaped(value) + "\\fR";
  return out + "\n" + escaped(description_of(option)) + "\n";
}

std::string command_entry(const CLI::App& command, const std::string& name) {
  std::string out = fmt::format(".SS \"{}\"\n{}\n", escaped(name), escaped(command.get_description()));
  for (const CLI::Option* option : command.get_options())
    if (option != command.get_help_ptr()) out += option_entry(*option);
  const auto examples = examples_of(command);
  if (!examples.empty()) out += ".PP\nExamples:\n.PP\n.nf\n.RS\n";
  for (const std::string& example : examples) out += escaped(example) + "\n";
  if (!examples.empty()) out += ".RE\n.fi\n";
  for (const CLI::App* below : command.get_subcommands(nullptr))
    out += command_entry(*below, name + " " + below->get_name());
  return out;
}

}  // namespace

std::string manual_page(const CLI::App& app) {
  std::string out = fmt::format(
      ".\\\" made by macadam man\n.TH MACADAM 1 \"\" \"Macadam {}\" \"User Commands\"\n.SH NAME\nmacadam \\- discrete "
      "elements for bituminous mixtures and other bonded granular solids\n.SH SYNOPSIS\n{} \\fICOMMAND\\fR "
      "[\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n{}\n",
      escaped(version()), bold("macadam"),
      escaped(
          "Macadam makes a specimen of a mixture, tests it, and gives its complex modulus, its relaxation, its creep "
          "or its curve of stress and strain. A scene is a text file that describes the specimen and its test: "
          "\"macadam new\" writes one to start from, \"macadam run\" runs it."));
  out += ".SH OPTIONS\n";
  for (const CLI::Option* option : app.get_options()) out += option_entry(*option);
  out += ".SH COMMANDS\n";
  for (const CLI::App* command : app.get_subcommands(nullptr))
    out += command_entry(*command, "macadam " + command->get_name());
  out += ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\nthe run failed, or was interrupted\n.TP\n2\nthe input is wrong\n";
  out += ".SH ENVIRONMENT\n";
  for (const auto& [name, text] : std::initializer_list<std::pair<const char*, const char*>>{
           {"OMP_NUM_THREADS", "number of threads of the CPU, if neither the scene nor an option gives it"},
           {"OMP_WAIT_POLICY",
            "how idle threads of the CPU wait; if neither this nor GOMP_SPINCOUNT is set, macadam sets passive, which "
            "leaves their cores to other programs"},
           {"MACADAM_PYTHON",
            "Python interpreter that has the package macadam; the commands mixture, report and study need it"},
           {"MACADAM_PLUGIN_PATH", "folder of the libraries of the CUDA backend and of --ranks"}})
    out += fmt::format(".TP\n{}\n{}\n", bold(name), escaped(text));
  return out;
}

}  // namespace macadam
