// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_contacts.hpp  Reads forces, deformation and states of all contacts from an executor, in the order of the
/// network.
#pragma once

#include <array>
#include <numeric>
#include <optional>
#include <variant>
#include <vector>

#include "kernels/contact/contact_readout.hpp"
#include "kernels/layout/layout.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Returns the present state of the contacts of the network from which the executor was made. The executor must have
/// gathered its arrays.
template <class Exec>
ContactState read_contacts(const Exec& exec, const ContactNetwork& network, const Layout& layout,
                           const std::array<std::optional<typename Exec::AnyLaw>, pair_types>& laws,
                           const StepperOptions& options) {
  using P = typename Exec::Policy;
  const std::vector<double> u = exec.displacements();
  const std::size_t n = network.contacts.size();
  ContactState out{std::vector<Vec3d>(n), std::vector<Vec3d>(n), std::vector<std::array<double, 6>>(n), {}, {0}};
  const auto each_group = [&](auto&& f) {
    for (std::size_t g = 0; g < layout.groups.size(); ++g) {
      const GroupLayout& group = layout.groups[g];
      std::visit([&](const auto& law) { f(g, group, law); }, laws[static_cast<std::size_t>(group.pair)].value());
    }
  };
  out.chain_begin.resize(n + 1, 0);
  each_group([&](std::size_t, const GroupLayout& group, const auto& law) {
    const GroupReading<P, std::decay_t<decltype(law)>> read(network, layout, group, law, options, u, {});
    for (const std::uint32_t c : group.contact) {
      if (c != inert) out.chain_begin[c + 1] = read.numbers(network.contacts[c]);
    }
  });
  std::partial_sum(out.chain_begin.begin(), out.chain_begin.end(), out.chain_begin.begin());
  out.chain.resize(out.chain_begin.back(), 0.0);
  const FactsTable facts = facts_of(laws);
  if (can_break(facts)) {
    out.broken.resize(n, 0.0);
    out.point_breaks.resize(network.point_area.size(), Break::none);
  }
  if (can_crack(facts)) out.point_cracks.resize(network.point_area.size());
  each_group([&](std::size_t g, const GroupLayout& group, const auto& law) {
    const GroupShape<P> shape(layout, group, facts_of(law), options);
    GroupReading<P, std::decay_t<decltype(law)>>(network, layout, group, law, options, u,
                                                 exec.group_state(g, shape.chain(), shape.frame()))
        .read(out);
  });
  return out;
}

}  // namespace macadam::kernels
