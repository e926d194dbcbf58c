// SPDX-License-Identifier: GPL-3.0-or-later
// command_help_test.cpp  Tests that the help of every command is readable and complete, and has examples that the
// command line accepts.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "host/cli/commands.hpp"
#include "host/cli/terminal/help.hpp"

namespace macadam::test {
namespace {

/// Calls f(command) for the program and all commands below it.
template <class F>
void for_each_command(CLI::App& command, F&& f) {
  f(command);
  for (CLI::App* below : command.get_subcommands(nullptr)) for_each_command(*below, f);
}

std::string name_of(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent ? name_of(*parent) + " " + command.get_name() : command.get_name();
}

/// Returns the help as --help prints it.
std::string help_of(const CLI::App& command) {
  return command.help(command.get_parent() ? name_of(*command.get_parent()) : "");
}

struct CommandHelp : testing::Test {
  void SetUp() override { make_command_line(app_); }
  CLI::App app_;
};

TEST_F(CommandHelp, WalksAllCommands) {
  std::size_t commands = 0;
  for_each_command(app_, [&](const CLI::App&) { ++commands; });
  EXPECT_GE(commands, 15u);
}

/// Returns the words of a text with one space between them.
std::string in_one_line(const std::string& text) {
  std::string out;
  std::istringstream words(text);
  for (std::string word; words >> word;) out += (out.empty() ? "" : " ") + word;
  return out;
}

TEST_F(CommandHelp, HasEveryDescriptionWordForWord) {
  for_each_command(app_, [](CLI::App& command) {
    const std::string help = in_one_line(help_of(command));
    const auto expect = [&](const std::string& description) {
      EXPECT_NE(help.find(in_one_line(description)), std::string::npos) << name_of(command) << ": " << description;
    };
    for (const CLI::Option* option : command.get_options()) expect(option->get_description());
    for (const CLI::App* below : command.get_subcommands(nullptr)) expect(below->get_description());
  });
}

// If CLI11 prints the type of an enumeration, the help shows a table of numbers such as `ENUM:value in {auto->1} OR
// {1}`.
TEST_F(CommandHelp, IsForPeople) {
  for_each_command(app_, [](CLI::App& command) {
    const std::string help = help_of(command);
    for (const char* word : {"ENUM", "->", "=TEXT", "FLOAT", "UINT"})
      EXPECT_EQ(help.find(word), std::string::npos) << name_of(command) << ": " << word << "\n" << help;
    std::istringstream lines(help);
    bool examples = false;  // an example is one line of any length
    for (std::string line; std::getline(lines, line);) {
      examples = examples || line == "Examples:";
      EXPECT_TRUE(examples || line.size() <= 100) << name_of(command) << ": " << line;
    }
    EXPECT_FALSE(command.get_description().empty()) << name_of(command);
    for (const CLI::Option* option : command.get_options()) {
      EXPECT_FALSE(option->get_description().empty()) << name_of(command) << " " << option->get_name();
      EXPECT_NE(help.find(option->get_name(option->get_positional())), std::string::npos) << option->get_name();
    }
  });
}

TEST_F(CommandHelp, SaysChoicesDefaultsAndWhatIsRequired) {
  const std::string run = help_of(*app_.get_subcommand("run"));
  for (const char* words : {"Usage: macadam run scene... --out FOLDER [OPTIONS]", "--backend auto|cuda|cpu|reference",
                            "Options that replace keys of the scene:", "(required)"})
    EXPECT_NE(run.find(words), std::string::npos) << words << "\n" << run;
  const std::string fill = help_of(*app_.get_subcommand("shapes")->get_subcommand("fill"));
  for (const char* words : {"--single intermediate|circumscribed|volume", "[intermediate]", "[8]"})
    EXPECT_NE(fill.find(words), std::string::npos) << words << "\n" << fill;
}

/// Returns the reason why the program refuses the words of a command line; empty if it accepts them. Runs no command.
std::string fault_of(std::vector<std::string> words) {
  CLI::App app;
  make_command_line(app);
  app.parse_complete_callback([] { throw CLI::Success(); });  // called before the callback of any command
  std::reverse(words.begin(), words.end());                   // CLI11 expects the words in reverse order
  words.pop_back();                                           // removes the word macadam
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) { return error.get_exit_code() == 0 ? "" : error.what(); }
  return "nothing was parsed";
}

TEST_F(CommandHelp, EveryCommandHasExamplesThatParse) {
  EXPECT_NE(fault_of({"macadam", "run", "scene.toml", "--out", "results", "--sed", "2"}), "");
  EXPECT_NE(fault_of({"macadam", "run", "scene.toml"}), "");
  const std::filesystem::path top = std::filesystem::path(MACADAM_EXAMPLES).parent_path();
  for_each_command(app_, [&](const CLI::App& command) {
    const std::vector<std::string> examples = examples_of(command);
    EXPECT_FALSE(examples.empty()) << name_of(command);
    bool own = false;
    for (const std::string& example : examples) {
      own = own || example.starts_with(name_of(command));
      std::vector<std::string> words = CLI::detail::split_up(example);
      for (std::string& word : words) {
        CLI::detail::remove_quotes(word);
        EXPECT_TRUE(!word.starts_with("examples/") || std::filesystem::exists(top / word)) << example;
      }
      EXPECT_EQ(fault_of(words), "") << example;
    }
    EXPECT_TRUE(own) << name_of(command);
  });
}

}  // namespace
}  // namespace macadam::test
