// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sphere_bins.cpp  Sorts spheres into cells with a counting sort.
#include "host/spheres/sphere_bins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace macadam {
namespace {

constexpr double most_cells_a_sphere = 4;  // filling a grid with more cells costs more than it saves

}  // namespace

std::vector<Ball> balls_of(const Specimen& specimen) {
  std::vector<Ball> balls;
  balls.reserve(specimen.size());
  for (std::size_t i = 0; i < specimen.size(); ++i) balls.push_back({specimen.centre[i], specimen.radius[i]});
  return balls;
}

/// Returns the cell of a coordinate; outside the box, the outermost cell. The cell number never decreases with the
/// coordinate, so the cells of the two ends of an interval enclose the cells of all points between the ends.
std::int64_t SphereBins::Axis::cell(double x) const {
  return static_cast<std::int64_t>(std::clamp(x * per_length, 0.0, static_cast<double>(cells - 1)));
}

SphereBins::SphereBins(const Box& box, std::span<const Ball> spheres, std::vector<std::int32_t> ids, double skin)
    : given_(std::move(ids)) {
  for (std::int32_t i : given_) largest_ = std::max(largest_, spheres[i].radius);
  // The edge of a cell is half of a query's range, which is two radii and the skin. The edge is larger if there would
  // otherwise be too many cells.
  const auto n = static_cast<double>(given_.size());
  const double least = std::cbrt(box.volume() / (most_cells_a_sphere * n));
  const double edge = std::max((2 * largest_ + skin) / 2, least);
  const auto axis = [&](double length) {
    const double cells = std::clamp(std::floor(length / edge), 1.0, most_cells_a_sphere * n);
    return Axis{static_cast<std::int64_t>(cells), cells / length};
  };
  x_ = axis(box.size.x), y_ = axis(box.size.y), z_ = axis(box.size.z);
  start_.resize(static_cast<std::size_t>(x_.cells * y_.cells * z_.cells) + 1);
  cell_.resize(given_.size()), slot_of_.resize(given_.size());
  sort(spheres);
}

void SphereBins::sort(std::span<const Ball> spheres) {
  ball_.resize(given_.size()), id_.resize(given_.size());
  std::fill(start_.begin(), start_.end(), 0);
  for (std::size_t k = 0; k < given_.size(); ++k) {
    const Vec3d& c = spheres[given_[k]].centre;
    cell_[k] = static_cast<std::uint32_t>((z_.cell(c.z) * y_.cells + y_.cell(c.y)) * x_.cells + x_.cell(c.x));
    ++start_[cell_[k]];
  }
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];  // start_[c] is now the end of cell c
  for (std::size_t k = given_.size(); k-- > 0;) {  // filling backwards turns start_[c] into the beginning of cell c
    const std::uint32_t slot = slot_of_[k] = --start_[cell_[k]];
    id_[slot] = given_[k];
    ball_[slot] = spheres[given_[k]];
  }
}

void SphereBins::move(std::int32_t id, const Vec3d& centre) {
  const auto k = std::lower_bound(given_.begin(), given_.end(), id) - given_.begin();
  std::uint32_t& slot = slot_of_[k];
  if (slot < given_.size()) {
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    ball_.push_back(ball_[slot]), id_.push_back(id);
    ball_[slot].centre = {nowhere, nowhere, nowhere};
    slot = static_cast<std::uint32_t>(ball_.size() - 1);
  }
  ball_[slot].centre = centre;
}

}  // namespace macadam
