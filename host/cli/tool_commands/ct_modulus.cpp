// SPDX-License-Identifier: GPL-3.0-or-later
// ct_modulus.cpp  Implements `macadam ct modulus DIR --scene SCENE --out RESULTS`.
#include "host/cli/tool_commands/ct_modulus.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/progress_line.hpp"
#include "host/cli/terminal/stop_signals.hpp"
#include "host/cli/terminal/streams.hpp"
#include "host/tools/ct/continuum/modulus_files.hpp"
#include "macadam/ct.hpp"
#include "macadam/error.hpp"
#include "macadam/lengths.hpp"
#include "macadam/scene.hpp"
#include "macadam/thread_limit.hpp"

namespace macadam {
namespace {

using continuum::ModulusFiles;
using continuum::ModulusPlan;
using continuum::PointModulus;
using continuum::ScanPhases;

struct CtModulusArguments {
  std::string folder, scene, out, memory, voxel;
  std::optional<int> threads;
};

/// Prints the scan and the sizes of the elements.
void say_plan(const ModulusPlan& plan, double memory) {
  const continuum::Scan& scan = plan.scan;
  say("specimen of {:.4g} x {:.4g} x {:.4g} mm, from {} x {} x {} voxels of {:.4g} mm: aggregate {:.2f} %, mastic "
      "{:.2f} %, air voids {:.2f} %\n",
      1e3 * scan.size.x * scan.edge, 1e3 * scan.size.y * scan.edge, 1e3 * scan.size.z * scan.edge, scan.size.x,
      scan.size.y, scan.size.z, 1e3 * scan.edge, 100 * plan.rock, 100 * plan.mastic, 100 * plan.voids);
  if (plan.removed_height > 0)
    say("{:.3g} mm at the top are left out, because the height must be a multiple of the largest elements\n",
        1e3 * plan.removed_height);
  say("finite elements of {:.4g}, {:.4g} and {:.4g} mm: up to {:.2g} million elements and {:.2g} GB of memory (of "
      "{:.2g} GB that may be used)\n",
      1e3 * plan.edge(0), 1e3 * plan.edge(1), 1e3 * plan.edge(2),
      double(scan.size.elements()) / std::pow(plan.blocks.back(), 3) / 1e6, plan.bytes / 1e9, memory / 1e9);
  for (const std::string& warning : plan.warnings) say("warning: {}\n", warning);
}

/// Prints the table of the points that have a result.
void say_results(const ScanPhases& phases, const std::vector<PointModulus>& results) {
  constexpr double degrees = 180 / std::numbers::pi;
  const bool warm = phases.points.front().temperature_c.has_value();
  say("\n{}{:>10} {:>11} {:>8} {:>9} {:>8} {:>7}\n", warm ? "   T (C) " : "", "f (Hz)", "|E*| (GPa)", "+- (%)",
      "phi (deg)", "+- (deg)", "nu");
  bool fewer = false;
  for (std::size_t p = 0; p < results.size(); ++p) {
    const PointModulus& r = results[p];
    if (r.sizes == 0) continue;
    fewer = fewer || r.sizes < 3;
    const double modulus = std::abs(r.limit.modulus);
    say("{}{:>10g} {:>11.5f} {:>8.2f} {:>9.3f} {:>8.3f} {:>7.4f}{}\n",
        warm ? fmt::format("{:>8g} ", *phases.points[p].temperature_c) : "", phases.points[p].frequency_hz,
        modulus / 1e9, 100 * r.limit.uncertainty / modulus, std::arg(r.limit.modulus) * degrees,
        r.limit.phase_uncertainty * degrees, std::abs(r.limit.poisson), r.sizes < 3 ? " *" : "");
  }
  say("The values are extrapolated to small elements. +- estimates the error of this extrapolation; it is not a bound, "
      "and does not include errors of the scan and of the laws.\n");
  if (fewer) say("* computed without the smallest elements\n");
}

void modulus(const CtModulusArguments& arguments) {
  const ThreadLimit threads(arguments.threads);
  const double memory = ct::memory_of(arguments.memory);
  const double voxel = arguments.voxel.empty() ? 0 : length_of(arguments.voxel, "--voxel");
  if (!arguments.voxel.empty() && !(voxel > 0))
    throw InputError("command line", 0, "--voxel", '"' + arguments.voxel + '"', "a length above 0");
  const ScanPhases phases = continuum::phases_of(read_scene(arguments.scene));
  listen_to_stop_signals();
  ProgressLine line;
  line.show("reading the scan", 0);
  const ModulusPlan plan = continuum::plan_modulus(arguments.folder, memory, voxel);
  ModulusFiles files(arguments.out, plan, phases, arguments.scene);
  line.clear();
  say_plan(plan, memory);
  std::vector<PointModulus> results(phases.points.size());
  const auto end = [&](const std::string& status) {
    line.clear();
    files.write(results, status);
  };
  try {
    results = continuum::solve_modulus(
        plan, phases,
        {[&](const std::string& stage, double fraction) { line.show(stage, fraction); }, stop_asked,
         [&](double seconds) {
           line.clear();
           say("expected time: about {:.0f} s with {} threads\n", std::ceil(seconds), omp_get_max_threads());
         },
         [&](const continuum::ModulusSolution& solution) { files.add(solution); },
         [&](const std::vector<PointModulus>& improved) {
           results = improved;
           files.write(results, "running");
         }});
  } catch (const InterruptedError&) {
    end("interrupted");
    const auto known = std::count_if(results.begin(), results.end(), [](const auto& r) { return r.sizes > 0; });
    if (known > 0) say_results(phases, results);
    throw InterruptedError(
        fmt::format("interrupted; {}/modulus.csv has {} of {} results, and {}/voxels.csv all "
                    "solutions so far",
                    arguments.out, known, results.size(), arguments.out));
  } catch (const std::exception& error) {
    end(std::string("failed: ") + error.what());
    throw;
  }
  end("done");
  say_results(phases, results);
  say("files in {}: modulus.csv voxels.csv summary.json\n", arguments.out);
}

}  // namespace

void add_ct_modulus(CLI::App& ct) {
  const auto arguments = std::make_shared<CtModulusArguments>();
  CLI::App& command =
      *ct.add_subcommand("modulus", "compute the modulus of a segmented scan without separating its grains");
  add_text(command, "folder", arguments->folder,
           "folder that macadam ct segment wrote, or the subfolder \"truth\" of a folder that macadam ct phantom wrote",
           "FOLDER")
      ->required();
  add_text(command, "--scene", arguments->scene,
           "scene file with rule \"series\": laws of the phases in [materials], frequencies in [loading]")
      ->required();
  add_out(command, arguments->out);
  add_text(command, "--voxel", arguments->voxel,
           "edge of the smallest elements (\"0.5 mm\"), a multiple of the scan's voxel; default: the smallest edge for "
           "which the memory suffices",
           "LENGTH");
  add_text(command, "--memory", arguments->memory,
           "memory that may be used (\"3 GB\"; default: four fifths of the free memory)", "BYTES");
  add_number(command, "--threads", arguments->threads, "number of CPU threads; results do not depend on it", 1, 1024);
  add_examples(command,
               {"macadam ct segment results/phantom/scan.mha --out results/segmented",
                "macadam ct modulus results/segmented --scene examples/ct/modulus.toml --out results/modulus"});
  command.callback([arguments] { modulus(*arguments); });
}

}  // namespace macadam
