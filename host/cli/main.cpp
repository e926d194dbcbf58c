// SPDX-License-Identifier: GPL-3.0-or-later
// main.cpp  The program: macadam run | specimen | shapes | fit | calibrate | ct | info | new | check | bench | report |
// mixture | study | completion | man. Exit code 0: done; 1: the run failed; 2: the input is wrong.
#include <CLI/CLI.hpp>
#include <new>
#include <string_view>

#include "host/cli/commands.hpp"
#include "host/cli/library_environment.hpp"
#include "host/cli/memory_reserve.hpp"
#include "host/cli/terminal/fault_signals.hpp"
#include "host/cli/terminal/json_lines.hpp"
#include "host/cli/terminal/streams.hpp"
#include "host/base/nearest.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Returns the innermost command that the command line names: `app` itself or one of its subcommands.
const CLI::App& reached(const CLI::App& app) {
  const auto below = app.get_subcommands();
  return below.empty() ? app : reached(*below.front());
}

/// Returns the names of the commands below a command, or of its options.
std::vector<std::string> known_words(const CLI::App& command, bool options) {
  std::vector<std::string> known;
  if (options) {
    for (const CLI::Option* o : command.get_options()) {
      if (!o->get_positional()) known.push_back(o->get_name());
    }
  } else {
    for (const CLI::App* below : command.get_subcommands(nullptr)) known.push_back(below->get_name());
  }
  return known;
}

/// Describes what is wrong with a command line. Names an unknown word rather than a missing one, because the missing
/// word is often the one that was misspelt; CLI11's own message would name the missing one.
std::string fault_of(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = reached(app);
  const std::vector<std::string> commands = known_words(command, false);
  std::vector<std::string> unknown = app.remaining(true);
  std::erase(unknown, "--");  // CLI11 also lists the mark `--`, which is never wrong
  if (unknown.empty()) {
    if (commands.empty()) return error.what();
    return fmt::format("found no command, expected one of {}", fmt::join(commands, ", "));
  }
  const std::string& word = unknown.front();
  const bool option = word.starts_with('-');
  const std::vector<std::string> known = option ? known_words(command, true) : commands;
  return fmt::format("found \"{}\", expected {}", word, known.empty() ? "nothing more" : expected_one_of(word, known));
}

/// Prints what is wrong with a command line, or the help or version that it asks for. Returns the exit code.
int refuse(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);  // help, version
  const std::string fault = fault_of(app, error);
  say_error("macadam: {}\n", fault);
  print_json_usage_error(fault);
  say_error("--help after a command lists its arguments and options\n");
  return 2;
}

struct End {
  int code;
  bool ran;  ///< whether a command ran; otherwise help, the version or an error of usage was printed
};

End run_program(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);  // commands run by their callbacks
    return {0, true};
  } catch (const CLI::ParseError& error) { return {refuse(app, error), false}; } catch (const InputError& error) {
    say_error("macadam: {}\n", error.what());
    print_json_error(error);
    return {2, true};
  } catch (const std::bad_alloc&) { throw; } catch (const std::exception& error) {
    say_error("macadam: {}\n", error.what());
    print_json_error(error);
    return {1, true};
  }
}

int say_and_run(int argc, char** argv) {
  CLI::App app;
  make_command_line(app);
  if (wants_json_lines(argc, argv)) begin_json_lines(std::string_view(argv[1]) == "run");
  const auto [code, ran] = run_program(app, argc, argv);
  if (ran || code != 0) print_json_end(code);  // no events with the help or the version
  // `run` and `specimen` also write their results to files, so a failed write to standard output is not an error
  const bool in_files = ran && (app.got_subcommand("run") || app.got_subcommand("specimen"));
  if (flush_output() || code != 0 || in_files) return code;
  say_error(
      "macadam: standard output: cannot be written (the disk is full, or the program that reads the output has "
      "ended)\n");
  return 1;
}

/// Catches the lack of memory here, because memory may also run out while the command line is made or an error is
/// described.
int main_function(int argc, char** argv) {
  restart_with_library_environment(argc, argv);
  hold_standard_streams();
  report_fault_signals();
  keep_memory_in_reserve();
  try {
    return say_and_run(argc, argv);
  } catch (const std::bad_alloc&) {
    say_error_text("macadam: out of memory\n");
    print_json_out_of_memory();
    return 1;
  }
}

}  // namespace
}  // namespace macadam

int main(int argc, char** argv) { return macadam::main_function(argc, argv); }
