// SPDX-License-Identifier: GPL-3.0-or-later
/// \file clusters.hpp  Finds clusters of particles connected by contacts, and the walls that each cluster touches.
#pragma once

#include <string>
#include <vector>

#include "macadam/contact_network.hpp"

namespace macadam {

/// Particles connected by contacts, and whether they touch the bottom and the top wall.
struct Cluster {
  std::vector<std::int32_t> particles;  ///< ascending
  bool bottom = false, top = false;
  /// Returns whether the cluster connects the bottom and the top wall.
  bool spans() const { return bottom && top; }
};

/// Returns all clusters, ordered by their smallest particle number. `particles` is the number of particles.
std::vector<Cluster> find_clusters(const ContactNetwork& network, std::size_t particles);

/// Returns for example "a cluster of 12 particles (3, 7, …) that does not touch the top wall".
std::string describe(const Cluster& cluster);

}  // namespace macadam
