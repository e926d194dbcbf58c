// SPDX-License-Identifier: GPL-3.0-or-later
// skips.cpp  Measures what a step saves when it skips work that a scene does not need, and whether results change.
//
// Each skip is compared with a run that does the work. Both run in turns within one process, and the ratio is the
// median over the turns, so that other load on the machine slows both equally. Prints a CSV with one row per skip.
// Usage: skips [cpu|cuda]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "tests/support/general_laws.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam {
namespace {

using test::TestScene;
using Clock = std::chrono::steady_clock;

Backend backend = Backend::cpu;

/// Returns the full specimen with given laws and contact rules.
TestScene full(const NetworkSpec& spec = {}, const test::Laws& laws = test::am1_laws()) {
  static const Specimen specimen = read_specimen_csv(MACADAM_TEST_DATA "/ss_full.csv.gz", {{0.05, 0.05, 0.08}});
  return test::make_scene(specimen, spec, laws);
}

/// Returns equal spheres on a cubic lattice, with α = 0, so that no particle rotates.
TestScene lattice() {
  constexpr int nx = 25, ny = 25, nz = 40;
  constexpr double side = 2e-3;
  Specimen out;
  out.box.size = {nx * side, ny * side, nz * side};
  for (int k = 0; k < nx * ny * nz; ++k) {
    out.centre.push_back({(k % nx + 0.5) * side, (k / nx % ny + 0.5) * side, (k / nx / ny + 0.5) * side});
  }
  out.radius.assign(out.centre.size(), 0.55 * side);
  out.phase.assign(out.centre.size(), Phase::mastic);
  out.body.assign(out.centre.size(), -1);
  test::Laws laws = test::am1_laws();
  std::get<laws::GeneralisedKelvin>(*laws[static_cast<std::size_t>(PairType::mm)]).alpha = 0;
  return test::make_scene(out, {}, laws);
}

/// Returns the laws of AM1 as springs with their instantaneous stiffness.
test::Laws elastic() {
  test::Laws laws = test::am1_laws();
  for (auto& law : laws) {
    if (law)
      law = laws::Elastic{std::visit([](const auto& l) { return l.instantaneous(); }, *law),
                          std::visit([](const auto& l) { return l.alpha; }, *law)};
  }
  return laws;
}

/// A scene, its laws and the options with which it is stepped.
struct Way {
  const TestScene& scene;
  test::Laws laws;
  StepperOptions options;
};

/// Times per step with and without the skip [µs], their ratio (time without the skip divided by time with it), and the
/// relative difference of the velocities.
struct Comparison {
  double with_us = 0, without_us = 0, ratio = 0, difference = 0;
};

/// Steps a scene in two ways in turn and compares times and velocities.
Comparison compare(const Way& with, const Way& without) {
  const auto make = [](const Way& way) {
    return make_stepper(backend, way.scene.specimen, way.scene.network, way.laws, way.scene.inertia, way.options);
  };
  const std::unique_ptr<Stepper> steppers[2] = {make(with), make(without)};
  constexpr int turns = 9, warm = 10;
  const std::int64_t steps = backend == Backend::cuda ? 2000 : 20;
  for (const auto& stepper : steppers) stepper->advance(warm);
  std::vector<double> ratios, times[2];
  for (int turn = 0; turn < turns; ++turn) {
    for (int which = 0; which < 2; ++which) {
      const auto start = Clock::now();
      steppers[which]->advance(steps);
      times[which].push_back(1e6 * std::chrono::duration<double>(Clock::now() - start).count() / double(steps));
    }
    ratios.push_back(times[1].back() / times[0].back());
  }
  const auto median = [](std::vector<double> list) {
    std::nth_element(list.begin(), list.begin() + turns / 2, list.end());
    return list[turns / 2];
  };
  return {median(times[0]), median(times[1]), median(ratios),
          test::relative_difference(steppers[0]->particles().velocity, steppers[1]->particles().velocity)};
}

/// Prints one row: the skip, the stepped scenes with and without it, and the difference. If the skip changes
/// the model, `change` is the relative change of |E*|.
void row(const char* what, const char* with, const char* without, const Comparison& c, const char* compared,
         double change = 0) {
  fmt::print("{},\"{}\",\"{}\",{:.1f},{:.1f},{:.3f},{},{:.2e}\n", what, with, without, c.with_us, c.without_us, c.ratio,
             compared, change != 0 ? change : c.difference);
  std::fflush(stdout);
}

/// Returns |E*| at 20 Hz without inertia.
double modulus(const TestScene& scene) {
  return Harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, 20).solve(20).top.e_star_pa;
}

