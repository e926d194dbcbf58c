// SPDX-License-Identifier: GPL-3.0-or-later
/// \file wall_motion.hpp  Computes the prescribed motion of the walls as a table with one row per step, for some
/// thousand steps at a time. Every executor reads this table.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "kernels/layout/layout.hpp"
#include "macadam/boundary.hpp"
#include "macadam/numeric.hpp"

namespace macadam::kernels {

inline constexpr int wall_axes = 3 * walls;  ///< numbered 3·wall + 0, 1 or 2 for x, y, z

/// The rows of the table for the next steps. A driven wall has four words in a row, so that a GPU reads them by one or
/// two instructions. R: precision of the particles. Passed to kernels by value.
template <class R>
struct WallMotion {
  static constexpr int words = 4;
  const R* table = nullptr;       ///< [row][driven wall][4] velocity over the step [m/s], or force at its beginning [N]
  std::int32_t driven = 0;        ///< number of driven walls, in each row
  std::int8_t place[walls] = {};  ///< index of a wall in a row; −1: at rest
  std::uint32_t by_force = 0;     ///< one bit for each axis: driven by a force

  MACADAM_HD bool moves(int wall) const { return place[wall] >= 0; }
  MACADAM_HD bool loaded(int axis) const { return by_force >> axis & 1; }
  MACADAM_HD std::size_t row_words() const { return static_cast<std::size_t>(driven) * words; }
  /// Values along x, y, z of a driven wall in a row.
  MACADAM_HD const R* row(int wall, std::int64_t row) const {
    return table + static_cast<std::size_t>(row) * row_words() + place[wall] * words;
  }
};

/// Computes the table of the motion of a boundary's walls, with one row per time step.
template <class R>
class WallTable {
 public:
  static constexpr std::int64_t first_rows = 256, most_rows = 4096;

  WallTable() = default;
  explicit WallTable(const Boundary& boundary) {
    for (int wall = 0; wall < walls; ++wall) {
      const auto& axes = boundary.wall[static_cast<std::size_t>(wall)].axis;
      motion_.place[wall] = -1;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (axes[axis].by == DrivenBy::rest) continue;
        if (!motion_.moves(wall)) motion_.place[wall] = static_cast<std::int8_t>(motion_.driven++);
        if (axes[axis].by == DrivenBy::force) motion_.by_force |= 1u << (3 * wall + static_cast<int>(axis));
        driven_.push_back({axes[axis], static_cast<std::size_t>(motion_.place[wall] * WallMotion<R>::words) + axis});
      }
    }
  }

  /// Returns the description of the table; its address is not set.
  const WallMotion<R>& motion() const { return motion_; }
  /// Returns how many rows to fill at once if `done` steps were requested before and `left` remain: few at first, so
  /// that a GPU does not wait for the host; later as many as all earlier calls together, up to `most_rows`.
  std::int64_t rows(std::int64_t done, std::int64_t left) const {
    return driven_.empty() ? left : std::min({left, std::max(first_rows, done), most_rows});
  }
  /// Size of the table. It includes one row after the last step, which kernels load but do not use.
  std::size_t most_values() const { return static_cast<std::size_t>(most_rows + 1) * motion_.row_words(); }

  /// Returns the rows of the steps first … first + n − 1; axes at rest are 0.
  const std::vector<R>& fill(std::int64_t first, std::int64_t n) {
    if (driven_.empty()) return values_;
    values_.assign(static_cast<std::size_t>(n) * motion_.row_words(), R(0));
    R* row = values_.data();
    for (std::int64_t k = first; k < first + n; ++k, row += motion_.row_words()) {
      for (const auto& [axis, word] : driven_)
        row[word] = static_cast<R>(axis.by == DrivenBy::force ? axis.drive->value(k) : axis.drive->rate(k));
    }
    return values_;
  }

 private:
  struct Driven {
    WallAxis axis;
    std::size_t word;  // index in a row
  };
  WallMotion<R> motion_;
  std::vector<Driven> driven_;
  std::vector<R> values_;
};

}  // namespace macadam::kernels
