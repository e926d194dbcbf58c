// SPDX-License-Identifier: GPL-3.0-or-later
// tile_plan.cpp  Contacts, halo, ranks and slots of every tile.
#include "kernels/tile_plan.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace macadam::kernels {
namespace {

/// A contact that touches a tile.
struct Touch {
  std::int32_t a, b;  ///< bodies
  std::uint32_t group, group_slot, wall_row;
};

class Planner {
 public:
  Planner(const ContactNetwork& network, const Layout& layout) : network_(network), layout_(layout) {
    tile_of_.resize(layout.particles());
    for (std::size_t t = 0; t < layout.tiles(); ++t) {
      for (auto b = layout.tile_body[t]; b < layout.tile_body[t + 1]; ++b) tile_of_[at(b)] = static_cast<int>(t);
    }
  }

  TilePlan plan() {
    find_touches();
    out_.body.resize(layout_.particles());
    out_.row.resize(2 * layout_.particles());
    for (std::size_t t = 0; t < layout_.tiles(); ++t) add_tile(static_cast<int>(t));
    std::vector<std::int32_t> place(layout_.particles());
    for (std::size_t p = 0; p < place.size(); ++p) place[at(out_.body[p])] = static_cast<std::int32_t>(p);
    for (auto& body : out_.halo) body = place[at(body)];
    return std::move(out_);
  }

 private:
  static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
  bool is_wall(std::int32_t body) const { return at(body) >= layout_.particles(); }
  bool owns(int tile, std::int32_t body) const { return !is_wall(body) && tile_of_[at(body)] == tile; }

  /// Contacts in order of their numbers.
  void find_touches() {
    touches_.resize(layout_.tiles());
    std::vector<std::uint32_t> next_row(walls + 1, 0);
    for (const Contact& c : network_.contacts) {
      if (c.b < 0) ++next_row[at(-c.b)];
    }
    std::partial_sum(next_row.begin(), next_row.end(), next_row.begin());
    out_.wall_begin = next_row;
    struct Slot {
      std::uint32_t group, slot;
    };
    std::vector<Slot> slot_of(network_.contacts.size());
    for (std::uint32_t g = 0; g < layout_.groups.size(); ++g) {
      const auto& slots = layout_.groups[g].contact;
      for (std::uint32_t s = 0; s < slots.size(); ++s) {
        if (slots[s] != inert) slot_of[slots[s]] = {g, s};
      }
    }
    for (std::size_t number = 0; number < slot_of.size(); ++number) {
      const Contact& c = network_.contacts[number];
      const Touch touch{layout_.body_of(c.a), layout_.body_of(c.b), slot_of[number].group, slot_of[number].slot,
                        c.b < 0 ? next_row[at(-c.b) - 1]++ : UINT32_MAX};
      const int tile = tile_of_[at(touch.a)];
      touches_[static_cast<std::size_t>(tile)].push_back(touch);
      if (!is_wall(touch.b) && !owns(tile, touch.b)) touches_[at(tile_of_[at(touch.b)])].push_back(touch);
    }
  }

  void add_tile(int t) {
    auto& touches = touches_[static_cast<std::size_t>(t)];
    const auto first = static_cast<std::uint32_t>(layout_.tile_body[static_cast<std::size_t>(t)]);
    const auto bodies = static_cast<std::uint32_t>(layout_.tile_body[static_cast<std::size_t>(t) + 1]) - first;
    Tile tile{
        first, bodies, static_cast<std::uint32_t>(out_.halo.size()), 0, static_cast<std::uint32_t>(out_.packets()), 0,
        0,     0};

    std::vector<std::uint32_t> length(bodies, 0), rank(bodies), order(bodies);
    std::vector<std::int32_t> halo;
    for (const Touch& touch : touches) {
      for (const std::int32_t body : {touch.a, touch.b}) {
        if (owns(t, body))
          ++length[at(body) - first];
        else if (!is_wall(body))
          halo.push_back(body);
      }
    }
    std::sort(halo.begin(), halo.end());
    halo.erase(std::unique(halo.begin(), halo.end()), halo.end());
    tile.halo = static_cast<std::uint32_t>(halo.size());
    out_.halo.insert(out_.halo.end(), halo.begin(), halo.end());

    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](auto i, auto j) { return length[i] > length[j]; });
    std::vector<std::uint32_t> diagonal(TilePlan::longest_short_row, 0);
    for (std::uint32_t r = 0; r < bodies; ++r) {
      const std::uint32_t n = length[order[r]];
      rank[order[r]] = r;
      out_.body[first + r] = static_cast<std::int32_t>(first + order[r]);
      out_.row[2 * (first + r)] = n;
      if (n > TilePlan::longest_short_row) {
        ++tile.long_rows;
        out_.row[2 * (first + r) + 1] = tile.slots;
        tile.slots += n;
      }
    }
    for (std::uint32_t e = 0; e < TilePlan::longest_short_row; ++e) {
      // short ranks r ≥ long_rows have row lengths that fall with r: slot e exists for a run of them
      std::uint32_t run = 0;
      for (std::uint32_t r = tile.long_rows; r < bodies && out_.row[2 * (first + r)] > e; ++r) ++run;
      diagonal[e] = tile.slots - tile.long_rows;
      tile.slots += run;
    }
    out_.diagonal.insert(out_.diagonal.end(), diagonal.begin(), diagonal.end());

