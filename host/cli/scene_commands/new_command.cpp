// SPDX-License-Identifier: GPL-3.0-or-later
// new_command.cpp  Implements `macadam new [--kind recipe] [--test cyclic] [--rule centres] [FILE]`.
#include "host/cli/scene_commands/new_command.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/streams.hpp"
#include "host/scene/new_scene.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

struct NewArguments {
  std::string file = "scene.toml", test = "cyclic";
  scene::NewKind kind = scene::NewKind::recipe;
  ContactRule rule = ContactRule::centres;
  bool cracks = false;
};

/// Writes a new file. \throws InputError if a file of this name exists, even if it was made a moment ago.
void write_new(const std::string& file, const std::string& text) {
  const int out = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (out < 0 && errno == EEXIST)
    throw InputError(file, 0, "scene", "an existing file",
                     "the name of a new file, because macadam new never replaces a file");
  const auto fail = [&] { throw RunError(fmt::format("{}: cannot be written: {}", file, std::strerror(errno))); };
  if (out < 0) fail();
  std::size_t at = 0;
  while (at < text.size()) {
    const ssize_t count = ::write(out, text.data() + at, text.size() - at);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      const int why = errno;
      ::close(out), ::unlink(file.c_str());
      errno = why, fail();
    }
    at += static_cast<std::size_t>(count);
  }
  if (::close(out) != 0) fail();
}

void new_command(const NewArguments& arguments) {
  write_new(arguments.file, scene::new_scene(arguments.kind, arguments.test, arguments.rule, arguments.cracks));
  say("{} is written. Edit it, then run:\n\n", arguments.file);
  if (arguments.kind == scene::NewKind::file)
    say("  put specimen.csv (id,x,y,z,radius,phase,body) into the same folder, and write the edge lengths of its box "
        "into the scene\n");
  say("  macadam check {0}\n  macadam run {0} --out results\n", arguments.file);
}

}  // namespace

void add_new_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("new", "write a commented scene to start from");
  const auto arguments = std::make_shared<NewArguments>();
  add_text(command, "file", arguments->file, "scene file to write; an existing file is never replaced")
      ->default_str(arguments->file);
  add_choice(command, "--kind", arguments->kind,
             "a mix design by mass, aggregate classes by volume as spheres or as shapes, or an existing specimen.csv",
             {{"recipe", scene::NewKind::recipe},
              {"spheres", scene::NewKind::spheres},
              {"shapes", scene::NewKind::shapes},
              {"file", scene::NewKind::file}});
  std::vector<std::pair<std::string, std::string>> tests;
  for (const std::string& kind : scene::tests_of_new_scenes()) tests.emplace_back(kind, kind);
  add_choice(command, "--test", arguments->test, "the test of the specimen", tests);
  add_choice(
      command, "--rule", arguments->rule,
      "laws of the scene: for each pair of materials (centres), for mastic and rock, from which the stiffness of all "
      "contacts follows (series), or for mastic and rock with their Poisson's ratios (volumetric)",
      {{"centres", ContactRule::centres}, {"series", ContactRule::series}, {"volumetric", ContactRule::volumetric}});
  command.add_flag("--cracks", arguments->cracks,
                   "contacts between particles crack, for a strength test (--test monotonic)");
  add_examples(command, {"macadam new mix.toml", "macadam new --kind spheres --test monotonic --cracks mix.toml",
                         "macadam new --kind shapes --test sweep mix.toml", "macadam new --rule series mix.toml"});
  command.callback([arguments] { new_command(*arguments); });
}

}  // namespace macadam
