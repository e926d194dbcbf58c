// SPDX-License-Identifier: GPL-3.0-or-later
// ct_segment.cpp  macadam ct segment IMAGES --voxel "25 um" --out DIR
#include "host/cli/ct_segment.hpp"

#include <omp.h>

#include <memory>

#include "host/cli/ct_region.hpp"
#include "host/cli/job.hpp"
#include "host/cli/lengths.hpp"
#include "host/cli/options.hpp"
#include "host/cli/streams.hpp"
#include "host/ct/gradation.hpp"
#include "host/ct/overlay.hpp"
#include "host/ct/segment_files.hpp"
#include "host/in_quotes.hpp"
#include "host/results/files.hpp"
#include "host/results/result_folder.hpp"
#include "host/scene/units.hpp"
#include "macadam/ct.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string images, dataset, out, region, memory, cuts, smallest, gradation;
  std::vector<std::string> voxel;
  bool no_slices = false, no_rings = false, no_hardening = false;
  std::optional<int> threads;
  SegmentOptions segment;
};

/// The edges of a voxel: of the command line, or of the file. \throws InputError where there are none, and where the
/// file says others by more than 1 %: it is of another scan.
Vec3d spacing_of(const ImageHeader& header, const Arguments& arguments) {
  const Vec3d& own = header.spacing;
  if (arguments.voxel.empty() && own.x > 0) return own;
  if (arguments.voxel.empty())
    throw InputError(arguments.images, 0, "edge of a voxel", "none in the file", "--voxel with one: \"25 um\"");
  const Vec3d given = lengths_of(arguments.voxel, "--voxel");
  const double in_file[3] = {own.x, own.y, own.z}, asked[3] = {given.x, given.y, given.z};
  for (int axis = 0; axis < 3; ++axis) {
    if (own.x > 0 && std::abs(in_file[axis] / asked[axis] - 1) > 0.01) {
      throw InputError(arguments.images, 0, fmt::format("edge of a voxel along {}", "xyz"[axis]),
                       fmt::format("{:.6g} mm", 1e3 * in_file[axis]),
                       fmt::format("{:.6g} mm, as --voxel says", 1e3 * asked[axis]));
    }
  }
  return given;
}

/// Bytes that may be taken: four fifths of what is free, for the system and others take some too.
double memory_of(const Arguments& arguments) {
  if (arguments.memory.empty()) return 0.8 * memory_available();
  constexpr scene::Unit units[] = {{"GB", 9}, {"MB", 6}};
  const scene::Quantity memory{"memory", units};
  const std::optional<double> bytes = scene::parse(arguments.memory, memory);
  if (!bytes || !(*bytes > 0))
    throw InputError("command line", 0, "--memory", in_quotes(arguments.memory), "an amount: \"3 GB\", \"800 MB\"");
  return *bytes;
}

void segment(Arguments arguments) {
  SegmentOptions& options = arguments.segment;
  options.slices = !arguments.no_slices, options.rings = !arguments.no_rings,
  options.hardening = !arguments.no_hardening;
  if (!arguments.smallest.empty()) options.smallest = length_of(arguments.smallest, "--smallest");
  if (!arguments.cuts.empty()) options.cuts = ct::read_cuts(arguments.cuts);
  if (!arguments.gradation.empty()) options.gradation = ct::read_gradation(arguments.gradation);
  if (arguments.threads) omp_set_num_threads(*arguments.threads);
  if (!arguments.region.empty()) read_region(arguments.region, options);
  const Vec3d voxel = spacing_of(read_image_header(arguments.images, arguments.dataset), arguments);
  ProgressLine line;
  options.progress = [&](const std::string& stage, double share) { show_or_stop(line, stage, share); };
  options.progress("reading", 0);
  const Segmentation out = segment_file({arguments.images, arguments.dataset, voxel}, options, memory_of(arguments));
  options.progress("writing", 0);
  const fs::path folder = arguments.out;
  const ResultFolder held(folder);
  for (const char* below : {"library", "border"}) {
    fs::remove_all(folder / below);
    fs::create_directories(folder / below);
  }
  std::size_t border = 0;
  for (const ScannedGrain& grain : out.grains) {
    border += grain.border;
    write_surface(folder / (grain.border ? "border" : "library") / (grain.surface.name + ".off"), grain.surface);
  }
  write_whole(folder / "grains.csv", ct::grains_csv(out.grains));
  write_whole(folder / "gradation.csv", ct::gradation_csv(out.grains, options.gradation, options.smallest));
  write_whole(folder / "cuts.csv", ct::cuts_csv(out.cuts));
  write_image(folder / "labels.mha", out.labels);
  write_image(folder / "phases.mha", out.phases);
  write_image(folder / "confidence.mha", out.confidence);
  ct::write_overlay(folder / "planes.png", out);
  ct::write_view(folder / "grains.png", out);
  line.clear();
  const ScanCorrections& c = out.corrections;
  say("taken out, in shares of the contrast: slices {:.1f} %, rings {:.1f} %, hardening {:.1f} %\n", 100 * c.slices,
      100 * c.rings, 100 * c.hardening);
  say("air voids {:.2f} %, mastic {:.2f} %, aggregate {:.2f} % of the specimen; confidence {:.3f}\n",
      100 * out.air_voids, 100 * out.mastic, 100 * out.aggregate, out.confidence_mean);
  if (out.block > 1) {
    say("larger than memory: images are of blocks of {0} x {0} x {0} voxels, {1} surfaces are finer\n", out.block,
        out.refined);
  }
  say("{} grains, {} of them cut by the end of the specimen\n", out.grains.size(), border);
  for (const std::string& warning : out.warnings) say("warning: {}\n", warning);
  say("files in {}: library border grains.csv gradation.csv cuts.csv labels.mha phases.mha confidence.mha planes.png "
      "grains.png\n",
      arguments.out);
}

}  // namespace

