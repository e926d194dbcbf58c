// SPDX-License-Identifier: GPL-3.0-or-later
/// \file aggregate_cube.hpp  A cube that consists of a single aggregate, filled with spheres, between two walls. [1]
/// found the contact moduli within aggregates by compressing such a cube.
#pragma once

#include "macadam/shape.hpp"
#include "tests/support/test_scenes.hpp"
#include "tests/support/test_surfaces.hpp"

namespace macadam::test {

/// Sizes of the spheres that fill an aggregate, with the modulus of [1] for the contacts among them.
struct InnerSpheres {
  const char* name;
  double radius_min, radius_max;  ///< [m]
  double contact_modulus;         ///< [Pa]
};
inline constexpr InnerSpheres fine_spheres{"fine", 0.75e-3, 1e-3, 1.125e11};
inline constexpr InnerSpheres coarse_spheres{"coarse", 1e-3, 2e-3, 1.116e11};
inline constexpr double inner_alpha = 0.05;
inline constexpr double cube_edge = 20e-3;              ///< [m]
inline constexpr double scene_porosity = 0;             ///< porosity of the fillings in examples/ac14_ms_*
inline constexpr double aggregate_modulus = 60e9;       ///< Young's modulus of the rock [Pa]
inline constexpr double paper_wall_modulus = 1.151e11;  ///< modulus of A–W contacts in [1] [Pa]

/// How the cube is filled: `shape` calls fill_shape() on its surface, `recipe` the specimen generator, as for mastic.
enum class CubeFilling : std::uint8_t { shape, recipe };
inline const char* to_string(CubeFilling filling) { return filling == CubeFilling::shape ? "shape" : "recipe"; }

/// Returns a cube filled with spheres, all of which belong to aggregate 0.
inline Specimen aggregate_cube(const InnerSpheres& spheres, CubeFilling filling, double porosity, std::uint64_t seed,
                               double edge = cube_edge) {
  Specimen out;
  if (filling == CubeFilling::shape) {
    FillSpec spec;
    spec.radius_min = spheres.radius_min, spec.radius_max = spheres.radius_max;
    spec.porosity = porosity, spec.seed = seed;
    MultiSphere cluster = fill_shape(box_surface(edge, edge, edge), spec);
    out.box.size = {edge, edge, edge};
    out.centre = std::move(cluster.centre), out.radius = std::move(cluster.radius);
  } else {
    SpecimenSpec spec;
    spec.box.size = {edge, edge, edge};
    spec.seed = seed;
    spec.mastic = {spheres.radius_min, spheres.radius_max, porosity, {}};
    out = generate_specimen(spec).specimen;
  }
  out.phase.assign(out.centre.size(), Phase::aggregate);
  out.body.assign(out.centre.size(), 0);
  return out;
}

/// Elastic constants of a specimen under uniaxial compression.
struct CubeModulus {
  double walls = 0;    ///< stress over the strain between the walls [Pa]
  double gauge = 0;    ///< stress over the strain of the middle 60 % of the height [Pa]
  double poisson = 0;  ///< Poisson's ratio of the middle 60 % of the height
};

/// Returns the normal strain along axis `component` (0 to 2) per unit displacement of the top wall. It is the slope of
/// the displacements over the positions along that axis, by least squares over the particles in the middle 60 % of the
/// height.
inline double gauge_strain(const Specimen& s, const HarmonicResult& result, int component) {
  const double Vec3d::*axis[] = {&Vec3d::x, &Vec3d::y, &Vec3d::z};
  double n = 0, x = 0, u = 0, xx = 0, xu = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (std::abs(s.centre[i].z / s.box.size.z - 0.5) > 0.3) continue;
    const double at = s.centre[i].*axis[component], moved = result.motion[6 * i + component].real();
    n += 1, x += at, u += moved, xx += at * at, xu += at * moved;
  }
  return (n * xu - x * u) / (n * xx - x * x);
}

/// Returns the moduli of one aggregate under static compression. Contacts are elastic, and the walls have no friction
/// (α = 0).
inline CubeModulus cube_modulus(const Specimen& specimen, const laws::Elastic& inner,
                                double wall_modulus = paper_wall_modulus, bool lateral_walls = false) {
  Laws laws;
  laws[static_cast<std::size_t>(PairType::inner)] = inner;
  laws[static_cast<std::size_t>(PairType::aw)] = laws::Elastic{wall_modulus, 0};
  NetworkSpec network;
  network.lateral_walls = lateral_walls;
  const TestScene scene = make_scene(specimen, network, laws);
  const HarmonicResult r = Harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, 1).solve(1);
  const double strain = gauge_strain(specimen, r, 2), height = specimen.box.size.z;
  return {r.top.e_star_pa, r.top.e_star_pa / (height * strain),
          -0.5 * (gauge_strain(specimen, r, 0) + gauge_strain(specimen, r, 1)) / strain};
}

/// Returns the ratio of Young's modulus to the contact modulus under uniform strain: every sphere moves with the mean
/// strain, and facets have all directions equally often. With Σ A·d = 3V (V: volume), K = E/3 and G = (2 + 3α)·E/10,
/// and Young's modulus is 9KG/(3K + G). Spheres that can move to equilibrium have a lower modulus.
inline double uniform_strain_modulus(double alpha) {
  const double k = 1.0 / 3, g = (2 + 3 * alpha) / 10;
  return 9 * k * g / (3 * k + g);
}

}  // namespace macadam::test
