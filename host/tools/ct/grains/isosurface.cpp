// SPDX-License-Identifier: GPL-3.0-or-later
// isosurface.cpp  Implements marching cubes. Instead of using a table of cases, the loops of each cube are traced along
// its six sides.
#include "host/tools/ct/grains/isosurface.hpp"

#include "host/shapes/files/surface_numbers.hpp"

namespace macadam::ct {
namespace {

using Grid = std::array<std::int64_t, 3>;

/// Returns the offset of a corner of a cube: bit a of its number is the step along axis a.
constexpr Grid corner(int number) { return {number & 1, number >> 1 & 1, number >> 2 & 1}; }

/// The corners of a cube's six sides, counter-clockwise as seen from outside.
constexpr int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

/// Traces the surface cube by cube. On each side of a cube, lines join the points where the field changes sign on the
/// edges; the lines of all sides form closed loops, which are split into triangles. If only two opposite corners of a
/// side are positive, the lines separate these corners. The rule depends on the side alone, so both cubes of a side
/// draw the same lines and the surface is closed.
class March {
 public:
  explicit March(const Image<float>& field) : field_(field), on_edge_(3 * field.count(), -1) {}

  Surface surface() {
    for (std::int64_t k = 0; k + 1 < field_.size[2]; ++k) {
      for (std::int64_t j = 0; j + 1 < field_.size[1]; ++j) {
        for (std::int64_t i = 0; i + 1 < field_.size[0]; ++i) cube({i, j, k});
      }
    }
    return std::move(surface_);
  }

 private:
  /// Adds the facets within one cube, whose first corner is the node `at`.
  void cube(const Grid& at) {
    float values[8];
    int inside = 0;
    for (int c = 0; c < 8; ++c) {
      const auto [x, y, z] = corner(c);
      values[c] = field_.at(at[0] + x, at[1] + y, at[2] + z);
      inside += values[c] > 0;
    }
    if (inside == 0 || inside == 8) return;
    // Going round the corners of a side in order, the value becomes positive on one edge and ceases to be positive on a
    // later edge. A line leads from the point where the surface crosses the first edge to the point where it crosses
    // the second edge. Such lines form loops, which are counter-clockwise as seen from outside the surface.
    std::int32_t from[12], to[12];
    int lines = 0;
    for (const auto& side : sides) {
      for (int c = 0; c < 4; ++c) {
        if (values[side[c]] > 0 || !(values[side[(c + 1) % 4]] > 0)) continue;
        int end = c + 1;
        while (values[side[(end + 1) % 4]] > 0) ++end;
        from[lines] = point_on(at, side[c], side[(c + 1) % 4], values);
        to[lines++] = point_on(at, side[end % 4], side[(end + 1) % 4], values);
      }
    }
    while (lines > 0) {
      const std::int32_t first = from[lines - 1];
      std::int32_t last = to[--lines];
      while (true) {
        const auto next = static_cast<int>(std::find(from, from + lines, last) - from);
        const std::int32_t third = to[next];
        from[next] = from[lines - 1], to[next] = to[lines - 1], --lines;
        if (third == first) break;
        surface_.facets.push_back({first, last, third});
        last = third;
      }
    }
  }

  /// Returns the number of the point on the edge between corners a and b of the cube at a node; adds the point if it is
  /// new.
  std::int32_t point_on(const Grid& at, int a, int b, const float (&values)[8]) {
    const int low = a & b, axis = (a ^ b) >> 1;  // a and b differ in one bit: 1, 2, 4 become axis 0, 1, 2
    const Grid from = corner(low);
    const Grid start{at[0] + from[0], at[1] + from[1], at[2] + from[2]};
    std::int32_t& number = on_edge_[3 * field_.index(start[0], start[1], start[2]) + static_cast<std::size_t>(axis)];
    if (number < 0) {
      number = static_cast<std::int32_t>(surface_.points.size());
      const float p = values[low], q = values[a | b];
      // keeps the point away from the nodes, because a point at a node would give facets without area
      const double share = std::clamp(static_cast<double>(p / (p - q)), 0.02, 0.98);
      Vec3d point = field_.centre(start[0], start[1], start[2]);
      const Vec3d& spacing = field_.spacing;
      (axis == 0   ? point.x
       : axis == 1 ? point.y
                   : point.z) += share * (axis == 0   ? spacing.x
                                          : axis == 1 ? spacing.y
                                                      : spacing.z);
      surface_.points.push_back(point);
    }
    return number;
  }

  const Image<float>& field_;
  std::vector<std::int32_t> on_edge_;  ///< number of the point by node and axis; −1: none yet
  Surface surface_;
};

/// Returns the connected part of a closed surface that encloses the largest volume.
Surface largest_part(const Surface& all) {
  std::vector<std::int32_t> parent(all.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t n) {
    auto at = [&](std::int32_t p) -> std::int32_t& { return parent[static_cast<std::size_t>(p)]; };
    while (at(n) != n) n = at(n) = at(at(n));
    return n;
  };
  for (const auto& [a, b, c] : all.facets) {
    parent[static_cast<std::size_t>(root(a))] = root(b);
    parent[static_cast<std::size_t>(root(b))] = root(c);
  }
  std::map<std::int32_t, double> volume;
  const auto point = [&](std::int32_t n) { return all.points[static_cast<std::size_t>(n)] - all.points.front(); };
  for (const auto& [a, b, c] : all.facets) volume[root(a)] += dot(point(a), cross(point(b), point(c)));
  const auto largest =
      std::max_element(volume.begin(), volume.end(), [](const auto& x, const auto& y) { return x.second < y.second; });
  Surface part;
  std::vector<std::int32_t> number(all.points.size(), -1);
  for (const auto& facet : all.facets) {
    if (root(facet[0]) != largest->first) continue;
    std::array<std::int32_t, 3> own;
    for (std::size_t c = 0; c < 3; ++c) {
      std::int32_t& n = number[static_cast<std::size_t>(facet[c])];
      if (n < 0) {
        n = static_cast<std::int32_t>(part.points.size());
        part.points.push_back(all.points[static_cast<std::size_t>(facet[c])]);
      }
      own[c] = n;
    }
    part.facets.push_back(own);
  }
  return part;
}

}  // namespace

Surface isosurface(const Image<float>& field) {
  const Surface all = March(field).surface();
  return all.facets.empty() ? all : largest_part(all);
}

}  // namespace macadam::ct
