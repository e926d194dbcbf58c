// SPDX-License-Identifier: GPL-3.0-or-later
// ct_segment.cpp  Implements `macadam ct segment IMAGES --voxel "25 um" --out DIR`.
#include "host/cli/tool_commands/ct_segment.hpp"

#include <memory>

#include "host/cli/terminal/fractions.hpp"
#include "host/cli/terminal/job.hpp"
#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/streams.hpp"
#include "host/tools/ct/grains/gradation.hpp"
#include "host/tools/ct/segment/segment_files.hpp"
#include "macadam/ct.hpp"
#include "macadam/error.hpp"
#include "macadam/lengths.hpp"
#include "macadam/thread_limit.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

struct CtSegmentArguments {
  std::string images, dataset, out, region, memory, cuts, smallest, gradation;
  std::vector<std::string> voxel;
  bool no_slices = false, no_rings = false, no_hardening = false;
  std::optional<int> threads;
  SegmentOptions segment;
};

void segment(CtSegmentArguments arguments) {
  SegmentOptions& options = arguments.segment;
  options.slices = !arguments.no_slices, options.rings = !arguments.no_rings,
  options.hardening = !arguments.no_hardening;
  if (!arguments.smallest.empty()) options.smallest = length_of(arguments.smallest, "--smallest");
  if (!arguments.cuts.empty()) options.cuts = ct::read_cuts(arguments.cuts);
  if (!arguments.gradation.empty()) options.gradation = ct::read_gradation(arguments.gradation);
  const ThreadLimit threads(arguments.threads);
  if (!arguments.region.empty()) ct::read_region(arguments.region, options);
  ScanFile scan{arguments.images, arguments.dataset, {}};
  if (!arguments.voxel.empty()) scan.spacing = lengths_of(arguments.voxel, "--voxel");
  const double memory = ct::memory_of(arguments.memory);
  ProgressLine line;
  options.progress = [&](const std::string& stage, double share) { show_or_stop(line, stage, share); };
  options.progress("reading", 0);
  const Segmentation out = segment_file(scan, options, memory);
  options.progress("writing", 0);
  const fs::path folder = arguments.out;
  ct::write_segmentation(folder, out, options);
  const auto border =
      std::count_if(out.grains.begin(), out.grains.end(), [](const auto& grain) { return grain.border; });
  line.clear();
  const ScanCorrections& c = out.corrections;
  say("corrections of grey values, in % of the contrast: slices {:.1f} %, rings {:.1f} %, beam hardening {:.1f} %\n",
      100 * c.slices, 100 * c.rings, 100 * c.hardening);
  say("air voids {:.2f} %, mastic {:.2f} %, aggregate {:.2f} % of the specimen; mean confidence {:.3f}\n",
      100 * out.air_voids, 100 * out.mastic, 100 * out.aggregate, out.confidence_mean);
  if (out.block > 1) {
    say("the scan does not fit in memory: a voxel of the written images is the mean of {0} x {0} x {0} voxels of the "
        "scan; the surfaces of {1} grains have a finer resolution\n",
        out.block, out.refined);
  }
  say("{} grains, {} of them cut by the boundary of the specimen; {:.2f} % of the aggregate's volume belongs to no "
      "grain\n",
      out.grains.size(), border, 100 * out.in_no_grain);
  for (const std::string& warning : out.warnings) say("warning: {}\n", warning);
  say("files in {}: library border grains.csv gradation.csv cuts.csv labels.mha phases.mha confidence.mha planes.png "
      "grains.png\n",
      arguments.out);
}

}  // namespace

void add_ct_segment(CLI::App& ct) {
  const auto arguments = std::make_shared<CtSegmentArguments>();
  SegmentOptions& options = arguments->segment;
  CLI::App& command = *ct.add_subcommand("segment", "find the grains and phases in a scan");
  command.add_option("images", arguments->images, "scan: .mha, .mhd, .nrrd, .tif, .h5, or a folder of .tif")
      ->required()
      ->type_name("FILE");
  add_text(command, "--dataset", arguments->dataset, "dataset of an HDF5 file, with the axes z, y, x", "NAME");
  command
      .add_option("--voxel", arguments->voxel,
                  "edge length of a voxel, \"25 um\", or three edge lengths along x, y and z, \"25 um,25 um,50 um\"; "
                  "replaces the edge lengths in the file")
      ->delimiter(',')
      ->expected(1, 3)
      ->type_name("LENGTH");
  add_out(command, arguments->out);
  add_text(command, "--region", arguments->region,
           "region of the scan that the specimen fills: \"found\" (detected; the default); \"whole\" (all voxels); "
           "\"cylinder\" or \"prism\" (detected with this outline); or a given region: "
           "\"cylinder:x,y,diameter[,z0,z1]\" or \"prism:x0,y0,z0,x1,y1,z1\"",
           "REGION");
  command.add_flag("--no-slices", arguments->no_slices, "do not correct the grey levels of slices");
  command.add_flag("--no-rings", arguments->no_rings, "do not correct rings");
  command.add_flag("--no-hardening", arguments->no_hardening,
                   "do not correct beam hardening (grey levels that change with radius and height)");
  add_choice(command, "--denoise", options.denoising, "filter of the noise; diffusion keeps edges",
             {{"diffusion", Denoising::diffusion}, {"median", Denoising::median}, {"none", Denoising::none}});
  add_fraction(command, "--air-voids", options.air_voids,
               "air voids measured in the laboratory, as a fraction of the specimen's volume (0.04, \"4 %\")", 0.0,
               0.5);
  add_fraction(command, "--aggregate", options.aggregate,
               "aggregate measured in the laboratory, as a fraction of the specimen's volume (0.4, \"40 %\")", 0.05,
               0.95);
  add_text(command, "--memory", arguments->memory,
           "memory that may be used (\"3 GB\"; default: four fifths of the free memory); a scan that needs more memory "
           "is first averaged over blocks of voxels",
           "BYTES");
  add_text(command, "--smallest", arguments->smallest,
           "diameter of the smallest grain that is separated from its neighbours (\"4 mm\")", "LENGTH");
  add_text(command, "--gradation", arguments->gradation,
           "CSV file of the gradation measured in the laboratory, with the columns sieve_mm,passing_percent or "
           "sieve_m,passing");
  add_text(command, "--cuts", arguments->cuts,
           "cuts.csv that this command wrote for the same scan, with an edited column `cut`");
  add_choice(command, "--recipe", options.recipe,
             "method of the segmentation: Macadam's own, or the published one (docs/ct.md)",
             {{"own", SegmentRecipe::own}, {"paper", SegmentRecipe::paper}});
  add_number(command, "--facets", options.facets,
             "number of facets of a grain's surface; a grain that needs more gets up to 800", 100, 10'000);
  add_number(command, "--threads", arguments->threads, "number of CPU threads; results do not depend on it", 1, 1024);
  for (const char* name : {"--no-slices", "--no-rings", "--no-hardening", "--denoise"})
    command.get_option(name)->group("Faults of the scan");
  for (const char* name : {"--air-voids", "--aggregate", "--gradation"})
    command.get_option(name)->group("Known from the laboratory");
  for (const char* name : {"--smallest", "--cuts", "--recipe", "--facets"}) command.get_option(name)->group("Grains");
  add_examples(command, {"macadam ct phantom examples/ct/scene.toml --voxel \"200 um\" --out results/phantom",
                         "macadam ct segment results/phantom/scan.mha --out results/segmented"});
  command.callback([arguments] { segment(*arguments); });
}

}  // namespace macadam
