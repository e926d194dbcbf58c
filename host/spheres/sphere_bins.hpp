// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sphere_bins.hpp  Spheres of about one size, sorted into cells by their centres.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "macadam/specimen.hpp"

namespace macadam {

/// Centre and radius side by side: whoever asks for one of them wants the other too [m].
struct Ball {
  Vec3d centre;
  double radius;
};

/// The spheres of a specimen, in its order.
std::vector<Ball> balls_of(const Specimen& specimen);

/// Each sphere stands in one cell of a grid over the box. Those of a row of cells along x lie side by side, so that a
/// query reads a few stretches of memory. A query goes as far as the largest sphere needs, hence the one size.
class SphereBins {
 public:
  /// For the spheres `ids`, given by ascending number; `skin` [m] is what queries add to the sum of two radii.
  SphereBins(const Box& box, std::span<const Ball> spheres, std::vector<std::int32_t> ids, double skin);

  /// Sorts again for the centres as they are now.
  void sort(std::span<const Ball> spheres);

  /// Moves one of the spheres. All that were moved since they were sorted are met by every query: sort when they are
  /// many.
  void move(std::int32_t id, const Vec3d& centre);
  std::size_t moved() const { return ball_.size() - given_.size(); }

  double largest() const { return largest_; }
  const Ball& ball(std::size_t slot) const { return ball_[slot]; }
  std::int32_t id(std::size_t slot) const { return id_[slot]; }

  /// The spheres given; and the same, cell by cell, while none has been moved.
  std::span<const std::int32_t> ids() const { return given_; }
  std::span<const std::int32_t> in_order() const { return id_; }

  /// Calls visit(first, last) for stretches of slots that hold all spheres with centres within `range` [m] of a point.
  template <class Visit>
  void near(const Vec3d& point, double range, const Visit& visit) const {
    const auto [x0, x1] = x_.between(point.x - range, point.x + range);
    const auto [y0, y1] = y_.between(point.y - range, point.y + range);
    const auto [z0, z1] = z_.between(point.z - range, point.z + range);
    for (std::int64_t z = z0; z <= z1; ++z)
      for (std::int64_t y = y0; y <= y1; ++y) {
        const std::int64_t row = (z * y_.cells + y) * x_.cells;
        const std::uint32_t first = start_[row + x0], last = start_[row + x1 + 1];
        if (first < last) visit(first, last);
      }
    if (moved() > 0) visit(static_cast<std::uint32_t>(given_.size()), static_cast<std::uint32_t>(ball_.size()));
  }

 private:
  struct Axis {
    std::int64_t cells = 1;
    double per_length = 0;  ///< cells a metre

    std::int64_t cell(double x) const;
    std::pair<std::int64_t, std::int64_t> between(double low, double high) const { return {cell(low), cell(high)}; }
  };

  std::vector<std::int32_t> given_;
  double largest_ = 0;  ///< radius [m]
  Axis x_, y_, z_;
  std::vector<std::uint32_t> start_;           ///< first slot of each cell
  std::vector<std::uint32_t> cell_, slot_of_;  ///< of each sphere given
  std::vector<Ball> ball_;                     ///< by cell, then by number; behind them those that were moved
  std::vector<std::int32_t> id_;
};

}  // namespace macadam
