// SPDX-License-Identifier: GPL-3.0-or-later
/// \file recipe.hpp  A mix design by mass, as a laboratory writes it, and the volumes that a specimen needs.
///
/// Aggregate above the cut size becomes particles, a size class between every two sieves; finer aggregate, filler and
/// binder together are the mastic. Formulas: maximum density EN 12697-5 (mathematical procedure), air voids, voids in
/// the mineral aggregate and voids filled with binder EN 12697-8. They stand in docs/model.md, section 22;
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
  double passing = 0;  ///< share of the aggregate's mass that passes it, 0…1
  int line = 0;        ///< in MixDesign::source, for messages; 0: none
};

/// One sieve of the envelope that a specification asks of the curve.
struct EnvelopePoint {
  double size = 0;             ///< [m]
  double least = 0, most = 0;  ///< shares of the aggregate's mass that pass it, 0…1
  int line = 0;                ///< in MixDesign::source, for messages; 0: none
};

/// What the binder content is a share of: the mass of the whole mix, or that of the aggregate (filler included).
enum class BinderOf : std::uint8_t { mix, aggregate };

/// A mix design by mass. Shares are 0…1; mass of aggregate always includes filler.
struct MixDesign {
  std::vector<SievePassing> gradation;  ///< coarsest sieve first; all pass that one
  double cut = 0.002;                   ///< [m]: one of the sieves; what it retains becomes particles
  double binder = 0;                    ///< content, absorbed binder included
  BinderOf binder_of = BinderOf::mix;
  /// Particle densities with the pores (oven-dried, EN 1097-6) [kg/m³]: one, or one for what lies between every two
  /// neighbouring sieves, coarsest first.
  std::vector<double> aggregate_density;
  std::optional<double> filler_density;   ///< of what passes the finest sieve; none: the last of the aggregate [kg/m³]
  double binder_density = 0;              ///< [kg/m³]
  std::optional<double> absorbed_binder;  ///< in the pores, share of the aggregate's mass; it takes no room. Or …
  std::optional<double> maximum_density;  ///< … measured [kg/m³], from which it follows; neither: none is absorbed
  std::optional<double> air_voids;        ///< share of the bulk volume, or …
  std::optional<double> bulk_density;     ///< … measured [kg/m³], from which it follows
  std::vector<EnvelopePoint> envelope;    ///< any order; only compared and drawn

  std::string source = "recipe";     ///< the scene's file, for messages
  int line = 0;                      ///< of its section there; 0: none
  std::map<std::string, int> lines;  ///< of its keys there, under the scene's names
};

/// One size class of aggregate particles.
struct MixClass {
  double sieve_min = 0, sieve_max = 0;  ///< [m]
  double mass = 0;                      ///< share of the mix, absorbed binder not counted
  double volume = 0;                    ///< share of the box
  double density = 0;                   ///< of the dry aggregate [kg/m³]
  int line = 0;                         ///< of the sieve that retains it, in MixDesign::source
};

/// What follows from a mix design. Shares are 0…1.
struct MixVolumes {
  double maximum_density = 0;   ///< without air voids, EN 12697-5 [kg/m³]
  double bulk_density = 0;      ///< with them, as EN 12697-6 measures it [kg/m³]
  double air_voids = 0;         ///< of the bulk volume, EN 12697-8; the porosity of the specimen
  double vma = 0;               ///< voids in the mineral aggregate: air and effective binder, of the bulk volume
  double vfb = 0;               ///< effective binder over VMA; 0 where there is no VMA
  double binder = 0;            ///< share of the mix by mass
  double effective_binder = 0;  ///< not absorbed, share of the mix by mass
  double absorbed_binder = 0;   ///< share of the aggregate by mass

  std::vector<MixClass> classes;  ///< above the cut, coarsest first; without those of no mass
  double aggregate_mass = 0;      ///< of all particles, with the binder in their pores, over the mix
  double aggregate_volume = 0;    ///< of all particles, over the box
  double aggregate_density = 0;   ///< of particles with the binder in their pores [kg/m³]; 0 where there are none
  double mastic_mass = 0;         ///< share of the mix
  double mastic_volume = 0;       ///< share of the box
  double mastic_density = 0;      ///< [kg/m³]
  double mastic_fine_mass = 0;    ///< aggregate below the cut without filler, dry, share of the mix
  double mastic_filler_mass = 0;  ///< what passes the finest sieve, dry, share of the mix
  double mastic_binder_mass = 0;  ///< the binder in the mastic, that in its fines' pores included, share of the mix
};

/// Checks a mix design and works out its volumes.
/// \throws InputError for numbers that contradict each other or cannot be: with the sum, where it stands, what was
/// found and what was expected.
MixVolumes volumes_of(const MixDesign& design);

/// Gives a specimen the classes and the porosity of a mix design; `spec.mastic` must be there, with its radii.
/// \throws InputError as volumes_of(), and where `spec` has classes, a porosity or a count of its own.
void follow(const MixDesign& design, SpecimenSpec& spec);

/// A sieve of the curve with what passes it, shares of the aggregate's mass.
struct GradationRow {
  double size = 0;  ///< [m]
  double asked = 0, reached = 0;
};

/// The curve of a generated specimen, from the volumes that its classes and its mastic reached. Below the cut, where
/// there are no particles, the mastic holds its fines in the design's proportions.
/// \throws InputError for a composition that has not the design's classes.
std::vector<GradationRow> gradation_of(const MixDesign& design, const std::vector<CompositionRow>& composition);

/// Sieves of the curve (no others) at which it leaves the envelope.
std::vector<SievePassing> outside_of_envelope(const MixDesign& design);

/// Writes `sieve,asked,reached`: metres, shares of the aggregate's mass. \throws RunError when it cannot be written.
void write_gradation_csv(const std::filesystem::path& file, const std::vector<GradationRow>& rows);

}  // namespace macadam
