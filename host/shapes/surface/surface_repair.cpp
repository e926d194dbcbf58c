// SPDX-License-Identifier: GPL-3.0-or-later
// surface_repair.cpp  Repairs surfaces. First the existing facets are mended; if the surface is still faulty, it is
// wrapped in a new surface.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/shapes/files/equal_points.hpp"
#include "host/shapes/files/join_seams.hpp"
#include "host/shapes/files/surface_files.hpp"
#include "host/shapes/files/surface_numbers.hpp"
#include "host/shapes/surface/surface_pieces.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

/// Points and polygons in the form that CGAL's functions for polygon soups take.
struct Soup {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;

  explicit Soup(const Surface& surface) {
    for (const Vec3d& p : surface.points) points.emplace_back(p.x, p.y, p.z);
    for (const auto& f : surface.facets) polygons.emplace_back(f.begin(), f.end());
  }
};

Surface surface_of(const Mesh& mesh, const std::string& name) {
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> polygons;
  pmp::polygon_mesh_to_polygon_soup(mesh, points, polygons);
  Surface surface{name, {}, {}};
  for (const Point& p : points) surface.points.push_back({p.x(), p.y(), p.z()});
  for (const auto& [a, b, c] : polygons) {
    surface.facets.push_back(
        {static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), static_cast<std::int32_t>(c)});
  }
  return surface;
}

double relative_change(double before, double after) { return (after - before) / before; }

/// One repair of one surface. Collects a description of the steps.
class Repair {
 public:
  /// `as` is the file from which the surface will be read later; its format determines how coordinates are rounded.
  /// `as` is empty if the surface will not be read from a file.
  Repair(const Surface& surface, const std::filesystem::path& as) : surface_(surface), as_(as) {}

  /// Returns the repaired surface. \throws RunError if neither mending nor wrapping gives a good surface.
  Surface operator()() {
    const bool good = check_surface(surface_).good();
    if (good) set_before(surface_, true);
    if (good && keep(surface_)) {
      add_step("nothing to do");
      return read_;
    }
    if (good) add_step("good, but the written file would be read back with faults: " + verdict_.text());
    const Surface mended = mend(good ? read_ : surface_);
    if (keep(without_specks(mended))) return read_;
    add_step("still " + verdict_.text());
    if (keep(wrap(mended))) return read_;
    throw RunError(fmt::format("{}: cannot be repaired: {}; still {}", surface_.name, repair_.what, verdict_.text()));
  }

  /// Returns the report of the steps so far.
  const SurfaceRepair& repair() const { return repair_; }

 private:
  /// Appends one step to the description.
  void add_step(const std::string& done) { repair_.what += (repair_.what.empty() ? "" : "; ") + done; }
  void say_count(std::int64_t n, const char* done, const std::string& of, const std::string& several) {
    if (n > 0) add_step(fmt::format("{} {} {}", done, n, n == 1 ? of : several));
  }
  void say_count(std::int64_t n, const char* done, const std::string& of) { say_count(n, done, of, of + "s"); }

  /// Returns whether the surface will be good after it was written to the file and read again. Reading merges points
  /// with equal coordinates, and STL rounds to floats, so that parts that share no point now may meet afterwards.
  /// Stores the surface as it will be read.
  bool keep(const Surface& surface) {
    read_ = surface;
    if (as_.empty())
      join_equal_points(read_);
    else
      read_ = read_back(as_, surface);
    read_.name = surface_.name;
    verdict_ = check_surface(read_);
    repair_.volume_after = signed_volume(read_);
    repair_.area_after = surface_area(read_);
    return verdict_.good();
  }

  /// Stores volume and area before the repair. The volume of a surface that is not closed is unknown (NaN).
  void set_before(const Surface& surface, bool closed) {
    repair_.volume_before = closed ? signed_volume(surface) : std::numeric_limits<double>::quiet_NaN();
    repair_.area_before = surface_area(surface);
  }

