// SPDX-License-Identifier: GPL-3.0-or-later
// shell_command.cpp  Implements `macadam completion SHELL` and `macadam man`.
#include "host/cli/shell_command.hpp"

#include <memory>

#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/streams.hpp"

namespace macadam {
namespace {

enum class Shell : std::uint8_t { bash, zsh, fish };

}  // namespace

void add_shell_commands(CLI::App& app) {
  CLI::App& completion =
      *app.add_subcommand("completion", "print a script for tab completion of macadam commands in a shell");
  const auto shell = std::make_shared<Shell>(Shell::bash);
  add_choice(completion, "shell", *shell, "shell for which the script is made",
             {{"bash", Shell::bash}, {"zsh", Shell::zsh}, {"fish", Shell::fish}});
  add_examples(completion, {"macadam completion bash", "macadam completion fish"});
  completion.callback([&app, shell] {
    say_text(*shell == Shell::bash  ? bash_completion(app)
             : *shell == Shell::zsh ? zsh_completion(app)
                                    : fish_completion(app));
  });

  CLI::App& manual = *app.add_subcommand("man", "print the manual page; macadam man | man -l - shows it");
  add_examples(manual, {"macadam man"});
  manual.callback([&app] { say_text(manual_page(app)); });
}

}  // namespace macadam
