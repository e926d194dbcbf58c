// SPDX-License-Identifier: GPL-3.0-or-later
// layout.cpp  Orders particles into tiles by recursive bisection, and contacts into groups and packets.
#include "kernels/layout/layout.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <tuple>

#include "kernels/base/aligned.hpp"

namespace macadam::kernels {
namespace {

double along(const Vec3d& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// A particle while it is being sorted.
struct Item {
  Vec3d centre;
  std::int32_t particle;
};

/// Splits the particles along their longest extent into two ranges, recursively, until there are `tiles` ranges of
/// about equal weight. Then orders the particles within each tile in the same way. The two ranges of a split are
/// independent, so the order does not depend on which thread sorts which range.
class Bisection {
 public:
  /// Without weights all particles count the same. `tile_body`: [tiles], receives the first body of each tile.
  Bisection(const std::vector<double>& weight, std::vector<std::int32_t>& tile_body)
      : weight_(weight), tile_body_(tile_body) {}

  void run(std::span<Item> items) {
#pragma omp parallel
#pragma omp single
    split(items, 0, 0, tile_body_.size());
  }

 private:
  /// Splits the items into `tiles` ranges. Requires items.size() ≥ tiles, so that every tile receives at least one
  /// particle.
  void split(std::span<Item> items, std::size_t first, std::size_t tile, std::size_t tiles) {
    if (tiles == 1) {
      tile_body_[tile] = static_cast<std::int32_t>(first);
      order(items);
      return;
    }
    const int axis = longest_axis(items);
    const std::size_t left = tiles / 2, right = tiles - left;
    const std::size_t cut = std::clamp(cut_at(items, axis, left, tiles), left, items.size() - right);
#pragma omp task if (items.size() > few)
    split(items.first(cut), first, tile, left);
    split(items.subspan(cut), first + cut, tile + left, right);
  }

  /// Orders the items of a tile by further bisection, down to pairs.
  void order(std::span<Item> items) {
    if (items.size() <= 2) return;
    const int axis = longest_axis(items);
    const std::size_t cut = items.size() / 2;
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(cut), items.end(), Before{axis});
    order(items.first(cut));
    order(items.subspan(cut));
  }

  /// Partitions the items along `axis` and returns the position of the cut. The items before the cut have the fraction
  /// left/whole of the total weight. Halves the range that contains the cut until it is short, and sorts only this
  /// range, because sorting all items would take longer.
  std::size_t cut_at(std::span<Item> items, int axis, std::size_t left, std::size_t whole) {
    const double share = static_cast<double>(left) / static_cast<double>(whole);
    if (weight_.empty()) {
      const auto cut = static_cast<std::size_t>(share * static_cast<double>(items.size()));
      std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(cut), items.end(), Before{axis});
      return cut;
    }
    const auto at = [&](std::size_t k) { return items.begin() + static_cast<std::ptrdiff_t>(k); };
    const double before = share * weight(items);
    double sum = 0;
    std::size_t low = 0, high = items.size();  // the cut is between them; the items before `low` weigh `sum`
    constexpr std::size_t short_enough = 32;
    while (high - low > short_enough) {
      const std::size_t middle = (low + high) / 2;
      std::nth_element(at(low), at(middle), at(high), Before{axis});
      const double half = weight(items.subspan(low, middle - low));
      if (sum + half < before)
        sum += half, low = middle;
      else
        high = middle;
    }
    std::sort(at(low), at(high), Before{axis});
    while (low < high && sum < before) sum += weight(items.subspan(low++, 1));
    return low;
  }
  /// Returns the total weight of some items.
  double weight(std::span<const Item> items) const {
    double sum = 0;
    for (const Item& i : items) sum += weight_[static_cast<std::size_t>(i.particle)];
    return sum;
  }