  /// Mends the existing facets: joins points, drops degenerate and repeated facets, orients facets, splits non-manifold
  /// points, fills holes and drops closed pores.
  Surface mend(const Surface& surface) {
    Surface joined = surface;
    join_equal_points(joined);
    const SeamJoin seams = join_seams(joined);
    say_count(surface.points.size() - joined.points.size(), "joined or dropped", "point");
    say_count(seams.facets, "dropped", "facet between joined points", "facets between joined points");
    require_facets(joined);
    const SurfaceVerdict verdict = check_surface(joined);
    drop(joined, verdict.degenerate);

    Soup soup(joined);
    say_count(pmp::merge_duplicate_polygons_in_polygon_soup(soup.points, soup.polygons,
                                                            CGAL::parameters::require_same_orientation(false)),
              "dropped", "repeated facet");
    const std::size_t points = soup.points.size();
    pmp::orient_polygon_soup(soup.points, soup.polygons);
    say_count(verdict.misoriented.size(), "turned", "facet");
    say_count(soup.points.size() - points, "parted at", "non-manifold point");
    Mesh mesh;
    pmp::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, mesh);
    pmp::stitch_borders(mesh);
    fill_holes(mesh);
    const bool closed = CGAL::is_closed(mesh);
    Surface mended = without_pores(surface_of(mesh, surface_.name));
    if (closed) mended = outward(std::move(mended));
    if (std::isnan(repair_.volume_before)) set_before(mended, closed);
    return mended;
  }

  void drop(Surface& surface, const std::vector<std::int32_t>& facets) {
    std::vector<bool> dropped(surface.facets.size(), false);
    for (const std::int32_t f : facets) dropped[f] = true;
    std::size_t kept = 0;
    for (std::size_t f = 0; f < dropped.size(); ++f) {
      if (!dropped[f]) surface.facets[kept++] = surface.facets[f];
    }
    surface.facets.resize(kept);
    say_count(std::ssize(facets), "dropped", "degenerate facet");
    require_facets(surface);
  }

  void require_facets(const Surface& surface) const {
    if (surface.facets.empty()) throw RunError(surface_.name + ": cannot be repaired: every facet is degenerate");
  }

  void fill_holes(Mesh& mesh) {
    std::vector<Mesh::Halfedge_index> borders;
    pmp::extract_boundary_cycles(mesh, std::back_inserter(borders));
    std::size_t facets = 0;
    std::ptrdiff_t filled = 0;
    double area = 0;
    for (const Mesh::Halfedge_index border : borders) {
      std::vector<Mesh::Face_index> patch;
#if CGAL_VERSION_NR >= 1060000000  // from this version on, the patch is a named parameter
      pmp::triangulate_hole(mesh, border, CGAL::parameters::face_output_iterator(std::back_inserter(patch)));
#else
      pmp::triangulate_hole(mesh, border, std::back_inserter(patch));
#endif
      facets += patch.size();
      filled += !patch.empty();
      area += CGAL::to_double(pmp::area(patch, mesh));
    }
    repair_.filled = std::max(repair_.filled, area / CGAL::to_double(pmp::area(mesh)));
    if (filled > 0)
      add_step(fmt::format("filled {} hole{} with {} facet{}, {:.2g} % of the area", filled, filled == 1 ? "" : "s",
                           facets, facets == 1 ? "" : "s", 100 * repair_.filled));
    say_count(std::ssize(borders) - filled, "could not fill", "hole");
  }

  /// Orients a closed surface such that its normals point outwards.
  Surface outward(Surface surface) {
    if (signed_volume(surface) >= 0) return surface;
    for (auto& facet : surface.facets) std::swap(facet[1], facet[2]);
    add_step("turned inside out");
    return surface;
  }

  /// Drops closed pores, because a particle is solid. In surfaces made from voxels, closed pores appear as inner
  /// shells.
  Surface without_pores(Surface surface) {
    const SurfacePieces pieces(surface);
    const std::vector<bool> inner = pieces.find_inner(check_surface(surface));
    const auto count = std::count(inner.begin(), inner.end(), true);
    if (count == 0) return surface;
    Surface solid = pieces.without(inner);
    std::vector<bool> outer(inner);
    outer.flip();
    add_step(fmt::format("dropped {} closed pore{}, {:.2g} % of the volume and {:.2g} % of the area", count,
                         count == 1 ? "" : "s",
                         100 * std::abs(signed_volume(pieces.without(outer)) / signed_volume(solid)),
                         100 * (1 - surface_area(solid) / surface_area(surface))));
    return solid;
  }

  /// Drops specks, which are pieces whose area is small compared with the area of the largest piece. If there are two
  /// or more larger pieces, keeps everything, because the program cannot choose between the pieces.
  Surface without_specks(const Surface& surface) {
    const SurfacePieces pieces(surface);
    constexpr double speck = 0.05;  // fraction of the area of the largest piece
    const std::vector<double> area = pieces.areas();
    const double largest = *std::max_element(area.begin(), area.end());
    std::vector<bool> dropped;
    for (const double a : area) dropped.push_back(a <= speck * largest);
    const auto specks = std::count(dropped.begin(), dropped.end(), true);
    if (specks + 1 < pieces.count()) return surface;
    say_count(specks, "dropped", "speck");
    return pieces.without(dropped);
  }

  /// Wraps everything in a new surface, slightly outside of the old one. The new surface is closed, manifold and
  /// oriented outwards by construction.
  Surface wrap(const Surface& surface) {
    const Soup soup(surface);
    const CGAL::Bbox_3 box = CGAL::bbox_3(soup.points.begin(), soup.points.end());
    const double diagonal = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
    const double alpha = diagonal / 40, offset = diagonal / 1000;
    Mesh mesh;
    CGAL::alpha_wrap_3(soup.points, soup.polygons, alpha, offset, mesh);
    add_step(fmt::format("wrapped (details below {:.3g} m lost, surface {:.3g} m further out)", alpha, offset));
    return without_specks(surface_of(mesh, surface_.name));
  }

  const Surface& surface_;
  const std::filesystem::path& as_;
  SurfaceRepair repair_{{}, std::numeric_limits<double>::quiet_NaN()};
  Surface read_;            ///< the surface tried last, as it will be read
  SurfaceVerdict verdict_;  ///< faults of read_
};

