// SPDX-License-Identifier: GPL-3.0-or-later
// aggregate_cube.cpp  Computes the modulus of cubes of aggregate. Writes a CSV with one row per cube to standard
// output.
#include "tests/support/aggregate_cube.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace macadam::test {
namespace {

/// Returns the contact modulus for which the cube has the modulus of the aggregate, from the cube moduli at two contact
/// moduli. The compliances of contacts and walls add up, so 1/modulus is linear in 1/E, except for small changes in how
/// the walls spread the load.
double contact_for_target(double E, double modulus, double other_E, double other_modulus) {
  const double slope = (1 / other_modulus - 1 / modulus) / (1 / other_E - 1 / E);
  return 1 / (1 / E + (1 / aggregate_modulus - 1 / modulus) / slope);
}

/// How the cubes of a group are made and loaded.
struct Choice {
  double porosity = scene_porosity, wall_modulus = paper_wall_modulus, edge = cube_edge;
  bool lateral_walls = false, calibrate = false;
  std::uint64_t seeds = 3;
};

/// Prints one row for each seed of a group of cubes.
void measure(const InnerSpheres& spheres, CubeFilling filling, const Choice& choice) {
  for (std::uint64_t seed = 1; seed <= choice.seeds; ++seed) {
    const Specimen cube = aggregate_cube(spheres, filling, choice.porosity, seed, choice.edge);
    const auto with = [&](double E) {
      return cube_modulus(cube, {E, inner_alpha}, choice.wall_modulus, choice.lateral_walls);
    };
    const double E = spheres.contact_modulus, other_E = 0.95 * E;
    const CubeModulus m = with(E);
    fmt::print("{},{},{},{:g},{:g},{},{},{},{:.6g},{:.6g},{:.4f},{:.6g}", spheres.name, to_string(filling),
               choice.porosity, 1e3 * choice.edge, choice.wall_modulus / 1e9, choice.lateral_walls ? "held" : "free",
               seed, cube.size(), m.walls / 1e9, m.gauge / 1e9, m.poisson,
               uniform_strain_modulus(inner_alpha) * E / 1e9);
    if (choice.calibrate) {
      const CubeModulus other = with(other_E);
      fmt::print(",{:.6g},{:.6g}\n", contact_for_target(E, m.walls, other_E, other.walls) / 1e9,
                 contact_for_target(E, m.gauge, other_E, other.gauge) / 1e9);
    } else {
      fmt::print(",,\n");
    }
    std::fflush(stdout);
  }
}

void all() {
  fmt::print(
      "spheres,filling,porosity,edge_mm,wall_gpa,sides,seed,number,walls_gpa,gauge_gpa,poisson,uniform_strain_gpa,"
      "contact_for_walls_gpa,contact_for_gauge_gpa\n");
  for (const InnerSpheres* spheres : {&fine_spheres, &coarse_spheres}) {
    for (const CubeFilling filling : {CubeFilling::shape, CubeFilling::recipe}) {
      measure(*spheres, filling, {.calibrate = true, .seeds = 20});
      for (const double porosity : {0.05, 0.12, 0.20}) measure(*spheres, filling, {.porosity = porosity});
      for (const double wall : {aggregate_modulus, 1e15}) measure(*spheres, filling, {.wall_modulus = wall});
      measure(*spheres, filling, {.lateral_walls = true});
    }
  }
  for (const CubeFilling filling : {CubeFilling::shape, CubeFilling::recipe})
    for (const double edge : {15e-3, 30e-3, 40e-3}) measure(coarse_spheres, filling, {.edge = edge});
}

}  // namespace
}  // namespace macadam::test

int main() {
  try {
    macadam::test::all();
    return 0;
  } catch (const macadam::Error& error) {
    fmt::print(stderr, "aggregate_cube: {}\n", error.what());
    return 1;
  }
}
