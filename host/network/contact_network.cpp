// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_network.cpp  Builds contacts from facets: selects facets, and computes frames, lever arms, points,
/// area moments, and the contacts of each particle.
#include "macadam/contact_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "host/base/counted.hpp"
#include "host/network/notched_facets.hpp"
#include "host/tessellation/domain_walls.hpp"
#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

void check_limits(const FacetLimits& limits, const std::string& of) {
  if (limits.gap_max && !std::isfinite(*limits.gap_max))
    throw InputError("network", 0, "gap_max" + of, fmt::format("{}", *limits.gap_max), "a finite number");
  if (limits.area_min && !(*limits.area_min >= 0 && std::isfinite(*limits.area_min)))
    throw InputError("network", 0, "area_min" + of, fmt::format("{}", *limits.area_min), "a finite number, 0 or more");
}

void check_input(const Specimen& specimen, const Tessellation& tessellation, const NetworkSpec& spec) {
  if (tessellation.cell_volume.size() != specimen.cells())
    throw InputError("network", 0, "cells of the tessellation", std::to_string(tessellation.cell_volume.size()),
                     std::to_string(specimen.cells()) + ", one for each particle and void of the specimen");
  if (spec.lateral_walls && !specimen.box.is_box())
    throw InputError("network", 0, "lateral_walls", std::string("true for a ") + specimen.box.name(),
                     "false, because only the sides of a box can be held");
  check_limits(spec, "");
  for (int k = 0; k < particle_pair_types; ++k)
    check_limits(spec.of_pair[k], std::string(" of ") + to_string(static_cast<PairType>(k)));
  if (const auto& hidden = tessellation.hidden; !hidden.empty()) {
    constexpr std::size_t named = 10;
    std::string found = "no cell for " + std::to_string(hidden.size()) + " of " + std::to_string(specimen.cells()) +
                        " particles and voids (number";
    for (std::size_t k = 0; k < std::min(named, hidden.size()); ++k)
      found += (k ? ", " : " ") + std::to_string(hidden[k]);
    found += hidden.size() > named ? ", …)" : ")";
    throw InputError(specimen.source, specimen.line_of(hidden.front()), "Laguerre cells inside the box", found,
                     "a cell for each particle and void");
  }
}

/// Returns whether a facet is a free surface, because one of its cells is a void.
bool is_free(const Specimen& specimen, const Facet& f) {
  return std::max(f.a, f.b) >= static_cast<std::int32_t>(specimen.size());
}

