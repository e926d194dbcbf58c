// SPDX-License-Identifier: GPL-3.0-or-later
/// \file facets.cpp  Makes facets from the dual of the triangulation: polygons, clipped by the walls of the domain.
#include "host/tessellation/facets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Smallest distance of two neighbouring centres, relative to the smaller radius. A smaller distance is an input error.
/// The stiffness of a contact is proportional to 1/d. At a distance of 1e-6 radii the equations lose so many digits
/// that linear systems of the frequency domain cannot be solved to a residual of 1e-11.
constexpr double smallest_distance = 1e-5;

/// Facets of a block of consecutive particles. Vertex ranges are counted from the beginning of the block.
struct FacetBlock {
  std::vector<Facet> facets;
  std::vector<Vec3d> vertices;
  std::int64_t null_facets = 0;
};

/// A neighbour of a particle in the triangulation, and a tetrahedron that contains both.
struct Neighbour {
  std::int32_t particle, tetrahedron;
};

/// Makes the facets of particles one by one and appends them to a block. Each block has its own maker, with its own
/// buffers.
class FacetMaker {
 public:
  FacetMaker(const Specimen& specimen, const PowerDiagram& diagram, const DomainWalls& walls,
             const std::vector<std::uint8_t>& beyond, FacetBlock& out)
      : specimen_(specimen),
        diagram_(diagram),
        walls_(walls),
        beyond_(beyond),
        rounding_(rounding_bound(walls.size())),
        out_(out) {}

