// SPDX-License-Identifier: GPL-3.0-or-later
/// \file specimen.hpp  Defines the particles of a specimen in its domain, and reads, writes, generates and checks them.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "macadam/domains/domain.hpp"
#include "macadam/numeric.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// The material of a particle.
enum class Phase : std::uint8_t {
  aggregate,
  mastic,
  air_void  ///< only for cells of voids, which are not particles: Specimen::voids
};

/// Returns "aggregate", "mastic" or "void".
const char* to_string(Phase phase);

/// A sphere of air. It has a cell in the tessellation like a particle; the facets of the cell are free surfaces.
struct VoidSphere {
  Vec3d centre{};     ///< [m]
  double radius = 0;  ///< [m]
};

/// Spheres in a domain. All vectors except `voids` have one entry per particle; the order is the user's and is kept in
/// every output. Voids are not particles: they have no mass, motion or contacts. In the numbering of cells, in the
/// tessellation and in files, the cells of voids follow the cells of particles.
struct Specimen {
  Domain box;                  ///< region that the specimen fills, a box by default
  std::vector<Vec3d> centre;   ///< [m]
  std::vector<double> radius;  ///< [m]
  std::vector<Phase> phase;
  std::vector<std::int32_t> body;  ///< number of the aggregate that the sphere belongs to; −1 for mastic
  std::vector<VoidSphere> voids = {};

  std::string source = "specimen";  ///< name of the specimen's file, or of the scene's file, for messages
  int first_line = 0;               ///< line of particle 0 in that file, which has one line per particle; 0: no lines

  std::size_t size() const { return centre.size(); }
  std::size_t cells() const { return size() + voids.size(); }
  /// Returns the phase of a cell; cells of voids are numbered after those of particles.
  Phase phase_of(std::int32_t cell) const {
    return static_cast<std::size_t>(cell) < size() ? phase[static_cast<std::size_t>(cell)] : Phase::air_void;
  }
  /// Returns the line in `source` of a particle or void, given by its cell, for messages; 0: no line.
  int line_of(std::int64_t cell) const { return first_line > 0 ? first_line + static_cast<int>(cell) : 0; }
};

/// Returns the area of the initial cross-section perpendicular to the load [m²]. The stress of a test is the force on a
/// loaded wall over this area.
/// @{
inline double section_area(const Domain& domain) { return domain.section_area(); }
inline double section_area(const Specimen& specimen) { return section_area(specimen.box); }
/// @}

/// Returns the initial distance of the two loaded walls [m]. The strain of a test is the displacement of the top wall
/// over this length.
/// @{
inline double gauge_length(const Domain& domain) { return domain.gauge_length(); }
inline double gauge_length(const Specimen& specimen) { return gauge_length(specimen.box); }
/// @}

/// Returns a copy in which the voids are particles, which follow all other particles.
Specimen with_voids_as_cells(const Specimen& specimen);

/// Checks every particle and void: finite centre inside the domain; finite positive radius; `body` is −1 for every
/// mastic particle and for no aggregate; no two centres coincide. Also checks that the dimensions are finite and
/// positive. `source` begins each message (usually a file name). \throws InputError naming the first particle with a
/// fault.
void validate(const Specimen& specimen, const std::string& source);

/// Reads `id,x,y,z,radius,phase,body` (metres; plain text or gzip, detected from the content), in file order, and
/// validates it. Rows of phase `void` must follow the rows of all particles.
///
/// \throws InputError with file, line, the value found and the value expected.
Specimen read_specimen_csv(const std::filesystem::path& file, const Domain& domain);

/// Writes a specimen in the format of read_specimen_csv(), with enough digits to recover each double.
///
/// \throws RunError if the file cannot be written.
void write_specimen_csv(const std::filesystem::path& file, const Specimen& specimen);

/// How diameters are sampled between the two sieves of a class (docs/model.md, section 19; log-uniform fits Table 3 of
/// [1]).
enum class SizeLaw : std::uint8_t { log_uniform, uniform, volume_uniform };

