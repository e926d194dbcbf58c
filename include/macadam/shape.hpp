// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape.hpp  Declares functions for shapes of aggregates. Shapes are closed triangulated surfaces, which can be
/// read, checked, repaired, measured, generated and filled with spheres.
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

/// A triangulated surface. The surface of a shape is closed, in one piece, free of self-intersections, and its facets
/// are counter-clockwise seen from outside; check_surface() checks this.
struct Surface {
  std::string name;                                 ///< name of the file without its ending, or of the generator
  std::vector<Vec3d> points;                        ///< [m]
  std::vector<std::array<std::int32_t, 3>> facets;  ///< point numbers
  /// Changes that read_surface() made, in words: "cut 6 polygons into triangles"; otherwise empty.
  std::string reading{};
};

/// Faults of a surface, each with the facets (or points) concerned; empty lists without a fault.
struct SurfaceVerdict {
  /// Points that belong to no facet; they would distort a shape's dimensions.
  std::vector<std::int32_t> stray;
  std::vector<std::int32_t> degenerate;         ///< facets without area, or with the same point twice
  std::vector<std::int32_t> non_manifold;       ///< facets at an edge of more than two facets, or at a pinched point
  std::vector<std::int32_t> open;               ///< facets with an edge that belongs to no other facet
  std::vector<std::int32_t> misoriented;        ///< facets oriented against the majority of those connected with them
  std::vector<std::int32_t> self_intersecting;  ///< facets that intersect another one
  std::int64_t pieces = 0;                      ///< connected parts
  /// Number of pieces inside the piece with the largest volume; these are closed pores.
  std::int64_t inner = 0;
  bool inside_out = false;  ///< closed, but the normals point inwards

  /// Returns whether the surface can be measured and filled.
  bool good() const;
  /// Returns the verdict in words, with the first facets of each fault: "open at 3 facets (12, 13, 40)"; "closed" if
  /// good().
  std::string text() const;
};

/// Reads STL (binary, ASCII), OFF, PLY or OBJ. `scale` multiplies the coordinates; files are often in millimetres
/// (1e-3). Equal points are joined, and polygons are cut into triangles. Points at open edges are joined if they differ
/// only by the rounding of single precision, 5e-7 of the surface's size; a closed surface keeps every point. \throws
/// InputError naming the file (and the line, in text files) if it cannot be read, has no facet, or has numbers that are
/// not finite.
Surface read_surface(const std::filesystem::path& file, double scale = 1);

/// Reads every surface of a folder, in the order of the files' names. Each surface must be good().
///
/// \throws InputError as read_surface(), or naming a file whose surface is not good, or a folder without surfaces.
std::vector<Surface> read_shape_library(const std::filesystem::path& folder);

/// Returns the surface files in a folder, ordered by name. \throws InputError if the folder has no surface file.
std::vector<std::filesystem::path> surface_files_in(const std::filesystem::path& folder);

/// Writes the format given by the ending of `file` (.off, .stl (binary), .ply, .obj). Coordinates are divided by
/// `scale` and written with enough digits to recover each double, if the format has them.
///
/// \throws RunError if the file cannot be written; InputError for another ending.
void write_surface(const std::filesystem::path& file, const Surface& surface, double scale = 1);

/// Checks a surface for every fault of SurfaceVerdict.
SurfaceVerdict check_surface(const Surface& surface);

/// Report of repair_surface(). Members with `before` describe the given surface, but without repeated facets, with its
/// holes filled and without its closed pores.
struct SurfaceRepair {
  std::string what;                            ///< in words: "filled 1 hole with 2 facets, 9.1 % of the area"
  double volume_before = 0, volume_after = 0;  ///< [m³]; before: NaN if holes could not be filled
  double area_before = 0, area_after = 0;      ///< [m²]; before: with filled holes
  double filled = 0;                           ///< part of the area that fills holes

  /// Largest relative change of volume and area that is accepted without `wrap`.
  static constexpr double bound = 0.01;
  /// Largest part of the area that may consist of filled holes without `wrap`. It is limited because the shape of a
  /// filled hole is a guess.
  static constexpr double most_filled = 0.25;
  /// Returns whether volume and area changed by at most `bound`, and filled holes are at most `most_filled`.
  bool within_bound() const;
  /// Returns volume and area in words: "volume 6 m3 (before 6, +0.00 %), area 22 m2 (before 22, +0.00 %)".
  std::string changes() const;
};

