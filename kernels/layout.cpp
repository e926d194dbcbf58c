// SPDX-License-Identifier: GPL-3.0-or-later
// layout.cpp  Recursive bisection of the particles into tiles; contacts into groups and packets.
#include "kernels/layout.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

namespace macadam::kernels {
namespace {

double along(const Vec3d& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Orders `ids` by recursive bisection along the longest extent into `tiles` runs of equal weight, then on within each.
class Bisection {
 public:
  Bisection(const std::vector<Vec3d>& centre, const std::vector<double>& weight, std::vector<std::int32_t>& tile_body)
      : centre_(centre), weight_(weight), tile_body_(tile_body) {}

  /// At least one particle a tile: ids.size() ≥ tiles.
  void split(std::span<std::int32_t> ids, std::size_t first, std::size_t tiles) {
    if (tiles == 1) {
      tile_body_.push_back(static_cast<std::int32_t>(first));
      order(ids);
      return;
    }
    const int axis = longest_axis(ids);
    std::sort(ids.begin(), ids.end(), Before{*this, axis});
    const std::size_t left = tiles / 2, right = tiles - left;
    const std::size_t cut = std::clamp(weighted_cut(ids, double(left) / double(tiles)), left, ids.size() - right);
    split(ids.first(cut), first, left);
    split(ids.subspan(cut), first + cut, right);
  }

 private:
  /// Along one axis; the particle's number breaks ties, so that the order does not depend on the sort.
  struct Before {
    const Bisection& bisection;
    int axis;
    bool operator()(std::int32_t i, std::int32_t j) const {
      return std::make_pair(bisection.at(i, axis), i) < std::make_pair(bisection.at(j, axis), j);
    }
  };

  void order(std::span<std::int32_t> ids) {
    if (ids.size() <= 2) return;
    const int axis = longest_axis(ids);
    const std::size_t cut = ids.size() / 2;
    std::nth_element(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(cut), ids.end(), Before{*this, axis});
    order(ids.first(cut));
    order(ids.subspan(cut));
  }
  double at(std::int32_t i, int axis) const { return along(centre_[static_cast<std::size_t>(i)], axis); }
  int longest_axis(std::span<const std::int32_t> ids) const {
    int best = 0;
    double longest = -1;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [lo, hi] = std::minmax_element(
          ids.begin(), ids.end(), [&](std::int32_t i, std::int32_t j) { return at(i, axis) < at(j, axis); });
      if (at(*hi, axis) - at(*lo, axis) > longest) longest = at(*hi, axis) - at(*lo, axis), best = axis;
    }
    return best;
  }
  std::size_t weighted_cut(std::span<const std::int32_t> ids, double share) const {
    double total = 0, sum = 0;
    for (const auto i : ids) total += weight_[static_cast<std::size_t>(i)];
    std::size_t cut = 0;
    while (cut < ids.size() && sum < share * total) sum += weight_[static_cast<std::size_t>(ids[cut++])];
    return cut;
  }

  const std::vector<Vec3d>& centre_;
  const std::vector<double>& weight_;
  std::vector<std::int32_t>& tile_body_;
};

/// Fills one group: sorts its contacts by (tile, points, body) and pads every tile's run to whole packets.
GroupLayout make_group(const ContactNetwork& network, const Layout& layout, const std::vector<std::int32_t>& tile_of,
                       PairType pair) {
  using Key = std::tuple<std::int32_t, std::uint32_t, std::int32_t, std::int32_t, std::uint32_t>;
  std::vector<Key> keys;
  for (std::uint32_t c = 0; c < network.contacts.size(); ++c) {
    const Contact& contact = network.contacts[c];
    if (contact.pair != pair) continue;
    const std::int32_t a = layout.body_of(contact.a), b = layout.body_of(contact.b);
    const std::int32_t low = std::min(a, b);  // a wall is never the lower body
    keys.emplace_back(tile_of[static_cast<std::size_t>(low)], contact.point_end - contact.point_begin, low,
                      std::max(a, b), c);
  }
  std::sort(keys.begin(), keys.end());

  GroupLayout group;
  group.pair = pair;
  const auto lanes = static_cast<std::size_t>(layout.lanes);
  std::size_t k = 0;
  std::uint32_t row = 0;
  for (std::size_t tile = 0; tile < layout.tiles(); ++tile) {
    group.tile_packet.push_back(static_cast<std::uint32_t>(group.contact.size() / lanes));
    for (; k < keys.size() && std::get<0>(keys[k]) == static_cast<std::int32_t>(tile); ++k) {
      group.contact.push_back(std::get<4>(keys[k]));
    }
    while (group.contact.size() % lanes != 0) group.contact.push_back(inert);
  }
  group.tile_packet.push_back(static_cast<std::uint32_t>(group.contact.size() / lanes));
  for (std::size_t packet = 0; packet < group.packets(); ++packet) {
    group.packet_row.push_back(row);
    std::uint32_t most = 0;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::uint32_t c = group.contact[packet * lanes + lane];
      if (c != inert) most = std::max(most, network.contacts[c].point_end - network.contacts[c].point_begin);
    }
    row += most;
  }
  group.packet_row.push_back(row);
  return group;
}

}  // namespace

Layout make_layout(const Specimen& specimen, const ContactNetwork& network, int lanes, std::size_t tile_contacts) {
  Layout layout;
  layout.lanes = lanes;
  const std::size_t n = specimen.size();
  std::vector<double> weight(n, 1.0);
  for (std::size_t i = 0; i < n; ++i) weight[i] += static_cast<double>(network.row(i).size());
  layout.particle.resize(n);
  std::iota(layout.particle.begin(), layout.particle.end(), 0);
  const std::size_t tiles =
      std::clamp<std::size_t>(network.contacts.size() / std::max<std::size_t>(tile_contacts, 1), 1, n);
  Bisection(specimen.centre, weight, layout.tile_body).split(layout.particle, 0, tiles);
  layout.tile_body.push_back(static_cast<std::int32_t>(n));

  layout.body.resize(n);
  std::vector<std::int32_t> tile_of(n);
  for (std::size_t tile = 0; tile < layout.tiles(); ++tile) {
    for (auto b = layout.tile_body[tile]; b < layout.tile_body[tile + 1]; ++b) {
      layout.body[static_cast<std::size_t>(layout.particle[static_cast<std::size_t>(b)])] = b;
      tile_of[static_cast<std::size_t>(b)] = static_cast<std::int32_t>(tile);
    }
  }
  for (int pair = 0; pair < pair_types; ++pair) {
    if (network.count[static_cast<std::size_t>(pair)] > 0) {
      layout.groups.push_back(make_group(network, layout, tile_of, static_cast<PairType>(pair)));
    }
  }
  return layout;
}

}  // namespace macadam::kernels
