// SPDX-License-Identifier: GPL-3.0-or-later
// tile_plan.cpp  Computes contacts, halo, ranks and load cells of every tile (the particles of one thread block).
// tile_plan.hpp explains these words.
#include "kernels/layout/tile_plan.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

#include "kernels/base/parallel.hpp"

namespace macadam::kernels {
namespace {

/// A contact that touches a tile's particles.
struct Touch {
  std::int32_t a, b;  ///< bodies
  std::uint32_t group, group_slot, wall_contact;
  bool ends_couple;  ///< last contact between the same two bodies
};

using Couple = std::vector<std::uint32_t>;

/// Couples of two contacts, stored as columns (one thread steps the contacts of a column in order), and couples of one
/// contact.
struct Columns {
  static_assert(TilePlan::couple == 2);
  using Column = std::array<std::uint32_t, TilePlan::couple>;
  static constexpr std::uint32_t nobody = UINT32_MAX;
  std::vector<Column> column;
  Couple ones;

  explicit Columns(const std::vector<Couple>& couples) {
    for (const Couple& couple : couples) {
      if (couple.size() == TilePlan::couple)
        column.push_back({couple[0], couple[1]});
      else
        ones.push_back(couple.front());
    }
  }
};

/// The plan of one tile. Places and packets are counted from the beginning of the tile.
struct TilePart {
  Tile tile{};
  std::vector<std::int32_t> body, halo;
  std::vector<std::uint32_t> list, diagonal;
  std::vector<TileContact> contact;
};

/// Makes the plan of all tiles of a layout.
class Planner {
 public:
  Planner(const ContactNetwork& network, const Layout& layout, const std::vector<bool>& begins_share)
      : network_(network), layout_(layout), begins_share_(begins_share), tile_of_(tiles_of(layout)) {}

  /// Plans all tiles in parallel, then joins their plans in order.
  TilePlan plan() {
    find_touches();
    std::vector<TilePart> parts(layout_.tiles());
    for_each_in_parallel(parts.size(), [&](std::size_t t) { make_tile(static_cast<int>(t), parts[t]); });
    for (std::size_t t = 0; t < parts.size(); ++t) add_tile(t, std::exchange(parts[t], {}));
    std::vector<std::int32_t> place(layout_.particles());
    for (std::size_t p = 0; p < out_.body.size(); ++p) {
      if (out_.body[p] >= 0) place[at(out_.body[p])] = static_cast<std::int32_t>(p);
    }
    for (auto& body : out_.halo) body = place[at(body)];
    return std::move(out_);
  }

 private:
  static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
  /// Returns n rounded up to a multiple of `of`.
  static std::size_t whole(std::size_t n, std::size_t of) { return (n + of - 1) / of * of; }
  bool is_wall(std::int32_t body) const { return at(body) >= layout_.particles(); }
  static bool is_halo(const Tile& tile, std::uint32_t local) {
    return local >= tile.bodies && local < tile.bodies + tile.halo;
  }
  bool owns(int tile, std::int32_t body) const { return !is_wall(body) && tile_of_[at(body)] == tile; }

  /// Fills in `touches_`: the contacts that touch each tile, in order of their numbers. Contacts between two tiles
  /// appear in both.
  void find_touches() {
    touches_.resize(layout_.tiles());
    std::vector<std::uint32_t> next_wall_contact(walls + 1, 0);
    for (const Contact& c : network_.contacts) {
      if (c.b < 0) ++next_wall_contact[at(-c.b)];
    }
    std::partial_sum(next_wall_contact.begin(), next_wall_contact.end(), next_wall_contact.begin());
    out_.wall_begin = next_wall_contact;
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
    std::vector<std::uint32_t> of_end_a(layout_.particles(), 0), met(of_end_a.size(), 0);
    for (const Contact& c : network_.contacts) ++of_end_a[at(c.a)];
    for (std::size_t number = 0; number < slot_of.size(); ++number) {
      const Contact& c = network_.contacts[number];
      const std::uint32_t k = met[at(c.a)]++;
      const Touch touch{layout_.body_of(c.a),
                        layout_.body_of(c.b),
                        slot_of[number].group,
                        slot_of[number].slot,
                        c.b < 0 ? next_wall_contact[at(-c.b) - 1]++ : UINT32_MAX,
                        (k + 1) % TilePlan::couple == 0 || k + 1 == of_end_a[at(c.a)]};
      const int tile = tile_of_[at(touch.a)];
      touches_[static_cast<std::size_t>(tile)].push_back(touch);
      if (!is_wall(touch.b) && !owns(tile, touch.b)) touches_[at(tile_of_[at(touch.b)])].push_back(touch);
    }
  }

