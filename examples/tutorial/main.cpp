// SPDX-License-Identifier: GPL-3.0-or-later
// main.cpp  The library in thirty lines: reads a scene, makes its contacts, solves E* in the frequency domain, and
// steps the same test in time.
#include <macadam/macadam.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

int main(int argc, char** argv) try {
  // 1. Reads a scene from a file, checks it, and changes it
  macadam::Scene scene = macadam::read_scene(argc > 1 ? argv[1] : "examples/demo/scene.toml");
  scene.specimen.box.size = {14e-3, 14e-3, 16e-3};  // m
  scene.cyclic().frequencies = {20};                // Hz

  // 2. Makes the particles of the scene, their Laguerre cells, and the contacts between the particles
  const macadam::Preparation prepared = macadam::prepare(scene);
  std::printf("%zu particles, %zu contacts\n", prepared.specimen.size(), prepared.network.contacts.size());

  // 3. Solves the steady state at 20 Hz in the frequency domain, at true mass (a density scaling of 1)
  const macadam::Inertia inertia =
      macadam::make_inertia(prepared.specimen, scene.materials.aggregate, scene.materials.mastic);
  macadam::Harmonic harmonic(prepared.specimen, prepared.network, scene.laws, inertia, {}, 20);
  const macadam::HarmonicResult solved = harmonic.solve(20, 1);
  std::printf("solved:  |E*| %.2f GPa, phi %.2f degrees\n", 1e-9 * solved.top.e_star_pa, solved.top.phase_deg);

  // 4. Steps the same test in time, within the tolerance that the scene asks for
  const std::string folder = argc > 2 ? argv[2] : "tutorial-results";
  macadam::run(scene, folder);

  // 5. Reads the recorded strain and stress from the file, and evaluates |E*| and phase angle from them again
  std::ifstream file(folder + "/response.csv");
  file.ignore(1000, '\n');  // the names of the columns
  std::vector<macadam::ResponseSample> samples;
  char comma = 0;
  for (macadam::ResponseSample s;
       file >> s.frequency_hz >> comma >> s.time_s >> comma >> s.strain >> comma >> s.stress_pa;)
    samples.push_back(s);
  const macadam::Stiffness stepped = macadam::evaluate_cyclic(samples, 20, 1).fit;
  std::printf("stepped: |E*| %.2f GPa, phi %.2f degrees\n", 1e-9 * stepped.e_star_pa, stepped.phase_deg);
  return std::abs(stepped.e_star_pa / solved.top.e_star_pa - 1) <= scene.solver.tolerance.value_or(1e-3) ? 0 : 1;
} catch (const macadam::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
