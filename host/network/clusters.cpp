// SPDX-License-Identifier: GPL-3.0-or-later
// clusters.cpp  Finds clusters by union–find over the contacts between particles.
#include "host/network/clusters.hpp"

#include <algorithm>
#include <numeric>
#include <string>

namespace macadam {

std::vector<Cluster> find_clusters(const ContactNetwork& network, std::size_t particles) {
  std::vector<std::int32_t> parent(particles);
  std::iota(parent.begin(), parent.end(), 0);
  auto root = [&](std::int32_t i) {
    auto at = [&](std::int32_t k) -> std::int32_t& { return parent[static_cast<std::size_t>(k)]; };
    while (at(i) != i) i = at(i) = at(at(i));
    return i;
  };
  for (const Contact& c : network.contacts) {
    if (c.b < 0) continue;
    const std::int32_t a = root(c.a), b = root(c.b);
    // The root of a cluster is its smallest number.
    parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  std::map<std::int32_t, Cluster> found;
  for (std::size_t i = 0; i < particles; ++i) {
    found[root(static_cast<std::int32_t>(i))].particles.push_back(static_cast<std::int32_t>(i));
  }
  for (const Contact& c : network.contacts) {
    if (c.b == wall_z_lo) found[root(c.a)].bottom = true;
    if (c.b == wall_z_hi) found[root(c.a)].top = true;
  }
  std::vector<Cluster> out;
  for (auto& [number, cluster] : found) out.push_back(std::move(cluster));
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
