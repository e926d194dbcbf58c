// SPDX-License-Identifier: GPL-3.0-or-later
// correction.cpp  Corrects slices, rings and beam hardening by the grey levels of the phases.
#include "host/tools/ct/voxels/correction.hpp"

#include <Eigen/Dense>

#include "kernels/base/parallel.hpp"

namespace macadam::ct {
namespace {

using Grid = std::array<std::int64_t, 3>;

/// Returns the centroid of the region in the middle slice, in voxel indices.
std::array<double, 2> middle_of(const Image<std::uint8_t>& region) {
  double x = 0, y = 0, n = 0;
  for (std::int64_t j = 0; j < region.size[1]; ++j) {
    for (std::int64_t i = 0; i < region.size[0]; ++i) {
      if (!region.at(i, j, region.size[2] / 2)) continue;
      x += static_cast<double>(i), y += static_cast<double>(j), ++n;
    }
  }
  return n > 0
             ? std::array{x / n, y / n}
             : std::array{0.5 * static_cast<double>(region.size[0] - 1), 0.5 * static_cast<double>(region.size[1] - 1)};
}

/// Grey levels of the whole scan, and for each part of the scan its brightness relative to these levels.
struct Parts {
  GreyLevels whole;
  std::vector<PartLevel> each;
};

/// Computes the brightness of each part; `part(i, j, k)` returns the part to which a voxel belongs.
template <class Part>
Parts levels_of_parts(const Image<float>& scan, const Image<std::uint8_t>& region, std::size_t parts, Part&& part) {
  Parts out;
  out.whole = fit_levels(histogram_of(scan, region));
  const Histogram empty = bins_of(scan, region, 256);
  std::vector<Histogram> histograms(parts, empty);
  for (std::int64_t k = 0; k < scan.size[2]; ++k) {
    for (std::int64_t j = 0; j < scan.size[1]; ++j) {
      for (std::int64_t i = 0; i < scan.size[0]; ++i) {
        const std::size_t at = scan.index(i, j, k);
        if (region.voxels[at]) histograms[part(i, j, k)].add(scan.voxels[at]);
      }
    }
  }
  out.each.resize(parts);
  for_each_in_parallel(parts, [&](std::size_t p) { out.each[p] = level_of_part(histograms[p], out.whole); });
  return out;
}

/// Removes the extra brightness `brighter(i, j, k)` from every voxel (see PartLevel). \returns the correction as a
/// function of position.
template <class Brighter>
CorrectionStep take_out(Image<float>& scan, const GreyLevels& whole, const Brighter& brighter) {
  for_each_in_parallel(static_cast<std::size_t>(scan.size[2]), [&](std::size_t slice) {
    const auto k = static_cast<std::int64_t>(slice);
    for (std::int64_t j = 0; j < scan.size[1]; ++j) {
      for (std::int64_t i = 0; i < scan.size[0]; ++i) {
        float& grey = scan.at(i, j, k);
        const double b = brighter(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        grey =
            static_cast<float>(whole.has_air ? whole.air + (grey - whole.air) / (1 + b) : grey - b * whole.contrast());
      }
    }
  });
  CorrectionStep step{whole.air, {}, {}};
  if (whole.has_air) step.factor = [brighter](double i, double j, double k) { return 1 + brighter(i, j, k); };
  if (!whole.has_air) {
    step.offset = [brighter, contrast = whole.contrast()](double i, double j, double k) {
      return contrast * brighter(i, j, k);
    };
  }
  return step;
}

/// Returns the linear interpolation of `values` at index `at`; beyond the ends the nearest value.
double between(const std::vector<double>& values, double at) {
  const double in = std::clamp(at, 0.0, static_cast<double>(values.size() - 1));
  const auto low = static_cast<std::size_t>(in);
  const double share = in - static_cast<double>(low);
  return share > 0 ? (1 - share) * values[low] + share * values[low + 1] : values[low];
}

/// Converts a brightness to the change of the aggregate's level, as a fraction of the contrast.
double in_contrasts(double brighter, const GreyLevels& whole) {
  return whole.has_air ? brighter * (whole.aggregate - whole.air) / whole.contrast() : brighter;
}

}  // namespace

// Blocks at the far ends that are not complete are left out.
std::pair<Image<float>, Image<std::uint8_t>> means_of_blocks(const Image<float>& scan,
                                                             const Image<std::uint8_t>& region, Grid block) {
  Grid size;
  for (std::size_t a = 0; a < 3; ++a) {
    block[a] = std::min(block[a], scan.size[a]);
    size[a] = scan.size[a] / block[a];
  }
  const Vec3d spacing{scan.spacing.x * static_cast<double>(block[0]), scan.spacing.y * static_cast<double>(block[1]),
                      scan.spacing.z * static_cast<double>(block[2])};
  const Vec3d origin = scan.origin + 0.5 * (spacing - scan.spacing);
  Image<float> means(size, spacing, origin);
  Image<std::uint8_t> inside(size, spacing, origin);
  const float share = 1.0f / static_cast<float>(block[0] * block[1] * block[2]);
  for_each_in_parallel(static_cast<std::size_t>(size[2]), [&](std::size_t slice) {
    const auto k = static_cast<std::int64_t>(slice);
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t i = 0; i < size[0]; ++i) {
        float sum = 0;
        bool all = true;
        for (std::int64_t c = 0; c < block[2]; ++c) {
          for (std::int64_t b = 0; b < block[1]; ++b) {
            for (std::int64_t a = 0; a < block[0]; ++a) {
              const std::size_t at = scan.index(i * block[0] + a, j * block[1] + b, k * block[2] + c);
              sum += scan.voxels[at];
              all = all && region.voxels[at];
            }
          }
        }
        means.at(i, j, k) = sum * share;
        inside.at(i, j, k) = all;
      }
    }
  });
  return {std::move(means), std::move(inside)};
}

