// SPDX-License-Identifier: GPL-3.0-or-later
// python_commands.cpp  Adds the commands that the Python package runs.
#include "host/cli/tool_commands/python_commands.hpp"

#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/python_package.hpp"

namespace macadam {

void add_python_commands(CLI::App& app) {
  const auto add = [&](const std::string& name, const char* description, const std::vector<std::string>& examples) {
    CLI::App* command = app.add_subcommand(name, description);
    command->prefix_command();
    command->set_help_flag();  // the Python command prints its own help
    add_examples(*command, examples);
    command->callback([command, name] { run_python(name, command->remaining()); });
  };
  add("report", "one HTML file about folders of results (by the Python package)",
      {"macadam report results --out report.html", "macadam report --help"});
  add("mixture", "|E*| of a mixture from binder and recipe (by the Python package)",
      {"macadam mixture examples/mixture/design.toml --out results/mixture", "macadam mixture --help"});
  add("mcp", "tools for assistants that speak the Model Context Protocol (by the Python package)",
      {"macadam mcp --folder mixes", "macadam mcp --help"});
  add("study", "many scenes, on this machine or several (by the Python package)",
      {"macadam study examples/study/study.toml --out results/study", "macadam study --help"});
}

}  // namespace macadam
