// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_record_rows.hpp  Which record of loads each end of a contact has: those of a body follow one another.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/cuda_bodies.hpp"
#include "kernels/layout.hpp"

namespace macadam::kernels {

/// In what order the loads of a body lie and are summed: in that in which a step writes them, so that records which
/// share a sector of memory are written at about one time, or in that of the contacts' numbers, first those whose end A
/// the body is, which does not depend on the layout.
enum class RecordOrder { as_written, by_number };

struct RecordRows {
  DeviceArray<std::uint32_t> begin;      ///< [body + 1]
  DeviceArray<std::uint32_t> place;      ///< [slot of all groups][2] records of the A and the B end
  DeviceArray<std::uint32_t> long_body;  ///< those of more than long_row records, walls last
  std::uint32_t long_particles = 0;      ///< of them
  std::size_t records = 0;

  RecordRows(const ContactNetwork& network, const Layout& layout, RecordOrder order) {
    const std::size_t bodies = layout.particles() + walls, contacts = network.contacts.size();
    std::vector<std::uint32_t> next(bodies + 1, 0), longer;
    const auto body_of = [&](std::int32_t end) { return static_cast<std::size_t>(layout.body_of(end)); };
    for (const Contact& c : network.contacts) {
      ++next[body_of(c.a) + 1];
      ++next[body_of(c.b) + 1];
    }
    for (std::size_t i = 0; i < bodies; ++i) {
      if (next[i + 1] > long_row) {
        longer.push_back(static_cast<std::uint32_t>(i));
        if (i < layout.particles()) ++long_particles;
      }
      next[i + 1] += next[i];
    }
    records = next.back();
    begin = DeviceArray<std::uint32_t>::of(next);
    long_body = DeviceArray<std::uint32_t>::of(longer);
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
    place = DeviceArray<std::uint32_t>::of(places);
  }

  /// Of an array [record][record_words]: the rows in the order of the specimen.
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