  /// Appends the plan of tile t to the plan of all tiles. Its places and packets, counted from the beginning of the
  /// tile, then follow those of earlier tiles.
  void add_tile(std::size_t t, const TilePart& part) {
    if (!begins_share_.empty() && begins_share_[t]) {
      out_.contact.resize(whole(out_.packets(), TilePlan::share_packets) * 32);  // inert
      out_.body.resize(whole(out_.body.size(), TilePlan::share_places), -1);
      out_.list.resize(2 * out_.body.size());
    }
    Tile tile = part.tile;
    tile.first_body = static_cast<std::uint32_t>(out_.body.size());
    tile.first_halo = static_cast<std::uint32_t>(out_.halo.size());
    tile.first_packet = static_cast<std::uint32_t>(out_.packets());
    const auto append = [](auto& list, const auto& more) { list.insert(list.end(), more.begin(), more.end()); };
    append(out_.body, part.body);
    append(out_.list, part.list);
    append(out_.diagonal, part.diagonal);
    append(out_.halo, part.halo);
    append(out_.contact, part.contact);
    out_.most_bodies = std::max(out_.most_bodies, tile.bodies);
    out_.most_locals = std::max(out_.most_locals, tile.bodies + tile.halo + walls);
    out_.most_cells = std::max(out_.most_cells, tile.cells);
    out_.fits = out_.fits && tile.bodies + tile.halo + walls < UINT16_MAX && tile.cells < TilePlan::more_of_couple;
    out_.tile.push_back(tile);
  }

  /// Plans one tile: halo, ranks and load lists of its particles, then its contacts.
  void make_tile(int t, TilePart& part) {
    auto& touches = touches_[at(t)];
    const auto first = static_cast<std::uint32_t>(layout_.tile_body[at(t)]);
    const auto bodies = static_cast<std::uint32_t>(layout_.tile_body[at(t) + 1]) - first;
    Tile& tile = part.tile;
    tile.bodies = bodies;
    part.body.resize(bodies);
    part.list.resize(std::size_t{2} * bodies);

    std::vector<std::uint32_t> length(bodies, 0), rank(bodies), order(bodies);
    std::vector<std::int32_t>& halo = part.halo;
    for (const Touch& touch : touches) {
      for (const std::int32_t body : {touch.a, touch.b}) {
        if (owns(t, body))
          length[at(body) - first] += body == touch.b || touch.ends_couple;
        else if (!is_wall(body))
          halo.push_back(body);
      }
    }
    std::sort(halo.begin(), halo.end());
    halo.erase(std::unique(halo.begin(), halo.end()), halo.end());
    tile.halo = static_cast<std::uint32_t>(halo.size());

    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](auto i, auto j) { return length[i] > length[j]; });
    part.diagonal.assign(TilePlan::longest_short_list, 0);
    for (std::uint32_t r = 0; r < bodies; ++r) {
      const std::uint32_t n = length[order[r]];
      rank[order[r]] = r;
      part.body[r] = static_cast<std::int32_t>(first + order[r]);
      part.list[2 * r] = n;
      if (n > TilePlan::longest_short_list) {
        ++tile.long_lists;
        part.list[2 * r + 1] = tile.cells;
        tile.cells += n;
      }
    }
    for (std::uint32_t e = 0; e < TilePlan::longest_short_list; ++e) {
      // from rank long_lists on, lists become shorter with rising rank, so cell e exists for the first `count` of these
      // ranks
      std::uint32_t count = 0;
      for (std::uint32_t r = tile.long_lists; r < bodies && part.list[2 * r] > e; ++r) ++count;
      part.diagonal[e] = tile.cells - tile.long_lists;
      tile.cells += count;
    }
    add_contacts(t, part, touches, rank);
    touches = {};
  }