// Block means of 3 × 3 voxels within a slice reduce the noise before the levels are fitted.
double correct_slices(Image<float>& scan, const Image<std::uint8_t>& region, CorrectionSteps* steps) {
  const auto [means, inside] = means_of_blocks(scan, region, {3, 3, 1});
  const auto slices = static_cast<std::size_t>(scan.size[2]);
  const auto slice = [](auto, auto, std::int64_t k) { return static_cast<std::size_t>(k); };
  const Parts parts = levels_of_parts(means, inside, slices, slice);
  double squares = 0;
  std::vector<double> brighter;
  for (const PartLevel& p : parts.each) squares += p.brighter * p.brighter, brighter.push_back(p.brighter);
  const CorrectionStep step =
      take_out(scan, parts.whole, [brighter](auto, auto, double k) { return between(brighter, k); });
  if (steps) steps->push_back(step);
  return in_contrasts(std::sqrt(squares / static_cast<double>(slices)), parts.whole);
}

// The brightness of each ring, one voxel wide in radius, is compared with the median of the rings up to 8 voxels away.
// The median follows smooth changes, which are due to beam hardening; the difference from the median is the ring's
// offset.
double correct_rings(Image<float>& scan, const Image<std::uint8_t>& region, CorrectionSteps* steps) {
  const auto [cx, cy] = middle_of(region);
  const auto [means, inside] = means_of_blocks(scan, region, {1, 1, 3});
  const auto ring = [cx = cx, cy = cy](std::int64_t i, std::int64_t j, auto) {
    return static_cast<std::size_t>(std::lround(std::hypot(static_cast<double>(i) - cx, static_cast<double>(j) - cy)));
  };
  const std::size_t rings = 1 + std::max({ring(0, 0, 0), ring(scan.size[0] - 1, 0, 0), ring(0, scan.size[1] - 1, 0),
                                          ring(scan.size[0] - 1, scan.size[1] - 1, 0)});
  const Parts parts = levels_of_parts(means, inside, rings, ring);
  constexpr std::size_t reach = 8;  // [voxels of radius]; wider changes are attributed to beam hardening
  std::vector<double> offset(rings);
  double squares = 0;
  for (std::size_t r = 0; r < rings; ++r) {
    if (parts.each[r].weight <= 0) continue;
    std::vector<double> near;
    for (std::size_t n = r < reach ? 0 : r - reach; n < std::min(rings, r + reach + 1); ++n) {
      if (parts.each[n].weight > 0) near.push_back(parts.each[n].brighter);
    }
    const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
    std::nth_element(near.begin(), middle, near.end());
    // the offset of a ring is subtracted instead of divided out, because a faulty detector pixel is off by the same
    // amount whatever the scan shows
    offset[r] = in_contrasts(parts.each[r].brighter - *middle, parts.whole) * parts.whole.contrast();
    squares += offset[r] * offset[r];
  }
  for_each_in_parallel(static_cast<std::size_t>(scan.size[2]), [&](std::size_t slice) {
    for (std::int64_t j = 0; j < scan.size[1]; ++j) {
      for (std::int64_t i = 0; i < scan.size[0]; ++i)
        scan.at(i, j, static_cast<std::int64_t>(slice)) -= static_cast<float>(offset[ring(i, j, 0)]);
    }
  });
  const double whole = parts.whole.contrast();
  if (steps)
    steps->push_back({0, {}, [offset = std::move(offset), cx = cx, cy = cy](double i, double j, double) {
                        return between(offset, std::hypot(i - cx, j - cy));
                      }});
  return std::sqrt(squares / static_cast<double>(rings)) / whole;
}

