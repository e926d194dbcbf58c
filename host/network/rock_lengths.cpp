// SPDX-License-Identifier: GPL-3.0-or-later
// rock_lengths.cpp  Intersects lines of centres with balls and triangulated surfaces. The points where a line crosses a
// surface divide it into intervals. Whether an interval is in rock is decided at its middle, so touching surfaces,
// edges and corners need no cases of their own.
#include "host/network/rock_lengths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "host/shapes/surface/shape_solid.hpp"
#include "host/spheres/sphere_grid.hpp"
#include "kernels/base/parallel.hpp"

namespace macadam {
namespace rock_surfaces {  // named, because a member of RockSurfaces has some of these types

/// Smallest and largest length of the mastic, as a fraction of the distance, and smallest thickness of a film between
/// two aggregates (section 25 of docs/model/contacts.md).
constexpr double least_mastic = 0.05, most_mastic = 0.95, least_film = 1e-9;
/// Intervals of a line that are shorter than this fraction of it are not looked at.
constexpr double least_interval = 1e-13;
/// Number of contacts, and of particles, that one thread takes at a time.
constexpr std::size_t piece = 1 << 11;

/// An interval of a segment, as fractions of its length.
using Interval = std::pair<double, double>;

/// Lists that a query fills; a thread keeps them from one query to the next.
struct Scratch {
  std::vector<std::int32_t> near;
  std::vector<double> crossing;
  std::vector<Interval> inside;
};

/// Returns the total length of intervals, whose parts in several intervals count once. Sorts them.
double length_of_union(std::vector<Interval>& intervals) {
  std::sort(intervals.begin(), intervals.end());
  double sum = 0, end = 0;
  for (const auto& [from, to] : intervals) {
    sum += std::max(0.0, to - std::max(from, end));
    end = std::max(end, to);
  }
  return std::min(sum, 1.0);
}

/// Applies the inverse of a pose.
Vec3d back(const Pose& pose, const Vec3d& point) {
  const auto& q = pose.turn;
  return Pose{{}, {q[0], -q[1], -q[2], -q[3]}, 1 / pose.scale}(point - pose.centre);
}

/// A surface of the library with its search tree.
struct Template {
  explicit Template(const Surface& surface) : solid(surface) {
    for (const Vec3d& p : surface.points) radius = std::max(radius, norm(p));
  }
  ShapeSolid solid;
  double radius = 0;  ///< of the ball about the origin that contains the surface
};

/// A ball, or the surface of an aggregate in a ball.
struct Body {
  Vec3d centre;
  double radius = 0;
  const Template* surface = nullptr;  ///< null for a ball
  Pose pose;
};

/// Returns the interval of the segment from p to q in a ball, if it has a length.
std::optional<Interval> in_ball(const Vec3d& p, const Vec3d& q, const Vec3d& centre, double radius) {
  const Vec3d along = q - p, from = centre - p;
  const double square = dot(along, along), middle = dot(from, along) / square;
  const Vec3d off = from - middle * along;
  const double half_square = radius * radius - dot(off, off);
  if (!(half_square > 0)) return {};
  const double half = std::sqrt(half_square / square);
  const Interval out{std::max(0.0, middle - half), std::min(1.0, middle + half)};
  if (!(out.first < out.second)) return {};
  return out;
}

/// Adds the intervals of the segment from p to q that lie in a body.
void add_inside(const Body& body, const Vec3d& p, const Vec3d& q, Scratch& scratch) {
  const auto ball = in_ball(p, q, body.centre, body.radius);
  if (!ball) return;
  if (!body.surface) {
    scratch.inside.push_back(*ball);
    return;
  }
  const Vec3d a = back(body.pose, p), b = back(body.pose, q);
  std::vector<double>& at = scratch.crossing;
  at.clear();
  body.surface->solid.crossings(a, b, at);
  at.push_back(0), at.push_back(1);
  std::sort(at.begin(), at.end());
  for (std::size_t k = 1; k < at.size(); ++k) {
    if (!(at[k] - at[k - 1] > least_interval)) continue;
    const double middle = 0.5 * (at[k - 1] + at[k]);
    if (body.surface->solid.contains(a + middle * (b - a))) scratch.inside.emplace_back(at[k - 1], at[k]);
  }
}

/// Returns the edge of the grid's cells: about the distance of two neighbouring particles.
double cell_of(const Specimen& specimen) {
  return std::cbrt(specimen.box.volume() / static_cast<double>(std::max<std::size_t>(1, specimen.size())));
}

/// Returns the largest of the edges of a grid's cells.
double longest_edge(const SphereGrid& grid) { return std::max({grid.edge().x, grid.edge().y, grid.edge().z}); }

}  // namespace rock_surfaces

using namespace rock_surfaces;

struct RockSurfaces::Bodies {
  std::vector<std::unique_ptr<const Template>> templates;  ///< as the surfaces; null for those that nothing uses
  std::vector<Body> bodies;
  SphereGrid grid;
  double step;  ///< length of the parts of a segment for each of which one cell of the grid is looked up

