// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_record_order.hpp  Assigns a load record to each end of each contact. The records of a body are
/// consecutive; they are its row.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernels/cuda/common/load_sums.hpp"
#include "kernels/cuda/multi_gpu/device_team.hpp"
#include "kernels/layout/layout.hpp"

namespace macadam::kernels {

/// Order in which the load records of a body are stored and summed. `as_written`: the order in which a step writes
/// them, so that records in the same memory sector are written at about the same time. `by_number`: the order of the
/// contacts' numbers, where contacts that have the body at end A come first. This order does not depend on the layout.
enum class RecordOrder { as_written, by_number };

/// The rows of load records of all bodies, on the device.
struct LoadLists {
  DeviceArray<std::uint32_t> begin;  ///< [body + 1] first record of a body
  /// [slot of all groups][2] records of the ends A and B; UINT32_MAX in an inert slot.
  DeviceArray<std::uint32_t> place;
  DeviceArray<std::uint32_t> long_body;  ///< bodies with more than long_list records, walls last
  std::vector<std::uint32_t> long_cut;   ///< [member of the team + 1] index in long_body of the member's first body
  std::uint32_t long_particles = 0;      ///< number of particles in long_body
  std::size_t records = 0;
  std::vector<std::size_t> cut;  ///< [member of the team + 1] first record of the member's bodies
  Shares shares;                 ///< how the records are divided among the devices

  LoadLists(const ContactNetwork& network, const Layout& layout, const TeamCuts& cuts, RecordOrder order) {
    const std::size_t bodies = layout.particles() + walls, contacts = network.contacts.size();
    std::vector<std::uint32_t> next(bodies + 1, 0), longer;
    const auto body_of = [&](std::int32_t end) { return static_cast<std::size_t>(layout.body_of(end)); };
    for (const Contact& c : network.contacts) {
      ++next[body_of(c.a) + 1];
      ++next[body_of(c.b) + 1];
    }
    for (std::size_t i = 0; i < bodies; ++i) {
      if (next[i + 1] > long_list) {
        longer.push_back(static_cast<std::uint32_t>(i));
        if (i < layout.particles()) ++long_particles;
      }
      next[i + 1] += next[i];
    }
    records = next.back();
    for (std::size_t m = 0; m <= cuts.members(); ++m) cut.push_back(next[cuts.body(m)]);
    shares = cuts.of([&](std::size_t m) { return cut[m]; });
    Shares begins = cuts.bodies();
    ++begins.back().end;
    begin = DeviceArray<std::uint32_t>::of(next, begins);
    long_body = DeviceArray<std::uint32_t>::of(longer);
    for (std::size_t m = 0; m <= cuts.members(); ++m) {
      const auto first = static_cast<std::uint32_t>(cuts.body(m));
      long_cut.push_back(
          static_cast<std::uint32_t>(std::lower_bound(longer.begin(), longer.end(), first) - longer.begin()));
    }
    std::vector<std::uint32_t> of_a(contacts), of_b(contacts), places;
    const auto take = [&](std::vector<std::uint32_t>& record, std::uint32_t c, std::int32_t end) {
      record[c] = next[body_of(end)]++;
    };
    if (order == RecordOrder::by_number) {
      for (std::uint32_t c = 0; c < contacts; ++c) take(of_a, c, network.contacts[c].a);
      for (std::uint32_t c = 0; c < contacts; ++c) take(of_b, c, network.contacts[c].b);
    }
    for (const GroupLayout& group : layout.groups) {
      for (const std::uint32_t c : group.contact) {
        if (c != inert && order == RecordOrder::as_written) {
          take(of_a, c, network.contacts[c].a);
          take(of_b, c, network.contacts[c].b);
        }
        places.push_back(c == inert ? UINT32_MAX : of_a[c]);
        places.push_back(c == inert ? UINT32_MAX : of_b[c]);
      }
    }
    place = DeviceArray<std::uint32_t>::of(places, cuts.all_slots());
  }

  /// Returns the bodies of member m in long_body, and their number, with or without the walls.
  std::pair<const std::uint32_t*, std::uint32_t> long_lists(std::size_t m, bool with_walls) const {
    const std::uint32_t most = with_walls ? static_cast<std::uint32_t>(long_body.size()) : long_particles;
    const std::uint32_t first = std::min(long_cut[m], most);
    return {long_body.data() + first, std::min(long_cut[m + 1], most) - first};
  }

  /// Returns the order in which a checkpoint stores an array [record][record_words]: the rows of the bodies follow one
  /// another in the order of the specimen.
  StateOrder state_order(const Layout& layout) const {
    StateOrder out{{}, strided(record_words, 1), {}};
    const std::vector<std::uint32_t> row = begin.download();
    for (const std::uint64_t body : body_order(layout, 1).first) {
      for (std::uint64_t r = row[body]; r < row[body + 1]; ++r) out.first.push_back(r * record_words);
    }
    return out;
  }
};

}  // namespace macadam::kernels
