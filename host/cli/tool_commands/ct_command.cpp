// SPDX-License-Identifier: GPL-3.0-or-later
// ct_command.cpp  macadam ct segment | …: works with images of computed tomography, if the program was built with ITK.
#include "host/cli/tool_commands/ct_command.hpp"

#include "host/cli/terminal/help.hpp"
#include "macadam/error.hpp"
#ifdef MACADAM_CT
#include "host/cli/tool_commands/ct_modulus.hpp"
#include "host/cli/tool_commands/ct_phantom.hpp"
#include "host/cli/tool_commands/ct_segment.hpp"
#include "host/cli/tool_commands/ct_twin.hpp"
#endif

namespace macadam {

void add_ct_command(CLI::App& app) {
  CLI::App& ct = *app.add_subcommand("ct", "find grains, phases and specimens in images of computed tomography");
  add_examples(ct, {"macadam ct phantom examples/ct/scene.toml --voxel \"200 um\" --out results/phantom",
                    "macadam ct segment results/phantom/scan.mha --out results/segmented",
                    "macadam ct twin results/segmented --scene examples/ct/scene.toml --out results/twin",
                    "macadam ct modulus results/segmented --scene examples/ct/modulus.toml --out results/modulus"});
#ifdef MACADAM_CT
  ct.require_subcommand(1);
  // Each of these commands is in a file of its own, which adds it here.
  add_ct_segment(ct);
  add_ct_phantom(ct);
  add_ct_twin(ct);
  add_ct_modulus(ct);
#else
  ct.allow_extras();
  ct.callback([] {
    throw InputError("macadam ct", 0, "images of computed tomography", "a program built without ITK",
                     "a program built with ITK: install libinsighttoolkit5-dev and build again, with -D MACADAM_CT=ON");
  });
#endif
}

}  // namespace macadam
