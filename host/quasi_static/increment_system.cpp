// SPDX-License-Identifier: GPL-3.0-or-later
// increment_system.cpp  Orders particles, contacts, points and the blocks of the tangent for a device.
#include "host/quasi_static/increment_system.hpp"

#include <algorithm>

#include "kernels/base/parallel.hpp"
#include "kernels/layout/layout.hpp"

namespace macadam::quasi_static {
namespace {

using kernels::IncrementSystem;

/// Orders the particles, and finds the levers from the centres of the boxes.
void add_boxes(const Specimen& specimen, const kernels::Layout& layout, IncrementSystem& s) {
  s.particle = layout.particle;
  s.box_body = layout.tile_body;
  s.box_of.resize(s.bodies());
  s.lever.resize(s.bodies());
  const auto centre_of = [&](std::int32_t body) {
    return specimen.centre[static_cast<std::size_t>(s.particle[static_cast<std::size_t>(body)])];
  };
  for (std::size_t box = 0; box < s.boxes(); ++box) {
    const std::int32_t begin = s.box_body[box], end = s.box_body[box + 1];
    Vec3d centre{};
    for (std::int32_t i = begin; i < end; ++i) centre += centre_of(i);
    if (end > begin) centre = (1.0 / (end - begin)) * centre;
    for (std::int32_t i = begin; i < end; ++i) {
      s.box_of[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(box);
      s.lever[static_cast<std::size_t>(i)] = centre_of(i) - centre;
    }
  }
}

/// Orders contacts by their first body, contacts without cracks before the others, and lists their points.
void add_contacts(const ContactNetwork& network, const PairLaws& laws, const kernels::Layout& layout,
                  IncrementSystem& s) {
  const auto cracks = [&](std::uint32_t c) {
    return laws[static_cast<std::size_t>(network.contacts[c].pair)].cracked.has_value();
  };
  s.contact_of.resize(network.contacts.size());
  for (std::uint32_t c = 0; c < s.contact_of.size(); ++c) s.contact_of[c] = c;
  const auto first_body = [&](std::uint32_t c) { return layout.body_of(network.contacts[c].a); };
  std::ranges::stable_sort(s.contact_of, [&](std::uint32_t c, std::uint32_t other) {
    return cracks(c) != cracks(other) ? cracks(other) : first_body(c) < first_body(other);
  });
  s.network_points = network.point_area.size();
  std::vector<std::uint32_t> at_wall[wall_count];
  for (std::uint32_t i = 0; i < s.contact_of.size(); ++i) {
    const Contact& c = network.contacts[s.contact_of[i]];
    kernels::IncrementContact& to = s.contacts.emplace_back();
    to.frame = {c.n, c.s, c.t, c.arm_a, c.arm_b};
    to.length = c.length, to.series = c.series;
    to.a = layout.body_of(c.a);
    to.b = c.b >= 0 ? layout.body_of(c.b) : c.b;
    to.pair = static_cast<std::int32_t>(c.pair);
    to.point_begin = static_cast<std::uint32_t>(s.point_of.size());
    if (c.b < 0) at_wall[wall_index(c.b)].push_back(i);
    if (cracks(s.contact_of[i])) {
      for (std::uint32_t j = c.point_begin; j < c.point_end; ++j) {
        s.point_of.push_back(j), s.point_contact.push_back(i);
        s.point_s.push_back(network.point_s[j]), s.point_t.push_back(network.point_t[j]);
        s.point_area.push_back(network.point_area[j]);
      }
    } else {
      kernels::LinearContact& linear = s.linear.emplace_back();
      linear.series = c.series;
      const auto m = moments_over_length(c);
      std::copy(m.begin(), m.end(), linear.moments);
    }
    to.point_end = static_cast<std::uint32_t>(s.point_of.size());
  }
  for (std::size_t w = 0; w < wall_count; ++w) {
    s.wall_begin[w] = static_cast<std::uint32_t>(s.wall_contact.size());
    s.wall_contact.insert(s.wall_contact.end(), at_wall[w].begin(), at_wall[w].end());
  }
  s.wall_begin[wall_count] = static_cast<std::uint32_t>(s.wall_contact.size());
}

/// Lists the contact ends of each body, and the entries of the tangent.
void add_rows(const ContactNetwork& network, IncrementSystem& s) {
  std::vector<std::uint32_t> place(s.contact_of.size());  // contact of the network → contact
  for (std::uint32_t i = 0; i < place.size(); ++i) place[s.contact_of[i]] = i;
  for (std::size_t body = 0; body < s.bodies(); ++body) {
    const std::int32_t particle = s.particle[body];
    const auto row = static_cast<std::int32_t>(body);
    s.end_begin.push_back(static_cast<std::uint32_t>(s.ends.size()));
    s.entry_begin.push_back(static_cast<std::uint32_t>(s.entry_row.size()));
    s.entry_row.push_back(row), s.entry_column.push_back(row);
    for (const std::uint32_t number : network.row(static_cast<std::size_t>(particle))) {
      const kernels::IncrementContact& c = s.contacts[place[number]];
      const bool is_a = network.contacts[number].a == particle;
      s.ends.push_back(2 * place[number] + (is_a ? 0 : 1));
      s.end_entry.push_back(c.b >= 0 ? static_cast<std::int32_t>(s.entry_row.size()) : -1);
      if (c.b >= 0) s.entry_row.push_back(row), s.entry_column.push_back(is_a ? c.b : c.a);
    }
  }
  s.end_begin.push_back(static_cast<std::uint32_t>(s.ends.size()));
  s.entry_begin.push_back(static_cast<std::uint32_t>(s.entry_row.size()));
}

/// Lists the pairs of boxes between which the tangent has entries.
void add_pairs(IncrementSystem& s) {
  const auto boxes_of = [&](std::uint32_t e) {
    return std::pair{s.box_of[static_cast<std::size_t>(s.entry_row[e])],
                     s.box_of[static_cast<std::size_t>(s.entry_column[e])]};
  };
  for (std::uint32_t e = 0; e < s.entry_row.size(); ++e) {
    const auto [row, column] = boxes_of(e);
    if (row <= column) s.pair_entry.push_back(e);
  }
  std::ranges::stable_sort(s.pair_entry,
                           [&](std::uint32_t e, std::uint32_t other) { return boxes_of(e) < boxes_of(other); });
  for (std::uint32_t i = 0; i < s.pair_entry.size(); ++i) {
    const auto [row, column] = boxes_of(s.pair_entry[i]);
    if (s.pairs.empty() || s.pairs.back().row != row || s.pairs.back().column != column)
      s.pairs.push_back({row, column, i});
  }
  s.pairs.push_back({-1, -1, static_cast<std::uint32_t>(s.pair_entry.size())});
}

}  // namespace

kernels::IncrementSystem make_increment_system(const Specimen& specimen, const ContactNetwork& network,
                                               const PairLaws& laws, std::size_t boxes) {
  IncrementSystem out;
  const kernels::Layout layout = kernels::make_order(specimen, boxes);
  add_boxes(specimen, layout, out);
  add_contacts(network, laws, layout, out);
  add_rows(network, out);
  add_pairs(out);
  for (const PairLaw& law : laws) {
    const int words = law.increment(0).words;
    int& most = law.cracked ? out.point_words : out.linear_words;
    most = std::max(most, words);
  }
  return out;
}

template <class State, class F>
void StateOrder::for_each(State& device, F&& f) const {
  const std::size_t linear = system_.linear.size(), points = system_.point_of.size();
  const auto linear_words = static_cast<std::size_t>(system_.linear_words),
             point_words = static_cast<std::size_t>(system_.point_words);
  for_each_of(system_.contacts.size(), [&](std::size_t i) {
    const std::size_t number = system_.contact_of[i];
    const auto words = static_cast<std::size_t>(laws_[static_cast<std::size_t>(system_.contacts[i].pair)].words);
    std::size_t at = begin_[number];
    if (i < linear) {
      for (std::size_t k = 0; k < 6; ++k) {
        for (std::size_t n = 0; n < words; ++n) f(at++, device.linear[(k * linear_words + n) * linear + i]);
      }
      return;
    }
    for (std::size_t j = system_.contacts[i].point_begin; j < system_.contacts[i].point_end; ++j) {
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t n = 0; n < words; ++n) f(at++, device.points[(k * point_words + n) * points + j]);
      }
    }
  });
}

std::vector<double> StateOrder::to_network(const kernels::IncrementStates& from) const {
  std::vector<double> out(begin_.back());
  for_each(from, [&](std::size_t at, double number) { out[at] = number; });
  return out;
}

void StateOrder::to_device(const std::vector<double>& from, kernels::IncrementStates& to) const {
  to.linear.assign(6 * static_cast<std::size_t>(system_.linear_words) * system_.linear.size(), 0.0);
  to.points.assign(3 * static_cast<std::size_t>(system_.point_words) * system_.point_of.size(), 0.0);
  for_each(to, [&](std::size_t at, double& number) { number = from[at]; });
}

}  // namespace macadam::quasi_static
