// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rock_lengths.hpp  Measures how much of each line of centres lies in rock, and gives contacts their lengths by
/// the rule "series" (docs/model/contacts.md, section 25).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "macadam/contact_network.hpp"

namespace macadam {

/// The true surfaces of a specimen's aggregates, in a grid. Several threads may run queries at the same time.
///
/// The surface of an aggregate with a pose is its triangulated surface. The surface of an aggregate that is known to be
/// a ball is this ball, whatever spheres fill it. A single sphere, and an aggregate of which nothing is known, has the
/// surfaces of its own spheres.
class RockSurfaces {
 public:
  /// `aggregates` and `surfaces` are those of GeneratedSpecimen; both may be empty. All arguments are copied as far as
  /// they are needed.
  RockSurfaces(const Specimen& specimen, std::span<const Aggregate> aggregates, std::span<const Surface> surfaces);
  ~RockSurfaces();
  RockSurfaces(RockSurfaces&&) noexcept;

  /// Returns the fraction of the segment from p to q that lies in rock, 0 … 1. Parts that lie in several aggregates
  /// count once. A segment that runs along a surface or touches it is in rock only where it enters the aggregate.
  double fraction_inside(const Vec3d& p, const Vec3d& q) const;

  /// Returns whether a point lies in an aggregate or on its surface.
  bool contains(const Vec3d& point) const;

 private:
  struct Bodies;
  std::unique_ptr<const Bodies> bodies_;
};

/// Returns, for each contact, the length of its line of centres that lies in rock [m]. At a wall the line runs from the
/// centre along the normal to the wall. The bits do not depend on the number of threads.
std::vector<double> rock_lengths(const ContactNetwork& network, const Specimen& specimen, const RockSurfaces& rock);

/// Sets `length` and `series` of all contacts by the rule "series", and `rule` of the network. `rock_modulus` [Pa] may
/// be 0 in a network without aggregates.
void apply_series(ContactNetwork& network, const Specimen& specimen, const RockSurfaces& rock, double rock_modulus,
                  double mastic_poisson_ratio);

/// Returns the number of mastic spheres whose centres lie in aggregates.
std::int64_t mastic_centres_in_rock(const Specimen& specimen, const RockSurfaces& rock);

}  // namespace macadam
