// SPDX-License-Identifier: GPL-3.0-or-later
// cross_section.cpp  Computes the polygon in which the section plane cuts each cell: the section of the domain,
// clipped by the planes of equal power with the neighbouring cells.
#include "macadam/cross_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "host/files/result_files.hpp"
#include "host/base/units.hpp"
#include "host/tessellation/facets.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Returns the box's wall on the plus side of the plane's axis, moved to the plane's position. \throws InputError if
/// the axis is not x, y or z, or if the plane is outside of the box.
WallPlane plane_in_box(const SectionPlane& plane, const Domain& box) {
  if (plane.axis < 'x' || plane.axis > 'z')
    throw InputError("section", 0, "axis", fmt::format("'{}'", plane.axis), "x, y or z");
  WallPlane out(2 * (plane.axis - 'x') + 1, box.size);
  if (!(plane.position >= 0 && plane.position <= out.position))
    throw InputError("section", 0, "plane", fmt::format("{} = {} m", plane.axis, plane.position),
                     fmt::format("0 to {} m, inside the box", out.position));
  out.position = plane.position;
  return out;
}

/// A plane of equal power, seen as a side of one of the two cells that it separates. height() has the same bits for
/// both cells, except for the sign.
struct Side {
  Vec3d from, normal;  ///< centre of the facet's particle a, and the unit normal that points away from it
  double arm;          ///< distance of the plane from that centre [m]
  double sign;         ///< 1 if the cell is the cell of particle a, −1 if it is the cell beyond the plane
  double distance;     ///< distance of the two particles' centres [m]

  Side(const Specimen& specimen, const Facet& f, bool of_a) : from(specimen.centre[f.a]), sign(of_a ? 1 : -1) {
    const Bisector bisector(specimen, f.a, f.b);
    normal = bisector.normal, arm = bisector.arm, distance = bisector.distance;
  }

  /// Returns the signed height of a point above the side [m], positive outside of the cell.
  double height(const Vec3d& p) const { return sign * (dot(p - from, normal) - arm); }
};

/// Cuts one cell after the other and uses the same buffers for all.
class Cutter {
 public:
  Cutter(const Domain& domain, const WallPlane& plane)
      : walls_(domain), plane_(plane), rounding_(rounding_bound(domain.size)) {}

  /// Returns the polygon in which the section plane cuts the cell between these sides. The polygon is empty if the
  /// plane and the cell have no area in common. Sorts the sides.
  const Polygon& cut(std::vector<Side>& sides) {
    walls_.section(plane_, rounding_, polygon_, scratch_);
    // Sides at a large angle to the section plane are applied first. A side that is parallel to the section plane
    // except for rounding is applied last, when the polygon is already as small as the facet on this side. Over such a
    // small polygon the heights that result from the side's tilt are within the tolerance.
    std::sort(sides.begin(), sides.end(), [this](const Side& p, const Side& q) { return tilt(p) > tilt(q); });
    for (const Side& side : sides) {
      if (contains_polygon(side)) {
        // If a facet lies in the section plane, only the cell above the facet gets a polygon.
        if (side.sign * side.normal.*plane_.coordinate > 0) polygon_.clear();
      } else {
        clip(
            polygon_, scratch_, rounding_, [&](const Vec3d& p) { return side.height(p); },
            [&](Vec3d& p) { p.*plane_.coordinate = plane_.position; });
      }
      if (polygon_.empty()) return polygon_;
    }
    merge_vertices(polygon_, rounding_);
    if (polygon_.size() > 2) measure_ = measure(polygon_, plane_.normal());
    if (polygon_.size() < 3 || measure_.area <= rounding_ * measure_.extent) polygon_.clear();
    return polygon_;
  }

  /// Returns the area of the polygon that was cut last, if the polygon is not empty [m²].
  double area() const { return measure_.area; }

 private:
  /// Returns the sine of the angle between a side and the section plane.
  double tilt(const Side& side) const { return std::hypot(side.normal.*plane_.u, side.normal.*plane_.v); }

