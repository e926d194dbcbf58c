// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_record_rows.hpp  Which record of loads each end of a contact has: those of a body follow one another.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/cuda_bodies.hpp"
#include "kernels/layout.hpp"

namespace macadam::kernels {

struct RecordRows {
  DeviceArray<std::uint32_t> begin;      ///< [body + 1]
  DeviceArray<std::uint32_t> place;      ///< [slot of all groups][2] records of the A and the B end
  DeviceArray<std::uint32_t> long_body;  ///< those of more than long_row records, walls last
  std::uint32_t long_particles = 0;      ///< of them
  std::size_t records = 0;

  RecordRows(const ContactNetwork& network, const Layout& layout) {
    const std::size_t bodies = layout.particles() + walls;
    std::vector<std::uint32_t> first(bodies + 1, 0), places, longer;
    const auto for_each_slot = [&](auto&& f) {
      for (const auto& group : layout.groups) {
        for (const std::uint32_t c : group.contact) f(c);
      }
    };
    const auto body_of = [&](std::int32_t end) { return static_cast<std::size_t>(layout.body_of(end)); };
    for_each_slot([&](std::uint32_t c) {
      if (c == inert) return;
      ++first[body_of(network.contacts[c].a) + 1];
      ++first[body_of(network.contacts[c].b) + 1];
    });
    for (std::size_t i = 0; i < bodies; ++i) {
      if (first[i + 1] > long_row) {
        longer.push_back(static_cast<std::uint32_t>(i));
        if (i < layout.particles()) ++long_particles;
      }
      first[i + 1] += first[i];
    }
    records = first.back();
    begin = DeviceArray<std::uint32_t>::of(first);
    long_body = DeviceArray<std::uint32_t>::of(longer);
    for_each_slot([&](std::uint32_t c) {
      places.push_back(c == inert ? UINT32_MAX : first[body_of(network.contacts[c].a)]++);
      places.push_back(c == inert ? UINT32_MAX : first[body_of(network.contacts[c].b)]++);
    });
    place = DeviceArray<std::uint32_t>::of(places);
  }
};

}  // namespace macadam::kernels
