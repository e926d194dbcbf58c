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
#include "macadam/shape.hpp"

namespace macadam {

/// What a particle is made of.
enum class Phase : std::uint8_t {
  aggregate,
  mastic,
  air_void  ///< of cells that are no particle: Specimen::voids
};

/// `"aggregate"`, `"mastic"` or `"void"`.
const char* to_string(Phase phase);

/// Axis-aligned box with one corner at the origin; z is vertical.
struct Box {
  Vec3d size{};                                               ///< edge lengths [m]
  double volume() const { return size.x * size.y * size.z; }  ///< [m³]
};

/// A sphere of air. It has a cell in the tessellation as a particle has; the cell's facets are free surface.
struct VoidSphere {
  Vec3d centre{};     ///< [m]
  double radius = 0;  ///< [m]
};

/// Spheres in a box. All vectors but `voids` have one entry a particle; the order is the user's and is kept in every
/// output. Voids are no particles: they have no mass, no motion and no contacts. Where cells are numbered, in the
/// tessellation and in files, theirs come behind those of the particles.
struct Specimen {
  Box box;
  std::vector<Vec3d> centre;   ///< [m]
  std::vector<double> radius;  ///< [m]
  std::vector<Phase> phase;
  std::vector<std::int32_t> body;  ///< number of the aggregate that the sphere belongs to, −1 for mastic
  std::vector<VoidSphere> voids = {};

  std::string source = "specimen";  ///< where it comes from, as messages say it: its file, or the scene's
  int first_line = 0;               ///< of particle 0 in that file, one line a particle; 0: they have none

