// SPDX-License-Identifier: GPL-3.0-or-later
// specimen_command.cpp  Implements `macadam specimen SCENE --out DIR [--section x=0.025]…`.
#include "host/cli/scene_commands/specimen_command.hpp"

#include <memory>

#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/job.hpp"
#include "host/cli/terminal/stop_signals.hpp"
#include "host/files/particle_files.hpp"
#include "macadam/macadam.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {
namespace {

struct SpecimenArguments {
  Job job;
  std::vector<std::string> sections, exports;
};

/// Returns the formats that --export names. \throws CLI::ValidationError
std::vector<ParticleFormat> formats_of(const std::vector<std::string>& names) {
  std::vector<ParticleFormat> out;
  for (const std::string& name : names) {
    if (name == "data")
      out.push_back(ParticleFormat::data);
    else if (name == "dump")
      out.push_back(ParticleFormat::dump);
    else if (name == "xyz")
      out.push_back(ParticleFormat::xyz);
    else
      options::refuse("--export", name, "one of data|dump|xyz");
  }
  return out;
}

/// Prints which fraction of the area of a section is aggregate.
void say_section(const Preparation& prepared, const SectionPlane& plane) {
  const CrossSection section = cut(prepared.specimen, prepared.tessellation, plane);
  double all = 0, aggregate = 0;
  for (const SectionCell& cell : section.cells) {
    all += cell.area;
    if (prepared.specimen.phase_of(cell.particle) == Phase::aggregate) aggregate += cell.area;
  }
  say("section {}={} m: {} cells, {:.2f} % of the area is aggregate\n", plane.axis, plane.position,
      section.cells.size(), 100 * aggregate / all);
}

void specimen_command(const SpecimenArguments& arguments) {
  const std::vector<ParticleFormat> formats = formats_of(arguments.exports);
  const Scene scene = scene_of(arguments.job);
  std::vector<SectionPlane> planes;  // read first, so that a wrong plane is refused before the specimen is made
  for (const std::string& text : arguments.sections) planes.push_back(read_section_plane(text, scene.specimen.box));
  ProgressLine line;
  listen_to_stop_signals();
  const Preparation prepared =
      prepare_into(arguments.job.out, scene, planes,
                   [&](const std::string& stage, double share) { show_or_stop(line, stage, share); });
  for (const ParticleFormat format : formats)
    write_particles(std::filesystem::path(arguments.job.out) / particle_file_name(format), format, prepared.specimen,
                    prepared.network, {scene.materials.aggregate, scene.materials.mastic});
  line.clear();
  say_recipe(scene, prepared);
  say_preparation(prepared);
  for (const std::string& warning : packing_warnings(prepared.specimen, prepared.tessellation))
    say("warning: {}\n", warning);
  const TessellationInvariants i = measure_invariants(prepared.specimen, prepared.tessellation);
  say("tessellation errors: volume {:.1e}, closure {:.1e}, flatness {:.1e}, power {:.1e}, walls {:.1e}\n", i.volume,
      i.closure, i.flatness, i.power, i.walls);
  for (const SectionPlane& plane : planes) say_section(prepared, plane);
  say("files in {}\n", arguments.job.out);
}

}  // namespace

void add_specimen_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("specimen", "build the specimen and its contact network without running the test");
  const auto arguments = std::make_shared<SpecimenArguments>();
  add_job_options(command, arguments->job);
  add_set(command, arguments->job.set);
  command
      .add_option("--section", arguments->sections,
                  "cut the cells by a plane, such as x=0.025 or \"z=40 mm\"; may be given several times")
      ->allow_extra_args(false)  // the argument that follows is the scene
      ->type_name("PLANE");
  command
      .add_option(
          "--export", arguments->exports,
          "also write particles, and in a data file their contacts, for LAMMPS or OVITO: LAMMPS data, LAMMPS dump "
          "or extended XYZ; may be given several times")
      ->allow_extra_args(false)
      ->type_name("data|dump|xyz");
  add_examples(command, {"macadam specimen examples/demo/scene.toml --out results/ovito --export data --export xyz",
                         "macadam specimen examples/ac14_recipe/scene.toml --out results/specimen",
                         "macadam specimen examples/demo/scene.toml --out results/cut --section \"z=15 mm\""});
  command.callback([arguments] { specimen_command(*arguments); });
}

}  // namespace macadam
