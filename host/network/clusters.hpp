// SPDX-License-Identifier: GPL-3.0-or-later
/// \file clusters.hpp  Which particles hang together, and on which walls.
#pragma once

#include <map>
#include <vector>

#include "macadam/contact_network.hpp"

namespace macadam {

/// Particles joined by contacts, and the walls that they touch.
struct Cluster {
  std::vector<std::int32_t> particles;  ///< ascending
  bool bottom = false, top = false;
  bool spans() const { return bottom && top; }
};

/// All clusters, by their smallest particle number.
std::vector<Cluster> find_clusters(const ContactNetwork& network, std::size_t particles);

/// "a cluster of 12 particles (3, 7, …) that does not touch the top wall"
std::string describe(const Cluster& cluster);

}  // namespace macadam
