// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cases.hpp  Makes the specimens for `macadam bench`: specimens of scenes, and lattices of any size.
#pragma once

#include <string>

#include "macadam/macadam.hpp"

namespace macadam::bench {

/// A specimen with everything that a step needs.
struct BenchCase {
  std::string name;
  Specimen specimen;
  ContactNetwork network;
  LawTable laws;
  Inertia inertia;
};

/// Returns about `particles` spheres of 1 mm diameter in a jittered face-centred cubic lattice. The pair types have the
/// proportions of specimen SS of [1], the laws are those of binder AM1. The lattice can be stepped only in the
/// condensed contact form, because its facets have no points. With `walls`, the lowest and the highest layer touch a
/// wall.
BenchCase lattice(std::size_t particles, bool walls);

/// Returns the specimen that a text names. "lattice:1e5" is a lattice of 1e5 particles. "scene.toml" is the specimen of
/// this scene, generated or read from its file. "scene.toml=specimen.csv" is a specimen file with the box, laws and
/// contact rules of the scene.
/// \throws InputError
BenchCase case_of(const std::string& text);

/// Returns elastic laws with the instantaneous stiffness of `laws`.
LawTable elastic(LawTable laws);
/// Returns the laws with `units` Kelvin units each. Every unit has the stiffness and viscosity of the first unit times
/// `units`, so that the total compliance of the chain does not depend on their number. Elastic laws do not change.
LawTable with_units(LawTable laws, int units);

}  // namespace macadam::bench
