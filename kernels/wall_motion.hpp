// SPDX-License-Identifier: GPL-3.0-or-later
/// \file wall_motion.hpp  What drives the walls, as every executor reads it: a table of some thousand steps.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "kernels/layout.hpp"
#include "macadam/boundary.hpp"
#include "macadam/numeric.hpp"

namespace macadam::kernels {

/// The rows of the steps that are to come, a column for each driven axis. Passed to kernels by value.
struct WallMotion {
  static constexpr int axes = 3 * walls;
  const double* table = nullptr;  ///< [row][columns] velocity over the step [m/s], or force at its beginning [N]
  std::int32_t columns = 0;
  std::int8_t column[axes] = {};  ///< of axis 3·wall + axis; −1: at rest
  std::uint32_t by_force = 0;     ///< bit 3·wall + axis
  std::uint32_t moving = 0;       ///< bit wall: any of its axes is driven

  MACADAM_HD bool moves(int wall) const { return moving >> wall & 1; }
  MACADAM_HD bool loaded(int wall, int axis) const { return by_force >> (3 * wall + axis) & 1; }
  /// The number of an axis at a row; 0 at rest.
  MACADAM_HD double at(int wall, int axis, std::int64_t row) const {
    const int c = column[3 * wall + axis];
    return c < 0 ? 0.0 : table[row * columns + c];
  }
};

/// Fills the rows of a boundary's walls.
class WallTable {
 public:
  static constexpr std::int64_t most_rows = 4096;

  WallTable() = default;
  explicit WallTable(const Boundary& boundary) {
    for (int wall = 0; wall < walls; ++wall) {
      for (int axis = 0; axis < 3; ++axis) {
        const WallAxis& a = boundary.wall[static_cast<std::size_t>(wall)].axis[static_cast<std::size_t>(axis)];
        std::int8_t& column = motion_.column[3 * wall + axis];
        column = -1;
        if (a.by == DrivenBy::rest) continue;
        column = static_cast<std::int8_t>(motion_.columns++);
        motion_.moving |= 1u << wall;
        if (a.by == DrivenBy::force) motion_.by_force |= 1u << (3 * wall + axis);
        driven_.push_back(a);
      }
    }
  }

  /// Without the address of a table.
  const WallMotion& motion() const { return motion_; }
  /// Rows that are filled at once, where so many steps are left.
  std::int64_t rows(std::int64_t steps) const { return driven_.empty() ? steps : std::min(steps, most_rows); }
  std::size_t most_values() const { return static_cast<std::size_t>(most_rows) * driven_.size(); }

  /// The rows of the steps first … first + n − 1.
  const std::vector<double>& fill(std::int64_t first, std::int64_t n) {
    values_.resize(static_cast<std::size_t>(n) * driven_.size());
    double* out = values_.data();
    for (std::int64_t k = first; !driven_.empty() && k < first + n; ++k) {
      for (const WallAxis& a : driven_) *out++ = a.by == DrivenBy::force ? a.drive->value(k) : a.drive->rate(k);
    }
    return values_;
  }

 private:
  WallMotion motion_;
  std::vector<WallAxis> driven_;
  std::vector<double> values_;
};

}  // namespace macadam::kernels