  /// Makes the facets of particle a with the walls and with particles of higher number, in this order. `begin` … `end`
  /// are the tetrahedra that contain the particle.
  void particle(std::int32_t a, const std::int32_t* begin, const std::int32_t* end) {
    neighbours_.clear();
    unsigned walls = 0;
    for (const std::int32_t* t = begin; t != end; ++t) {
      walls |= beyond_[*t];
      for (const std::int32_t b : diagram_.tetrahedra[*t].site)
        if (b >= 0 && b != a) neighbours_.push_back({b, *t});
    }
    // Keeps one tetrahedron per neighbour, the one with the lowest number, so that the result does not depend on the
    // order of the tetrahedra.
    std::sort(neighbours_.begin(), neighbours_.end(), [](const Neighbour& p, const Neighbour& q) {
      return p.particle != q.particle ? p.particle < q.particle : p.tetrahedron < q.tetrahedron;
    });
    neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end(),
                                  [](const Neighbour& p, const Neighbour& q) { return p.particle == q.particle; }),
                      neighbours_.end());
    for (const Neighbour& b : neighbours_)
      if (b.particle > a) require_apart(a, b.particle);
    for (int k = wall_count - 1; k >= 0; --k) {
      if (!(walls >> k & 1)) continue;
      if (walls_.is_flat(k))
        wall_facet(a, k);
      else
        side_facets(a, k, begin, end);
    }
    for (const Neighbour& b : neighbours_)
      if (b.particle > a) particle_facet(a, b);
  }

 private:
  /// Checks that the centres of two particles are far enough apart. \throws InputError if they nearly coincide.
  void require_apart(std::int32_t a, std::int32_t b) const {
    const double distance = norm(specimen_.centre[b] - specimen_.centre[a]);
    const double least = smallest_distance * std::min(specimen_.radius[a], specimen_.radius[b]);
    if (distance > least) return;
    throw InputError(specimen_.source, specimen_.line_of(b),
                     fmt::format("distance between the centres of particles {} and {}", a, b),
                     fmt::format("{} m", distance),
                     fmt::format("more than {} m, which is {} times the smaller radius", least, smallest_distance));
  }

  /// Sets polygon_ to the dual points of the tetrahedra around the edge (a, b), in cyclic order. Returns, as bits, the
  /// walls beyond which at least one of these points lies.
  unsigned circulate(std::int32_t a, const Neighbour& b) {
    polygon_.clear();
    unsigned some = 0;
    std::int32_t t = b.tetrahedron;
    // Indices of the two corners that are not on the edge. The next tetrahedron is across the face opposite to corner
    // `leave`; corner `keep` also belongs to the next tetrahedron.
    std::int32_t leave = -1, keep = -1;
    for (int k = 0; k < 4; ++k) {
      const std::int32_t site = diagram_.tetrahedra[t].site[k];
      if (site == a || site == b.particle) continue;
      (leave < 0 ? leave : keep) = k;
    }
    std::int32_t kept_site = diagram_.tetrahedra[t].site[keep];
    do {
      polygon_.push_back(diagram_.dual[t]);
      some |= beyond_[t];
      t = diagram_.tetrahedra[t].neighbour[leave];
      std::int32_t next_site = 0;
      for (int k = 0; k < 4; ++k) {
        const std::int32_t site = diagram_.tetrahedra[t].site[k];
        if (site == a || site == b.particle) continue;
        if (site == kept_site)
          leave = k;
        else
          next_site = site;
      }
      kept_site = next_site;
    } while (t != b.tetrahedron);
    return some;
  }

  /// Makes the facet between two particles, clipped by the walls that it crosses.
  void particle_facet(std::int32_t a, const Neighbour& b) {
    const unsigned walls = circulate(a, b);
    if (walls & walls_.side_walls()) walls_.clip_by_sides(rounding_, polygon_, scratch_, [](const Vec3d&) {});
    for (int k = 0; k < wall_count; ++k) {
      if (!(walls >> k & 1) || !walls_.is_flat(k)) continue;
      const WallPlane wall(k, walls_.size());
      clip(
          polygon_, scratch_, rounding_, [&](const Vec3d& p) { return wall.height(p); },
          [&](Vec3d& p) { p.*wall.coordinate = wall.position; });
    }
    if (polygon_.empty()) return;
    const Bisector plane(specimen_, a, b.particle);
    if (!add(a, b.particle, plane.normal, plane.distance)) ++out_.null_facets;
  }

  /// Makes the facet of a particle on the flat wall k.
  void wall_facet(std::int32_t a, int k) {
    const WallPlane wall(k, walls_.size());
    walls_.whole_wall(k, polygon_);
    facet_on_wall(a, -1 - k, wall.normal(), [&](Vec3d& p) { p.*wall.coordinate = wall.position; });
  }

  /// Makes the facets of a particle on the planes of the sides that belong to wall k. `begin` … `end` are the
  /// tetrahedra that contain the particle. The cell reaches a plane only if one of their dual points lies beyond the
  /// plane.
  void side_facets(std::int32_t a, int k, const std::int32_t* begin, const std::int32_t* end) {
    for (const std::size_t j : walls_.sides()) {
      const domains::SidePlane& side = walls_.side(j);
      if (side.wall != k) continue;
      if (std::none_of(begin, end, [&](std::int32_t t) { return side.height(diagram_.dual[t]) >= -rounding_; }))
        continue;
      walls_.whole_side(j, polygon_);
      facet_on_wall(a, -1 - k, side.normal, [](const Vec3d&) {});
    }
  }

  /// Makes the facet of a particle on a plane of a wall: polygon_, which is the whole plane, clipped by the planes of
  /// equal power with all neighbours. `land` moves a new vertex onto the plane.
  template <class Land>
  void facet_on_wall(std::int32_t a, std::int32_t wall, const Vec3d& normal, const Land& land) {
    double nearest = norm(walls_.size());
    for (const Neighbour& b : neighbours_) {
      const Bisector plane(specimen_, a, b.particle);
      nearest = std::min(nearest, plane.distance);
      clip(
          polygon_, scratch_, rounding_,
          [&](const Vec3d& p) { return dot(p - specimen_.centre[a], plane.normal) - plane.arm; }, land);
      if (polygon_.empty()) return;
    }
    add(a, wall, normal, nearest);
  }

  /// Simplifies polygon_ and stores it as one facet. Returns false if it has no area. Lengths below 1e-10 of `scale`,
  /// the distance of the centres, count as rounding of the input. If the coordinates of a lattice are rounded to
  /// decimals, rounding causes short edges, slivers, split facets, and vertices in the middle of an edge. The contact
  /// points of a facet must not depend on such details.
  bool add(std::int32_t a, std::int32_t b, const Vec3d& normal, double scale) {
    const double tolerance = 1e-10 * scale + rounding_;
    merge_vertices(polygon_, tolerance);
    drop_collinear(polygon_, tolerance);
    if (polygon_.size() < 3) return false;
    PolygonMeasure m = measure(polygon_, normal);
    if (std::abs(m.area) <= tolerance * m.extent) return false;
    if (m.area < 0) {
      std::reverse(polygon_.begin(), polygon_.end());
      m.area = -m.area;
    }
    const auto first = static_cast<std::uint32_t>(out_.vertices.size());
    out_.vertices.insert(out_.vertices.end(), polygon_.begin(), polygon_.end());
    out_.facets.push_back({a, b, m.area, m.centroid, normal, first, static_cast<std::uint32_t>(out_.vertices.size())});
    return true;
  }

  const Specimen& specimen_;
  const PowerDiagram& diagram_;
  const DomainWalls& walls_;
  const std::vector<std::uint8_t>& beyond_;
  double rounding_;
  FacetBlock& out_;
  Polygon polygon_, scratch_;
  std::vector<Neighbour> neighbours_;
};