std::string change(double before, double after) {
  if (std::isnan(before)) return "(before: unknown, as holes could not be filled)";
  const double percent = std::round(1e4 * relative_change(before, after)) / 100 + 0.0;  // + 0.0 turns -0 into 0
  return fmt::format("(before {:.6g}, {:+.2f} %)", before, percent);
}

}  // namespace

bool SurfaceRepair::within_bound() const {
  return filled <= most_filled && std::abs(relative_change(volume_before, volume_after)) <= bound &&
         std::abs(relative_change(area_before, area_after)) <= bound;
}

std::string SurfaceRepair::changes() const {
  return fmt::format("volume {:.6g} m3 {}, area {:.6g} m2 {}", volume_after, change(volume_before, volume_after),
                     area_after, change(area_before, area_after));
}

Surface repair_surface(const Surface& surface, SurfaceRepair* repair, const std::filesystem::path& as, bool wrap) {
  require_sound_numbers(surface);
  Repair attempt(surface, as);
  Surface repaired = attempt();
  const SurfaceRepair& done = attempt.repair();
  if (!wrap && !done.within_bound()) {
    const std::string why =
        std::isnan(done.volume_before) ? "the volume before the repair is unknown"
        : done.filled > SurfaceRepair::most_filled
            ? fmt::format("filled holes are more than {:.0f} % of the area", 100 * SurfaceRepair::most_filled)
            : fmt::format("the repair changes volume or area by more than {:.0f} %", 100 * SurfaceRepair::bound);
    throw RunError(
        fmt::format("{}: {}; give --wrap to accept the repair: {}; {}", surface.name, why, done.what, done.changes()));
  }
  if (repair) *repair = done;
  return repaired;
}

}  // namespace macadam