    add_contacts(t, tile, touches, halo, rank, diagonal);
    out_.most_bodies = std::max(out_.most_bodies, bodies);
    out_.most_halo = std::max(out_.most_halo, tile.halo);
    out_.most_locals = std::max(out_.most_locals, bodies + tile.halo + walls);
    out_.most_slots = std::max(out_.most_slots, tile.slots);
    out_.most_packets = std::max(out_.most_packets, tile.packets);
    out_.fits = out_.fits && bodies + tile.halo + walls < UINT16_MAX && tile.slots < UINT16_MAX;
    out_.tile.push_back(tile);
    touches = {};
  }

  /// Contacts are sorted by the slot of one of their own ends, so that the lanes of a warp touch neighbouring words of
  /// shared memory: entry e of consecutive ranks.
  void add_contacts(int t, Tile& tile, const std::vector<Touch>& touches, const std::vector<std::int32_t>& halo,
                    const std::vector<std::uint32_t>& rank, const std::vector<std::uint32_t>& diagonal) {
    struct Entry {
      bool shared;
      std::uint32_t entry, rank;
      TileContact contact;
    };
    std::vector<std::uint32_t> filled(tile.bodies, 0);
    const auto local = [&](std::int32_t body) -> std::uint32_t {
      if (is_wall(body)) {
        return tile.bodies + tile.halo + static_cast<std::uint32_t>(at(body) - layout_.particles());
      }
      if (owns(t, body)) return rank[at(body) - tile.first_body];
      return tile.bodies + static_cast<std::uint32_t>(std::lower_bound(halo.begin(), halo.end(), body) - halo.begin());
    };
    const auto fill = [&](std::uint32_t r, std::uint16_t& slot) {
      const std::uint32_t e = filled[r]++;
      slot = static_cast<std::uint16_t>(r < tile.long_rows ? out_.row[2 * (tile.first_body + r) + 1] + e
                                                           : diagonal[e] + r);
      return e;
    };
    std::vector<Entry> entries;
    for (const Touch& touch : touches) {
      const bool own_a = owns(t, touch.a), own_b = owns(t, touch.b);
      TileContact c{touch.group_slot,
                    static_cast<std::uint16_t>(local(touch.a)),
                    static_cast<std::uint16_t>(local(touch.b)),
                    TilePlan::no_slot,
                    TilePlan::no_slot,
                    touch.group,
                    touch.wall_row};
      entries.push_back({!(own_a && own_b) && !is_wall(touch.b), 0, own_a ? c.local_a : c.local_b, c});
      if (own_a) entries.back().entry = fill(c.local_a, entries.back().contact.slot_a);
    }
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (!owns(t, touches[i].b)) continue;
      const std::uint32_t entry = fill(entries[i].contact.local_b, entries[i].contact.slot_b);
      if (!owns(t, touches[i].a)) entries[i].entry = entry;
    }
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& x, const Entry& y) {
      return std::tie(x.shared, x.entry, x.rank) < std::tie(y.shared, y.entry, y.rank);
    });
    for (const Entry& e : entries) out_.contact.push_back(e.contact);
    while (out_.contact.size() % 32 != 0) {
      TileContact none;
      none.slot_a = none.slot_b = TilePlan::no_slot;
      out_.contact.push_back(none);
    }
    tile.packets = static_cast<std::uint32_t>(out_.packets()) - tile.first_packet;
  }

  const ContactNetwork& network_;
  const Layout& layout_;
  std::vector<int> tile_of_;
  std::vector<std::vector<Touch>> touches_;
  TilePlan out_;
};

}  // namespace

TilePlan plan_tiles(const ContactNetwork& network, const Layout& layout) { return Planner(network, layout).plan(); }

}  // namespace macadam::kernels
