// SPDX-License-Identifier: GPL-3.0-or-later
/// \file recipe.hpp  Defines a mix design by mass, as used in laboratories, and computes the volumes that a specimen
/// needs.
///
/// Aggregate above the cut size becomes particles, one size class between every two sieves. Finer aggregate, filler and
/// binder together are the mastic. The maximum density follows EN 12697-5 (mathematical procedure); air voids, voids in
/// the mineral aggregate and voids filled with binder follow EN 12697-8. docs/model.md, section 22, gives the formulas;
/// docs/mix-design.md works an example.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "macadam/specimen.hpp"

namespace macadam {

/// One sieve of a gradation curve.
struct SievePassing {
  double size = 0;     ///< [m]
  double passing = 0;  ///< fraction of the aggregate's mass that passes this sieve, 0…1
  int line = 0;        ///< line in MixDesign::source, for messages; 0: none
};

/// One sieve of the envelope that a specification prescribes for the curve.
struct EnvelopePoint {
  double size = 0;             ///< [m]
  double least = 0, most = 0;  ///< limits of the fraction of the aggregate's mass that passes this sieve, 0…1
  int line = 0;                ///< line in MixDesign::source, for messages; 0: none
};

/// Reference of the binder content: the mass of the whole mix, or of the aggregate (filler included).
enum class BinderOf : std::uint8_t { mix, aggregate };

/// A mix design by mass. Fractions are 0…1; the mass of aggregate always includes filler.
struct MixDesign {
  std::vector<SievePassing> gradation;  ///< coarsest sieve first; everything passes that one
  double cut = 0.002;                   ///< one of the sieves [m]; aggregate retained on it becomes particles
  double binder = 0;                    ///< binder content as a fraction, absorbed binder included
  BinderOf binder_of = BinderOf::mix;
  /// Particle densities including the pores (oven-dried, EN 1097-6) [kg/m³]: one density for all aggregate, or one for
  /// every two neighbouring sieves, coarsest first.
  std::vector<double> aggregate_density;
  /// Density of the material that passes the finest sieve [kg/m³]; empty: the last of aggregate_density.
  std::optional<double> filler_density;
  double binder_density = 0;  ///< [kg/m³]
  /// Binder in the pores of the aggregate, which adds no volume, as a fraction of the aggregate's mass. Either this or
  /// maximum_density may be given; without both, no binder is absorbed.
  std::optional<double> absorbed_binder;
  /// Measured maximum density [kg/m³], from which the absorbed binder is computed.
  std::optional<double> maximum_density;
  std::optional<double> air_voids;      ///< fraction of the bulk volume; either this or bulk_density is given
  std::optional<double> bulk_density;   ///< measured [kg/m³]; the air voids are computed from it
  std::vector<EnvelopePoint> envelope;  ///< in any order; only compared and drawn

  std::string source = "recipe";  ///< the scene's file, for messages
  int line = 0;                   ///< line of `[specimen.recipe]` in that file; 0: none
  /// Lines of the keys of `[specimen.recipe]` in that file, by the names in the scene.
  std::map<std::string, int> lines;
};

/// One size class of aggregate particles.
struct MixClass {
  double sieve_min = 0, sieve_max = 0;  ///< [m]
  double mass = 0;                      ///< fraction of the mix by mass, without absorbed binder
  double volume = 0;                    ///< fraction of the box
  double density = 0;                   ///< density of the dry aggregate [kg/m³]
  int line = 0;                         ///< line in MixDesign::source of the sieve that retains it
};

/// Volumes and masses that follow from a mix design. Fractions are 0…1.
struct MixVolumes {
  double maximum_density = 0;  ///< without air voids, EN 12697-5 [kg/m³]
  double bulk_density = 0;     ///< with air voids, as measured by EN 12697-6 [kg/m³]
  double air_voids = 0;        ///< fraction of the bulk volume, EN 12697-8; the porosity of the specimen
  double vma = 0;     ///< voids in the mineral aggregate: air and effective binder, fraction of the bulk volume
  double vfb = 0;     ///< effective binder over VMA; 0 if VMA is 0
  double binder = 0;  ///< fraction of the mix by mass
  double effective_binder = 0;  ///< binder that is not absorbed, fraction of the mix by mass
  double absorbed_binder = 0;   ///< fraction of the aggregate by mass

  std::vector<MixClass> classes;  ///< classes above the cut, coarsest first, without empty ones
  double aggregate_mass = 0;      ///< mass of all particles with the binder in their pores, fraction of the mix
  double aggregate_volume = 0;    ///< volume of all particles, fraction of the box
  double aggregate_density = 0;   ///< density of particles with the binder in their pores [kg/m³]; 0 without particles
  double mastic_mass = 0;         ///< fraction of the mix
  double mastic_volume = 0;       ///< fraction of the box
  double mastic_density = 0;      ///< [kg/m³]
  double mastic_fine_mass = 0;    ///< aggregate below the cut without filler, dry, fraction of the mix
  double mastic_filler_mass = 0;  ///< material that passes the finest sieve, dry, fraction of the mix
  /// Binder in the mastic, including the binder in the pores of the fine aggregate; fraction of the mix.
  double mastic_binder_mass = 0;
};

/// Checks a mix design and computes its volumes.
///
/// \throws InputError for impossible or contradictory numbers. The message gives file and line, the key or the
/// calculation that is wrong, the value found and the value expected.
MixVolumes volumes_of(const MixDesign& design);

/// Sets the classes and the porosity of a specimen from a mix design. `spec.mastic` must be set, with its radii.
/// \throws InputError as volumes_of(), and if `spec` has classes, a porosity or a count of its own.
void follow(const MixDesign& design, SpecimenSpec& spec);

/// A sieve of the curve with the fractions of the aggregate's mass that pass this sieve: in the design (`asked`) and in
/// the specimen (`reached`).
struct GradationRow {
  double size = 0;  ///< [m]
  double asked = 0, reached = 0;
};

/// Returns the curve of a generated specimen, from the volumes that its classes and its mastic reached. No aggregate
/// particle is smaller than the cut size. The mastic contains the finer aggregate in the proportions of the design.
///
/// \throws InputError if the composition does not have the classes of the design.
std::vector<GradationRow> gradation_of(const MixDesign& design, const std::vector<CompositionRow>& composition);

/// Returns the sieves of the curve (not of the envelope) at which the curve leaves the envelope.
std::vector<SievePassing> outside_of_envelope(const MixDesign& design);

/// Writes `sieve,asked,reached`: metres, fractions of the aggregate's mass. \throws RunError if the file cannot be
/// written.
void write_gradation_csv(const std::filesystem::path& file, const std::vector<GradationRow>& rows);

}  // namespace macadam
