// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tile_accumulators.hpp  Decides, for the CPU, to which accumulator each contact adds its loads, and which
/// accumulators are summed for a body.
///
/// A tile is a range of neighbouring particles. It has one accumulator for each of its bodies and, after them, one for
/// each body of another tile that its contacts touch (its halo). The load on a body is its own accumulator plus the
/// accumulators of its halo row, in the order of the tiles. So the order of additions depends on the specimen, not on
/// the number of threads.
#pragma once

#include <unordered_map>

#include "kernels/base/aligned.hpp"
#include "kernels/layout/layout.hpp"

namespace macadam::kernels {

/// The accumulators of all tiles. An accumulator is eight words that hold a force and a moment.
struct TileAccumulators {
  std::vector<std::uint32_t> tile_begin;      ///< tile → first accumulator; tiles + 1 entries
  std::vector<std::uint32_t> row_begin, row;  ///< body → its accumulators in other tiles; wall → all its accumulators
  /// Accumulators of the two ends of each slot, one vector per group.
  std::vector<std::vector<std::uint32_t>> end_a, end_b;

  std::size_t size() const { return tile_begin.back(); }

  TileAccumulators(const ContactNetwork& network, const Layout& layout) {
    const std::size_t lanes = static_cast<std::size_t>(layout.lanes);
    std::vector<std::vector<std::uint32_t>> rows(layout.particles() + walls);
    for (const auto& group : layout.groups) {
      end_a.emplace_back(group.contact.size());
      end_b.emplace_back(group.contact.size());
    }
    std::uint32_t next = 0;
    for (std::size_t tile = 0; tile < layout.tiles(); ++tile) {
      tile_begin.push_back(next);
      const std::int32_t first = layout.tile_body[tile], last = layout.tile_body[tile + 1];
      next += static_cast<std::uint32_t>(last - first);
      std::unordered_map<std::int32_t, std::uint32_t> halo;
      auto accumulator = [&](std::int32_t body) {
        if (body >= first && body < last) return tile_begin[tile] + static_cast<std::uint32_t>(body - first);
        const auto [it, fresh] = halo.try_emplace(body, next);
        if (fresh) rows[static_cast<std::size_t>(body)].push_back(next++);
        return it->second;
      };
      for (std::size_t g = 0; g < layout.groups.size(); ++g) {
        const auto& group = layout.groups[g];
        for (std::size_t slot = group.tile_packet[tile] * lanes; slot < group.tile_packet[tile + 1] * lanes; ++slot) {
          const bool real = group.contact[slot] != inert;
          const Contact& c = network.contacts[group.contact[real ? slot : slot / lanes * lanes]];
          end_a[g][slot] = accumulator(layout.body_of(c.a));
          end_b[g][slot] = real ? accumulator(layout.body_of(c.b)) : end_a[g][slot];
        }
      }
    }
    tile_begin.push_back(next);
    for (const auto& r : rows) {
      row_begin.push_back(static_cast<std::uint32_t>(row.size()));
      row.insert(row.end(), r.begin(), r.end());
    }
    row_begin.push_back(static_cast<std::uint32_t>(row.size()));
  }
};

}  // namespace macadam::kernels