/// Makes a surface fit for measuring: joins points, drops degenerate facets, orients facets, fills holes, drops specks
/// (pieces with less than 5 % of the largest piece's area) and closed pores. If that is not enough, wraps the surface
/// in a new skin (CGAL's alpha wrap). `repair` receives the report. If `as` is given, the result is still good after
/// writing it to such a file and reading it back (STL rounds to floats). With `wrap`, changes beyond
/// SurfaceRepair::bound and larger holes are accepted.
///
/// \throws RunError with the verdict if the surface still has faults, or if the change exceeds the bound.
Surface repair_surface(const Surface& surface, SurfaceRepair* repair = nullptr, const std::filesystem::path& as = {},
                       bool wrap = false);

/// The shape properties of [1], section 4.1 (Eq. 18–23). Lengths in m; directions are unit vectors.
struct ShapeMeasure {
  std::int64_t points = 0, facets = 0;
  double d_long = 0;          ///< D^L: between the two most distant points of the surface
  double d_intermediate = 0;  ///< D^I: longest chord of the surface perpendicular to D^L
  double d_short = 0;         ///< D^S: longest chord perpendicular to D^L and D^I
  Vec3d axis_long{}, axis_intermediate{}, axis_short{};
  double volume = 0;           ///< V [m³]
  double area = 0;             ///< A [m²]
  double sphericity_true = 0;  ///< ψ^w, Eq. 22: area of the sphere with the same volume, over A
  Vec3d centroid{};            ///< centroid of the volume [m]
  double radius_bounding = 0;  ///< radius of the smallest enclosing sphere
  Vec3d centre_bounding{};     ///< its centre

  double shape_index() const { return d_long / d_short; }        ///< SI, Eq. 18
  double flatness() const { return d_short / d_intermediate; }   ///< F, Eq. 19
  double elongation() const { return d_intermediate / d_long; }  ///< E, Eq. 21
  double sphericity_working() const;                             ///< Returns ψ^A, Eq. 23 with its misprint corrected.
  /// Returns Fl, Eq. 20: D^S over the larger sieve of the class of D^I; NaN above the largest sieve.
  double flakiness() const;
};

/// Returns the sieves of the classes of [1], section 4.1 [m]: 0, 0.5, 1, 2, 4, 6.3, 10, 12.5, 16, 20 (×1e-3).
const std::vector<double>& standard_sieves();
/// Returns the two sieves [m] between which D^I lies; the last class has an infinite upper limit.
std::array<double, 2> sieve_class(double d_intermediate);

/// Measures a closed surface. All results are exact for the polyhedron, up to rounding. Chords end at the outermost
/// points, like the jaws of a calliper, even if they leave a non-convex body in between. If several D^L are equally
/// long, the one with the longest D^I counts; of several such D^I, the one with the longest D^S.
///
/// \throws InputError naming the surface if check_surface() finds a fault.
ShapeMeasure measure_shape(const Surface& surface);

/// An aggregate as a cluster of spheres.
struct MultiSphere {
  std::vector<Vec3d> centre;   ///< [m], in the frame of the surface
  std::vector<double> radius;  ///< [m]
  std::size_t size() const { return centre.size(); }
};

/// The radius R of the single sphere that replaces a shape with fewer than FillSpec::least spheres.
enum class SingleSphere : std::uint8_t {
  intermediate,   ///< R = D^I/2: half the size by which sieves separate, as in Table 3 of [1]
  circumscribed,  ///< R of the smallest enclosing sphere
  volume          ///< R of the sphere of equal volume
};

/// Options for filling a shape with spheres.
struct FillSpec {
  double radius_min = 0, radius_max = 0;  ///< radii are sampled uniformly between them [m]
  /// 1 − Σ sphere volumes / volume of the shape, −0.5 … 1; overlaps count twice. The numbers of equal spheres in [1],
  /// Fig. 5, correspond to 0.12.
  double porosity = 0.12;
  std::int64_t least = 8;  ///< smallest number of spheres; with fewer, one sphere replaces the cluster
  SingleSphere single = SingleSphere::intermediate;
  std::uint64_t seed = 1;
};

