// SPDX-License-Identifier: GPL-3.0-or-later
// main.cpp  The command line: macadam run | specimen | shapes | info. Exit code 0 done, 1 the run failed, 2 the input
// is wrong.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <csignal>

#include "host/cli/progress_line.hpp"
#include "host/cli/shapes_command.hpp"
#include "macadam/macadam.hpp"

namespace macadam {
namespace {

/// What `run` and `specimen` were asked on the command line.
struct Arguments {
  std::string scene, out;
  std::optional<Backend> backend;
  std::optional<Precision> precision;
  std::optional<SolverMethod> method;
  std::optional<int> threads;
  std::optional<std::uint64_t> seed;
  bool resume = false;
  std::vector<std::string> sections;
};

/// Set by the first Ctrl-C or SIGTERM once the stepping begins; the second ends the program as it would any other.
volatile std::sig_atomic_t stop_asked = 0;
extern "C" void ask_to_stop(int) {
  stop_asked = 1;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

void print_preparation(const Preparation& p) {
  if (!p.composition.empty()) {
    fmt::print("{:<14} {:>9} {:>9} {:>12} {:>12}\n", "class", "asked", "reached", "asked/box", "reached/box");
    for (const CompositionRow& row : p.composition) {
      fmt::print("{:<14} {:>9} {:>9} {:>11.3f}% {:>11.3f}%\n", row.name, row.count_asked, row.count,
                 100 * row.fraction_asked, 100 * row.fraction);
    }
  }
  fmt::print("{} particles, {} contacts (", p.specimen.size(), p.network.contacts.size());
  const char* separator = "";
  for (int pair = 0; pair < pair_types; ++pair) {
    if (const auto n = p.network.count[static_cast<std::size_t>(pair)]; n > 0) {
      fmt::print("{}{} {}", separator, to_string(static_cast<PairType>(pair)), n);
      separator = ", ";
    }
  }
  fmt::print("), {} contact points\n", p.network.point_area.size());
  if (p.network.dropped_gap + p.network.dropped_area > 0) {
    fmt::print("dropped: {} facets by gap_max, {} by area_min\n", p.network.dropped_gap, p.network.dropped_area);
  }
  if (p.loose_particles > 0) fmt::print("warning: {} particles are not joined to both walls\n", p.loose_particles);
  fmt::print("specimen {:.2f} s, tessellation {:.2f} s, network {:.2f} s\n", p.seconds_specimen, p.seconds_tessellation,
             p.seconds_network);
}

Scene scene_of(const Arguments& arguments) {
  Scene scene = read_scene(arguments.scene);
  if (arguments.method) scene.solver.method = *arguments.method;
  if (arguments.backend) scene.solver.backend = *arguments.backend;
  if (arguments.precision) scene.solver.precision = *arguments.precision;
  if (arguments.threads) scene.solver.threads = *arguments.threads;
  if (arguments.seed && scene.specimen.file) throw InputError("--seed: the scene takes its specimen from a file");
  if (arguments.seed) {
    scene.specimen.seed = *arguments.seed;
    scene.text += fmt::format("\n# --seed {}", *arguments.seed);  // a checkpoint belongs to the text
  }
  return scene;
}

void print_results(const RunResult& result) {
  fmt::print("\n{:>8} {:>11} {:>9}", "f (Hz)", "|E*| (GPa)", "phi (deg)");
  const bool stepped = !result.frequencies.empty() && result.frequencies.front().method == SolverMethod::explicit_;
  const bool known = stepped && result.frequencies.front().achieved;
  if (stepped) {
    fmt::print(" {:>11} {:>9} {:>9} {:>10} {:>9}\n", known ? "err |E*|" : "d|E*| cycle", known ? "err (rad)" : "d phi",
               "scaling", "steps", "time (s)");
  } else {
    fmt::print(" {:>9} {:>10} {:>11} {:>9}\n", "residual", "iterations", "held force", "time (s)");
  }
  for (const FrequencyResult& f : result.frequencies) {
    fmt::print("{:>8g} {:>11.5f} {:>9.4f}", f.frequency_hz, f.stiffness.e_star_pa / 1e9, f.stiffness.phase_deg);
    if (f.cyclic) {
      const double e_star = f.achieved ? f.achieved->e_star : f.cyclic->change_e_star;
      const double phase = f.achieved ? f.achieved->phase_rad : f.cyclic->change_phase_deg;
      fmt::print(" {:>11.1e} {:>9.1e} {:>9.5g} {:>10} {:>9.1f}\n", e_star, phase, f.density_scaling, f.steps,
                 f.seconds);
    } else {
      fmt::print(" {:>9.1e} {:>10} {:>11.1e} {:>9.1f}\n", f.residual, f.iterations, f.held_force, f.seconds);
    }
  }
  if (known) fmt::print("err: against the harmonic solution at true mass, |E*| relative, phi in radians\n");
  for (const FrequencyResult& f : result.frequencies) {
    if (f.kept && !*f.kept) fmt::print("warning: {} Hz: the tolerance was not kept\n", f.frequency_hz);
  }
}

void run_command(const Arguments& arguments) {
  const Scene scene = scene_of(arguments);
  ProgressLine line;
  Watcher watcher;
  watcher.progress = [&](const std::string& stage, double share) { line.show(stage, share); };
  watcher.prepared = [&](const Preparation& prepared) {
    line.clear();
    print_preparation(prepared);
    std::fflush(stdout);
  };
  watcher.planned = [&](const RunResult& planned) {
    line.clear();
    for (const std::string& decision : planned.decisions) fmt::print("{}\n", decision);
    for (const Skip& skip : planned.skips) fmt::print("skips {}: {}\n", skip.what, skip.why);
    std::fflush(stdout);
    // until now there is nothing to keep, and an older checkpoint is whole
    for (const int number : {SIGINT, SIGTERM}) {
      if (std::signal(number, ask_to_stop) == SIG_IGN) std::signal(number, SIG_IGN);
    }
  };
  watcher.stop = [] { return stop_asked != 0; };
  const RunResult result = run(scene, arguments.out, watcher, arguments.resume);
  line.clear();
  print_results(result);
  fmt::print("\n{} | files in {}: summary.json specimen.csv{}{}\n", result.solver, arguments.out,
             scene.solver.method == SolverMethod::explicit_ && scene.output.response ? " response.csv" : "",
             scene.output.contacts ? " contacts.csv" : "");
}

/// Writes what a plane cuts and says how much of it is aggregate.
void write_section(const Preparation& prepared, const SectionPlane& plane, const std::filesystem::path& out) {
  const CrossSection section = cut(prepared.specimen, prepared.tessellation, plane);
  write_cross_section_csv(out / section_file_name(plane), prepared.specimen, section);
  double all = 0, aggregate = 0;
  for (const SectionCell& cell : section.cells) {
    all += cell.area;
    if (prepared.specimen.phase[cell.particle] == Phase::aggregate) aggregate += cell.area;
  }
  fmt::print("section {}={} m: {} cells, {:.2f} % of the area is aggregate\n", plane.axis, plane.position,
             section.cells.size(), 100 * aggregate / all);
}

void specimen_command(const Arguments& arguments) {
  const Scene scene = scene_of(arguments);
  std::vector<SectionPlane> planes;  // a wrong one is refused before the work
  for (const std::string& text : arguments.sections) planes.push_back(read_section_plane(text, scene.specimen.box));
  ProgressLine line;
  const Preparation prepared = prepare(scene, [&](const std::string& stage, double share) { line.show(stage, share); });
  write_preparation(scene, prepared, arguments.out);
  line.clear();
  print_preparation(prepared);
  const TessellationInvariants i = measure_invariants(prepared.specimen, prepared.tessellation);
  fmt::print("tessellation errors: volume {:.1e}, closure {:.1e}, flatness {:.1e}, power {:.1e}, walls {:.1e}\n",
             i.volume, i.closure, i.flatness, i.power, i.walls);
  for (const SectionPlane& plane : planes) write_section(prepared, plane, arguments.out);
  fmt::print("files in {}\n", arguments.out);
}

void info_command() {
  const BackendReport report = report_backends();
  fmt::print("macadam {}\n", version());
  fmt::print("cpu        yes, {} threads\n", report.threads);
  fmt::print("reference  yes, for checking: per point, double, one thread\n");
  fmt::print("cuda       {}: {}\n", report.devices.empty() ? "no" : "yes", report.cuda_status);
  for (const DeviceInfo& d : report.devices) {
    fmt::print("           {}, compute capability {}.{}, {} multiprocessors, {:.1f} GiB\n", d.name,
               d.compute_capability / 10, d.compute_capability % 10, d.multiprocessors,
               static_cast<double>(d.memory_bytes) / (1 << 30));
  }
  std::string reason;
  const Backend chosen = select_backend(Backend::automatic, &reason);
  fmt::print("auto       {} ({})\n", to_string(chosen), reason);
}

void add_job_options(CLI::App& command, Arguments& arguments) {
  command.add_option("scene", arguments.scene, "scene file (TOML)")->required();
  command.add_option("--out", arguments.out, "folder of the results; made if it is not there")->required();
  command.add_option("--seed", arguments.seed, "instead of the scene's: another specimen of the same mixture");
}

}  // namespace

int main_function(int argc, char** argv) {
  CLI::App app("Macadam: discrete elements for bituminous mixtures and other bonded granular solids");
  app.require_subcommand(1);
  app.set_version_flag("--version", version());
  Arguments arguments;

  auto* run_app = app.add_subcommand("run", "run a scene and write its results");
  add_job_options(*run_app, arguments);
  run_app->add_option("--backend", arguments.backend, "instead of the scene's: auto, cuda, cpu or reference")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Backend>{{"auto", Backend::automatic},
                                                                         {"cuda", Backend::cuda},
                                                                         {"cpu", Backend::cpu},
                                                                         {"reference", Backend::reference}}));
  run_app->add_option("--precision", arguments.precision, "instead of the scene's: double, mixed or single")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Precision>{
          {"double", Precision::double_}, {"mixed", Precision::mixed}, {"single", Precision::single}}));
  run_app->add_option("--method", arguments.method, "instead of the scene's: explicit or harmonic")
      ->transform(CLI::CheckedTransformer(std::map<std::string, SolverMethod>{{"explicit", SolverMethod::explicit_},
                                                                              {"harmonic", SolverMethod::harmonic}}));
  run_app->add_option("--threads", arguments.threads, "cpu threads; results do not depend on it")
      ->check(CLI::Range(1, 1024));
  run_app->add_flag("--resume", arguments.resume, "go on from the checkpoint that an interrupted run left in DIR");
  auto* specimen_app = app.add_subcommand("specimen", "build the specimen and its contact network only");
  add_job_options(*specimen_app, arguments);
  specimen_app
      ->add_option("--section", arguments.sections,
                   "cut the cells by a plane, such as x=0.025 or \"z=40 mm\"; may be given several times")
      ->allow_extra_args(false);  // what follows is the scene
  add_shapes_command(app);
  auto* info_app = app.add_subcommand("info", "version, backends and devices");

  try {
    app.parse(argc, argv);  // runs the commands that have callbacks
    if (*run_app)
      run_command(arguments);
    else if (*specimen_app)
      specimen_command(arguments);
    else if (*info_app)
      info_command();
    return 0;
  } catch (const CLI::ParseError& error) { return app.exit(error) == 0 ? 0 : 2; } catch (const InputError& error) {
    fmt::print(stderr, "macadam: {}\n", error.what());
    return 2;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "macadam: out of memory\n");
    return 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "macadam: {}\n", error.what());
    return 1;
  }
}

}  // namespace macadam

int main(int argc, char** argv) { return macadam::main_function(argc, argv); }