  /// Assigns cells to the contacts and sorts them into packets. Couples are sorted by the index e of their cell in its
  /// load list, then by the rank of the list's particle, so that the lanes of a warp access neighbouring words of
  /// shared memory. Couples of two that need no halo come first, so that they can be stepped while velocities of other
  /// tiles are in transit.
  void add_contacts(int t, TilePart& part, const std::vector<Touch>& touches,
                    const std::vector<std::uint32_t>& rank) const {
    Tile& tile = part.tile;
    const std::vector<std::int32_t>& halo = part.halo;
    std::vector<std::uint32_t> filled(tile.bodies, 0);
    const auto local = [&](std::int32_t body) -> std::uint32_t {
      if (is_wall(body)) {
        return tile.bodies + tile.halo + static_cast<std::uint32_t>(at(body) - layout_.particles());
      }
      if (owns(t, body)) return rank[at(body - layout_.tile_body[at(t)])];
      return tile.bodies + static_cast<std::uint32_t>(std::lower_bound(halo.begin(), halo.end(), body) - halo.begin());
    };
    const auto fill = [&](std::uint32_t r, std::uint16_t& cell) {
      const std::uint32_t e = filled[r]++;
      cell = static_cast<std::uint16_t>(r < tile.long_lists ? part.list[2 * r + 1] + e : part.diagonal[e] + r);
      return e;
    };
    using Entry = std::tuple<std::uint32_t, std::uint32_t, Couple>;  // entry, rank, contacts
    std::vector<Entry> entries;
    std::vector<TileContact> contacts;
    std::vector<Couple> begun(tile.bodies);
    for (const Touch& touch : touches) {
      const auto number = static_cast<std::uint32_t>(contacts.size());
      TileContact& c = contacts.emplace_back(TileContact{touch.group_slot, static_cast<std::uint16_t>(local(touch.a)),
                                                         static_cast<std::uint16_t>(local(touch.b)), TilePlan::no_cell,
                                                         TilePlan::no_cell, touch.group, touch.wall_contact});
      if (!owns(t, touch.a)) continue;
      auto& couple = begun[c.local_a];
      couple.push_back(number);
      c.cell_a = TilePlan::more_of_couple;
      if (touch.ends_couple) entries.emplace_back(fill(c.local_a, c.cell_a), c.local_a, std::exchange(couple, {}));
    }
    for (std::uint32_t i = 0; i < contacts.size(); ++i) {
      TileContact& c = contacts[i];
      if (!owns(t, touches[i].b)) continue;
      const std::uint32_t entry = fill(c.local_b, c.cell_b);
      if (!owns(t, touches[i].a)) entries.emplace_back(entry, c.local_b, std::vector{i});
    }
    std::sort(entries.begin(), entries.end());
    std::vector<Couple> inner, outer;
    for (auto& [entry, r, couple] : entries) {
      const bool waits = std::any_of(couple.begin(), couple.end(), [&](std::uint32_t number) {
        const TileContact& c = contacts[number];
        return is_halo(tile, c.local_a) || is_halo(tile, c.local_b);
      });
      (waits ? outer : inner).push_back(std::move(couple));
    }
    Columns columns(inner);
    tile.inner = static_cast<std::uint32_t>(columns.column.size() / 32);
    for (const std::uint32_t number : columns.ones) outer.push_back({number});
    const Columns others(outer);
    columns.column.insert(columns.column.end(), others.column.begin(), others.column.end());
    tile.double_packets = static_cast<std::uint32_t>((columns.column.size() + 31) / 32);
    TileContact none;
    none.cell_a = none.cell_b = TilePlan::no_cell;
    const auto add = [&](std::uint32_t number) {
      part.contact.push_back(number == Columns::nobody ? none : contacts[number]);
    };
    columns.column.resize(std::size_t{32} * tile.double_packets, {Columns::nobody, Columns::nobody});
    for (std::size_t first = 0; first < columns.column.size(); first += 32) {
      for (std::size_t place = 0; place < TilePlan::couple; ++place) {
        for (std::size_t lane = 0; lane < 32; ++lane) add(columns.column[first + lane][place]);
      }
    }
    for (const std::uint32_t number : others.ones) add(number);
    while (part.contact.size() % 32 != 0) add(Columns::nobody);
    tile.packets = static_cast<std::uint32_t>(part.contact.size() / 32);
  }

  const ContactNetwork& network_;
  const Layout& layout_;
  const std::vector<bool>& begins_share_;
  std::vector<std::int32_t> tile_of_;
  std::vector<std::vector<Touch>> touches_;
  TilePlan out_;
};

}  // namespace

TilePlan plan_tiles(const ContactNetwork& network, const Layout& layout, const std::vector<bool>& begins_share) {
  return Planner(network, layout, begins_share).plan();
}

}  // namespace macadam::kernels
