// SPDX-License-Identifier: GPL-3.0-or-later
// clusters.cpp  Finds clusters by union–find over the contacts between particles.
#include "host/network/clusters.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "host/base/disjoint_sets.hpp"

namespace macadam {

std::vector<Cluster> find_clusters(const ContactNetwork& network, std::size_t particles) {
  DisjointSets sets(particles);
  for (const Contact& c : network.contacts) {
    if (c.b >= 0) sets.join(c.a, c.b);
  }
  std::map<std::int32_t, Cluster> found;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(particles); ++i) found[sets.find(i)].particles.push_back(i);
  for (const Contact& c : network.contacts) {
    if (c.b == wall_z_lo) found[sets.find(c.a)].bottom = true;
    if (c.b == wall_z_hi) found[sets.find(c.a)].top = true;
  }
  std::vector<Cluster> out;
  for (auto& [root, cluster] : found) out.push_back(std::move(cluster));
  return out;
}

std::string describe(const Cluster& cluster) {
  std::string numbers;
  for (std::size_t i = 0; i < std::min<std::size_t>(cluster.particles.size(), 10); ++i) {
    numbers += (i > 0 ? ", " : "") + std::to_string(cluster.particles[i]);
  }
  if (cluster.particles.size() > 10) numbers += ", …";
  return "a cluster of " + std::to_string(cluster.particles.size()) + " particles (" + numbers +
         ") that does not touch the " + (cluster.bottom ? "top" : "bottom") + " wall";
}

}  // namespace macadam
