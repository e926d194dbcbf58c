// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cases.hpp  What is timed: specimens of scenes, and lattices of any size.
#pragma once

#include <string>

#include "macadam/macadam.hpp"

namespace macadam::bench {

/// A specimen with all that a step needs.
struct BenchCase {
  std::string name;
  Specimen specimen;
  ContactNetwork network;
  LawTable laws;
  Inertia inertia;
};

/// About `particles` spheres of 1 mm in a jittered face-centred cubic lattice; pair types in the proportions of the
/// specimen SS of [1], laws AM1. Condensed form only: the facets have no points. Walls: the lowest and the highest
/// layer touch a wall.
BenchCase lattice(std::size_t particles, bool walls);

/// "lattice:1e5", or the file of a scene: its specimen is made, or read, with its contacts; or a specimen.csv, with the
/// box, the laws and the contacts of a scene: "scene.toml=specimen.csv". \throws InputError
BenchCase case_of(const std::string& text);

/// Every law as the spring that it is at once.
LawTable elastic(LawTable laws);
/// The same laws with so many Kelvin units, each with the compliances of the first over their number; what is elastic
/// stays so.
LawTable with_units(LawTable laws, int units);

}  // namespace macadam::bench