  /// Compares coordinates along one axis. The particle's number breaks ties, so that the order does not depend on the
  /// sort algorithm.
  struct Before {
    int axis;
    bool operator()(const Item& i, const Item& j) const {
      return std::make_pair(along(i.centre, axis), i.particle) < std::make_pair(along(j.centre, axis), j.particle);
    }
  };
  /// Returns the axis along which the items extend farthest.
  static int longest_axis(std::span<const Item> items) {
    Vec3d low = items.front().centre, high = low;
    for (const Item& i : items) {
      low = {std::min(low.x, i.centre.x), std::min(low.y, i.centre.y), std::min(low.z, i.centre.z)};
      high = {std::max(high.x, i.centre.x), std::max(high.y, i.centre.y), std::max(high.z, i.centre.z)};
    }
    const Vec3d extent = high - low;
    int best = 0;
    for (int axis = 1; axis < 3; ++axis) {
      if (along(extent, axis) > along(extent, best)) best = axis;
    }
    return best;
  }

  static constexpr std::size_t few = 2000;  ///< with fewer particles a task costs more than it saves
  const std::vector<double>& weight_;
  std::vector<std::int32_t>& tile_body_;
};

/// Fills in the particles and tiles of a layout.
void order_particles(const Specimen& specimen, const std::vector<double>& weight, std::size_t tiles, Layout& layout) {
  const std::size_t n = specimen.size();
  RawVector<Item> items(n);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) items[i] = {specimen.centre[i], static_cast<std::int32_t>(i)};
  layout.tile_body.assign(std::clamp<std::size_t>(tiles, 1, n), 0);
  Bisection(weight, layout.tile_body).run(items);
  layout.tile_body.push_back(static_cast<std::int32_t>(n));
  layout.particle.resize(n);
  layout.body.resize(n);
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < n; ++b) {
    layout.particle[b] = items[b].particle;
    layout.body[static_cast<std::size_t>(items[b].particle)] = static_cast<std::int32_t>(b);
  }
}

/// Makes one group: sorts its contacts by (tile, number of points, bodies, number) and pads the contacts of every tile
/// to whole packets. `numbers`: the group's contacts in the network.
GroupLayout make_group(const ContactNetwork& network, const Layout& layout, const std::vector<std::int32_t>& tile_of,
                       PairType pair, const std::vector<std::uint32_t>& numbers) {
  using Key = std::tuple<std::uint32_t, std::int32_t, std::int32_t, std::uint32_t>;  // points, bodies, number
  // A contact belongs to the tile of its lower-numbered body, which is always a particle
  const auto tile_of_contact = [&](const Contact& c) {
    const std::int32_t low = std::min(layout.body_of(c.a), layout.body_of(c.b));
    return static_cast<std::size_t>(tile_of[static_cast<std::size_t>(low)]);
  };
  std::vector<std::size_t> begin(layout.tiles() + 1, 0);
  for (const std::uint32_t number : numbers) ++begin[tile_of_contact(network.contacts[number]) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  RawVector<Key> keys(begin.back());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (const std::uint32_t number : numbers) {
    const Contact& c = network.contacts[number];
    const std::int32_t a = layout.body_of(c.a), b = layout.body_of(c.b);
    keys[next[tile_of_contact(c)]++] = {c.point_end - c.point_begin, std::min(a, b), std::max(a, b), number};
  }
  const auto key_at = [&](std::size_t k) { return keys.begin() + static_cast<std::ptrdiff_t>(k); };
#pragma omp parallel for schedule(dynamic, 16)
  for (std::size_t tile = 0; tile < layout.tiles(); ++tile) std::sort(key_at(begin[tile]), key_at(begin[tile + 1]));

  GroupLayout group;
  group.pair = pair;
  const auto lanes = static_cast<std::size_t>(layout.lanes);
  std::uint32_t layer = 0;
  for (std::size_t tile = 0; tile < layout.tiles(); ++tile) {
    group.tile_packet.push_back(static_cast<std::uint32_t>(group.contact.size() / lanes));
    for (std::size_t k = begin[tile]; k < begin[tile + 1]; ++k) {
      group.contact.push_back(std::get<3>(keys[k]));
      group.points.push_back(std::get<0>(keys[k]));
    }
    while (group.contact.size() % lanes != 0) group.contact.push_back(inert);
    group.points.resize(group.contact.size(), 0);
  }
  group.tile_packet.push_back(static_cast<std::uint32_t>(group.contact.size() / lanes));
  for (std::size_t packet = 0; packet < group.packets(); ++packet) {
    group.packet_layer.push_back(layer);
    const auto first = group.points.begin() + static_cast<std::ptrdiff_t>(packet * lanes);
    layer += *std::max_element(first, first + layout.lanes);
  }
  group.packet_layer.push_back(layer);
  group.series = std::ranges::any_of(numbers, [&](auto number) { return network.contacts[number].series != 0; });
  return group;
}

/// Multiplies each particle's weight by the size of its tile divided by the mean size of the tiles. Size is the number
/// of particles plus the number of contacts that touch them. The next bisection then makes overfull tiles smaller and
/// others larger.
void weigh_by_touched(const ContactNetwork& network, const Layout& layout, const std::vector<std::int32_t>& tile_of,
                      std::vector<double>& weight) {
  std::vector<std::int64_t> touched(layout.tiles());
  for (std::size_t t = 0; t < touched.size(); ++t) touched[t] = layout.tile_body[t + 1] - layout.tile_body[t];
  const auto tile_at = [&](std::int32_t end) {
    return static_cast<std::size_t>(tile_of[static_cast<std::size_t>(layout.body_of(end))]);
  };
#pragma omp parallel
  {
    std::vector<std::int64_t> own(touched.size());
#pragma omp for schedule(static) nowait
    for (const Contact& c : network.contacts) {
      const std::size_t a = tile_at(c.a), b = c.b < 0 ? a : tile_at(c.b);
      ++own[a];
      if (a != b) ++own[b];
    }
#pragma omp critical
    for (std::size_t t = 0; t < own.size(); ++t) touched[t] += own[t];
  }
  const auto all = static_cast<double>(std::accumulate(touched.begin(), touched.end(), std::int64_t{0}));
  const double mean = all / static_cast<double>(touched.size());
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < weight.size(); ++i) {
    weight[i] *= static_cast<double>(touched[tile_at(static_cast<std::int32_t>(i))]) / mean;
  }
}

}  // namespace

