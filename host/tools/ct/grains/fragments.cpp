// SPDX-License-Identifier: GPL-3.0-or-later
// fragments.cpp  Computes the watershed, and the faces between its fragments.
#include "host/tools/ct/grains/fragments.hpp"

#include <unordered_map>

#include "host/base/counted.hpp"

namespace macadam::ct {
namespace {

/// Union-find of basins. Stores for each basin the basin into which it was merged, and its peak (its largest distance
/// from the surface).
class Joined {
 public:
  std::uint32_t add(float peak) {
    parent_.push_back(counted<std::uint32_t>(parent_.size(), "basins"));
    peak_.push_back(peak);
    return parent_.back();
  }
  std::uint32_t root(std::uint32_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  // a and b must be roots; the one with the higher peak stays, or the lower number if the peaks are equal
  void join(std::uint32_t a, std::uint32_t b) {
    if (peak_[a] < peak_[b] || (peak_[a] == peak_[b] && b < a)) std::swap(a, b);
    parent_[b] = a;
  }
  float peak(std::uint32_t root) const { return peak_[root]; }
  std::size_t size() const { return parent_.size(); }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<float> peak_;
};

/// Returns the voxels inside from the largest distance to the smallest, by a counting sort. Voxels in the same bin of
/// width `step` are in the order of their index.
std::vector<std::uint32_t> from_inside_out(const Image<float>& distance, double step) {
  float top = 0;
  for (const float d : distance.voxels) top = std::max(top, d);
  const auto bins = static_cast<std::size_t>(top / step) + 1;
  const auto bin = [&](float d) { return bins - 1 - std::min(bins - 1, static_cast<std::size_t>(d / step)); };
  std::vector<std::size_t> start(bins + 1);
  for (const float d : distance.voxels) {
    if (d > 0) ++start[bin(d) + 1];
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::uint32_t> order(start.back());
  for (std::size_t i = 0; i < distance.count(); ++i) {
    if (distance.voxels[i] > 0) order[start[bin(distance.voxels[i])]++] = static_cast<std::uint32_t>(i);
  }
  return order;
}

/// Returns the faces between all pairs of adjacent fragments, sorted by the numbers of the two fragments.
std::vector<Face> faces_of(const Image<std::uint32_t>& labels, const Image<float>& distance, const Image<float>& grey) {
  std::unordered_map<std::uint64_t, std::size_t> known;
  std::vector<Face> faces;
  const auto [nx, ny, nz] = labels.size;
  const auto meet = [&](std::size_t p, std::size_t q, const Vec3d& place) {
    const std::uint32_t a = std::min(labels.voxels[p], labels.voxels[q]),
                        b = std::max(labels.voxels[p], labels.voxels[q]);
    if (a == 0 || a == b) return;
    const auto [at, fresh] = known.try_emplace(std::uint64_t{a} << 32 | b, faces.size());
    if (fresh) faces.push_back({a, b});
    Face& face = faces[at->second];
    face.neck = std::max<double>(face.neck, std::min(distance.voxels[p], distance.voxels[q]));
    face.grey += std::min(grey.voxels[p], grey.voxels[q]);
    face.area += 1;
    face.middle += place;
  };
  for (std::int64_t k = 0; k < nz; ++k) {
    for (std::int64_t j = 0; j < ny; ++j) {
      for (std::int64_t i = 0; i < nx; ++i) {
        const std::size_t at = labels.index(i, j, k);
        if (labels.voxels[at] == 0) continue;
        const Vec3d place = labels.centre(i, j, k);
        if (i + 1 < nx) meet(at, at + 1, place);
        if (j + 1 < ny) meet(at, labels.index(i, j + 1, k), place);
        if (k + 1 < nz) meet(at, labels.index(i, j, k + 1), place);
      }
    }
  }
  std::sort(faces.begin(), faces.end(),
            [](const Face& x, const Face& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
  return faces;
}

}  // namespace

Fragments flood(const Image<float>& distance, const Image<float>& grey, double ratio) {
  counted<std::uint32_t>(distance.count(), "voxels of the grid on which grains are separated");
  const double voxel = std::cbrt(distance.voxel_volume());
  const auto [nx, ny, nz] = distance.size;
  Fragments out;
  out.labels = Image<std::uint32_t>::like(distance);
  std::vector<std::uint32_t>& label = out.labels.voxels;
  Joined basins;
  basins.add(0);  // number 0 is reserved for voxels without a basin
  for (const std::uint32_t at : from_inside_out(distance, voxel / 64)) {
    const std::int64_t i = at % nx, j = at / nx % ny, k = at / (nx * ny);
    const float d = distance.voxels[at];
    std::uint32_t own = 0;
    float highest = -1;
    std::array<std::uint32_t, 26> met;
    std::size_t n = 0;
    for (std::int64_t c = std::max<std::int64_t>(k - 1, 0); c <= std::min(k + 1, nz - 1); ++c) {
      for (std::int64_t b = std::max<std::int64_t>(j - 1, 0); b <= std::min(j + 1, ny - 1); ++b) {
        for (std::int64_t a = std::max<std::int64_t>(i - 1, 0); a <= std::min(i + 1, nx - 1); ++a) {
          const std::size_t near = distance.index(a, b, c);
          if (label[near] == 0) continue;
          const std::uint32_t root = basins.root(label[near]);
          if (distance.voxels[near] > highest) highest = distance.voxels[near], own = root;
          if (std::find(met.begin(), met.begin() + n, root) == met.begin() + n) met[n++] = root;
        }
      }
    }
    if (n == 0) own = basins.add(d);
    label[at] = own;
    for (std::size_t m = 0; m < n; ++m) {
      const std::uint32_t a = basins.root(own), b = basins.root(met[m]);
      if (a == b) continue;
      const float lower = std::min(basins.peak(a), basins.peak(b));
      if (d > ratio * lower || d > lower - 0.5 * voxel) basins.join(a, b);
    }
  }
  std::vector<std::uint32_t> number(basins.size());
  out.radius.push_back(0);
  for (std::uint32_t b = 1; b < basins.size(); ++b) {
    if (basins.root(b) != b) continue;
    number[b] = static_cast<std::uint32_t>(out.radius.size());
    out.radius.push_back(basins.peak(b));
  }
  for (std::uint32_t& l : label) l = l == 0 ? 0 : number[basins.root(l)];
  out.faces = faces_of(out.labels, distance, grey);
  return out;
}

}  // namespace macadam::ct
