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
  say("corrections, as parts of the contrast: slices {:.1f} %, rings {:.1f} %, hardening {:.1f} %\n", 100 * c.slices,
      100 * c.rings, 100 * c.hardening);
  say("air voids {:.2f} %, mastic {:.2f} %, aggregate {:.2f} % of the specimen; confidence {:.3f}\n",
      100 * out.air_voids, 100 * out.mastic, 100 * out.aggregate, out.confidence_mean);
  if (out.block > 1) {
    say("the scan is larger than memory: images have blocks of {0} x {0} x {0} voxels, and {1} surfaces are finer\n",
        out.block, out.refined);
  }
  say("{} grains, {} of them cut by the end of the specimen; {:.2f} % of the aggregate is in no grain\n",
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
  CLI::App& command = *ct.add_subcommand("segment", "grains and phases from a scan");
  command.add_option("images", arguments->images, "scan: .mha, .mhd, .nrrd, .tif, .h5, or a folder of .tif")
      ->required()
      ->type_name("FILE");
  add_text(command, "--dataset", arguments->dataset, "dataset of an HDF5 file, with the axes z, y, x", "NAME");
  command
      .add_option("--voxel", arguments->voxel,
                  "edges of a voxel: \"25 um\", or three: \"25 um,25 um,50 um\"; instead of the edges in the file")
      ->delimiter(',')
      ->expected(1, 3)
      ->type_name("LENGTH");
  add_out(command, arguments->out);
  add_text(command, "--region", arguments->region,
           "the specimen in the scan: found, whole, cylinder, prism, cylinder:x,y,diameter[,z0,z1] or "
           "prism:x0,y0,z0,x1,y1,z1; default: found",
           "REGION");
  command.add_flag("--no-slices", arguments->no_slices, "do not correct the grey levels of slices");
  command.add_flag("--no-rings", arguments->no_rings, "do not correct rings");
  command.add_flag("--no-hardening", arguments->no_hardening, "do not correct grey levels over radius and height");
  add_choice(command, "--denoise", options.denoising, "filter of the noise; diffusion keeps edges",
             {{"diffusion", Denoising::diffusion}, {"median", Denoising::median}, {"none", Denoising::none}});
  add_fraction(command, "--air-voids", options.air_voids,
               "fraction of the specimen's volume, from the laboratory (0.04, \"4 %\")", 0.0, 0.5);
  add_fraction(command, "--aggregate", options.aggregate,
               "fraction of the specimen's volume, from the laboratory (0.4, \"40 %\")", 0.05, 0.95);
  add_text(command, "--memory", arguments->memory,
           "memory that may be used (\"3 GB\"; default: four fifths of the free memory); a larger scan is segmented by "
           "means of blocks",
           "BYTES");
  add_text(command, "--smallest", arguments->smallest, "diameter of the smallest grain to keep apart (\"4 mm\")",
           "LENGTH");
  add_text(command, "--gradation", arguments->gradation,
           "gradation from the laboratory: a CSV file, sieve_mm,passing_percent or sieve_m,passing");
  add_text(command, "--cuts", arguments->cuts, "a cuts.csv of the same scan, in which the column `cut` was edited");
  add_choice(command, "--recipe", options.recipe, "steps of the segmentation",
             {{"own", SegmentRecipe::own}, {"paper", SegmentRecipe::paper}});
  add_number(command, "--facets", options.facets, "facets of a grain's surface; up to 800 for a grain that needs more",
             100, 10'000);
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
