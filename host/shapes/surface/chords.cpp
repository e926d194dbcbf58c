// SPDX-License-Identifier: GPL-3.0-or-later
// chords.cpp  Finds D^L among pairs of vertices, D^I in the planes through vertices, and D^S among crossings in the
// projection along its direction.
#include "host/shapes/surface/chords.hpp"

#include <algorithm>
#include <optional>

#include "host/shapes/surface/projected_edges.hpp"
#include "host/shapes/surface/interval_search.hpp"
#include "host/shapes/files/surface_numbers.hpp"

namespace macadam {
namespace {

/// Length of a chord and its unit direction.
struct Chord {
  double length = 0;
  Vec3d axis{};
};

/// Collects the longest chords offered so far. Chords whose lengths differ only by rounding count as equally long, and
/// all of them are kept.
class Longest {
 public:
  explicit Longest(double rounding) : rounding_(rounding) {}

  void offer(const Vec3d& chord) {
    const double length = norm(chord);
    if (length <= rounding_ || length < best_ - rounding_) return;
    best_ = std::max(best_, length);
    chords_.push_back({length, (1 / length) * chord});
    if (chords_.size() >= 2 * kept_) prune();
  }

  /// Returns the chords whose length is within rounding of the longest, in the order in which they were offered. If
  /// several chords have the same direction, only the first one is kept.
  const std::vector<Chord>& chords() {
    prune();
    return chords_;
  }
  double best() const { return best_; }

 private:
  // Removes the chords that are shorter than the longest by more than rounding, and repeated directions.
  void prune() {
    std::vector<Chord> kept;
    for (const Chord& c : chords_) {
      if (c.length < best_ - rounding_) continue;
      const bool known = std::any_of(kept.begin(), kept.end(),
                                     [&](const Chord& k) { return best_ * norm(cross(k.axis, c.axis)) <= rounding_; });
      if (!known) kept.push_back(c);
    }
    chords_ = std::move(kept);
    kept_ = std::max<std::size_t>(chords_.size(), 32);
  }

  double rounding_, best_ = 0;
  std::size_t kept_ = 32;
  std::vector<Chord> chords_;
};

/// Finds the three chords of one surface. Coordinates are taken relative to the middle of the surface.
class ChordFinder {
 public:
  explicit ChordFinder(const Surface& surface)
      : points_(surface.points), facets_(surface.facets), rounding_(coordinate_rounding(surface.points)) {
    const Vec3d middle = middle_of(points_);
    for (Vec3d& p : points_) p -= middle;
    for (const auto& f : facets_) {
      for (int k = 0; k < 3; ++k) edges_.push_back({std::min(f[k], f[(k + 1) % 3]), std::max(f[k], f[(k + 1) % 3])});
    }
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  }

  Chords operator()() const {
    Longest longest = long_chords();
    const double d_long = longest.best();
    struct Pair {
      Vec3d axis_long;
      Chord intermediate;
    };
    std::vector<Pair> pairs;
    double d_intermediate = 0;
    std::optional<Chords> best;
    // D^I and D^S cannot exceed D^L. The search ends as soon as both equal D^L, which saves the many equally long
    // chords of a nearly spherical shape.
    const auto as_long = [&](double length) { return length >= d_long - rounding_; };
    const auto measure_short = [&](const Pair& pair) {
      const Vec3d axis = cross(pair.axis_long, pair.intermediate.axis);
      const double d_short = longest_along(axis, pair.axis_long, pair.intermediate.axis);
      if (best && d_short <= best->length[2] + rounding_) return;
      best = Chords{{d_long, d_intermediate, d_short}, {pair.axis_long, pair.intermediate.axis, axis}};
    };
    for (const Chord& c : longest.chords()) {
      Longest across = chords_across(c.axis);
      d_intermediate = std::max(d_intermediate, across.best());
      for (const Chord& i : across.chords()) pairs.push_back({c.axis, i});
      if (!as_long(across.best())) continue;
      measure_short(pairs.back());
      if (as_long(best->length[2])) break;
    }
    for (const Pair& pair : pairs) {
      if (best && as_long(best->length[2])) break;
      if (pair.intermediate.length >= d_intermediate - rounding_) measure_short(pair);
    }
    best->length[1] = d_intermediate;
    return *best;
  }

 private:
  /// Returns all chords of length D^L. Vertices far from the middle are tried first, so that the search ends early
  /// unless all vertices are equally far.
  Longest long_chords() const {
    std::vector<std::pair<double, std::int32_t>> order;
    for (std::size_t p = 0; p < points_.size(); ++p) order.push_back({-norm(points_[p]), static_cast<std::int32_t>(p)});
    std::sort(order.begin(), order.end());
    Longest longest(rounding_);
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        if (-order[i].first - order[j].first < longest.best() - rounding_) break;
        longest.offer(points_[order[j].second] - points_[order[i].second]);
      }
    }
    return longest;
  }

  /// Returns all chords of length D^I: from each vertex to the points where edges cross the plane that contains the
  /// vertex and is perpendicular to `axis`.
  Longest chords_across(const Vec3d& axis) const {
    std::vector<double> level;
    for (const Vec3d& p : points_) level.push_back(dot(axis, p));
    std::vector<Interval> spans;
    for (const auto& [a, b] : edges_) spans.push_back({std::min(level[a], level[b]), std::max(level[a], level[b])});
    Longest longest(rounding_);
    stab(spans, level, rounding_, [&](std::size_t edge, std::size_t vertex) {
      const auto [a, b] = edges_[edge];
      const Vec3d &p = points_[a], &q = points_[b], &v = points_[vertex];
      if (spans[edge].high - spans[edge].low <= rounding_) {  // the edge lies in the plane
        longest.offer(p - v);
        longest.offer(q - v);
        return;
      }
      const double share = std::clamp((level[vertex] - level[a]) / (level[b] - level[a]), 0.0, 1.0);
      longest.offer(p + share * (q - p) - v);
    });
    return longest;
  }

  /// Returns D^S, the length of the longest chord along `axis`. `u` and `v` are perpendicular to the axis and to each
  /// other.
  double longest_along(const Vec3d& axis, const Vec3d& u, const Vec3d& v) const {
    std::vector<Vec3d> seen;  // coordinates (along u, along v, height along axis)
    for (const Vec3d& p : points_) seen.push_back({dot(u, p), dot(v, p), dot(axis, p)});
    return std::max(largest_gap_of_edges(seen, edges_, rounding_), largest_gap_over_facets(seen, facets_, rounding_));
  }

  std::vector<Vec3d> points_;
  std::vector<std::array<std::int32_t, 3>> facets_;
  double rounding_;
  std::vector<std::array<std::int32_t, 2>> edges_;
};

}  // namespace

Chords measure_chords(const Surface& surface) { return ChordFinder(surface)(); }

}  // namespace macadam
