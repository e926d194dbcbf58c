// SPDX-License-Identifier: GPL-3.0-or-later
// aggregate_cube.cpp  The modulus of a cube of aggregate: the tables of docs/aggregate-cube.md, to the standard output.
#include "tests/aggregate_cube.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace macadam::test {
namespace {

/// Mean and half the range of some numbers.
struct Spread {
  double low = INFINITY, high = -INFINITY, sum = 0;
  int count = 0;
  void add(double x) { low = std::min(low, x), high = std::max(high, x), sum += x, ++count; }
  double mean() const { return sum / count; }
  double half_range() const { return 0.5 * (high - low); }
};

std::string gigapascals(const Spread& s) {
  return fmt::format("{:.2f} ± {:.2f}", s.mean() / 1e9, s.half_range() / 1e9);
}

/// Against the target.
std::string deviation(const Spread& s) { return fmt::format("{:+.1f} %", 100 * (s.mean() / aggregate_modulus - 1)); }

/// Everything measured on cubes that differ in their seed alone.
struct Group {
  Spread spheres, walls, gauge, poisson, contact_for_walls, contact_for_gauge;
};

/// The contact modulus that gives the target, from the moduli with two contact moduli: the compliances of contacts and
/// walls add up, so that 1/modulus is linear in 1/E but for how the walls' share is spread.
double contact_for_target(double E, double modulus, double other_E, double other_modulus) {
  const double slope = (1 / other_modulus - 1 / modulus) / (1 / other_E - 1 / E);
  return 1 / (1 / E + (1 / aggregate_modulus - 1 / modulus) / slope);
}

/// How the cubes of one group are made and held.
struct Choice {
  double porosity = scene_porosity, wall_modulus = paper_wall_modulus, edge = cube_edge;
  bool lateral_walls = false, calibrate = false;
  std::uint64_t seeds = 3;
};

Group measure(const InnerSpheres& spheres, CubeFilling filling, const Choice& choice = {}) {
  Group out;
  for (std::uint64_t seed = 1; seed <= choice.seeds; ++seed) {
    const Specimen cube = aggregate_cube(spheres, filling, choice.porosity, seed, choice.edge);
    const auto with = [&](double E) {
      return cube_modulus(cube, {E, inner_alpha}, choice.wall_modulus, choice.lateral_walls);
    };
    const double E = spheres.contact_modulus, other_E = 0.95 * E;
    const CubeModulus m = with(E);
    out.spheres.add(static_cast<double>(cube.size()));
    out.walls.add(m.walls), out.gauge.add(m.gauge), out.poisson.add(m.poisson);
    if (!choice.calibrate) continue;
    const CubeModulus other = with(other_E);
    out.contact_for_walls.add(contact_for_target(E, m.walls, other_E, other.walls));
    out.contact_for_gauge.add(contact_for_target(E, m.gauge, other_E, other.gauge));
  }
  return out;
}

/// Calls `row` for every size of spheres and both fillings.
template <class Row>
void each(Row row) {
  for (const InnerSpheres* spheres : {&fine_spheres, &coarse_spheres})
    for (const CubeFilling filling : {CubeFilling::shape, CubeFilling::recipe}) row(*spheres, filling);
}

void headline() {
  fmt::print("Porosity {}, A-W {} GPa, twenty seeds:\n\n", scene_porosity, paper_wall_modulus / 1e9);
  fmt::print(
      "| spheres | filling | number | walls (GPa) | to 60 | gauge (GPa) | to 60 | Poisson's ratio "
      "| uniform strain (GPa) | E for 60 by walls (GPa) | E for 60 by gauge (GPa) |\n"
      "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  each([](const InnerSpheres& spheres, CubeFilling filling) {
    const Group g = measure(spheres, filling, {.calibrate = true, .seeds = 20});
    fmt::print("| {} | {} | {:.0f} | {} | {} | {} | {} | {:.3f} | {:.2f} | {} | {} |\n", spheres.name,
               to_string(filling), g.spheres.mean(), gigapascals(g.walls), deviation(g.walls), gigapascals(g.gauge),
               deviation(g.gauge), g.poisson.mean(),
               uniform_strain_modulus(inner_alpha) * spheres.contact_modulus / 1e9, gigapascals(g.contact_for_walls),
               gigapascals(g.contact_for_gauge));
  });
}

void porosities() {
  fmt::print(
      "\nPorosity, three seeds:\n\n"
      "| spheres | filling | porosity | number | walls (GPa) | gauge (GPa) | to 60 |\n"
      "|---|---|---:|---:|---:|---:|---:|\n");
  each([](const InnerSpheres& spheres, CubeFilling filling) {
    for (const double porosity : {0.0, 0.05, 0.12, 0.20}) {
      const Group g = measure(spheres, filling, {.porosity = porosity});
      fmt::print("| {} | {} | {:.2f} | {:.0f} | {} | {} | {} |\n", spheres.name, to_string(filling), porosity,
                 g.spheres.mean(), gigapascals(g.walls), gigapascals(g.gauge), deviation(g.gauge));
    }
  });
}

void boundaries() {
  fmt::print(
      "\nWhat holds the cube, porosity {}, three seeds; modulus between the walls (GPa):\n\n"
      "| spheres | filling | A-W 60 GPa | A-W 115.1 GPa | rigid A-W | rigid A-W: gauge "
      "| four sides held too, 115.1 GPa |\n"
      "|---|---|---:|---:|---:|---:|---:|\n",
      scene_porosity);
  each([](const InnerSpheres& spheres, CubeFilling filling) {
    const Group soft = measure(spheres, filling, {.wall_modulus = aggregate_modulus});
    const Group paper = measure(spheres, filling);
    const Group rigid = measure(spheres, filling, {.wall_modulus = 1e15});
    const Group held = measure(spheres, filling, {.lateral_walls = true});
    fmt::print("| {} | {} | {} | {} | {} | {} | {} |\n", spheres.name, to_string(filling), gigapascals(soft.walls),
               gigapascals(paper.walls), gigapascals(rigid.walls), gigapascals(rigid.gauge), gigapascals(held.walls));
  });
}

void edges() {
  fmt::print(
      "\nEdge of the cube, coarse spheres, porosity {}, three seeds:\n\n"
      "| filling | edge (mm) | number | walls (GPa) | gauge (GPa) | to 60 | Poisson's ratio |\n"
      "|---|---:|---:|---:|---:|---:|---:|\n",
      scene_porosity);
  for (const CubeFilling filling : {CubeFilling::shape, CubeFilling::recipe}) {
    for (const double edge : {15e-3, 20e-3, 30e-3, 40e-3}) {
      const Group g = measure(coarse_spheres, filling, {.edge = edge});
      fmt::print("| {} | {:.0f} | {:.0f} | {} | {} | {} | {:.3f} |\n", to_string(filling), 1e3 * edge, g.spheres.mean(),
                 gigapascals(g.walls), gigapascals(g.gauge), deviation(g.gauge), g.poisson.mean());
    }
  }
}

}  // namespace
}  // namespace macadam::test

int main() {
  try {
    for (const auto table :
         {macadam::test::headline, macadam::test::porosities, macadam::test::boundaries, macadam::test::edges}) {
      table();
      std::fflush(stdout);
    }
    return 0;
  } catch (const macadam::Error& error) {
    fmt::print(stderr, "aggregate_cube: {}\n", error.what());
    return 1;
  }
}