/// Returns the mean area of the facets between particles [m²]; 0 without such facets.
double mean_facet_area(const Specimen& specimen, const Tessellation& tessellation) {
  double sum = 0;
  std::int64_t count = 0;
  for (const Facet& f : tessellation.facets)
    if (f.b >= 0 && !is_free(specimen, f)) sum += f.area, ++count;
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

PairType pair_of(const Specimen& specimen, const Facet& f) {
  const bool mastic_a = specimen.phase[f.a] == Phase::mastic;
  if (f.b < 0) return mastic_a ? PairType::mw : PairType::aw;
  const bool mastic_b = specimen.phase[f.b] == Phase::mastic;
  if (mastic_a && mastic_b) return PairType::mm;
  if (mastic_a || mastic_b) return PairType::ma;
  return specimen.body[f.a] == specimen.body[f.b] ? PairType::inner : PairType::aa;
}

/// Returns the distance of a particle's centre from a wall [m]. \throws InputError if it is too small, because the
/// stiffness of a wall contact is E·A/h.
double distance_to_wall(const Specimen& specimen, const Facet& f) {
  const double h = -height_above_wall(specimen.box, f, specimen.centre[f.a]);
  if (!(h > 1e-9 * specimen.radius[f.a])) {
    throw InputError(
        specimen.source, specimen.line_of(f.a),
        fmt::format("distance between the centre of particle {} and the {} wall that the particle touches", f.a,
                    specimen.box.wall_name(-1 - f.b)),
        fmt::format("{} m", h),
        fmt::format("more than {} m, which is 1e-9 times the radius of the particle", 1e-9 * specimen.radius[f.a]));
  }
  return h;
}

/// Returns a contact with its distance, frame and lever arms (model, section 3). `area`: area of its parts [m²].
Contact geometry(const Specimen& specimen, const Facet& f, double area) {
  Contact c;
  c.a = f.a, c.b = f.b;
  c.pair = pair_of(specimen, f);
  c.area = area;
  c.n = f.normal;
  canonical_frame(c.n, c.s, c.t);
  if (f.b < 0) {
    c.arm_a = c.length = c.distance = distance_to_wall(specimen, f);
    return c;
  }
  const double ra = specimen.radius[f.a], rb = specimen.radius[f.b];
  c.length = c.distance = norm(specimen.centre[f.b] - specimen.centre[f.a]);
  c.arm_a = 0.5 * (c.distance + (ra - rb) * ((ra + rb) / c.distance));
  c.arm_b = c.distance - c.arm_a;
  return c;
}

/// Adds the area moments of one triangle, given by the coordinates of its corners. `lumped` gets the moments of three
/// points, one at each corner, with a third of the area each; `exact` gets the integrals over the triangle. Area and
/// first moments are the same in both.
void add_triangle(double area, const std::array<double, 3>& s, const std::array<double, 3>& t, AreaMoments& lumped,
                  AreaMoments& exact) {
  const auto product = [](const std::array<double, 3>& p, const std::array<double, 3>& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  };
  const double sum_s = s[0] + s[1] + s[2], sum_t = t[0] + t[1] + t[2];
  const double ss = product(s, s), st = product(s, t), tt = product(t, t);
  for (AreaMoments* m : {&lumped, &exact}) m->a += area, m->s += area / 3 * sum_s, m->t += area / 3 * sum_t;
  lumped.ss += area / 3 * ss, lumped.st += area / 3 * st, lumped.tt += area / 3 * tt;
  // ∫ x y dA over a triangle = A/12·(Σx·Σy + Σ x y)
  exact.ss += area / 12 * (sum_s * sum_s + ss);
  exact.st += area / 12 * (sum_s * sum_t + st);
  exact.tt += area / 12 * (sum_t * sum_t + tt);
}

/// Sets the coordinates and areas of the points (vertices, then centroid) of a part of the contact's facet, beginning
/// with the point `first`. Adds the part to the lumped and the exact moments.
void set_points(const Specimen& specimen, const FacetPart& part, const Contact& c, std::size_t first,
                ContactNetwork& out, AreaMoments& lumped, AreaMoments& exact) {
  const std::span<const Vec3d> polygon = part.polygon;
  const std::size_t n = polygon.size();
  const Vec3d x0 = specimen.centre[c.a] + c.arm_a * c.n;
  const auto set = [&](std::size_t k, const Vec3d& x) {
    out.point_s[first + k] = dot(x - x0, c.s);
    out.point_t[first + k] = dot(x - x0, c.t);
  };
  for (std::size_t k = 0; k < n; ++k) set(k, polygon[k]);
  set(n, part.centroid);
  const double *s = &out.point_s[first], *t = &out.point_t[first];
  for (std::size_t k = 0; k < n; ++k) {  // triangles begin at the centroid, because x0 may lie outside the polygon
    const std::size_t l = k + 1 < n ? k + 1 : 0;
    const double area = 0.5 * ((s[k] - s[n]) * (t[l] - t[n]) - (s[l] - s[n]) * (t[k] - t[n]));
    for (const std::size_t j : {k, l, n}) out.point_area[first + j] += area / 3;
    add_triangle(area, {s[k], s[l], s[n]}, {t[k], t[l], t[n]}, lumped, exact);
  }
}

/// Sets the centroid as the contact's only point, with the whole area. Returns its moments.
AreaMoments set_one_point(const Specimen& specimen, const Vec3d& centroid, const Contact& c, ContactNetwork& out) {
  const Vec3d x = centroid - (specimen.centre[c.a] + c.arm_a * c.n);
  const double s = dot(x, c.s), t = dot(x, c.t);
  out.point_s[c.point_begin] = s;
  out.point_t[c.point_begin] = t;
  out.point_area[c.point_begin] = c.area;
  return {c.area, c.area * s, c.area * t, c.area * s * s, c.area * s * t, c.area * t * t};
}

/// Returns the centroid of the parts of a facet with the area `area` in total [m²].
Vec3d centroid_of(std::span<const FacetPart> parts, double area) {
  if (parts.size() == 1) return parts.front().centroid;
  Vec3d moment{};
  for (const FacetPart& part : parts) moment += part.area * part.centroid;
  return (1 / area) * moment;
}

/// Builds the lists of the contacts of each particle (compressed rows, ascending).
void build_rows(std::size_t particles, ContactNetwork& out) {
  out.row_begin.assign(particles + 1, 0);
  for (const Contact& c : out.contacts) {
    ++out.row_begin[c.a + 1];
    if (c.b >= 0) ++out.row_begin[c.b + 1];
  }
  std::partial_sum(out.row_begin.begin(), out.row_begin.end(), out.row_begin.begin());
  out.rows.resize(out.row_begin.back());
  std::vector<std::uint32_t> next(out.row_begin.begin(), out.row_begin.end() - 1);
  for (std::uint32_t k = 0; k < out.contacts.size(); ++k) {
    const Contact& c = out.contacts[k];
    out.rows[next[c.a]++] = k;
    if (c.b >= 0) out.rows[next[c.b]++] = k;
  }
}

}  // namespace

void canonical_frame(const Vec3d& n, Vec3d& s, Vec3d& t) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  s = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  t = {b, sign + n.y * n.y * a, -n.y};
}