double ring_share(const Image<float>& scan, const Image<std::uint8_t>& region) {
  const auto [cx, cy] = middle_of(region);
  struct Ring {
    double voxels = 0, sum = 0, squares = 0;
    double mean() const { return sum / voxels; }
  };
  std::vector<Ring> rings;
  for (std::int64_t k = 0; k < scan.size[2]; ++k) {
    for (std::int64_t j = 0; j < scan.size[1]; ++j) {
      for (std::int64_t i = 0; i < scan.size[0]; ++i) {
        const std::size_t at = scan.index(i, j, k);
        if (!region.voxels[at]) continue;
        const auto r =
            static_cast<std::size_t>(std::lround(std::hypot(static_cast<double>(i) - cx, static_cast<double>(j) - cy)));
        if (r >= rings.size()) rings.resize(r + 1);
        const double grey = scan.voxels[at];
        ++rings[r].voxels, rings[r].sum += grey, rings[r].squares += grey * grey;
      }
    }
  }
  std::erase_if(rings, [](const Ring& r) { return r.voxels == 0; });
  double voxels = 0, sum = 0, squares = 0, explained = 0;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    voxels += rings[r].voxels, sum += rings[r].sum, squares += rings[r].squares;
    // Half the squared step to the next ring is the variance that a ring explains. Smooth changes over the radius give
    // almost no steps, so they do not count.
    const double step = rings[r].mean() - rings[r > 0 ? r - 1 : std::min(r + 1, rings.size() - 1)].mean();
    explained += rings[r].voxels * 0.5 * step * step;
  }
  const double variance = squares - sum * sum / voxels;
  return variance > 0 ? explained / variance : 0;
}

// Divides the specimen into 12 ranges of ρ (squared radius) and 6 of height, finds the brightness of each cell, and
// fits the polynomial 1, ρ, ρ², ζ, ζ², ρζ to these values by least squares. The weights are the numbers of voxels.
double correct_hardening(Image<float>& scan, const Image<std::uint8_t>& region, CorrectionSteps* steps) {
  const auto [cx, cy] = middle_of(region);
  const std::int64_t edge = std::clamp<std::int64_t>(scan.size[0] / 100, 1, 4);
  const auto [means, inside] = means_of_blocks(scan, region, {edge, edge, edge});
  const double half = 0.5 * std::hypot(static_cast<double>(scan.size[0]), static_cast<double>(scan.size[1]));
  const auto height = static_cast<double>(scan.size[2]);
  constexpr int radii = 12, heights = 6;
  // ρ = (r/half)², ζ: height from −1 to 1
  const auto radius2 = [half, cx = cx, cy = cy](double i, double j) {
    return ((i - cx) * (i - cx) + (j - cy) * (j - cy)) / (half * half);
  };
  const auto block = static_cast<double>(edge);
  const auto cell = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    const double rho =
        radius2(block * (static_cast<double>(i) + 0.5) - 0.5, block * (static_cast<double>(j) + 0.5) - 0.5);
    const int r = std::min(radii - 1, static_cast<int>(rho * radii));
    const int z = std::min<int>(heights - 1, static_cast<int>(heights * k / means.size[2]));
    return static_cast<std::size_t>(r + radii * z);
  };
  const Parts parts = levels_of_parts(means, inside, radii * heights, cell);
  using Terms = Eigen::Matrix<double, 6, 1>;
  const auto terms = [](double rho, double zeta) { return Terms{1, rho, rho * rho, zeta, zeta * zeta, rho * zeta}; };
  Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
  Terms right = Terms::Zero();
  double weights = 0;
  for (int z = 0; z < heights; ++z) {
    for (int r = 0; r < radii; ++r) {
      const PartLevel& p = parts.each[static_cast<std::size_t>(r + radii * z)];
      const Terms t = terms((r + 0.5) / radii, -1 + 2 * (z + 0.5) / heights);
      matrix += p.weight * t * t.transpose();
      right += p.weight * p.brighter * t;
      weights += p.weight;
    }
  }
  if (!(weights > 0)) return 0;
  matrix.diagonal().array() += 1e-6 * weights;  // a small diagonal keeps terms that the cells do not determine at zero
  const Terms fit = matrix.ldlt().solve(right);
  double low = 0, high = 0;
  for (int r = 0; r < radii; ++r) {
    if (parts.each[static_cast<std::size_t>(r + radii * (heights / 2))].weight <= 0) continue;
    const double there = fit.dot(terms((r + 0.5) / radii, 0));
    low = std::min(low, there), high = std::max(high, there);
  }
  const CorrectionStep step = take_out(scan, parts.whole, [fit, terms, radius2, height](double i, double j, double k) {
    return fit.dot(terms(radius2(i, j), -1 + 2 * (k + 0.5) / height));
  });
  if (steps) steps->push_back(step);
  return in_contrasts(high - low, parts.whole);
}

ScanCorrections correct(Image<float>& scan, const Image<std::uint8_t>& region, const SegmentOptions& options,
                        CorrectionSteps* steps) {
  ScanCorrections first;
  for (int round = 0; round < 4; ++round) {
    ScanCorrections now;
    if (options.hardening) now.hardening = correct_hardening(scan, region, steps);
    if (options.slices) now.slices = correct_slices(scan, region, steps);
    if (options.rings) now.rings = correct_rings(scan, region, steps);
    if (round == 0) first = now;
    if (std::max({now.slices, now.rings, now.hardening}) < 0.02) break;
  }
  return first;
}

}  // namespace macadam::ct
