// SPDX-License-Identifier: GPL-3.0-or-later
// ct_phantom.cpp  Implements `macadam ct phantom SCENE --voxel "100 um" --out DIR`.
#include "host/cli/tool_commands/ct_phantom.hpp"

#include <limits>
#include <memory>

#include "host/cli/terminal/fractions.hpp"
#include "host/cli/terminal/job.hpp"
#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/stop_signals.hpp"
#include "macadam/lengths.hpp"
#include "macadam/phantom.hpp"

namespace macadam {
namespace {

struct CtPhantomArguments {
  std::string scene, out, voxel, sawn = "0", air = "1 mm";
  std::optional<std::uint64_t> specimen_seed;
  PhantomSpec spec;
};

void phantom_command(CtPhantomArguments arguments) {
  PhantomSpec& spec = arguments.spec;
  spec.voxel = length_of(arguments.voxel, "--voxel");
  spec.sawn = length_of(arguments.sawn, "--sawn");
  spec.air = length_of(arguments.air, "--air");
  const Scene scene = scene_of({arguments.scene, arguments.out, arguments.specimen_seed});
  listen_to_stop_signals();
  ProgressLine line;
  const Phantom phantom =
      make_phantom(scene, spec, [&](const std::string& stage, double share) { show_or_stop(line, stage, share); });
  line.show("writing", 0);
  write_phantom(arguments.out, phantom, scene, spec);
  line.clear();
  const auto& n = phantom.scan.size;
  say("{} x {} x {} voxels of {:.4g} um: {} grains, aggregate {:.2f} %, mastic {:.2f} %, voids {:.2f} %\n", n[0], n[1],
      n[2], 1e6 * spec.voxel, phantom.grains.size(), 100 * phantom.aggregate, 100 * phantom.mastic,
      100 * phantom.voids);
  say("scan.mha, phantom.json and the subfolder \"truth\" are in {}\n", arguments.out);
}

}  // namespace

void add_ct_phantom(CLI::App& ct) {
  const auto arguments = std::make_shared<CtPhantomArguments>();
  PhantomSpec& spec = arguments->spec;
  CLI::App& command =
      *ct.add_subcommand("phantom", "make a synthetic scan of a scene's specimen, with the true grains and phases");
  add_text(command, "scene", arguments->scene, "scene file (TOML)")->required();
  add_text(command, "--voxel", arguments->voxel, "edge of a voxel, as \"100 um\"", "LENGTH")->required();
  add_out(command, arguments->out);
  constexpr std::uint64_t largest_seed = std::numeric_limits<std::uint64_t>::max();
  add_number(command, "--specimen-seed", arguments->specimen_seed, "seed of the specimen, instead of the scene's seed",
             0, largest_seed);
  add_number(command, "--seed", spec.seed, "seed of the noise and the rings of the scan", 0, largest_seed);
  add_choice(command, "--shape", spec.shape, "outline of the scanned specimen",
             {{"prism", CoreShape::prism}, {"cylinder", CoreShape::cylinder}});
  add_text(command, "--sawn", arguments->sawn, "thickness that is sawn off each side of the box before the scan",
           "LENGTH");
  add_text(command, "--air", arguments->air, "thickness of the air around the specimen", "LENGTH");
  add_number(command, "--samples", spec.samples, "number of sample columns along each edge of a voxel", 1, 16);
  add_number(command, "--blur", spec.blur, "standard deviation of the blur, in voxels", 0.0, 10.0);
  add_fraction(command, "--noise", spec.noise,
               "standard deviation of the noise, as a fraction of the grey-value difference between aggregate and air",
               0.0, 1.0);
  add_fraction(command, "--cupping", spec.cupping,
               "loss of grey value on the axis of the specimen, as a fraction of the grey value", 0.0, 1.0);
  add_fraction(
      command, "--rings", spec.rings,
      "grey-value offsets of ring artefacts, as a fraction of the grey-value difference between aggregate and air", 0.0,
      1.0);
  add_fraction(command, "--drift", spec.drift, "change of brightness between slices, as a fraction of the grey value",
               0.0, 1.0);
  add_number(command, "--grey-air", spec.grey_air, "grey value of air", 0.0, 65535.0);
  add_number(command, "--grey-mastic", spec.grey_mastic, "grey value of mastic", 0.0, 65535.0);
  add_number(command, "--grey-aggregate", spec.grey_aggregate, "grey value of aggregate", 0.0, 65535.0);
  for (const char* name : {"--seed", "--blur", "--noise", "--cupping", "--rings", "--drift"})
    command.get_option(name)->group("Faults of the scan");
  for (const char* name : {"--grey-air", "--grey-mastic", "--grey-aggregate"})
    command.get_option(name)->group("Grey levels");
  add_examples(command, {"macadam ct phantom examples/ct/scene.toml --voxel \"200 um\" --out results/phantom"});
  command.callback([arguments] { phantom_command(*arguments); });
}

}  // namespace macadam