/// One aggregate class: spheres whose diameters lie between two sieves.
struct AggregateClass {
  double sieve_min = 0, sieve_max = 0;    ///< diameters [m]
  std::optional<double> volume_fraction;  ///< fraction of the volume of all solids; empty if `count` is given
  std::optional<std::int64_t> count;      ///< number of aggregates
  int line = 0;                           ///< line in SpecimenSpec::source, for messages; 0: none
};

/// The mastic that fills the remaining volume; radii are uniform in a range.
struct MasticSpec {
  double radius_min = 0, radius_max = 0;  ///< [m]
  std::optional<double> porosity;  ///< 1 − Σ volumes of solid spheres / (box − voids); empty if `count` is given
  std::optional<std::int64_t> count;  ///< number of mastic spheres
  int line = 0;                       ///< line in SpecimenSpec::source, for messages; 0: none
};

/// Air voids: spheres that overlap neither each other nor the aggregates. Their radii are distributed uniformly in a
/// range.
struct VoidSpec {
  double radius_min = 0, radius_max = 0;  ///< [m]
  std::optional<double> fraction;         ///< Σ sphere volumes / box; empty if `count` is given
  std::optional<std::int64_t> count;      ///< number of voids
  int line = 0;                           ///< line in SpecimenSpec::source, for messages; 0: none
};

/// How positions of shaped aggregates are found.
enum class PlacementMethod : std::uint8_t {
  insertion,  ///< one by one, largest first, each at a random position where it touches no earlier one, as in [1]
  packing     ///< all at once: they grow from a smaller scale while overlaps push them apart; reaches higher fractions
};

/// Which geometry decides whether two shaped aggregates touch during insertion.
enum class PlacementTest : std::uint8_t {
  surfaces,  ///< surfaces of the shapes
  spheres    ///< spheres that fill the shapes; clusters may interlock
};

/// Aggregates of real shape, each a deformable cluster of spheres, in place of single spheres. The size of an
/// aggregate, used by sieves and classes, is then its D^I.
struct ShapeSpec {
  /// Source of the shapes.
  enum class Library : std::uint8_t {
    aggregates,                  ///< shape_library()
    icosahedron,                 ///< subdivided_icosahedron()
    aggregates_and_icosahedron,  ///< the icosahedron is one more shape of the library ([1], section 3.3)
    folder                       ///< every surface of a folder
  };
  Library library = Library::aggregates;
  std::filesystem::path folder;  ///< folder of surfaces, in any unit of length; only with Library::folder
  /// How shapes are filled with spheres; the seed is not used, because every aggregate has a seed of its own.
  FillSpec fill;
  PlacementMethod placement = PlacementMethod::packing;
  /// With insertion: whether a class may stay below the requested amount if there is no more space.
  bool allow_short = false;
  PlacementTest test = PlacementTest::surfaces;  ///< with insertion
  double gap = 0.01;  ///< with packing: smallest distance between two surfaces, divided by the smaller D^I of the two
  /// Stiffness with which the surfaces of the shapes resist the mastic while it relaxes, divided by the stiffness of a
  /// pair of mastic spheres, 0 to 10. With 0, only the spheres that fill the shapes keep the mastic out.
  double hold_out = 0;
};

/// The value of SpecimenSpec::file in a scene whose particles are given by the caller of the library, not by a file.
/// Reading the scene does not look for the file. A run that is not given the particles fails, because there is no file
/// of this name.
inline constexpr const char* given_particles = "particles given in Python";

