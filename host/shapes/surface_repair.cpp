// SPDX-License-Identifier: GPL-3.0-or-later
// surface_repair.cpp  From the gentlest means to the hardest: mend what is there; where that does not do, wrap it anew.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
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

#include "host/shapes/equal_points.hpp"
#include "host/shapes/surface_files.hpp"
#include "host/shapes/surface_numbers.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

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

/// One attempt at a surface that is sound as it will be read; says in words what it does.
class Repair {
 public:
  /// `as`: the file that it will be read from; empty where there is none.
  Repair(const Surface& surface, const std::filesystem::path& as) : surface_(surface), as_(as) {}

  Surface operator()() {
    const bool good = check_surface(surface_).good();
    if (good && keep(surface_)) {
      say("nothing to do");
      return read_;
    }
    if (good) say("good, but not as it would be read back: " + verdict_.text());
    const Surface mended = mend(good ? read_ : surface_);
    if (keep(mended)) return read_;
    say("still " + verdict_.text());
    if (keep(wrap(mended))) return read_;
    throw RunError(fmt::format("{}: cannot be repaired: {}; still {}", surface_.name, what_, verdict_.text()));
  }

  const std::string& what() const { return what_; }

 private:
  void say(const std::string& done) { what_ += (what_.empty() ? "" : "; ") + done; }
  void say_count(std::size_t n, const char* done, const char* of) {
    if (n > 0) say(fmt::format("{} {} {}{}", done, n, of, n == 1 ? "" : "s"));
  }

  /// Whether the surface is good as it will be read, where points of equal coordinates are one and STL has floats:
  /// parts that share no point here may meet there. Keeps what would be read.
  bool keep(const Surface& surface) {
    read_ = surface;
    if (as_.empty())
      join_equal_points(read_);
    else
      read_ = read_back(as_, surface);
    read_.name = surface_.name;
    verdict_ = check_surface(read_);
    return verdict_.good();
  }

  Surface mend(const Surface& surface) {
    Surface joined = surface;
    join_equal_points(joined);
    say_count(surface.points.size() - joined.points.size(), "joined or dropped", "point");
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
    return largest_piece(outward(std::move(mesh)));
  }

  void drop(Surface& surface, const std::vector<std::int32_t>& facets) {
    for (auto f = facets.rbegin(); f != facets.rend(); ++f) surface.facets.erase(surface.facets.begin() + *f);
    say_count(facets.size(), "dropped", "degenerate facet");
    if (surface.facets.empty()) throw RunError(surface_.name + ": cannot be repaired: every facet is degenerate");
  }

  void fill_holes(Mesh& mesh) {
    std::vector<Mesh::Halfedge_index> borders;
    pmp::extract_boundary_cycles(mesh, std::back_inserter(borders));
    std::size_t facets = 0;
    for (const Mesh::Halfedge_index border : borders) {
      std::vector<Mesh::Face_index> patch;
#if CGAL_VERSION_NR >= 1060000000  // where this is a named parameter
      pmp::triangulate_hole(mesh, border, CGAL::parameters::face_output_iterator(std::back_inserter(patch)));
#else
      pmp::triangulate_hole(mesh, border, std::back_inserter(patch));
#endif
      facets += patch.size();
    }
    if (!borders.empty()) {
      say(fmt::format("filled {} hole{} with {} facet{}", borders.size(), borders.size() == 1 ? "" : "s", facets,
                      facets == 1 ? "" : "s"));
    }
  }

  Mesh outward(Mesh mesh) {
    if (CGAL::is_closed(mesh) && signed_volume(surface_of(mesh, "")) < 0) {
      pmp::reverse_face_orientations(mesh);
      say("turned inside out");
    }
    return mesh;
  }

  /// Specks beside the body are dropped; two bodies are not ours to choose from.
  Surface largest_piece(const Mesh& mesh) {
    std::vector<Mesh> parts;
    pmp::split_connected_components(mesh, parts);
    constexpr double speck = 0.05;  // of the largest piece's area
    std::vector<double> area;
    for (const Mesh& part : parts) area.push_back(CGAL::to_double(pmp::area(part)));
    const auto largest = static_cast<std::size_t>(std::max_element(area.begin(), area.end()) - area.begin());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i != largest && area[i] > speck * area[largest]) return surface_of(mesh, surface_.name);
    }
    say_count(parts.size() - 1, "dropped", "speck");
    return surface_of(parts[largest], surface_.name);
  }

  /// A new skin around all that is there, a little outside of it. Bounds its own faults: closed, manifold, outward.
  Surface wrap(const Surface& surface) {
    const Soup soup(surface);
    const CGAL::Bbox_3 box = CGAL::bbox_3(soup.points.begin(), soup.points.end());
    const double diagonal = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
    const double alpha = diagonal / 40, offset = diagonal / 1000;
    Mesh mesh;
    CGAL::alpha_wrap_3(soup.points, soup.polygons, alpha, offset, mesh);
    say(fmt::format("wrapped (details below {:.3g} m lost, surface {:.3g} m further out)", alpha, offset));
    return largest_piece(mesh);
  }

  const Surface& surface_;
  const std::filesystem::path& as_;
  std::string what_;
  Surface read_;            ///< the last one tried, as it will be read …
  SurfaceVerdict verdict_;  ///< … and what is wrong with it
};

}  // namespace

Surface repair_surface(const Surface& surface, std::string* what, const std::filesystem::path& as) {
  require_sound_numbers(surface);
  Repair repair(surface, as);
  Surface repaired = repair();
  if (what) *what = repair.what();
  return repaired;
}

}  // namespace macadam
