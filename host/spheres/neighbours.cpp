// SPDX-License-Identifier: GPL-3.0-or-later
/// \file neighbours.cpp  Each pair is found by its smaller sphere, then entered in both rows.
#include "host/spheres/neighbours.hpp"

namespace macadam {

Neighbours::Neighbours(const Specimen& specimen, double cell, double skin)
    : specimen_(specimen), skin_(skin), grid_(specimen.box, cell) {
  rebuild();
}

/// Calls `visit` with the neighbours that are larger than a sphere, or as large and of higher number.
template <class Visit>
void Neighbours::larger_neighbours(std::size_t i, const Visit& visit) const {
  const Vec3d centre = specimen_.centre[i];
  const double radius = specimen_.radius[i];
  for (std::int32_t j : grid_.near(grid_.cell_of(centre))) {
    const double other = specimen_.radius[j], range = radius + other + skin_;
    if (other < radius || (other == radius && j <= static_cast<std::int32_t>(i))) continue;
    const Vec3d d = specimen_.centre[j] - centre;
    if (dot(d, d) < range * range) visit(j);
  }
}

void Neighbours::rebuild() {
  const auto n = static_cast<std::int64_t>(specimen_.size());
  grid_.clear();
  for (std::int64_t i = 0; i < n; ++i)
    grid_.insert(static_cast<std::int32_t>(i), specimen_.centre[i], 2 * specimen_.radius[i] + skin_);

  larger_start_.assign(n + 1, 0);
#pragma omp parallel for schedule(static) if (specimen_.size() >= parallel_from)
  for (std::int64_t i = 0; i < n; ++i) larger_neighbours(i, [&](std::int32_t) { ++larger_start_[i + 1]; });
  for (std::int64_t i = 0; i < n; ++i) larger_start_[i + 1] += larger_start_[i];
  larger_.resize(larger_start_[n]);
#pragma omp parallel for schedule(static) if (specimen_.size() >= parallel_from)
  for (std::int64_t i = 0; i < n; ++i) {
    std::size_t k = larger_start_[i];
    larger_neighbours(i, [&](std::int32_t j) { larger_[k++] = j; });
  }

  start_.assign(n + 1, 0);
  for (std::int64_t i = 0; i < n; ++i) start_[i + 1] += larger_start_[i + 1] - larger_start_[i];
  for (std::int32_t j : larger_) ++start_[j + 1];
  for (std::int64_t i = 0; i < n; ++i) start_[i + 1] += start_[i];
  end_.assign(start_.begin(), start_.end() - 1);
  list_.resize(start_[n]);
  for (std::int64_t i = 0; i < n; ++i)
    for (std::size_t k = larger_start_[i]; k < larger_start_[i + 1]; ++k) {
      list_[end_[i]++] = larger_[k];
      list_[end_[larger_[k]]++] = static_cast<std::int32_t>(i);
    }
}

}  // namespace macadam
