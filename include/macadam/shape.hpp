// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape.hpp  Shapes of aggregates: closed triangulated surfaces, read, checked, measured, made and filled.
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

/// A triangulated surface. Of a shape it is closed, of one piece, without self-intersections, and its facets are
/// counter-clockwise seen from outside (check_surface() tells).
struct Surface {
  std::string name;                                 ///< of the file without its ending, or of the generator
  std::vector<Vec3d> points;                        ///< [m]
  std::vector<std::array<std::int32_t, 3>> facets;  ///< point numbers
  /// Changes that read_surface() made, in words: `"cut 6 polygons into triangles"`; empty if there are none.
  std::string reading{};
};

/// What is wrong with a surface, each with the facets (or points) where it is so; empty lists where nothing is.
struct SurfaceVerdict {
  std::vector<std::int32_t> stray;         ///< points of no facet, which would count in a shape's dimensions
  std::vector<std::int32_t> degenerate;    ///< facets without area or with a point twice
  std::vector<std::int32_t> non_manifold;  ///< facets at an edge of more than two facets, or around a pinched point
  std::vector<std::int32_t> open;          ///< facets at an edge of one facet
  std::vector<std::int32_t> misoriented;   ///< facets turned against the greater part of those they hang together with
  std::vector<std::int32_t> self_intersecting;  ///< facets that cut another one
  std::int64_t pieces = 0;                      ///< connected parts
  std::int64_t inner = 0;                       ///< pieces inside the one of the largest volume: closed pores
  bool inside_out = false;                      ///< closed, but the normals point inwards

  /// Fit for measuring and filling.
  bool good() const;
  /// In words, with the first facets of each fault: `"open at 3 facets (12, 13, 40)"`; `"closed"` where good().
  std::string text() const;
};

/// Reads STL (binary, ASCII), OFF, PLY or OBJ; `scale` multiplies the coordinates (files are often in millimetres:
/// 1e-3). Equal points are joined, and polygons cut into triangles. Points at open edges are joined where they differ
/// by rounding of single precision only, 5e-7 of the surface's size; a closed surface keeps every point. \throws
/// InputError naming the file, and of text the line, where it cannot be read, holds no facet, or has numbers that are
/// not finite.
Surface read_surface(const std::filesystem::path& file, double scale = 1);

/// Every surface of a folder, by the files' names, each good().
/// \throws InputError as read_surface(), or naming a file whose surface is not good, or a folder without any.
std::vector<Surface> read_shape_library(const std::filesystem::path& folder);

/// Writes the format that the ending of `file` asks for (.off, .stl (binary), .ply, .obj), coordinates divided by
/// `scale`, digits enough to round-trip a double where the format has them.
/// \throws RunError when the file cannot be written; InputError for another ending.
void write_surface(const std::filesystem::path& file, const Surface& surface, double scale = 1);

/// Looks for every fault that SurfaceVerdict knows.
SurfaceVerdict check_surface(const Surface& surface);

/// Report of repair_surface(). "Before" is the given surface with each facet once, its holes filled and its closed
/// pores left out.
struct SurfaceRepair {
  std::string what;                            ///< in words: `"filled 1 hole with 2 facets, 9.1 % of the area"`
  double volume_before = 0, volume_after = 0;  ///< [m³]; before: NaN if holes could not be filled
  double area_before = 0, area_after = 0;      ///< [m²]

  /// Largest relative change of volume and area that is accepted without `wrap`.
  static constexpr double bound = 0.01;
  /// Whether volume and area have changed by `bound` at most.
  bool within_bound() const;
  /// Volume and area in words: `"volume 6 m3 (before 6, +0.00 %), area 22 m2 (before 22, +0.00 %)"`.
  std::string changes() const;
};

/// Makes a surface fit for measuring: joins points, drops degenerate facets, orients, fills holes, drops specks (pieces
/// below 5 % of the largest one's area) and closed pores. If that is not enough, it wraps the surface in a new skin
/// (CGAL's alpha wrap). `repair` receives the report. The result is good as it will be read back from a file like `as`,
/// if one is given (STL rounds to floats). With `wrap`, changes beyond SurfaceRepair::bound are accepted.
///
/// \throws RunError with the verdict if the surface is still faulty, or if the change is beyond the bound.
Surface repair_surface(const Surface& surface, SurfaceRepair* repair = nullptr, const std::filesystem::path& as = {},
                       bool wrap = false);

/// The properties of [1], section 4.1 (Eq. 18–23). Lengths in m, directions are unit vectors.
struct ShapeMeasure {
  std::int64_t points = 0, facets = 0;
  double d_long = 0;          ///< D^L: between the two most distant points of the surface
  double d_intermediate = 0;  ///< D^I: longest chord of the surface perpendicular to D^L
  double d_short = 0;         ///< D^S: longest chord perpendicular to both
  Vec3d axis_long{}, axis_intermediate{}, axis_short{};
  double volume = 0;           ///< V [m³]
  double area = 0;             ///< A [m²]
  double sphericity_true = 0;  ///< ψ^w, Eq. 22: area of the sphere of equal volume over A
  Vec3d centroid{};            ///< of the volume
  double radius_bounding = 0;  ///< of the smallest enclosing sphere
  Vec3d centre_bounding{};     ///< its centre