  std::size_t size() const { return centre.size(); }
  std::size_t cells() const { return size() + voids.size(); }
  Phase phase_of(std::int32_t cell) const {
    return static_cast<std::size_t>(cell) < size() ? phase[static_cast<std::size_t>(cell)] : Phase::air_void;
  }
  /// For messages: the line of a particle or void, by its cell, in `source`, or 0.
  int line_of(std::int64_t cell) const { return first_line > 0 ? first_line + static_cast<int>(cell) : 0; }
};

/// Every sphere that has a cell, voids behind the particles, as a specimen of its own without voids.
Specimen with_voids_as_cells(const Specimen& specimen);

/// Checks every particle and void: finite centre inside the box, finite positive radius, `body` −1 exactly for mastic,
/// no two coincident centres; and that the box is finite and positive. `source` begins each message (a file name,
/// usually). \throws InputError naming the first offending particle.
void validate(const Specimen& specimen, const std::string& source);

/// Reads `id,x,y,z,radius,phase,body` (metres; plain text or gzip, told by content), in file order, and validates it.
/// Rows of phase `void` stand behind those of all particles.
/// \throws InputError with file, line, what was found and what was expected.
Specimen read_specimen_csv(const std::filesystem::path& file, const Box& box);

/// Writes the same format with digits enough to round-trip a double.
/// \throws RunError when the file cannot be written.
void write_specimen_csv(const std::filesystem::path& file, const Specimen& specimen);

/// How diameters are drawn between the two sieves of a class (docs/model.md, section 19: log-uniform
/// fits Table 3 of [1]).
enum class SizeLaw : std::uint8_t { log_uniform, uniform, volume_uniform };

/// One aggregate class: spheres whose diameters lie between two sieves.
struct AggregateClass {
  double sieve_min = 0, sieve_max = 0;    ///< diameters [m]
  std::optional<double> volume_fraction;  ///< share of the solid volume (aggregates and mastic), or …
  std::optional<std::int64_t> count;      ///< … the number of aggregates
  int line = 0;                           ///< in SpecimenSpec::source, for messages; 0: none
};

/// The mastic that fills the rest: radius uniform in a range.
struct MasticSpec {
  double radius_min = 0, radius_max = 0;  ///< [m]
  std::optional<double> porosity;         ///< 1 − Σ volumes of solid spheres / (box − voids), or …
  std::optional<std::int64_t> count;      ///< … the number of mastic spheres
  int line = 0;                           ///< in SpecimenSpec::source, for messages; 0: none
};

/// Air voids that have a size of their own: spheres without overlap, clear of the aggregates, radius uniform in a
/// range.
struct VoidSpec {
  double radius_min = 0, radius_max = 0;  ///< [m]
  std::optional<double> fraction;         ///< Σ sphere volumes / box, or …
  std::optional<std::int64_t> count;      ///< … the number of voids
  int line = 0;                           ///< in SpecimenSpec::source, for messages; 0: none
};

/// How places of shaped aggregates are found.
enum class PlacementMethod : std::uint8_t {
  insertion,  ///< one by one at random, largest first, each where it touches none before it, as in [1]
  packing     ///< all at once: grown from a smaller scale while overlaps push them apart; reaches higher fractions
};

/// What tells whether two shaped aggregates touch while they are inserted.
enum class PlacementTest : std::uint8_t {
  surfaces,  ///< those of the shapes
  spheres    ///< those that fill the shapes: clusters may interlock
};

/// Aggregates of real shape, each a deformable cluster of spheres, in place of single spheres. An aggregate's size, by
/// which sieves part and classes are drawn, is then its D^I.
struct ShapeSpec {
  enum class Library : std::uint8_t {
    aggregates,                  ///< shape_library()
    icosahedron,                 ///< subdivided_icosahedron()
    aggregates_and_icosahedron,  ///< the icosahedron as one more of the library ([1], section 3.3)
    folder                       ///< every surface of a folder
  };
  Library library = Library::aggregates;
  std::filesystem::path folder;  ///< of surfaces, any unit of length; with Library::folder
  FillSpec fill;                 ///< its seed is not used: every aggregate has one of its own
  PlacementMethod placement = PlacementMethod::packing;
  bool allow_short = false;  ///< insertion: classes that find no more room stay short of what was asked
  PlacementTest test = PlacementTest::surfaces;  ///< insertion
  double gap = 0.01;  ///< packing: least distance of two surfaces, over the smaller one's D^I
  /// Stiffness of the shapes' surfaces against the mastic while it relaxes, over that of a pair of mastic spheres, 0 to
  /// 10. At 0 only the spheres that fill the shapes hold the mastic out.
  double hold_out = 0;
};

/// Everything needed to obtain a specimen: a file, or a recipe for the generator.
struct SpecimenSpec {
  std::optional<std::filesystem::path> file;
  Box box;
  std::uint64_t seed = 1;
  std::vector<AggregateClass> aggregate;  ///< any order; placed largest first
  std::optional<ShapeSpec> shapes;        ///< none: aggregates are single spheres
  std::optional<MasticSpec> mastic;
  std::optional<VoidSpec> voids;
  SizeLaw size_law = SizeLaw::log_uniform;
  double spacing = 0;                 ///< least distance of two aggregates one of which is inserted after the other [m]
  bool fix_aggregates = true;         ///< hold the aggregates while the mastic relaxes (moves |E*| by 6–7 % if not)
  std::int64_t attempts = 2'000'000;  ///< positions tried for one aggregate before its class is given up
  std::string source = "specimen";    ///< the scene's file, for messages
  int line = 0;                       ///< of its section there; 0: none
};

/// What was asked of the generator and what it reached, one entry an aggregate class, then one for the mastic, then one
/// for the voids, if there are any.
struct CompositionRow {
  std::string name;  ///< e.g. `"12.5-19 mm"` or `"mastic"`
  std::int64_t count_asked = 0, count = 0;
  double fraction_asked = 0, fraction = 0;  ///< Σ volumes (of the shapes, or of single spheres) / box volume
};

/// One aggregate of a generated specimen.
struct Aggregate {
  std::int32_t body = 0;           ///< Specimen::body of its spheres
  std::int32_t size_class = 0;     ///< number of its class in the recipe's order
  std::string shape;               ///< name of its template, `"sphere"` where a single sphere stands for it
  double size = 0;                 ///< D^I [m]
  double d_long = 0, d_short = 0;  ///< D^L, D^S of the shape; of a single sphere its diameter [m]
  Vec3d axis_long{};               ///< unit vector along D^L; 0 for a sphere
  double volume = 0;               ///< of the shape, or of the single sphere [m³]
  std::int64_t spheres = 1;
  Vec3d centre{};             ///< of its volume [m]
  std::int32_t surface = -1;  ///< number in GeneratedSpecimen::surfaces; −1 of a single sphere
  Pose pose;                  ///< that brings this surface to the aggregate's place
};

/// A generated specimen with the report of its making.
struct GeneratedSpecimen {
  Specimen specimen;
  std::vector<CompositionRow> composition;
  std::vector<Aggregate> aggregates;  ///< in the order of their spheres
  std::vector<Surface> surfaces;      ///< templates of the shaped ones, about the centroids of their volumes
  int relaxation_iterations = 0;
  double residual_overlap = 0;  ///< largest aggregate–aggregate overlap after relaxation [m]; 0 where they are held
};

/// Generates a specimen: aggregates largest first without overlap and inside the box (single spheres, or shapes filled
/// with spheres), then mastic to the porosity or count, then relaxation until the spheres are evenly spread and every
/// one has a Laguerre cell.
/// The same spec (seed included) gives the same bits. `progress`, if given, receives (stage, share done 0…1).
/// \throws InputError for impossible specs; RunError when a class cannot be placed, saying how much was.
GeneratedSpecimen generate_specimen(const SpecimenSpec& spec,
                                    const std::function<void(const char* stage, double share)>& progress = {});

/// Writes `body,size_class,class,shape,size,d_long,d_short,axis_x,axis_y,axis_z,volume,spheres,x,y,z` (SI units), a
/// line an aggregate; `classes` are the composition's names. \throws RunError when the file cannot be written.
void write_aggregates_csv(const std::filesystem::path& file, const std::vector<Aggregate>& aggregates,
                          const std::vector<CompositionRow>& classes);

/// Numbers (specimen order) of particles whose Laguerre cell inside the box is empty. Declared here because the
/// generator asks; the tessellation answers.
std::vector<std::int32_t> particles_without_cell(const Specimen& specimen);

}  // namespace macadam
