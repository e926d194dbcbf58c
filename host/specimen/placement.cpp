// SPDX-License-Identifier: GPL-3.0-or-later
/// \file placement.cpp  Places spheres one after another at random. When few places are left, it samples from a list of
/// cells that still have space.
#include "host/specimen/placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "host/spheres/size_law.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Number of random positions tried before the open cells are listed; listing them takes about the time of this many
/// trials.
constexpr std::int64_t plain_attempts = 20'000;
constexpr std::int64_t tries_at_once = 128;  // number of trials that a thread processes at a time

double squared_distance(const Vec3d& a, const Vec3d& b) {
  const Vec3d d = a - b;
  return dot(d, d);
}

Vec3d random_point(Draws& draws, const Vec3d& low, const Vec3d& high) {
  const double x = draws.uniform(low.x, high.x), y = draws.uniform(low.y, high.y);
  return {x, y, draws.uniform(low.z, high.z)};
}

/// An aggregate to be placed.
struct Waiting {
  std::size_t population, rank;  ///< index of the class, and index in the class's list of radii
  double radius;
};

/// Returns the aggregates of all classes, largest first.
std::vector<Waiting> largest_first(const std::vector<Population>& classes) {
  std::vector<Waiting> all;
  for (std::size_t k = 0; k < classes.size(); ++k)
    for (std::size_t i = 0; i < classes[k].radius.size(); ++i) all.push_back({k, i, classes[k].radius[i]});
  std::stable_sort(all.begin(), all.end(), [](const Waiting& a, const Waiting& b) { return a.radius > b.radius; });
  return all;
}

std::string no_room(const Population& c, std::size_t placed, std::int64_t attempts) {
  double volume = 0, total = 0;
  for (std::size_t i = 0; i < c.radius.size(); ++i) {
    total += sphere_volume(2 * c.radius[i]);
    if (i < placed) volume += sphere_volume(2 * c.radius[i]);
  }
  char text[320];
  std::snprintf(text, sizeof text,
                "no space for aggregate %zu of %zu of class %s (diameter %.4g mm) in %lld attempts: %zu of %zu placed, "
                "%.1f %% of the class's volume; choose less of this class or of coarser classes, a larger box, smaller "
                "sieves, more attempts or another seed",
                placed + 1, c.radius.size(), c.row.name.c_str(), 2e3 * c.radius[placed],
                static_cast<long long>(attempts), placed, c.radius.size(), 100 * volume / total);
  return text;
}

}  // namespace

Placement::Placement(Specimen& specimen, double smallest, std::int64_t attempts, RandomStream random,
                     const Origin& origin, std::function<bool(const Vec3d&)> taken, double largest_void)
    : specimen_(specimen),
      grid_(specimen.box, smallest),
      attempts_(attempts),
      random_(random),
      origin_(origin),
      taken_(std::move(taken)),
      largest_void_(largest_void) {}

std::vector<std::int32_t> Placement::place_aggregates(const std::vector<Population>& classes, double spacing,
                                                      const std::function<void(double share)>& progress) {
  const std::vector<Waiting> all = largest_first(classes);
  std::vector<std::int32_t> size_class;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::optional<Vec3d> centre = position_for(all[k].radius, spacing);
    if (!centre)
      throw RunError(classes[all[k].population].origin.text() +
                     no_room(classes[all[k].population], all[k].rank, attempts_));
    add_aggregate(*centre, all[k].radius, static_cast<std::int32_t>(specimen_.size()), spacing);
    size_class.push_back(static_cast<std::int32_t>(all[k].population));
    if (k % 64 == 0) progress(static_cast<double>(k) / static_cast<double>(all.size()));
  }
  progress(1);
  return size_class;
}

void Placement::add_aggregate(const Vec3d& centre, double radius, std::int32_t body, double spacing) {
  // Later spheres are not larger than this one, except voids. With this reach, this sphere is listed in every cell in
  // which a later sphere could have its centre and be too close to this sphere.
  grid_.insert(static_cast<std::int32_t>(specimen_.size()), centre, radius + std::max(radius, largest_void_) + spacing);
  add(centre, radius, Phase::aggregate, body);
}

void Placement::place_voids(const Population& voids, std::int32_t body) {
  for (std::size_t k = 0; k < voids.radius.size(); ++k) {
    const std::optional<Vec3d> centre = position_for(voids.radius[k], 0);
    if (!centre)
      throw RunError(
          fmt::format("{}no space for void {} of {} (diameter {:.4g} mm) in {} attempts; choose fewer or smaller "
                      "voids, less aggregate or another seed",
                      voids.origin.text(), k + 1, voids.radius.size(), 2e3 * voids.radius[k], attempts_));
    add_aggregate(*centre, voids.radius[k], body++);
  }
}

