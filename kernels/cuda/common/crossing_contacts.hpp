// SPDX-License-Identifier: GPL-3.0-or-later
/// \file crossing_contacts.hpp  Finds the data that ranks must send each other for contacts between bodies of different
/// ranks.
#pragma once

#include <algorithm>
#include <vector>

#include "kernels/cuda/multi_gpu/rank_exchange.hpp"
#include "kernels/cuda/common/load_record_order.hpp"

namespace macadam::kernels {

/// A contact is stepped by the rank that has its slot. That rank reads both bodies and writes a load record for each.
struct Crossing {
  RankItems bodies;   ///< from the rank of the body to the rank of the contact
  RankItems records;  ///< from the rank of the contact to the rank of the body

  Crossing(const DeviceTeam& team, const ContactNetwork& network, const Layout& layout, const TeamCuts& cuts,
           const LoadLists& lists)
      : bodies(team), records(team) {
    const std::vector<std::uint32_t> place = lists.place.download();
    std::size_t slot = 0;  // number among the slots of all groups
    for (const GroupLayout& group : layout.groups) {
      for (std::size_t m = 0; m < cuts.members(); ++m) {
        for (std::size_t s = cuts.slot(group, m); s < cuts.slot(group, m + 1); ++s, ++slot) {
          const std::uint32_t c = group.contact[s];
          if (c == inert) continue;
          const Contact& contact = network.contacts[c];
          const std::int32_t end[2] = {contact.a, contact.b};
          for (std::size_t k = 0; k < 2; ++k) {
            const auto body = static_cast<std::size_t>(layout.body_of(end[k]));
            const std::size_t owner = cuts.owner(body);
            bodies.add(body, owner, m);
            records.add(place[2 * slot + k], m, owner);
          }
        }
      }
    }
  }
};

}  // namespace macadam::kernels
