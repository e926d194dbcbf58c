// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sphere_grid.cpp  Makes the cells of the grid and lists in each cell the spheres whose reach touches the cell.
#include "host/spheres/sphere_grid.hpp"

#include <algorithm>
#include <cmath>

namespace macadam {
namespace {

constexpr double most_cells = 2e6;

std::int64_t clamped_cell(double position, double edge, std::int64_t n) {
  return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(position / edge)), 0, n - 1);
}

}  // namespace

SphereGrid::SphereGrid(const Box& box, double cell) {
  const auto number = [&](double length) { return std::clamp(std::floor(length / cell), 1.0, most_cells); };
  while (number(box.size.x) * number(box.size.y) * number(box.size.z) > most_cells) cell *= 1.1;
  nx_ = static_cast<std::int64_t>(number(box.size.x));
  ny_ = static_cast<std::int64_t>(number(box.size.y));
  nz_ = static_cast<std::int64_t>(number(box.size.z));
  edge_ = {box.size.x / static_cast<double>(nx_), box.size.y / static_cast<double>(ny_),
           box.size.z / static_cast<double>(nz_)};
  list_.resize(static_cast<std::size_t>(nx_ * ny_ * nz_));
}

void SphereGrid::clear() {
  for (auto& list : list_) list.clear();
}

std::pair<std::int64_t, std::int64_t> SphereGrid::range(double position, double reach, double edge, std::int64_t n) {
  return {clamped_cell(position - reach, edge, n), clamped_cell(position + reach, edge, n)};
}

void SphereGrid::insert(std::int32_t id, const Vec3d& c, double reach) {
  reach *= 1 + 1e-9;  // because rounding may assign a point on a border to either cell
  const auto [z0, z1] = range(c.z, reach, edge_.z, nz_);
  for (std::int64_t z = z0; z <= z1; ++z)
    within(c, reach, static_cast<std::size_t>(z), [&](std::size_t cell) { list_[cell].push_back(id); });
}

std::size_t SphereGrid::cell_of(const Vec3d& p) const {
  const std::int64_t x = clamped_cell(p.x, edge_.x, nx_);
  const std::int64_t y = clamped_cell(p.y, edge_.y, ny_);
  const std::int64_t z = clamped_cell(p.z, edge_.z, nz_);
  return static_cast<std::size_t>((z * ny_ + y) * nx_ + x);
}

Vec3d SphereGrid::corner(std::size_t cell) const {
  const auto k = static_cast<std::int64_t>(cell);
  const std::int64_t x = k % nx_, y = k / nx_ % ny_, z = k / (nx_ * ny_);
  return {static_cast<double>(x) * edge_.x, static_cast<double>(y) * edge_.y, static_cast<double>(z) * edge_.z};
}

}  // namespace macadam