  /// Returns whether the side lies in the section plane over the whole polygon, within the tolerance of facets
  /// (facets.cpp).
  bool contains_polygon(const Side& side) const {
    const double tolerance = 1e-10 * side.distance + rounding_;
    return tilt(side) < 1e-6 && std::all_of(polygon_.begin(), polygon_.end(),
                                            [&](const Vec3d& p) { return std::abs(side.height(p)) <= tolerance; });
  }

  DomainWalls walls_;
  WallPlane plane_;
  double rounding_;
  Polygon polygon_, scratch_;
  PolygonMeasure measure_;
};

/// Returns the facets of all cells that reach the plane, each with its cell, sorted by cell.
std::vector<std::pair<std::int32_t, const Facet*>> facets_at(const WallPlane& plane, const Specimen& specimen,
                                                             const Tessellation& tessellation) {
  std::vector<double> low(specimen.size(), std::numeric_limits<double>::infinity()), high(specimen.size(), 0);
  for (const Facet& f : tessellation.facets) {
    for (const Vec3d& v : tessellation.polygon(f)) {
      for (const std::int32_t cell : {f.a, f.b}) {
        if (cell < 0) continue;
        low[cell] = std::min(low[cell], v.*plane.coordinate);
        high[cell] = std::max(high[cell], v.*plane.coordinate);
      }
    }
  }
  // Vertices are accurate to 1e-11, so cells that only come near the plane are examined too.
  const double margin = 1e-9 * norm(specimen.box.size);
  std::vector<std::pair<std::int32_t, const Facet*>> out;
  for (const Facet& f : tessellation.facets)
    for (const std::int32_t cell : {f.a, f.b})
      if (cell >= 0 && std::abs(plane.position - std::clamp(plane.position, low[cell], high[cell])) <= margin)
        out.emplace_back(cell, &f);
  std::stable_sort(out.begin(), out.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  return out;
}

}  // namespace

SectionPlane read_section_plane(const std::string& text, const Domain& box) {
  const std::string_view expected = "an axis and a length, such as x=0.025 or \"x=25 mm\"";
  if (text.size() < 3 || text[1] != '=')
    throw InputError("section", 0, "plane", '"' + text + '"', std::string(expected));
  const std::string_view number = std::string_view(text).substr(2);
  std::optional<double> position = scene::parse(number, scene::length);
  if (!position) position = scene::parse(std::string(number) + " m", scene::length);
  if (!position) throw InputError("section", 0, "plane", '"' + text + '"', std::string(expected));
  const SectionPlane plane{text[0], *position};
  plane_in_box(plane, box);
  return plane;
}

CrossSection cut(const Specimen& particles, const Tessellation& tessellation, const SectionPlane& plane) {
  const Specimen specimen = with_voids_as_cells(particles);
  const WallPlane at = plane_in_box(plane, specimen.box);
  const auto facets = facets_at(at, specimen, tessellation);
  CrossSection out;
  out.plane = plane;
  Cutter cutter(specimen.box, at);
  std::vector<Side> sides;
  for (auto f = facets.begin(); f != facets.end();) {
    const std::int32_t cell = f->first;
    sides.clear();
    for (; f != facets.end() && f->first == cell; ++f)
      if (f->second->b >= 0) sides.emplace_back(specimen, *f->second, f->second->a == cell);
    const Polygon& polygon = cutter.cut(sides);
    if (polygon.empty()) continue;
    const auto first = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.insert(out.vertices.end(), polygon.begin(), polygon.end());
    out.cells.push_back({cell, cutter.area(), first, static_cast<std::uint32_t>(out.vertices.size())});
  }
  return out;
}

std::string section_file_name(const SectionPlane& plane) {
  return fmt::format("section_{}_{}.csv", plane.axis, plane.position);
}

void write_cross_section_csv(const std::filesystem::path& file, const Specimen& particles,
                             const CrossSection& section) {
  const Specimen specimen = with_voids_as_cells(particles);
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  fmt::format_to(to, "particle,phase,body,x,y,z\n");
  for (const SectionCell& c : section.cells)
    for (const Vec3d& v : section.polygon(c))
      fmt::format_to(to, "{},{},{},{},{},{}\n", c.particle, to_string(specimen.phase[c.particle]),
                     specimen.body[c.particle], v.x, v.y, v.z);
  write_whole(file, fmt::to_string(text));
}

}  // namespace macadam
