// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_insertion.cpp  Random sequential insertion of shapes, with a list of open cells when room is scarce.
#include "host/specimen/shape_insertion.hpp"

#include <algorithm>

namespace macadam {
namespace {

constexpr std::int64_t plain_attempts = 2'000;  // a listing of open cells costs about as much

double smallest_radius(const std::vector<ShapeBody>& bodies) {
  double r = bodies.empty() ? 1 : bodies.front().radius();
  for (const ShapeBody& b : bodies) r = std::min(r, b.radius());
  return r;
}

}  // namespace

ShapeInsertion::ShapeInsertion(const Box& box, const std::vector<ShapeBody>& bodies, std::int64_t attempts,
                               RandomStream random)
    : box_(box),
      radius_to_come_(bodies.size()),
      grid_(box, smallest_radius(bodies) / 2),
      attempts_(attempts),
      random_(random) {
  double largest = 0;
  for (std::size_t k = bodies.size(); k-- > 0;) radius_to_come_[k] = largest = std::max(largest, bodies[k].radius());
}

bool ShapeInsertion::place(std::size_t k, ShapeBody& body) {
  std::optional<std::vector<std::size_t>> open;
  for (std::int64_t attempt = 0; attempt < attempts_; ++attempt) {
    if (attempt == plain_attempts) {
      // Points drawn evenly over the cells that are not wholly taken are distributed as plain ones are; more succeed.
      open = open_cells(body.inner_radius());
      if (open->empty()) return false;
    }
    body.set_turn(random_turn(random_));
    const Extent e = extent(body);
    const Vec3d low = -e.low, high = box_.size - e.high;
    const auto point = [&](const Vec3d& from, const Vec3d& to) {
      const double x = random_.uniform(from.x, to.x), y = random_.uniform(from.y, to.y);
      return Vec3d{x, y, random_.uniform(from.z, to.z)};
    };
    if (open) {
      const Vec3d corner = grid_.corner((*open)[random_.index(open->size())]);
      body.centre = point(corner, corner + grid_.edge());
    } else {
      body.centre = point(low, high);
    }
    const Vec3d c = body.centre;
    const bool inside = c.x >= low.x && c.x <= high.x && c.y >= low.y && c.y <= high.y && c.z >= low.z && c.z <= high.z;
    if (!inside || !clear(body)) continue;
    if (k + 1 < radius_to_come_.size())
      grid_.insert(static_cast<std::int32_t>(placed_.size()), c, body.radius() + radius_to_come_[k + 1]);
    placed_.push_back(body);
    return true;
  }
  return false;
}

bool ShapeInsertion::clear(const ShapeBody& body) const {
  const std::vector<std::int32_t>& near = grid_.near(grid_.cell_of(body.centre));
  // Most tries fail, and most of these by their centre alone.
  for (std::int32_t j : near)
    if (placed_[j].distance_at_most(body.centre) < body.inner_radius()) return false;
  return std::none_of(near.begin(), near.end(), [&](std::int32_t j) { return overlap(placed_[j], body); });
}

std::vector<std::size_t> ShapeInsertion::open_cells(double inner_radius) const {
  std::vector<std::size_t> open;
  const double half = norm(grid_.edge()) / 2;
  const Vec3d l = box_.size;
  for (std::size_t cell = 0; cell < grid_.cells(); ++cell) {
    const Vec3d c = grid_.corner(cell) + 0.5 * grid_.edge();
    const double farthest = inner_radius - half;  // no point of the cell has more room than its centre and half
    const std::vector<std::int32_t>& near = grid_.near(cell);
    const bool taken = std::min({c.x, c.y, c.z, l.x - c.x, l.y - c.y, l.z - c.z}) < farthest ||
                       std::any_of(near.begin(), near.end(),
                                   [&](std::int32_t j) { return placed_[j].distance_at_most(c) < farthest; });
    if (!taken) open.push_back(cell);
  }
  return open;
}

}  // namespace macadam