  double shape_index() const { return d_long / d_short; }        ///< SI, Eq. 18
  double flatness() const { return d_short / d_intermediate; }   ///< F, Eq. 19
  double elongation() const { return d_intermediate / d_long; }  ///< E, Eq. 21
  double sphericity_working() const;                             ///< ψ^A, Eq. 23 with its misprint put right
  /// Fl, Eq. 20: D^S over the larger sieve of the class that D^I falls into; NaN above the largest sieve.
  double flakiness() const;
};

/// Sieves of the classes of [1], section 4.1 [m]: 0, 0.5, 1, 2, 4, 6.3, 10, 12.5, 16, 20 (×1e-3).
const std::vector<double>& standard_sieves();
/// The two sieves [m] between which D^I lies; the last class is open above (infinite).
std::array<double, 2> sieve_class(double d_intermediate);

/// Measures a closed surface. Everything is exact for the polyhedron, to rounding. Chords end where a calliper's jaws
/// would: at the outermost points, even where they leave a body that is not convex on their way. Where several D^L are
/// equally long the one with the longest D^I counts, of several such D^I the one with the longest D^S.
/// \throws InputError naming the surface where check_surface() finds a fault.
ShapeMeasure measure_shape(const Surface& surface);

/// One aggregate as spheres.
struct MultiSphere {
  std::vector<Vec3d> centre;   ///< [m], in the frame of the surface
  std::vector<double> radius;  ///< [m]
  std::size_t size() const { return centre.size(); }
};

/// What a single sphere stands for where a shape takes fewer than FillSpec::least spheres.
enum class SingleSphere : std::uint8_t {
  intermediate,   ///< R = D^I/2: half the size by which sieves part, as in Table 3 of [1]
  circumscribed,  ///< R of the smallest enclosing sphere
  volume          ///< R of the sphere of equal volume
};

/// How a shape is filled with spheres.
struct FillSpec {
  double radius_min = 0, radius_max = 0;  ///< drawn uniformly between them [m]
  /// 1 − Σ sphere volumes / volume of the shape, −0.5 … 1; overlaps count twice. Counts of equal spheres in [1],
  /// Fig. 5, fit 0.12.
  double porosity = 0.12;
  std::int64_t least = 8;  ///< fewer spheres: one sphere in place of the cluster
  SingleSphere single = SingleSphere::intermediate;
  std::uint64_t seed = 1;
};

/// How well a cluster stands for its shape. Volumes to about 1e-4, by columns; the deviations are over the shape's
/// points and 20,000 and more samples of its facets. The dimensions are those of ShapeMeasure with chords between
/// points of any two spheres' surfaces: D^L the longest, D^I the longest perpendicular to it, D^S the longest
/// perpendicular to both; of a single sphere all are 2R.
struct FillReport {
  double sphere_volume = 0;    ///< Σ sphere volumes [m³]
  double covered = 0;          ///< share of the shape's volume inside a sphere
  double outside = 0;          ///< volume of the spheres' union outside the shape, over the shape's
  double largest_overlap = 0;  ///< of two spheres, over the sum of their radii
  double deviation_mean = 0;   ///< mean distance of the shape's surface from the nearest sphere's surface [m]
  /// The largest such distance, or by how much a sphere comes out where that is more: the Hausdorff distance between
  /// the two surfaces, not counting the voids between the spheres [m].
  double deviation_largest = 0;
  double d_long = 0, d_intermediate = 0, d_short = 0;  ///< of the cluster, spheres' surfaces included [m]
};

/// Fills a shape with spheres that touch its surface from within: as many as the porosity asks, placed at random and
/// relaxed until they are evenly spread. Where the porosity asks for fewer than `least`, one sphere at the centroid.
/// Every sphere has a Laguerre cell among the others. Spheres are pressed into the surface by a tenth of a radius or
/// so; where the shape is thinner than a sphere, it stands in the middle and comes out on both sides. The same surface
/// and spec give the same bits, for any number of threads. \throws InputError for an impossible spec or a faulty
/// surface; RunError where a sphere remains without a cell.
MultiSphere fill_shape(const Surface& surface, const FillSpec& spec);

/// Measures a cluster against its shape.
FillReport measure_fill(const Surface& surface, const MultiSphere& cluster);

/// The shape library that ships with the program (examples/shapes): 82 aggregates, what generate_shape_library() makes.
std::vector<Surface> shape_library();

/// Makes a shape library: `shapes` aggregates with the statistics of Table 1. The same seed gives the same bits.
/// \throws InputError for a number of shapes below 1 or above 1000.
std::vector<Surface> generate_shape_library(std::uint64_t seed = 1, int shapes = 82);

/// The subdivided icosahedron (42 points, 80 facets) with its points on a sphere of the given radius [m].
Surface subdivided_icosahedron(double radius = 1);

/// A turned and scaled copy: x ↦ centre + scale·Q·x, Q from the unit quaternion (w, x, y, z).
struct Pose {
  Vec3d centre{};
  std::array<double, 4> turn{1, 0, 0, 0};
  double scale = 1;
  Vec3d operator()(const Vec3d& x) const;
};

}  // namespace macadam
