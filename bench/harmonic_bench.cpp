// SPDX-License-Identifier: GPL-3.0-or-later
// harmonic_bench.cpp  The frequency domain from the contact network on: time, iterations and memory, as CSV.
//
//   harmonic_bench [--backend cpu|cuda]… [--fcc PARTICLES]… [--frequencies 2,5,10,20] [--tolerance 1e-8] [--runs 3]
//                  [--digits] [SCENE.toml …]
//
// A scene's specimen and network are made first and not timed. --fcc: a jittered lattice of three pair types between
// two walls. `setup_s`: order, rows, preconditioner and its copy to the device; `solve_s`: all frequencies side by
// side, the check of the solutions included. Each is the median of the runs; `first_s` has both of the first run.
// --digits: beside them how far |E*| and φ are, at most, from those with factors and a residual of 1e-11.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <chrono>

#include "bench/fcc_network.hpp"
#include "macadam/macadam.hpp"

namespace macadam::bench {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }
double median(std::vector<double> list) {
  std::sort(list.begin(), list.end());
  return list[list.size() / 2];
}

struct Options {
  std::vector<Backend> backends;
  std::vector<double> frequencies{2, 5, 10, 20};
  double tolerance = 1e-8;
  int runs = 3;
  bool digits = false;
  DeviceList devices;
};

/// Largest differences from solutions with factors: of |E*|, relative, and of φ [°].
std::pair<double, double> off(const test::TestScene& scene, const std::vector<HarmonicResult>& found) {
  Harmonic exact(scene.specimen, scene.network, scene.laws, scene.inertia, {.linear = LinearMethod::direct}, 6);
  std::pair<double, double> out{0, 0};
  for (const HarmonicResult& r : found) {
    const Stiffness with_factors = exact.solve(r.frequency_hz).top;
    out.first = std::max(out.first, std::abs(r.top.e_star_pa / with_factors.e_star_pa - 1));
    out.second = std::max(out.second, std::abs(r.top.phase_deg - with_factors.phase_deg));
  }
  return out;
}

void time_solver(const std::string& name, const test::TestScene& scene, const Options& options) {
  for (const Backend backend : options.backends) {
    std::vector<double> setup, solve;
    std::vector<HarmonicResult> found;
    for (int run = 0; run < options.runs; ++run) {
      const auto start = Clock::now();
      Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia,
                        {.tolerance = options.tolerance, .linear = LinearMethod::iterative, .backend = backend,
                         .devices = backend == Backend::cuda ? options.devices : DeviceList{}}, 6);
      setup.push_back(since(start));
      std::vector<HarmonicLoad> loads;
      for (const double f : options.frequencies) loads.push_back({f});
      found = harmonic.solve(loads);
      solve.push_back(since(start) - setup.back());
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    int iterations = 0;
    double residual = 0;
    for (const HarmonicResult& r : found) {
      iterations = std::max(iterations, r.iterations), residual = std::max(residual, r.residual);
    }
    std::printf("%s,%zu,%zu,%zu,%s,%d,%.4f,%.4f,%.4f,%d,%.2g,%.10g,%.9g,%.2f", name.c_str(), scene.specimen.size(),
                scene.network.contacts.size(), found.size(), to_string(backend), report_backends().threads,
                median(setup), median(solve), setup.front() + solve.front(), iterations, residual,
                found.back().top.e_star_pa, found.back().top.phase_deg, static_cast<double>(usage.ru_maxrss) / 1048576);
    if (options.digits) {
      const auto [modulus, phase] = off(scene, found);
      std::printf(",%.1e,%.1e", modulus, phase);
    }
    std::puts("");
    std::fflush(stdout);
  }
}

int bench(int argc, char** argv) {
  CLI::App app("The frequency domain from the contact network on");
  Options options;
  std::vector<std::string> backends{"cpu"}, scenes;
  std::vector<double> lattices;
  bool every = false;
  app.add_flag("--all-devices", every);
  app.add_option("--backend", backends)->check(CLI::IsMember({"cpu", "cuda"}));
  app.add_option("--fcc", lattices);
  app.add_option("--frequencies", options.frequencies)->delimiter(',');
  app.add_option("--tolerance", options.tolerance);
  app.add_option("--runs", options.runs)->check(CLI::PositiveNumber);
  app.add_flag("--digits", options.digits);
  app.add_option("scenes", scenes);
  CLI11_PARSE(app, argc, argv);
  if (every) options.devices = {every_device};
  for (const std::string& b : backends) options.backends.push_back(b == "cuda" ? Backend::cuda : Backend::cpu);
  std::printf(
      "network,particles,contacts,frequencies,backend,threads,setup_s,solve_s,first_s,iterations,residual,"
      "e_star_pa_last,phase_deg_last,process_gb%s\n",
      options.digits ? ",modulus_off,phase_off_deg" : "");
  for (const std::string& file : scenes) {
    const Scene scene = read_scene(file);
    Preparation prepared = prepare(scene);
    test::TestScene made;
    made.inertia = make_inertia(prepared.specimen, scene.materials.aggregate, scene.materials.mastic);
    made.specimen = std::move(prepared.specimen);
    made.network = std::move(prepared.network);
    made.laws = scene.laws;
    time_solver(std::filesystem::path(file).parent_path().filename().string(), made, options);
  }
  for (const double particles : lattices) {
    time_solver("fcc", fcc_scene(static_cast<std::size_t>(particles), true), options);
  }
  return 0;
}

}  // namespace
}  // namespace macadam::bench

int main(int argc, char** argv) {
  try {
    return macadam::bench::bench(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "harmonic_bench: %s\n", error.what());
    return 1;
  }
}