/// Returns, for each dual point, the walls (as bits 0…5) that the point touches or lies beyond, up to rounding. The
/// bits of all walls that are sides of a prism are set for points near one of them.
std::vector<std::uint8_t> beyond_walls(const PowerDiagram& diagram, const DomainWalls& walls) {
  const double rounding = rounding_bound(walls.size());
  std::vector<std::uint8_t> beyond(diagram.dual.size(), 0);
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < beyond.size(); ++t) {
    for (int k = 0; k < wall_count; ++k)
      if (walls.is_flat(k) && WallPlane(k, walls.size()).height(diagram.dual[t]) >= -rounding) beyond[t] |= 1U << k;
    if (walls.may_be_beyond_sides(diagram.dual[t])) beyond[t] |= walls.side_walls();
  }
  return beyond;
}

/// The tetrahedra that contain each particle, in any order: those of particle i are list[begin[i] … begin[i + 1]).
struct Incidence {
  std::vector<std::uint32_t> begin;
  std::vector<std::int32_t> list;

  Incidence(const PowerDiagram& diagram, std::size_t particles) : begin(particles + 1, 0) {
    const auto next = [](std::uint32_t& counter) {
      return std::atomic_ref(counter).fetch_add(1, std::memory_order_relaxed);
    };
    const auto each = [&](auto&& f) {
#pragma omp parallel for schedule(static)
      for (std::size_t t = 0; t < diagram.tetrahedra.size(); ++t)
        for (const std::int32_t site : diagram.tetrahedra[t].site)
          if (site >= 0) f(static_cast<std::size_t>(site), static_cast<std::int32_t>(t));
    };
    each([&](std::size_t site, std::int32_t) { next(begin[site + 1]); });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    list.resize(begin.back());
    std::vector<std::uint32_t> free(begin.begin(), begin.end() - 1);
    each([&](std::size_t site, std::int32_t t) { list[next(free[site])] = t; });
  }
};

}  // namespace

void make_facets(const Specimen& specimen, const PowerDiagram& diagram, Tessellation& out) {
  const std::size_t n = specimen.size();
  const Incidence incidence(diagram, n);
  const DomainWalls walls(specimen.box);
  const std::vector<std::uint8_t> beyond = beyond_walls(diagram, walls);
  // Blocks of particles are independent and are joined in order, so the result does not depend on the number of
  // threads.
  constexpr std::size_t block_size = 256;
  std::vector<FacetBlock> blocks((n + block_size - 1) / block_size);
  for_each_in_parallel(blocks.size(), [&](std::size_t k) {
    FacetMaker maker(specimen, diagram, walls, beyond, blocks[k]);
    const std::int32_t* list = incidence.list.data();
    for (std::size_t a = k * block_size; a < std::min(n, (k + 1) * block_size); ++a)
      maker.particle(static_cast<std::int32_t>(a), list + incidence.begin[a], list + incidence.begin[a + 1]);
  });
  std::size_t facets = 0, vertices = 0;
  for (const FacetBlock& block : blocks) facets += block.facets.size(), vertices += block.vertices.size();
  out.facets.clear(), out.vertices.clear();
  out.facets.reserve(facets), out.vertices.reserve(vertices);
  out.null_facets = 0;
  for (FacetBlock& block : blocks) {
    const auto shift = static_cast<std::uint32_t>(out.vertices.size());
    for (Facet& f : block.facets) f.vertex_begin += shift, f.vertex_end += shift;
    out.facets.insert(out.facets.end(), block.facets.begin(), block.facets.end());
    out.vertices.insert(out.vertices.end(), block.vertices.begin(), block.vertices.end());
    out.null_facets += block.null_facets;
  }
}

}  // namespace macadam
