// SPDX-License-Identifier: GPL-3.0-or-later
// projected_edges.cpp  Compares edges in the xy projection. Parallel edges and edges along z are the usual case for
// boxes and prisms. Every test therefore includes the ends of edges, within rounding.
#include "host/shapes/surface/projected_edges.hpp"

#include <algorithm>
#include <cmath>

#include "host/shapes/surface/interval_search.hpp"

namespace macadam {
namespace {

/// Returns the z component of the cross product, that is, the cross product in the projection.
double turn(const Vec3d& a, const Vec3d& b) { return a.x * b.y - a.y * b.x; }
double flat_dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y; }

struct Segment {
  Vec3d from, to;

  Vec3d at(double share) const { return from + share * (to - from); }
  double y_low() const { return std::min(from.y, to.y); }
  double y_high() const { return std::max(from.y, to.y); }
  double z_low() const { return std::min(from.z, to.z); }
  double z_high() const { return std::max(from.z, to.z); }
};

/// Keeps the largest difference of height over all pairs of edges offered.
class EdgeGap {
 public:
  explicit EdgeGap(double rounding) : rounding_(rounding) {}

  /// Compares the heights of two edges where they cross, and where an end of one edge lies on the other edge.
  void offer(const Segment& a, const Segment& b) {
    if (a.y_low() > b.y_high() + rounding_ || b.y_low() > a.y_high() + rounding_) return;
    if (std::max(a.z_high() - b.z_low(), b.z_high() - a.z_low()) <= largest_) return;
    offer_crossing(a, b);
    for (const Vec3d* end : {&a.from, &a.to}) offer_end(*end, b);
    for (const Vec3d* end : {&b.from, &b.to}) offer_end(*end, a);
  }
  /// If the two ends of an edge coincide in the xy projection, records their difference of height.
  void offer_end_on(const Segment& a) { offer(a.from, a.to); }

  double largest() const { return largest_; }

 private:
  /// Records the difference of height of two points if they coincide in the projection.
  void offer(const Vec3d& p, const Vec3d& q) {
    const Vec3d apart = p - q;
    if (flat_dot(apart, apart) <= rounding_ * rounding_) largest_ = std::max(largest_, std::abs(apart.z));
  }

  void offer_crossing(const Segment& a, const Segment& b) {
    const Vec3d da = a.to - a.from, db = b.to - b.from, r = b.from - a.from;
    const double both = turn(da, db), s = turn(r, db) / both, t = turn(r, da) / both;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) offer(a.at(s), b.at(t));  // false for parallel edges, which give NaN
  }

  void offer_end(const Vec3d& p, const Segment& s) {
    const Vec3d along = s.to - s.from;
    const double length2 = flat_dot(along, along);
    offer(p, s.at(length2 > 0 ? std::clamp(flat_dot(p - s.from, along) / length2, 0.0, 1.0) : 0));
  }

  double rounding_, largest_ = 0;
};

}  // namespace

double largest_gap_of_edges(const std::vector<Vec3d>& points, const std::vector<std::array<std::int32_t, 2>>& edges,
                            double rounding) {
  std::vector<Segment> segments;
  std::vector<Interval> spans;
  std::vector<double> begins;
  for (const auto& [a, b] : edges) {
    segments.push_back({points[a], points[b]});
    spans.push_back({std::min(points[a].x, points[b].x), std::max(points[a].x, points[b].x)});
    begins.push_back(spans.back().low);
  }
  EdgeGap gap(rounding);
  for (const Segment& s : segments) gap.offer_end_on(s);
  // If two spans overlap, the beginning of one span lies in the other span. So stab() finds all pairs of overlapping
  // spans.
  stab(spans, begins, rounding, [&](std::size_t i, std::size_t j) {
    if (i != j) gap.offer(segments[i], segments[j]);
  });
  return gap.largest();
}

double largest_gap_over_facets(const std::vector<Vec3d>& points, const std::vector<std::array<std::int32_t, 3>>& facets,
                               double rounding) {
  std::vector<Interval> spans;
  std::vector<double> at;
  for (const auto& [a, b, c] : facets) {
    const auto [low, high] = std::minmax({points[a].x, points[b].x, points[c].x});
    spans.push_back({low, high});
  }
  for (const Vec3d& p : points) at.push_back(p.x);
  double largest = 0;
  stab(spans, at, 0, [&](std::size_t facet, std::size_t point) {
    const auto [a, b, c] = facets[facet];
    const Vec3d &o = points[a], e1 = points[b] - o, e2 = points[c] - o, r = points[point] - o;
    const double both = turn(e1, e2), s = turn(r, e2) / both, t = turn(e1, r) / both;
    if (!(s >= 0 && t >= 0 && s + t <= 1)) return;
    // s and t are coordinates of the point in the facet. For a vertical facet they are meaningless, so the projected
    // distance is tested too; largest_gap_of_edges() compares the edges of such a facet.
    const Vec3d apart = s * e1 + t * e2 - r;
    if (flat_dot(apart, apart) <= rounding * rounding) largest = std::max(largest, std::abs(apart.z));
  });
  return largest;
}

}  // namespace macadam