std::vector<std::int32_t> tiles_of(const Layout& layout) {
  std::vector<std::int32_t> out(layout.particles());
  for (std::size_t tile = 0; tile < layout.tiles(); ++tile) {
    for (auto b = layout.tile_body[tile]; b < layout.tile_body[tile + 1]; ++b)
      out[static_cast<std::size_t>(b)] = static_cast<std::int32_t>(tile);
  }
  return out;
}

Layout make_order(const Specimen& specimen, std::size_t tiles) {
  Layout layout;
  order_particles(specimen, {}, tiles, layout);
  return layout;
}

Layout make_layout(const Specimen& specimen, const ContactNetwork& network, int lanes, const TileSize& size) {
  Layout layout;
  layout.lanes = lanes;
  const std::size_t n = specimen.size(), tiles = network.contacts.size() / std::max<std::size_t>(size.contacts, 1);
  std::vector<double> weight(n, 1.0);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) weight[i] += static_cast<double>(network.row(i).size());
  std::vector<std::int32_t> tile_of;
  const int rounds = size.even ? 4 : 1;  // tile_plan_test checks the balance after four rounds
  for (int round = 0; round < rounds; ++round) {
    if (round > 0) weigh_by_touched(network, layout, tile_of, weight);
    order_particles(specimen, weight, tiles, layout);
    tile_of = tiles_of(layout);
  }
  std::array<std::vector<std::uint32_t>, pair_types> numbers;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    numbers[pair].reserve(static_cast<std::size_t>(network.count[pair]));
  }
  for (std::uint32_t number = 0; number < network.contacts.size(); ++number) {
    numbers[static_cast<std::size_t>(network.contacts[number].pair)].push_back(number);
  }
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (numbers[pair].empty()) continue;
    layout.groups.push_back(make_group(network, layout, tile_of, static_cast<PairType>(pair), numbers[pair]));
  }
  return layout;
}

}  // namespace macadam::kernels