void add_ct_segment(CLI::App& ct) {
  const auto arguments = std::make_shared<Arguments>();
  SegmentOptions& options = arguments->segment;
  CLI::App& command = *ct.add_subcommand("segment", "grains and phases from a scan");
  command.add_option("images", arguments->images, "scan: .mha, .mhd, .nrrd, .tif, .h5, or a folder of .tif")
      ->required();
  add_text(command, "--dataset", arguments->dataset, "of an HDF5 file: the dataset; z, y, x");
  command
      .add_option("--voxel", arguments->voxel,
                  "edges of a voxel: \"25 um\", or three: \"25 um,25 um,50 um\"; where the file has none")
      ->delimiter(',')
      ->expected(1, 3);
  add_text(command, "--out", arguments->out, "folder of the results; made if it is not there")->required();
  add_text(command, "--region", arguments->region,
           "what of the scan is the specimen: found|whole|cylinder|prism, cylinder:x,y,diameter[,z0,z1] or "
           "prism:x0,y0,z0,x1,y1,z1 (found)");
  command.add_flag("--no-slices", arguments->no_slices, "slices keep their grey levels");
  command.add_flag("--no-rings", arguments->no_rings, "rings are left in the scan");
  command.add_flag("--no-hardening", arguments->no_hardening,
                   "grey levels over radius and height are left as they are");
  add_choice(command, "--denoise", options.denoising, "(diffusion, which keeps edges)",
             {{"diffusion", Denoising::diffusion}, {"median", Denoising::median}, {"none", Denoising::none}});
  add_number(command, "--air-voids", options.air_voids, "share of the specimen's volume, from the laboratory", 0.0,
             0.5);
  add_number(command, "--aggregate", options.aggregate, "share of the specimen's volume, from the laboratory", 0.05,
             0.95);
  add_text(command, "--memory", arguments->memory,
           "that may be taken (\"3 GB\"; four fifths of what is free): a larger scan is decided on block means");
  add_text(command, "--smallest", arguments->smallest, "diameter of the smallest grain that matters (\"4 mm\")");
  add_text(command, "--gradation", arguments->gradation,
           "the laboratory's: a CSV file, sieve_mm,passing_percent or sieve_m,passing");
  add_text(command, "--cuts", arguments->cuts, "a cuts.csv of the same scan, in which `cut` was changed by hand");
  add_choice(command, "--recipe", options.recipe, "steps of the segmentation (own)",
             {{"own", SegmentRecipe::own}, {"paper", SegmentRecipe::paper}});
  add_number(command, "--facets", options.facets, "of a grain's surface; up to 800 where it needs them", 100, 10'000);
  add_number(command, "--threads", arguments->threads, "cpu threads; results do not depend on it", 1, 1024);
  command.callback([arguments] { segment(*arguments); });
}

}  // namespace macadam