  explicit Bodies(const Specimen& specimen) : grid(specimen.box, cell_of(specimen)), step(longest_edge(grid)) {}

  void add(const Body& body) {
    grid.insert(static_cast<std::int32_t>(bodies.size()), body.centre, body.radius + 0.5 * step);
    bodies.push_back(body);
  }

  /// Lists the bodies whose balls come near the segment from p to q, each once, in rising order.
  void find_near(const Vec3d& p, const Vec3d& q, std::vector<std::int32_t>& near) const {
    near.clear();
    const double parts = std::max(1.0, std::ceil(norm(q - p) / step));
    for (double k = 0; k < parts; ++k) {
      const auto& list = grid.near(grid.cell_of(p + ((k + 0.5) / parts) * (q - p)));
      near.insert(near.end(), list.begin(), list.end());
    }
    if (parts > 1) {
      std::sort(near.begin(), near.end());
      near.erase(std::unique(near.begin(), near.end()), near.end());
    }
  }

  double fraction_inside(const Vec3d& p, const Vec3d& q, Scratch& scratch) const {
    find_near(p, q, scratch.near);
    scratch.inside.clear();
    for (const std::int32_t k : scratch.near) add_inside(bodies[static_cast<std::size_t>(k)], p, q, scratch);
    return length_of_union(scratch.inside);
  }
};

RockSurfaces::~RockSurfaces() = default;
RockSurfaces::RockSurfaces(RockSurfaces&&) noexcept = default;

RockSurfaces::RockSurfaces(const Specimen& specimen, std::span<const Aggregate> aggregates,
                           std::span<const Surface> surfaces) {
  auto out = std::make_unique<Bodies>(specimen);
  std::unordered_map<std::int32_t, std::size_t> spheres;  // number of spheres of each body
  for (std::size_t i = 0; i < specimen.size(); ++i)
    if (specimen.phase[i] == Phase::aggregate) ++spheres[specimen.body[i]];

  // The spheres of a body in `known` are not used, because its surface is.
  std::unordered_map<std::int32_t, bool> known;
  std::vector<const Aggregate*> used;
  std::vector<char> wanted(surfaces.size());
  for (const Aggregate& a : aggregates) {
    const auto own = spheres.find(a.body);
    const bool shaped = a.surface >= 0 && static_cast<std::size_t>(a.surface) < surfaces.size();
    if (own == spheres.end() || (!shaped && (a.surface >= 0 || own->second == 1 || !(a.size > 0)))) continue;
    if (!known.emplace(a.body, true).second) continue;
    used.push_back(&a);
    if (shaped) wanted[static_cast<std::size_t>(a.surface)] = 1;
  }
  out->templates.resize(surfaces.size());
  for_each_in_parallel(surfaces.size(), [&](std::size_t k) {
    if (wanted[k]) out->templates[k] = std::make_unique<const Template>(surfaces[k]);
  });
  for (const Aggregate* a : used) {
    const Template* surface = a->surface >= 0 ? out->templates[static_cast<std::size_t>(a->surface)].get() : nullptr;
    if (surface)
      out->add({a->pose.centre, surface->radius * a->pose.scale * (1 + 1e-12), surface, a->pose});
    else
      out->add({a->centre, a->size / 2, nullptr, {}});
  }
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    if (specimen.phase[i] == Phase::aggregate && !known.contains(specimen.body[i]))
      out->add({specimen.centre[i], specimen.radius[i], nullptr, {}});
  }
  bodies_ = std::move(out);
}

