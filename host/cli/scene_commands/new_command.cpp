// SPDX-License-Identifier: GPL-3.0-or-later
// new_command.cpp  Implements `macadam new [--kind recipe] [--test cyclic] [--rule centres] [FILE]`.
#include "host/cli/scene_commands/new_command.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/streams.hpp"
#include "host/base/units.hpp"
#include "host/scene/new_scene.hpp"
#include "host/scene/packing_scene.hpp"
#include "host/specimen/foreign_packing.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

struct NewArguments {
  std::string file = "scene.toml", test = "cyclic";
  scene::NewKind kind = scene::NewKind::recipe;
  ContactRule rule = ContactRule::centres;
  bool cracks = false;
  std::string packing, unit = "m";
  bool cylinder = false;
  CLI::Option *unit_option = nullptr, *cylinder_option = nullptr;
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

/// Refuses options of packings without a packing, and the other way round. \throws InputError.
void check_packing(const NewArguments& arguments) {
  const bool given = !arguments.packing.empty(), asked = arguments.kind == scene::NewKind::packing;
  const auto refuse = [](const std::string& option, const std::string& found, const std::string& expected) {
    throw InputError("macadam new", 0, option, found, expected);
  };
  if (asked && !given) refuse("--packing", "nothing", "a file with the spheres, because of --kind packing");
  if (given && !asked) refuse("--packing", "a file without --kind packing", "--kind packing as well");
  if (asked &&
      (arguments.test.starts_with("indirect_") || arguments.test.ends_with("bending") || arguments.test == "torsion"))
    refuse("--test", arguments.test + " with --kind packing", "another test, or --kind spheres");
  for (const CLI::Option* option : {arguments.unit_option, arguments.cylinder_option})
    if (!asked && option->count() > 0)
      refuse(option->get_name(), "this option without --kind packing", "no such option");
}

/// Writes the specimen of a packing beside the scene, and the scene. The specimen has the name of the scene with the
/// ending `.csv`. \throws InputError
void write_packing(const NewArguments& arguments) {
  const auto unit = scene::parse("1 " + arguments.unit, scene::length);
  if (!unit) options::refuse("--unit", arguments.unit, "a unit of length, such as m, mm or um");
  const ForeignPacking packing = read_packing(arguments.packing, *unit);
  const Specimen specimen = specimen_of(packing, arguments.cylinder, arguments.packing);
  const std::filesystem::path csv = std::filesystem::path(arguments.file).replace_extension(".csv");
  if (csv == std::filesystem::path(arguments.file))
    throw InputError(arguments.file, 0, "scene", "a scene with the ending .csv",
                     "another ending, such as .toml, because the specimen gets this name");
  for (const std::filesystem::path& file : {std::filesystem::path(arguments.file), csv})
    if (std::filesystem::exists(file))
      throw InputError(
          file.string(), 0, "scene", "an existing file",
          "the name of a new file, because macadam new never replaces a file, and writes the specimen beside "
          "the scene with the ending .csv");
  write_specimen_csv(csv, specimen);
  write_new(arguments.file, scene::packing_scene(csv.filename().string(), specimen.box, arguments.test, arguments.rule,
                                                 arguments.cracks));
  const auto [least, most] = std::minmax_element(specimen.radius.begin(), specimen.radius.end());
  say("{}: {}, {} spheres with radii from {:.4g} to {:.4g} m\n", arguments.packing, packing.format, specimen.size(),
      *least, *most);
  const Vec3d& size = specimen.box.size;
  say("{}: {} of {:.6g} x {:.6g} x {:.6g} m around the spheres, one material\n", csv.string(), specimen.box.name(),
      size.x, size.y, size.z);
}

void new_command(const NewArguments& arguments) {
  check_packing(arguments);
  if (arguments.kind == scene::NewKind::packing)
    write_packing(arguments);
  else
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
  add_choice(
      command, "--kind", arguments->kind,
      "a mix design by mass, aggregate classes by volume as spheres or as shapes, an existing specimen.csv, or a "
      "packing of another program",
      {{"recipe", scene::NewKind::recipe},
       {"spheres", scene::NewKind::spheres},
       {"shapes", scene::NewKind::shapes},
       {"file", scene::NewKind::file},
       {"packing", scene::NewKind::packing}});
  add_text(command, "--packing", arguments->packing,
           "with --kind packing: spheres of one material as LAMMPS dump, Yade text, CSV, or columns x y z radius");
  arguments->unit_option =
      add_text(command, "--unit", arguments->unit, "with --kind packing: unit of the file's lengths", "UNIT")
          ->default_str(arguments->unit);
  arguments->cylinder_option =
      command.add_flag("--cylinder", arguments->cylinder,
                       "with --kind packing: the specimen is the smallest cylinder around the spheres, not a box");
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
                         "macadam new --kind shapes --test sweep mix.toml", "macadam new --rule series mix.toml",
                         "macadam new --kind packing --packing spheres.csv --unit mm mix.toml"});
  command.callback([arguments] { new_command(*arguments); });
}

}  // namespace macadam
