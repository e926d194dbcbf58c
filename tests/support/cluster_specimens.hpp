// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cluster_specimens.hpp  Small specimens whose aggregates are clusters of spheres, with many inner contacts.
#pragma once

#include "tests/support/test_scenes.hpp"

namespace macadam::test {

/// Returns a recipe of icosahedra of 3.6 to 4.5 mm in mastic. Each has about 20 to 35 spheres; together they are a
/// fifth of the solid volume.
inline SpecimenSpec cluster_recipe(std::uint64_t seed, const Vec3d& box) {
  SpecimenSpec spec;
  spec.box.size = box;
  spec.seed = seed;
  spec.aggregate = {{3.6e-3, 4.5e-3, 0.2, std::nullopt}};
  spec.mastic = {0.75e-3, 1e-3, 0.05, std::nullopt};
  spec.shapes.emplace();
  spec.shapes->library = ShapeSpec::Library::icosahedron;
  spec.shapes->fill.radius_min = 0.6e-3;
  spec.shapes->fill.radius_max = 0.75e-3;
  spec.shapes->fill.porosity = 0;
  return spec;
}

/// Returns two clusters in mastic, about 140 spheres in all: few enough for dense matrices.
inline Specimen few_clusters(std::uint64_t seed) {
  SpecimenSpec spec = cluster_recipe(seed, {6.5e-3, 6.5e-3, 8.5e-3});
  spec.aggregate = {{3.6e-3, 3.9e-3, std::nullopt, 2}};
  return generate_specimen(spec).specimen;
}

}  // namespace macadam::test
