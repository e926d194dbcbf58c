// SPDX-License-Identifier: GPL-3.0-or-later
/// \file particle_files.hpp  Writes particles and contacts in formats of LAMMPS and OVITO.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "macadam/contact_network.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Formats of particle files: LAMMPS data with contacts as bonds, LAMMPS dump, extended XYZ.
enum class ParticleFormat : std::uint8_t { data, dump, xyz };

/// Density of each phase [kg/m³]; LAMMPS data files have it.
struct PhaseDensities {
  double aggregate = 0, mastic = 0;
};

/// Returns the name of the file with this format in a folder of results: specimen.data, specimen.dump, specimen.xyz.
std::string particle_file_name(ParticleFormat format);

/// Writes the particles of a specimen; voids are left out. Lengths are in metres. The number of a particle is its row
/// in specimen.csv, counted from 1. Types are 1 (aggregate) and 2 (mastic); the molecule is the number of the
/// aggregate, counted from 1, and 0 for mastic. A data file (`atom_style bpm/sphere`) also has a bond for each contact
/// between particles, whose type is 1 (M-M), 2 (M-A), 3 (A-A) or 4 (inner); contacts with walls are left out. \throws
/// RunError
void write_particles(const std::filesystem::path& file, ParticleFormat format, const Specimen& specimen,
                     const ContactNetwork& network, const PhaseDensities& density);

}  // namespace macadam
