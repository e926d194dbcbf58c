// SPDX-License-Identifier: GPL-3.0-or-later
// valleys.cpp  Assigns voxels to grains by the shortest paths from the middles of the grains (Dijkstra). A path through
// mastic counts as long.
#include "host/tools/ct/grains/valleys.hpp"

#include <queue>
#include <tuple>

#include "host/tools/ct/voxels/distance.hpp"

namespace macadam::ct {
namespace {

/// A voxel that a path from a grain has reached.
struct Reached {
  /// length of the path
  float way = 0;
  std::uint32_t voxel = 0, grain = 0;
  /// Orders the queue: the shortest path first, then by voxel and grain number, so that the result does not depend on
  /// the order of arrival.
  bool operator<(const Reached& o) const { return std::tie(way, voxel, grain) > std::tie(o.way, o.voxel, o.grain); }
};

/// Calls `see` with the six neighbours of a voxel.
template <class T, class See>
void around(const Image<T>& image, std::size_t at, See&& see) {
  const auto n = static_cast<std::int64_t>(at);
  const auto [nx, ny, nz] = image.size;
  const std::int64_t i = n % nx, j = n / nx % ny, k = n / (nx * ny);
  const auto row = static_cast<std::size_t>(nx), slice = static_cast<std::size_t>(nx * ny);
  if (i > 0) see(at - 1);
  if (i + 1 < nx) see(at + 1);
  if (j > 0) see(at - row);
  if (j + 1 < ny) see(at + row);
  if (k > 0) see(at - slice);
  if (k + 1 < nz) see(at + slice);
}

/// Restores the old labels of voxels that moved to another grain but form only a thin layer along a cut. Such a layer
/// is only roughness of the cut. An edge of a grain that was assigned to the wrong grain is thicker than `thick`
/// voxels.
void keep_cuts_smooth(const Image<std::uint32_t>& before, Image<std::uint32_t>& labels, int thick) {
  Image<std::uint8_t> seen = Image<std::uint8_t>::like(labels);
  for (std::size_t start = 0; start < labels.count(); ++start) {
    if (seen.voxels[start] || labels.voxels[start] == before.voxels[start]) continue;
    const std::uint32_t from = before.voxels[start], to = labels.voxels[start];
    const auto same = [&](std::size_t at) { return before.voxels[at] == from && labels.voxels[at] == to; };
    std::vector<std::size_t> part{start}, layer;
    seen.voxels[start] = 1;
    for (std::size_t k = 0; k < part.size(); ++k) {
      around(labels, part[k], [&](std::size_t near) {
        if (!same(near) || seen.voxels[near]) return;
        seen.voxels[near] = 1;
        part.push_back(near);
      });
    }
    // removes the moved voxels layer by layer, starting next to the grain to which they moved
    std::vector<std::size_t> left = part;
    int layers = 0;
    while (!left.empty() && layers < thick) {
      std::vector<std::size_t> inner;
      layer.clear();
      for (const std::size_t at : left) {
        bool outer = false;
        around(labels, at, [&](std::size_t near) {
          outer = outer || seen.voxels[near] == 2 || (before.voxels[near] == to && labels.voxels[near] == to);
        });
        (outer ? layer : inner).push_back(at);
      }
      if (layer.empty()) break;  // the remaining voxels do not touch the grain to which they moved
      for (const std::size_t at : layer) seen.voxels[at] = 2;
      left = std::move(inner);
      ++layers;
    }
    for (const std::size_t at : part) seen.voxels[at] = 1;
    if (!left.empty()) continue;
    for (const std::size_t at : part) labels.voxels[at] = from;
  }
}

}  // namespace

// The shortest paths start from the cores of all grains, the voxels deep inside them, at the same time. A step through
// a voxel is longer the darker the voxel is, so that paths go around mastic. Each voxel outside the cores gets the
// grain whose path reaches it first.
Image<std::uint32_t> cut_along_valleys(const Fragments& fragments, const std::vector<std::uint32_t>& grain,
                                       const Image<float>& grey, double depth) {
  Image<std::uint32_t> labels = fragments.labels;
  for (std::uint32_t& label : labels.voxels) label = grain[label];
  if (!(depth > 0)) return labels;
  const Image<std::uint32_t> watershed = labels;
  Image<std::uint8_t> within = Image<std::uint8_t>::like(labels);  // 1: not next to a voxel of another grain
  for (std::size_t at = 0; at < labels.count(); ++at) {
    const std::uint32_t own = labels.voxels[at];
    if (own == 0) continue;
    bool alone = true;
    around(labels, at,
           [&](std::size_t near) { alone = alone && (labels.voxels[near] == 0 || labels.voxels[near] == own); });
    within.voxels[at] = alone;
  }
  if (std::find(within.voxels.begin(), within.voxels.end(), 1) == within.voxels.end()) return labels;
  const Image<float> below = distance_inside(within);
  std::vector<float> deepest(fragments.radius.size());
  for (std::size_t at = 0; at < labels.count(); ++at) {
    float& d = deepest[labels.voxels[at]];
    d = std::max(d, below.voxels[at]);
  }
  // Returns whether a voxel is deep within a grain; such voxels keep their label.
  const auto core = [&](std::size_t at) {
    // Largest depth in the grain. It is 0 if the grain is at most two voxels thick; all its voxels then count as core
    // and keep their label.
    const float most = deepest[labels.voxels[at]];
    return labels.voxels[at] != 0 &&
           (most <= 0 || below.voxels[at] >= std::min(static_cast<float>(depth), 0.5f * most));
  };
  // Returns the length of a path through a voxel. Noise changes the grey value within a grain by a few per cent of the
  // contrast; mastic thinner than a voxel lowers it by a tenth or more. So the path becomes longer where the grey value
  // is below 0.94.
  const auto step = [&](std::size_t at) {
    const float valley = std::max(0.0f, 0.94f - grey.voxels[at]) / 0.04f;
    return 0.05f + valley * valley;
  };
  std::vector<float> way(labels.count(), std::numeric_limits<float>::infinity());
  std::priority_queue<Reached> front;
  const auto leave = [&](std::size_t from, std::uint32_t own) {
    around(labels, from, [&](std::size_t near) {
      if (labels.voxels[near] == 0 || way[near] == 0) return;
      const float there = way[from] + step(near);
      if (there > way[near]) return;
      way[near] = there;
      front.push({there, static_cast<std::uint32_t>(near), own});
    });
  };
  for (std::size_t at = 0; at < labels.count(); ++at) {
    if (core(at)) way[at] = 0;
  }
  for (std::size_t at = 0; at < labels.count(); ++at) {
    if (way[at] == 0) leave(at, labels.voxels[at]);
  }
  std::vector<bool> settled(labels.count());
  while (!front.empty()) {
    const Reached next = front.top();
    front.pop();
    if (settled[next.voxel] || next.way > way[next.voxel]) continue;
    settled[next.voxel] = true;
    labels.voxels[next.voxel] = next.grain;
    leave(next.voxel, next.grain);
  }
  keep_cuts_smooth(watershed, labels, 1);
  return labels;
}

}  // namespace macadam::ct
