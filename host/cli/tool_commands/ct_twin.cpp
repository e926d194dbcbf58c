// SPDX-License-Identifier: GPL-3.0-or-later
// ct_twin.cpp  Implements `macadam ct twin DIR --scene SCENE --out SCENE_DIR`.
#include "host/cli/tool_commands/ct_twin.hpp"

#include <limits>
#include <memory>

#include "host/cli/terminal/fractions.hpp"
#include "host/cli/terminal/job.hpp"
#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/stop_signals.hpp"
#include "macadam/error.hpp"
#include "macadam/lengths.hpp"
#include "macadam/twin.hpp"

namespace macadam {
namespace {

struct CtTwinArguments {
  std::string folder, scene, out, least_void = "0";
  std::vector<std::string> box;
  TwinSpec spec;
};

/// Returns the lower and the upper corner of the box that six lengths give.
std::array<Vec3d, 2> box_of(const std::vector<std::string>& texts) {
  std::vector<double> at;
  for (const std::string& text : texts) at.push_back(length_of(text, "--box"));
  return {Vec3d{at[0], at[1], at[2]}, Vec3d{at[3], at[4], at[5]}};
}

void twin_command(CtTwinArguments arguments) {
  TwinSpec& spec = arguments.spec;
  if (!arguments.box.empty()) spec.box = box_of(arguments.box);
  spec.least_void = length_of(arguments.least_void, "--least-void");
  if (spec.least_void < 0)
    throw InputError("command line", 0, "--least-void", '"' + arguments.least_void + '"', "a length of 0 or more");
  const Scene scene = read_scene(arguments.scene);
  listen_to_stop_signals();
  ProgressLine line;
  const Twin twin = make_twin(arguments.folder, scene, spec,
                              [&](const std::string& stage, double share) { show_or_stop(line, stage, share); });
  line.clear();
  write_twin(arguments.out, twin, scene);
  const Vec3d& size = twin.specimen.box.size;
  say("box of {:.4g} x {:.4g} x {:.4g} mm: {} grains ({} of them clusters of several spheres, {} left out because too "
      "little of each lies in the box), {} void spheres, {} particles\n",
      1e3 * size.x, 1e3 * size.y, 1e3 * size.z, twin.grains, twin.clusters, twin.lost, twin.specimen.voids.size(),
      twin.specimen.size());
  say("aggregate {:.2f} %, mastic {:.2f} %, voids {:.2f} %; voids of {:.2f} % are left out because they are too "
      "small\n",
      100 * twin.aggregate, 100 * twin.mastic, 100 * twin.voids, 100 * twin.voids_left_out);
  say("macadam run {}/scene.toml --out DIR\n", arguments.out);
}

}  // namespace

void add_ct_twin(CLI::App& ct) {
  const auto arguments = std::make_shared<CtTwinArguments>();
  CLI::App& command = *ct.add_subcommand("twin", "make a scene from the specimen in a scan");
  add_text(command, "folder", arguments->folder,
           "folder that macadam ct segment wrote, or the subfolder \"truth\" of a folder that macadam ct phantom wrote",
           "FOLDER")
      ->required();
  add_text(command, "--scene", arguments->scene,
           "scene file that gives materials, contacts, loading and the radii of the spheres")
      ->required();
  add_out(command, arguments->out, "folder for the scene");
  command
      .add_option(
          "--box", arguments->box,
          "x, y, z of the lower and of the upper corner of the box in the scan: \"1 mm,1 mm,0,21 mm,21 mm,30 mm\"")
      ->delimiter(',')
      ->expected(6)
      ->type_name("LENGTH");
  add_fraction(command, "--porosity", arguments->spec.porosity,
               "porosity of the mastic, in place of the scene's; negative if the spheres overlap", -1.0, 1.0);
  add_text(command, "--least-void", arguments->least_void,
           "radius below which a void is left out; 0: twice the edge of a voxel", "LENGTH");
  add_number(command, "--seed", arguments->spec.seed, "seed of the mastic and of the fillings of grains", 0,
             std::numeric_limits<std::uint64_t>::max());
  add_examples(command, {"macadam ct segment results/phantom/scan.mha --out results/segmented",
                         "macadam ct twin results/segmented --scene examples/ct/scene.toml --out results/twin"});
  command.callback([arguments] { twin_command(*arguments); });
}

}  // namespace macadam