void Placement::place_mastic(const Population& mastic) {
  if (mastic.radius.empty()) return;
  std::size_t placed = 0;
  const auto place = [&](Draws draws) {
    add(random_point(draws, {0, 0, 0}, domain().size), mastic.radius[placed], Phase::mastic, -1);
    return ++placed < mastic.radius.size();
  };
  // `place` and `free` get the same random numbers, so both compute the same point.
  const auto free = [&](Draws draws) { return free_for_mastic(random_point(draws, {0, 0, 0}, domain().size)); };
  if (!random_.each_good(attempts_, 3, tries_at_once, free, place)) no_room_for_mastic();
}

Vec3d Placement::point_outside_aggregates() {
  const auto free = [&](Draws draws) { return free_for_mastic(random_point(draws, {0, 0, 0}, domain().size)); };
  auto found = random_.first_good(attempts_, 3, tries_at_once, free);
  if (!found) no_room_for_mastic();
  return random_point(*found, {0, 0, 0}, domain().size);
}

void Placement::no_room_for_mastic() const {
  throw RunError(origin_.text() + "no space for mastic outside the aggregates in " + std::to_string(attempts_) +
                 " attempts; choose less aggregate");
}

/// Returns a random centre for a sphere inside the domain, clear of all placed spheres; nothing if all attempts_ trials
/// fail.
std::optional<Vec3d> Placement::position_for(double radius, double spacing) {
  const Vec3d low{radius, radius, radius}, high = domain().size - low;
  const std::int64_t plain = std::min(attempts_, plain_attempts);
  const auto anywhere = [&](Draws draws) {
    const Vec3d point = random_point(draws, low, high);
    return domain().inside_sides(point, radius) && clear_of_placed(point, radius + spacing);
  };
  if (auto found = random_.first_good(plain, 3, tries_at_once, anywhere)) return random_point(*found, low, high);
  if (plain == attempts_) return std::nullopt;
  // Trials are made only in the cells that placed spheres do not cover completely. Successful trials then have the same
  // distribution as successful trials over the whole box, but more trials succeed.
  const std::vector<std::size_t> open = open_cells(radius);
  if (open.empty()) return std::nullopt;
  const auto in_the_open = [&](Draws& draws) {
    const Vec3d corner = grid_.corner(open[draws.index(open.size())]);
    return random_point(draws, corner, corner + grid_.edge());
  };
  const auto free = [&](Draws draws) {
    const Vec3d point = in_the_open(draws);
    const bool inside = point.x >= low.x && point.x <= high.x && point.y >= low.y && point.y <= high.y &&
                        point.z >= low.z && point.z <= high.z;
    return inside && domain().inside_sides(point, radius) && clear_of_placed(point, radius + spacing);
  };
  if (auto found = random_.first_good(attempts_ - plain, 4, tries_at_once, free)) return in_the_open(*found);
  return std::nullopt;
}

bool Placement::free_for_mastic(const Vec3d& point) const {
  return domain().inside_sides(point, 0) && clear_of_placed(point, 0);
}

bool Placement::clear_of_placed(const Vec3d& point, double distance) const {
  for (std::int32_t j : grid_.near(grid_.cell_of(point))) {
    const double least = specimen_.radius[j] + distance;
    if (squared_distance(point, specimen_.centre[j]) < least * least) return false;
  }
  return !(taken_ && taken_(point));
}

/// Returns the cells that may have space for the centre of a sphere of this radius.
std::vector<std::size_t> Placement::open_cells(double radius) const {
  const Vec3d edge = grid_.edge(), size = domain().size;
  std::vector<std::size_t> open;
  for (std::size_t cell = 0; cell < grid_.cells(); ++cell) {
    const Vec3d a = grid_.corner(cell), b = a + edge;
    bool taken = b.x < radius || b.y < radius || b.z < radius || a.x > size.x - radius || a.y > size.y - radius ||
                 a.z > size.z - radius;
    for (std::size_t k = 0; k < grid_.near(cell).size() && !taken; ++k) {
      const std::int32_t j = grid_.near(cell)[k];
      const Vec3d c = specimen_.centre[j];
      const Vec3d farthest{std::max(c.x - a.x, b.x - c.x), std::max(c.y - a.y, b.y - c.y),
                           std::max(c.z - a.z, b.z - c.z)};
      taken = norm(farthest) < specimen_.radius[j] + radius;
    }
    if (!taken) open.push_back(cell);
  }
  return open;
}

void Placement::add(const Vec3d& centre, double radius, Phase phase, std::int32_t body) {
  specimen_.body.push_back(body);
  specimen_.centre.push_back(centre);
  specimen_.radius.push_back(radius);
  specimen_.phase.push_back(phase);
}

}  // namespace macadam