/// How well a cluster represents its shape. Volumes are accurate to about 1e-4 (computed by columns). Deviations are
/// taken over the shape's points and at least 20,000 samples of its facets. The dimensions are those of ShapeMeasure
/// with chords between points of any two spheres' surfaces: D^L is the longest, D^I the longest perpendicular to it,
/// D^S the longest perpendicular to D^L and D^I; for a single sphere all three are 2R.
struct FillReport {
  double sphere_volume = 0;    ///< Σ sphere volumes [m³]
  double covered = 0;          ///< fraction of the shape's volume inside a sphere
  double outside = 0;          ///< volume of the spheres' union outside the shape, over the shape's volume
  double largest_overlap = 0;  ///< largest overlap of two spheres, over the sum of their radii
  double deviation_mean = 0;   ///< mean distance between the shape's surface and the nearest sphere's surface [m]
  /// The largest such distance or, if that is larger, the largest protrusion of a sphere: the Hausdorff distance
  /// between the two surfaces, without the voids between the spheres [m].
  double deviation_largest = 0;
  double d_long = 0, d_intermediate = 0, d_short = 0;  ///< dimensions of the cluster, as described above [m]
};

/// Fills a shape with spheres that touch its surface from inside. Their number follows from the porosity. They are
/// placed at random and relaxed until they are evenly spread. If their number is below `least`, one sphere is placed at
/// the centroid instead. Every sphere has a Laguerre cell among the others. Spheres are pressed into the surface by
/// about a tenth of a radius; where the shape is thinner than a sphere, the sphere is in the middle and protrudes on
/// both sides. The same surface and spec give the same bits, for any number of threads. \throws InputError for an
/// impossible spec or a faulty surface; RunError if a sphere remains without a cell.
MultiSphere fill_shape(const Surface& surface, const FillSpec& spec);

/// Measures how well a cluster represents its shape.
FillReport measure_fill(const Surface& surface, const MultiSphere& cluster);

/// Returns the shape, scaled so that its intermediate dimension D^I is twice `radius` [m]. \throws InputError if the
/// radius is not above 0.
Surface scale_to_radius(Surface surface, double radius);

/// Writes spheres.csv, spheres.obj and shape.obj, in metres. In spheres.obj every sphere is a subdivided icosahedron,
/// so that any viewer of meshes shows it. \throws RunError; InputError if another command is writing into the folder.
void write_filling(const std::filesystem::path& out, const Surface& surface, const MultiSphere& cluster);

/// Returns the shape library that comes with the program (examples/shapes): the 82 aggregates that
/// generate_shape_library() makes.
std::vector<Surface> shape_library();

/// Makes a shape library: `shapes` aggregates with the statistics of Table 1 of [1]. The same seed gives the same bits.
///
/// \throws InputError for a number of shapes below 1 or above 1000.
std::vector<Surface> generate_shape_library(std::uint64_t seed = 1, int shapes = 82);

/// Writes shapes.csv (one row per shape, named by `names`), statistics.csv and correlation.csv (docs/shapes.md) in SI
/// units. \throws RunError; InputError if another command is writing into the folder.
void write_shape_tables(const std::filesystem::path& out, const std::vector<std::string>& names,
                        const std::vector<ShapeMeasure>& shapes);

/// Writes each shape as an OFF file. \throws RunError; InputError if the folder holds a shape that is not one of them,
/// because all shapes in a folder make one library.
void write_shape_library(const std::filesystem::path& out, const std::vector<Surface>& shapes);

/// Returns the subdivided icosahedron (42 points, 80 facets) with its points on a sphere of the given radius [m].
Surface subdivided_icosahedron(double radius = 1);

/// A rotation, scaling and translation: x ↦ centre + scale·Q·x, Q from the unit quaternion (w, x, y, z).
struct Pose {
  Vec3d centre{};
  std::array<double, 4> turn{1, 0, 0, 0};
  double scale = 1;
  Vec3d operator()(const Vec3d& x) const;
};

}  // namespace macadam