/// Compares a whole experiment with and without response.csv: wall time and result.
void observation() {
  Scene scene;
  scene.specimen.file = MACADAM_TEST_DATA "/t8.csv";
  scene.specimen.box.size = {0.008, 0.008, 0.011};
  scene.materials = {2630, 2110};
  scene.laws = test::am1_laws();
  scene.cyclic().frequencies = {20};
  scene.cyclic().cycles = 10;
  scene.solver.density_scaling = std::vector<double>{5e4};
  scene.solver.geometry = Geometry::fixed;
  scene.solver.backend = backend;
  const auto folder = std::filesystem::temp_directory_path() / "macadam_skips";
  Comparison c;
  std::vector<double> times[2], ratios;
  Stiffness found[2];
  for (int turn = 0; turn < 9; ++turn) {
    for (int which = 0; which < 2; ++which) {
      scene.output.response = which == 1;
      const experiments::SteppedFrequency f = run(scene, folder).stepped().frequencies[0];
      times[which].push_back(1e6 * f.seconds / static_cast<double>(f.steps));
      found[which] = f.stiffness;
    }
    ratios.push_back(times[1].back() / times[0].back());
  }
  std::filesystem::remove_all(folder);
  for (auto* list : {&times[0], &times[1], &ratios}) std::sort(list->begin(), list->end());
  c = {times[0][4], times[1][4], ratios[4], std::abs(found[0].e_star_pa / found[1].e_star_pa - 1)};
  row("observation: response.csv not asked for", "t8, 10 cycles", "t8, 10 cycles, observed", c, "modulus");
}

void all() {
  fmt::print("skipped,with,without,with_us,without_us,ratio,compared,difference\n");
  {
    const TestScene scene = full();
    StepperOptions options = test::shaking_options(scene), updated = options;
    options.geometry = Geometry::fixed;
    updated.geometry = Geometry::updated;
    auto c = compare({scene, elastic(), updated}, {scene, test::general_laws(elastic(), 3), updated});
    row("Kelvin units that no law has", "full, elastic, updated", "full, three Kelvin units, updated", c, "velocities");
    c = compare({scene, elastic(), options}, {scene, test::general_laws(elastic(), 0), options});
    row("states of elastic contacts", "full, elastic, fixed", "full, elastic with states, fixed", c, "velocities");
    test::Laws smooth = test::am1_laws();
    for (auto& law : smooth) std::visit([](auto& l) { l.alpha = 0; }, *law);
    StepperOptions kept = options;
    kept.skip_shear = false;
    c = compare({scene, smooth, options}, {scene, smooth, kept});
    row("shear where α = 0", "full, AM1 with α = 0, fixed", "full, AM1 with α = 0 and shear, fixed", c, "velocities");
    c = compare({scene, scene.laws, options}, {scene, scene.laws, updated});
    row("geometry update", "full, AM1, fixed", "full, AM1, updated", c, "velocities");
    NetworkSpec spec;
    spec.area_min = 0.026;
    const TestScene filtered = full(spec);
    c = compare({filtered, filtered.laws, options}, {scene, scene.laws, options});
    row("facets below 0.026 of the mean area", "full, AM1 without them, fixed", "full, AM1, fixed", c, "model",
        modulus(filtered) / modulus(scene) - 1);
  }
  {
    const TestScene scene = lattice();
    StepperOptions options = test::shaking_options(scene), kept = options;
    options.geometry = kept.geometry = Geometry::fixed;
    kept.skip_rotations = false;
    const auto c = compare({scene, scene.laws, options}, {scene, scene.laws, kept});
    row("rotations where nothing turns", "lattice, AM1 with α = 0, fixed",
        "lattice, AM1 with α = 0 and rotations, fixed", c, "velocities");
  }
  {
    NetworkSpec spec;
    spec.quadrature = Quadrature::one_point;
    const TestScene scene = full(spec);
    StepperOptions points = test::shaking_options(scene), condensed = points;
    points.geometry = condensed.geometry = Geometry::fixed;
    points.form = ContactForm::points;
    const auto c = compare({scene, scene.laws, points}, {scene, scene.laws, condensed});
    row("second moments where a facet has one point", "full, AM1, one_point, fixed",
        "full, AM1, one_point with second moments, fixed", c, "velocities");
  }
  observation();
}

}  // namespace
}  // namespace macadam

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "cuda") macadam::backend = macadam::Backend::cuda;
  macadam::all();
}
