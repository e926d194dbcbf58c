// SPDX-License-Identifier: GPL-3.0-or-later
// job.cpp  Handles scene, seed and folder of a command, and prints the text about a specimen.
#include "host/cli/terminal/job.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/stop_signals.hpp"
#include "macadam/error.hpp"
#include "macadam/overrides.hpp"

namespace macadam {

DeviceList devices_of(const std::string& text) {
  if (text == "all") return {every_device};
  DeviceList out;
  for (const char *at = text.data(), *end = at + text.size();; ++at) {
    constexpr int most = 1023;
    int number = -1;
    const auto [stop, error] = std::from_chars(at, end, number);
    const bool known = error == std::errc{} && number >= 0 && number <= most;
    if (!known || (stop != end && *stop != ',') || std::count(out.begin(), out.end(), number) > 0)
      options::refuse("--device", text,
                      fmt::format("\"all\", or different whole numbers from 0 to {} separated by commas", most));
    out.push_back(number);
    if (stop == end) return out;
    at = stop;
  }
}

void add_job_options(CLI::App& command, Job& job) {
  add_text(command, "scene", job.scene, "scene file (TOML)")->required();
  add_out_and_seed(command, job);
}

void add_out_and_seed(CLI::App& command, Job& job) {
  add_out(command, job.out);
  add_number(command, "--seed", job.seed,
             "seed of the generator: another seed gives another specimen of the same mixture", 0,
             std::numeric_limits<std::uint64_t>::max())
      ->group(instead_of_scene);
}

void add_set(CLI::App& command, std::vector<std::string>& set) {
  command
      .add_option("--set", set,
                  "value of a key of the scene, such as solver.method=harmonic, contacts.M-A.delta=2 or "
                  "\"loading.frequencies=[1, 10]\"; may be given several times")
      ->allow_extra_args(false)  // the argument that follows may be the scene
      ->type_name("KEY=VALUE")
      ->group(instead_of_scene);
}

void add_overrides(CLI::App& command, Overrides& instead) {
  add_choice(
      command, "--backend", instead.backend,
      "backend that computes: auto is a CUDA device if there is one, else the CPU",
      {{"auto", Backend::automatic}, {"cuda", Backend::cuda}, {"cpu", Backend::cpu}, {"reference", Backend::reference}})
      ->group(instead_of_scene);
  add_choice(command, "--precision", instead.precision, "precision of the time steps",
             {{"double", Precision::double_}, {"mixed", Precision::mixed}, {"single", Precision::single}})
      ->group(instead_of_scene);
  add_choice(command, "--method", instead.method,
             "step the test in time, solve it in the frequency domain, or follow it by increments without inertia",
             {{"explicit", SolverMethod::explicit_},
              {"harmonic", SolverMethod::harmonic},
              {"quasi_static", SolverMethod::quasi_static}})
      ->group(instead_of_scene);
  add_choice(
      command, "--linear", instead.linear,
      "solver of the frequency domain: iterative, or direct by factorisation on the CPU",
      {{"auto", LinearMethod::automatic}, {"iterative", LinearMethod::iterative}, {"direct", LinearMethod::direct}})
      ->group(instead_of_scene);
  add_number(command, "--threads", instead.threads, "number of threads of the CPU; results do not depend on it", 1,
             1024)
      ->group(instead_of_scene);
  add_devices(command, instead.devices)->group(instead_of_scene);
}

Scene scene_of(const Job& job) {
  Scene scene = read_changed_scene(job.scene, job.set);
  Overrides instead;
  instead.seed = job.seed;
  apply(instead, scene);
  return scene;
}

void say_recipe(const Scene& scene, const Preparation& prepared) {
  if (!scene.recipe) return;
  const MixDesign& design = *scene.recipe;
  const MixVolumes v = volumes_of(design);
  say("recipe: binder {:.2f} % of the mix by mass, {:.2f} % of the aggregate by mass; effective binder {:.2f} % of the "
      "mix by mass\n",
      100 * v.binder, 100 * v.binder / (1 - v.binder), 100 * v.effective_binder);
  say("maximum density {:.1f} kg/m3, bulk density {:.1f} kg/m3, air voids {:.2f} %, VMA {:.2f} %, VFB {:.2f} %\n",
      v.maximum_density, v.bulk_density, 100 * v.air_voids, 100 * v.vma, 100 * v.vfb);
  const auto phase = [](const char* name, double mass, double volume, double density) {
    say("{:<9} {:6.2f} % of the mass, {:6.2f} % of the box, {:.1f} kg/m3\n", name, 100 * mass, 100 * volume, density);
  };
  if (!v.classes.empty()) phase("aggregate", v.aggregate_mass, v.aggregate_volume, v.aggregate_density);
  phase("mastic", v.mastic_mass, v.mastic_volume, v.mastic_density);
  say("{:>9} {:>13} {:>9}\n", "sieve", "passing asked", "reached");
  for (const GradationRow& row : gradation_of(design, prepared.composition)) {
    say("{:>6.6g} mm {:>12.2f}% {:>8.2f}%{}\n", 1e3 * row.size, 100 * row.asked, 100 * row.reached,
        row.size < design.cut ? " (in the mastic)" : "");
  }
  for (const SievePassing& s : outside_of_envelope(design))
    say("outside of the envelope: {:.4g} % passing the sieve of {:.6g} mm\n", 100 * s.passing, 1e3 * s.size);
}

void say_preparation(const Preparation& p) {
  if (!p.composition.empty()) {
    say("{:<14} {:>9} {:>9} {:>12} {:>12}\n", "class", "asked", "reached", "asked/box", "reached/box");
    for (const CompositionRow& row : p.composition) {
      say("{:<14} {:>9} {:>9} {:>11.3f}% {:>11.3f}%\n", row.name, row.count_asked, row.count, 100 * row.fraction_asked,
          100 * row.fraction);
    }
  }
  say("{} particles, ", p.specimen.size());
  if (!p.specimen.voids.empty()) say("{} voids, ", p.specimen.voids.size());
  say("{} contacts (", p.network.contacts.size());
  const char* separator = "";
  for (int pair = 0; pair < pair_types; ++pair) {
    if (const auto n = p.network.count[static_cast<std::size_t>(pair)]; n > 0) {
      say("{}{} {}", separator, to_string(static_cast<PairType>(pair)), n);
      separator = ", ";
    }
  }
  say("), {} contact points\n", p.network.point_area.size());
  if (p.network.dropped_gap + p.network.dropped_area > 0) {
    say("facets that are not contacts: {} because of gap_max, {} because of area_min\n", p.network.dropped_gap,
        p.network.dropped_area);
  }
  for (const NotchCut& cut : p.network.notches)
    say("notch at {} = {:.6g} mm: {} contacts removed, {} shortened; ligament {:.6g} mm2\n", "xyz"[cut.notch.axis],
        1e3 * cut.notch.position, cut.removed, cut.shortened, 1e6 * cut.ligament);
  if (p.loose_particles > 0)
    say("warning: {} particles have no path of contacts to the bottom wall, to the top wall or to both\n",
        p.loose_particles);
  say("specimen {:.2f} s, tessellation {:.2f} s, network {:.2f} s\n", p.seconds_specimen, p.seconds_tessellation,
      p.seconds_network);
}

void show_or_stop(ProgressLine& line, const std::string& stage, double share) {
  if (stop_asked()) {
    throw InterruptedError(
        fmt::format("interrupted at: {}; nothing was written, and the files in the folder are unchanged", stage));
  }
  line.show(stage, share);
}

}  // namespace macadam
