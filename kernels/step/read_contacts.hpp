// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_contacts.hpp  Reads forces, deformation and states of all contacts from an executor, in the order of the
/// network.
#pragma once

#include <array>
#include <numeric>
#include <optional>
#include <variant>
#include <vector>

#include "kernels/base/parallel.hpp"
#include "kernels/contact/contact_readout.hpp"
#include "kernels/layout/layout.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Reads the present state of the contacts of the network from which the executor was made into `out`, whose memory is
/// reused. The executor must have gathered its arrays.
template <class Exec>
void read_contacts(const Exec& exec, const ContactNetwork& network, const Layout& layout,
                   const std::array<std::optional<typename Exec::AnyLaw>, pair_types>& laws,
                   const StepperOptions& options, ContactState& out) {
  using P = typename Exec::Policy;
  const std::vector<double> u = exec.displacements();
  const std::size_t n = network.contacts.size();
  const std::size_t points = network.point_area.size();
  const FactsTable facts = facts_of(laws);
  const bool breaks = can_break(facts), cracks = can_crack(facts);
  out.force.resize(n), out.moment.resize(n), out.relative.resize(n);
  out.broken.resize(breaks ? n : 0), out.point_breaks.resize(breaks ? points : 0);
  out.point_cracks.resize(cracks ? points : 0);
  const auto each_group = [&](auto&& f) {
    for (std::size_t g = 0; g < layout.groups.size(); ++g) {
      const GroupLayout& group = layout.groups[g];
      std::visit([&](const auto& law) { f(g, group, law); }, laws[static_cast<std::size_t>(group.pair)].value());
    }
  };
  out.chain_begin.resize(n + 1);
  out.chain_begin[0] = 0;
  each_group([&](std::size_t, const GroupLayout& group, const auto& law) {
    const GroupReading<P, std::decay_t<decltype(law)>> read(network, layout, group, law, options, u, {});
    for_each_of(group.contact.size(), [&](std::size_t slot) {
      const std::uint32_t c = group.contact[slot];
      if (c != inert) out.chain_begin[c + 1] = read.numbers(network.contacts[c]);
    });
  });
  std::partial_sum(out.chain_begin.begin(), out.chain_begin.end(), out.chain_begin.begin());
  out.chain.resize(out.chain_begin.back());
  each_group([&](std::size_t g, const GroupLayout& group, const auto& law) {
    const GroupShape<P> shape(layout, group, facts_of(law), options);
    GroupReading<P, std::decay_t<decltype(law)>>(network, layout, group, law, options, u,
                                                 exec.group_state(g, shape.chain(), shape.frame()))
        .read(out);
  });
}

}  // namespace macadam::kernels