double RockSurfaces::fraction_inside(const Vec3d& p, const Vec3d& q) const {
  thread_local Scratch scratch;
  return bodies_->fraction_inside(p, q, scratch);
}

bool RockSurfaces::contains(const Vec3d& point) const {
  const auto& near = bodies_->grid.near(bodies_->grid.cell_of(point));
  return std::any_of(near.begin(), near.end(), [&](std::int32_t k) {
    const Body& body = bodies_->bodies[static_cast<std::size_t>(k)];
    const Vec3d off = point - body.centre;
    if (dot(off, off) > body.radius * body.radius) return false;
    return !body.surface || body.surface->solid.contains(back(body.pose, point));
  });
}

std::vector<double> rock_lengths(const ContactNetwork& network, const Specimen& specimen, const RockSurfaces& rock) {
  const std::size_t n = network.contacts.size();
  std::vector<double> out(n);
  for_each_in_parallel((n + piece - 1) / piece, [&](std::size_t part) {
    for (std::size_t k = part * piece; k < std::min(n, (part + 1) * piece); ++k) {
      const Contact& c = network.contacts[k];
      const Vec3d& p = specimen.centre[static_cast<std::size_t>(c.a)];
      const Vec3d q = c.b >= 0 ? specimen.centre[static_cast<std::size_t>(c.b)] : p + c.distance * c.n;
      out[k] = c.distance * rock.fraction_inside(p, q);
    }
  });
  return out;
}

void apply_series(ContactNetwork& network, const Specimen& specimen, const RockSurfaces& rock, double rock_modulus,
                  double mastic_poisson_ratio) {
  const std::vector<double> in_rock = rock_lengths(network, specimen, rock);
  const double nu = mastic_poisson_ratio;
  // λ + 2μ = E·(1 − ν)/((1 + ν)(1 − 2ν)), so a film of thickness g resists opening like a bar of length g·opening.
  const double opening = (1 + nu) * (1 - 2 * nu) / (1 - nu);
  for (std::size_t k = 0; k < network.contacts.size(); ++k) {
    Contact& c = network.contacts[k];
    const double d = c.distance, outside = d - in_rock[k];
    double mastic = d;  // length of the line in mastic
    c.length = d, c.series = 0;
    if (c.pair == PairType::inner || c.pair == PairType::aw) continue;
    if (c.pair == PairType::aa) {
      mastic = std::max(outside, least_film * d);
      c.length = mastic * opening;
    } else {
      mastic = std::max(outside, least_mastic * d);
      if (c.pair == PairType::ma) mastic = std::min(mastic, most_mastic * d);
      c.length = mastic;
    }
    if (mastic < d) c.series = (d - mastic) / (c.length * rock_modulus);
  }
  network.rule = ContactRule::series;
  network.rock_modulus = rock_modulus, network.mastic_poisson_ratio = mastic_poisson_ratio;
}

std::int64_t mastic_centres_in_rock(const Specimen& specimen, const RockSurfaces& rock) {
  return sum_in_parallel<std::int64_t>(specimen.size(), [&](std::size_t i) -> std::int64_t {
    return specimen.phase[i] == Phase::mastic && rock.contains(specimen.centre[i]) ? 1 : 0;
  });
}

}  // namespace macadam
