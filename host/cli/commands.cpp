// SPDX-License-Identifier: GPL-3.0-or-later
// commands.cpp  Lists the commands, one per line.
#include "host/cli/commands.hpp"

#include "host/cli/tool_commands/bench_command.hpp"
#include "host/cli/tool_commands/calibrate_command.hpp"
#include "host/cli/scene_commands/check_command.hpp"
#include "host/cli/tool_commands/ct_command.hpp"
#include "host/cli/tool_commands/fit_command.hpp"
#include "host/cli/terminal/help.hpp"
#include "host/cli/scene_commands/info_command.hpp"
#include "host/cli/scene_commands/new_command.hpp"
#include "host/cli/tool_commands/python_commands.hpp"
#include "host/cli/scene_commands/run_command.hpp"
#include "host/cli/tool_commands/shapes_command.hpp"
#include "host/cli/shell_command.hpp"
#include "host/cli/scene_commands/specimen_command.hpp"
#include "macadam/version.hpp"

namespace macadam {

void make_command_line(CLI::App& app) {
  app.description("Macadam: discrete elements for bituminous mixtures and other bonded granular solids");
  app.name("macadam");
  app.formatter(std::make_shared<HelpFormatter>());  // commands that are added later inherit the formatter
  app.require_subcommand(1);
  app.set_help_flag("-h,--help", "print this help and exit; after a command, the help of that command");
  app.set_version_flag("--version", version(), "print the version and exit");
  add_examples(app, {"macadam run examples/demo/scene.toml --out results", "macadam run --help"});
  add_run_command(app);
  add_specimen_command(app);
  add_shapes_command(app);
  add_fit_command(app);
  add_calibrate_command(app);
  add_ct_command(app);
  add_info_command(app);
  add_new_command(app);
  add_check_command(app);
  add_bench_command(app);
  add_python_commands(app);
  add_shell_commands(app);
}

}  // namespace macadam