/// Everything needed to obtain a specimen: a file, or a recipe for the generator.
struct SpecimenSpec {
  std::optional<std::filesystem::path> file;
  /// With `file`: the true surfaces of its aggregates, for the rule "series" of contacts.
  std::optional<std::filesystem::path> aggregate_file = {};
  Domain box;  ///< region that the specimen fills
  std::uint64_t seed = 1;
  std::vector<AggregateClass> aggregate;  ///< in any order; placed largest first
  std::vector<std::string> merged;  ///< one sentence for each class of a recipe that had too little volume for the box
  std::optional<ShapeSpec> shapes;  ///< empty: aggregates are single spheres
  std::optional<MasticSpec> mastic;
  std::optional<VoidSpec> voids;
  SizeLaw size_law = SizeLaw::log_uniform;
  double spacing = 0;  ///< smallest distance between two aggregates inserted one after the other [m]
  bool fix_aggregates =
      true;  ///< whether aggregates are fixed while the mastic relaxes; if they are not, |E*| changes by 6–7 %
  std::int64_t attempts = 2'000'000;  ///< number of positions tried for one aggregate before the generator gives up
  std::string source = "specimen";    ///< the scene's file, for messages
  int line = 0;                       ///< line of its section in that file; 0: none
};

/// The requested and the reached amount of one component. The generator reports one entry per aggregate class, then one
/// for the mastic, then one for the voids if there are any.
struct CompositionRow {
  std::string name;  ///< for example "12.5-19 mm" or "mastic"
  std::int64_t count_asked = 0, count = 0;
  double fraction_asked = 0, fraction = 0;  ///< Σ volumes (of the shapes, or of single spheres) / box volume
};

/// One aggregate of a generated specimen.
struct Aggregate {
  std::int32_t body = 0;           ///< Specimen::body of its spheres
  std::int32_t size_class = 0;     ///< index of its class in the recipe's order
  std::string shape;               ///< name of its template; "sphere" if a single sphere represents it
  double size = 0;                 ///< D^I [m]
  double d_long = 0, d_short = 0;  ///< D^L, D^S of the shape; for a single sphere its diameter [m]
  Vec3d axis_long{};               ///< unit vector along D^L; zero for a sphere
  double volume = 0;               ///< volume of the shape, or of the single sphere [m³]
  std::int64_t spheres = 1;
  Vec3d centre{};             ///< centroid of its volume [m]
  std::int32_t surface = -1;  ///< index in GeneratedSpecimen::surfaces; −1 for a single sphere
  Pose pose;                  ///< maps the surface `surface` to the aggregate's position
};

/// A generated specimen, and the report of its generation.
struct GeneratedSpecimen {
  Specimen specimen;
  std::vector<CompositionRow> composition;
  std::vector<Aggregate> aggregates;  ///< in the order of their spheres
  std::vector<Surface> surfaces;      ///< templates of the shaped aggregates, centred at the centroids of their volumes
  int relaxation_iterations = 0;
  double residual_overlap = 0;  ///< largest aggregate–aggregate overlap after relaxation [m]; 0 if they are fixed
};

/// Generates a specimen: first aggregates, largest first, without overlap and inside the box (single spheres, or shapes
/// filled with spheres); then mastic up to the porosity or count; then relaxation until the spheres are evenly spread
/// and every one has a Laguerre cell. The same spec (seed included) gives the same bits. `progress`, if given, receives
/// (stage, fraction done 0…1).
///
/// \throws InputError for an impossible spec; RunError if a class cannot be placed, saying how much was placed.
GeneratedSpecimen generate_specimen(const SpecimenSpec& spec,
                                    const std::function<void(const char* stage, double share)>& progress = {});

/// Writes `body,size_class,class,shape,size,d_long,d_short,axis_x,axis_y,axis_z,volume,spheres,x,y,z` (SI units), one
/// line per aggregate, and the rotation `qw,qx,qy,qz` of its shape if one of them has a shape; `classes` are the names
/// of the composition. \throws RunError if the file cannot be written.
void write_aggregates_csv(const std::filesystem::path& file, const std::vector<Aggregate>& aggregates,
                          const std::vector<CompositionRow>& classes);

/// Returns the numbers (specimen order) of particles whose Laguerre cell inside the box is empty. Declared here because
/// the generator needs it; the tessellation defines it.
std::vector<std::int32_t> particles_without_cell(const Specimen& specimen);

}  // namespace macadam
