// SPDX-License-Identifier: GPL-3.0-or-later
/// \file increment_system.hpp  Arranges a network for quasi-static increments on a device (GPU).
#pragma once

#include "host/quasi_static/contact_increments.hpp"
#include "kernels/quasi_static/increment_system.hpp"

namespace macadam::quasi_static {

/// Returns the arrays of a network. Particles are ordered so that those of a box are neighbours in memory. `boxes`: of
/// the coarse level of the preconditioner.
kernels::IncrementSystem make_increment_system(const Specimen& specimen, const ContactNetwork& network,
                                               const PairLaws& laws, std::size_t boxes);

/// Converts states between the order of the network (ContactIncrements::states()) and the order of the device.
class StateOrder {
 public:
  StateOrder(const ContactNetwork& network, const kernels::IncrementSystem& system,
             const std::vector<std::size_t>& state_begin, const kernels::IncrementLaws& laws)
      : network_(network), system_(system), begin_(state_begin), laws_(laws) {}

  std::vector<double> to_network(const kernels::IncrementStates& from) const;
  void to_device(const std::vector<double>& from, kernels::IncrementStates& to) const;

 private:
  /// Calls f(place in the network's order, number in the device's order) for all numbers.
  template <class State, class F>
  void for_each(State& device, F&& f) const;

  const ContactNetwork& network_;
  const kernels::IncrementSystem& system_;
  const std::vector<std::size_t>& begin_;
  const kernels::IncrementLaws& laws_;
};

}  // namespace macadam::quasi_static