ContactNetwork build_network(const Specimen& specimen, const Tessellation& tessellation, const NetworkSpec& spec) {
  check_input(specimen, tessellation, spec);
  ContactNetwork out;
  std::array<FacetLimits, particle_pair_types> limits = spec.of_pair;
  for (FacetLimits& l : limits) {
    if (!l.gap_max) l.gap_max = spec.gap_max;
    if (!l.area_min) l.area_min = spec.area_min;
  }
  const double mean_area = mean_facet_area(specimen, tessellation);
  double dropped = 0, kept = 0;
  NotchedFacets notched(specimen, tessellation, spec.notches);
  // Returns whether a facet becomes a contact, and counts the facets that `gap_max` or `area_min` excludes.
  const auto wanted = [&](const Facet& f) {
    if (is_free(specimen, f)) return false;
    if (f.b < 0) {
      if (f.b > wall_z_lo) return spec.lateral_walls;
      return spec.bottom_top_walls && specimen.box.carries(static_cast<int>(wall_index(f.b)), f.centroid);
    }
    const double radii = specimen.radius[f.a] + specimen.radius[f.b];
    const double gap = norm(specimen.centre[f.b] - specimen.centre[f.a]) - radii;
    const FacetLimits& limit = limits[static_cast<std::size_t>(pair_of(specimen, f))];
    if (limit.gap_max && gap > *limit.gap_max * 0.5 * radii) return ++out.dropped_gap, false;
    if (f.area < limit.area_min.value_or(0) * mean_area) return ++out.dropped_area, dropped += f.area, false;
    return true;
  };
  // For each contact: its facet, and the index of its first point. point_begin has one more entry, the end.
  std::vector<std::uint32_t> facet_of, point_begin{0};
  for (std::size_t k = 0; k < tessellation.facets.size(); ++k) {
    const Facet& f = tessellation.facets[k];
    const auto facet = static_cast<std::uint32_t>(k);
    if (!wanted(f)) continue;
    if (f.b >= 0) kept += f.area;
    if (f.b >= 0 && !notched.keep(facet)) continue;
    facet_of.push_back(facet);
    const auto [vertices, parts] = notched.sizes(facet);
    const std::size_t points = spec.quadrature == Quadrature::one_point ? 1 : vertices + parts;
    point_begin.push_back(counted<std::uint32_t>(point_begin.back() + points, "contact points"));
  }
  out.contacts.resize(facet_of.size());
  for (auto* list : {&out.point_s, &out.point_t, &out.point_area}) list->resize(point_begin.back(), 0);
  // Sums over the contacts, from which ContactNetwork::second_moment_difference is computed.
  struct Sums {
    double difference = 0, total = 0;
    Sums& operator+=(const Sums& o) { return difference += o.difference, total += o.total, *this; }
  };
  const auto sums = sum_in_parallel<Sums>(facet_of.size(), [&](std::size_t k) -> Sums {
    const Facet& f = tessellation.facets[facet_of[k]];
    Contact& c = out.contacts[k];
    const FacetPart whole{f.area, f.centroid, tessellation.polygon(f)};
    const std::vector<FacetPart> shortened = notched.parts(facet_of[k]);
    const std::span<const FacetPart> parts = shortened.empty() ? std::span(&whole, 1) : std::span(shortened);
    double area = 0;
    for (const FacetPart& part : parts) area += part.area;
    c = geometry(specimen, f, area);
    c.point_begin = point_begin[k], c.point_end = point_begin[k + 1];
    if (spec.quadrature == Quadrature::one_point) {
      c.moments = set_one_point(specimen, centroid_of(parts, area), c, out);
      return {};
    }
    AreaMoments lumped, exact;
    std::size_t first = c.point_begin;
    for (const FacetPart& part : parts) {
      set_points(specimen, part, c, first, out, lumped, exact);
      first += part.polygon.size() + 1;
    }
    c.moments = spec.quadrature == Quadrature::exact ? exact : lumped;
    return {std::abs(lumped.ss + lumped.tt - exact.ss - exact.tt), exact.ss + exact.tt};
  });
  for (const Contact& c : out.contacts) ++out.count[static_cast<std::size_t>(c.pair)];
  if (dropped > 0) out.dropped_share = dropped / (dropped + kept);
  if (out.contacts.empty())
    throw InputError("network", 0, "contacts",
                     fmt::format("none left of {} facets ({} dropped by gap_max, {} by area_min)",
                                 tessellation.facets.size(), out.dropped_gap, out.dropped_area),
                     "at least one");
  notched.finish(out);
  if (sums.total > 0) out.second_moment_difference = sums.difference / sums.total;
  counted<std::uint32_t>(2 * out.contacts.size(), "ends of contacts");
  build_rows(specimen.size(), out);
  return out;
}

}  // namespace macadam
