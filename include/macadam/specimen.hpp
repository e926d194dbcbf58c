// SPDX-License-Identifier: GPL-3.0-or-later
/// \file specimen.hpp  The particles of a specimen in its box: read, written, generated, checked.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "macadam/numeric.hpp"

namespace macadam {

/// What a particle is made of.
enum class Phase : std::uint8_t { aggregate, mastic };

/// `"aggregate"` or `"mastic"`.
const char* to_string(Phase phase);

/// Axis-aligned box with one corner at the origin; z is vertical.
struct Box {
  Vec3d size{};                                               ///< edge lengths [m]
  double volume() const { return size.x * size.y * size.z; }  ///< [m³]
};

/// Spheres in a box. All vectors have one entry a particle; the order is the user's and is kept in every output.
struct Specimen {
  Box box;
  std::vector<Vec3d> centre;   ///< [m]
  std::vector<double> radius;  ///< [m]
  std::vector<Phase> phase;
  std::vector<std::int32_t> body;  ///< number of the aggregate that the sphere belongs to, −1 for mastic

  std::size_t size() const { return centre.size(); }
};

/// Checks every particle: finite centre inside the box, finite positive radius, `body` −1 exactly for mastic, no two
/// coincident centres; and that the box is finite and positive. `source` begins each message (a file name, usually).
/// \throws InputError naming the first offending particle.
void validate(const Specimen& specimen, const std::string& source);

/// Reads `id,x,y,z,radius,phase,body` (metres; plain text or gzip, told by content), in file order, and validates it.
/// \throws InputError with file, line, what was found and what was expected.
Specimen read_specimen_csv(const std::filesystem::path& file, const Box& box);

/// Writes the same format with digits enough to round-trip a double.
/// \throws RunError when the file cannot be written.
void write_specimen_csv(const std::filesystem::path& file, const Specimen& specimen);

/// How diameters are drawn between the two sieves of a class (physics: log-uniform fits the paper's Table 3).
enum class SizeLaw : std::uint8_t { log_uniform, uniform, volume_uniform };

/// One aggregate class: spheres whose diameters lie between two sieves.
struct AggregateClass {
  double sieve_min = 0, sieve_max = 0;    ///< diameters [m]
  std::optional<double> volume_fraction;  ///< share of the solid volume (aggregates and mastic), or …
  std::optional<std::int64_t> count;      ///< … the number of aggregates
};

/// The mastic that fills the rest: radius uniform in a range.
struct MasticSpec {
  double radius_min = 0, radius_max = 0;  ///< [m]
  std::optional<double> porosity;         ///< 1 − Σ sphere volumes / box, or …
  std::optional<std::int64_t> count;      ///< … the number of mastic spheres
};

/// Everything needed to obtain a specimen: a file, or a recipe for the generator.
struct SpecimenSpec {
  std::optional<std::filesystem::path> file;
  Box box;
  std::uint64_t seed = 1;
  std::vector<AggregateClass> aggregate;  ///< any order; placed largest first
  std::optional<MasticSpec> mastic;
  SizeLaw size_law = SizeLaw::log_uniform;
  bool fix_aggregates = true;         ///< hold the aggregates while the mastic relaxes (moves |E*| by 6–7 % if not)
  std::int64_t attempts = 2'000'000;  ///< positions tried for one aggregate before its class is given up
};

/// What was asked of the generator and what it reached, one entry an aggregate class and then one for the mastic.
struct CompositionRow {
  std::string name;  ///< e.g. `"12.5-19 mm"` or `"mastic"`
  std::int64_t count_asked = 0, count = 0;
  double fraction_asked = 0, fraction = 0;  ///< Σ sphere volumes / box volume
};

/// A generated specimen with the report of its making.
struct GeneratedSpecimen {
  Specimen specimen;
  std::vector<CompositionRow> composition;
  int relaxation_iterations = 0;
  double residual_overlap = 0;  ///< largest aggregate–aggregate overlap after relaxation [m]; 0 where they are held
};

/// Generates a single-sphere specimen: aggregates largest first without overlap and inside the box, then mastic to the
/// porosity or count, then relaxation until the spheres are evenly spread and every one has a Laguerre cell.
/// The same spec (seed included) gives the same bits. `progress`, if given, receives (stage, share done 0…1).
/// \throws InputError for impossible specs; RunError when a class cannot be placed, saying how much was.
GeneratedSpecimen generate_specimen(const SpecimenSpec& spec,
                                    const std::function<void(const char* stage, double share)>& progress = {});

/// Numbers (specimen order) of particles whose Laguerre cell inside the box is empty. Declared here because the
/// generator asks; the tessellation answers.
std::vector<std::int32_t> particles_without_cell(const Specimen& specimen);

}  // namespace macadam
