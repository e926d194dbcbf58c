// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_insertion.cpp  Inserts shapes one after another at random. When few places are left, it samples from a
/// list of cells that still have space.
#include "host/specimen/packing/shape_insertion.hpp"

#include <algorithm>

#include "kernels/base/parallel.hpp"

namespace macadam {
namespace {

constexpr std::int64_t plain_shape_attempts = 2'000;  // listing the open cells takes about the time of this many trials
constexpr std::int64_t shape_tries_at_once = 4;       // number of trials that a thread processes at a time

double smallest_radius(const std::vector<ShapeBody>& bodies) {
  double r = bodies.empty() ? 1 : bodies.front().radius();
  for (const ShapeBody& b : bodies) r = std::min(r, b.radius());
  return r;
}

}  // namespace

ShapeInsertion::ShapeInsertion(const Domain& box, const std::vector<ShapeBody>& bodies, double spacing,
                               std::int64_t attempts, RandomStream random)
    : box_(box),
      radius_to_come_(bodies.size()),
      inner_to_come_(bodies.size()),
      near_(box, 2 * smallest_radius(bodies)),
      grid_(box, smallest_radius(bodies) / 2),
      spacing_(spacing),
      attempts_(attempts),
      random_(random) {
  double largest = 0, inner = 0;
  for (std::size_t k = bodies.size(); k-- > 0;) {
    radius_to_come_[k] = largest = std::max(largest, bodies[k].radius());
    inner_to_come_[k] = inner = std::max(inner, bodies[k].inner_radius());
  }
}

bool ShapeInsertion::place(std::size_t k, ShapeBody& body) {
  const std::int64_t plain = std::min(attempts_, plain_shape_attempts);
  const auto anywhere = [&](Draws draws, ShapeBody& b) {
    b.set_turn(random_turn(draws));
    const Extent e = extent(b);
    b.centre = point(draws, -e.low, box_.size - e.high);
    return inside(b, e) && clear(b);
  };
  bool placed = find(plain, 6, anywhere, body);
  if (!placed && attempts_ > plain) {
    // Trials are made only in the cells that placed bodies do not cover completely. Successful trials then have the
    // same distribution as successful trials over the whole box, but more trials succeed.
    const std::vector<std::size_t> open = open_cells(k, body.inner_radius());
    if (open.empty()) return false;
    const auto in_the_open = [&](Draws draws, ShapeBody& b) {
      b.set_turn(random_turn(draws));
      const Vec3d corner = grid_.corner(open[draws.index(open.size())]);
      b.centre = point(draws, corner, corner + grid_.edge());
      return clear_at_centre(b) && inside(b, extent(b)) && clear(b);
    };
    placed = find(attempts_ - plain, 7, in_the_open, body);
  }
  if (!placed) return false;
  if (k + 1 < radius_to_come_.size())
    near_.insert(static_cast<std::int32_t>(placed_.size()), body.centre,
                 body.radius() + radius_to_come_[k + 1] + spacing_);
  placed_.push_back(body);
  return true;
}

template <class Attempt>
bool ShapeInsertion::find(std::int64_t most, std::size_t draws, const Attempt& attempt, ShapeBody& body) {
  const auto found = random_.first_good(most, draws, shape_tries_at_once, [&](Draws next) {
    ShapeBody tried = body;
    return attempt(next, tried);
  });
  return found && attempt(*found, body);
}

Vec3d ShapeInsertion::point(Draws& draws, const Vec3d& from, const Vec3d& to) {
  const double x = draws.uniform(from.x, to.x), y = draws.uniform(from.y, to.y);
  return Vec3d{x, y, draws.uniform(from.z, to.z)};
}

bool ShapeInsertion::inside(const ShapeBody& body, const Extent& e) const {
  const Vec3d c = body.centre, low = -e.low, high = box_.size - e.high;
  if (!(c.x >= low.x && c.x <= high.x && c.y >= low.y && c.y <= high.y && c.z >= low.z && c.z <= high.z)) return false;
  if (box_.inside_sides(c, body.radius())) return true;
  if (body.sphere) return false;
  const auto& points = body.geometry->shape.surface.points;
  return std::all_of(points.begin(), points.end(),
                     [&](const Vec3d& p) { return box_.inside_sides(body.to_space(p), 0); });
}

/// Tests only whether the body's inner ball (a ball inside the body, see ShapeBody::inner_radius()) comes too close to
/// a placed body. Most trials fail, and this fast test detects most of the failures.
bool ShapeInsertion::clear_at_centre(const ShapeBody& body) const {
  const std::vector<std::int32_t>& near = near_.near(near_.cell_of(body.centre));
  return std::none_of(near.begin(), near.end(), [&](std::int32_t j) {
    const Vec3d d = placed_[j].centre - body.centre;
    const double far = placed_[j].radius() + body.inner_radius();
    return dot(d, d) < far * far && placed_[j].distance_at_most(body.centre) < body.inner_radius();
  });
}

bool ShapeInsertion::clear(const ShapeBody& body) const {
  if (!clear_at_centre(body)) return false;
  const std::vector<std::int32_t>& near = near_.near(near_.cell_of(body.centre));
  return std::none_of(near.begin(), near.end(), [&](std::int32_t j) { return nearer(placed_[j], body, spacing_); });
}

/// Updates room_ for the bodies placed since the last call. Only cells near such a body are updated. In cells farther
/// away the body leaves room for the inner ball of every body that is still to be placed.
void ShapeInsertion::measure_room(std::size_t k) {
  if (room_.empty()) {
    room_.resize(grid_.cells());
    for (std::size_t cell = 0; cell < room_.size(); ++cell) room_[cell] = -box_.signed_distance(middle(cell));
  }
  for_each_in_parallel(grid_.layers(), [&](std::size_t layer) {
    for (std::size_t j = measured_; j < placed_.size(); ++j) {
      const double reach = placed_[j].radius() + inner_to_come_[k];
      grid_.within(placed_[j].centre, reach, layer, [&](std::size_t cell) {
        room_[cell] = std::min(room_[cell], placed_[j].distance_at_most(middle(cell)));
      });
    }
  });
  measured_ = placed_.size();
}

std::vector<std::size_t> ShapeInsertion::open_cells(std::size_t k, double inner_radius) {
  measure_room(k);
  // The distance from any point of a cell to the nearest body is at most room_, which is measured at the cell's middle,
  // plus half of the cell's diagonal.
  const double least = inner_radius - norm(grid_.edge()) / 2;
  std::vector<std::size_t> open;
  for (std::size_t cell = 0; cell < room_.size(); ++cell)
    if (!(room_[cell] < least)) open.push_back(cell);
  return open;
}

}  // namespace macadam
