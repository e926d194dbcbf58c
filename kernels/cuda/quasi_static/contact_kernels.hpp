// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_kernels.hpp  Defines the kernels that prepare an increment and evaluate contacts: one thread per
/// contact with a linear law, `point_lanes` threads per contact with cracks.
#pragma once

#include "kernels/cuda/quasi_static/increment_view.hpp"

namespace macadam::kernels {

/// Computes the forces of linear contacts without motion.
__global__ void __launch_bounds__(increment_threads) increment_prepare_linear(IncrementView d) {
  const unsigned i = thread_number();
  if (i >= d.linear_contacts) return;
  double base[6];
  prepare_linear(d.laws[d.contact[i].pair], d.linear[i].series,
                 DeviceState{d.linear_state + i, d.linear_contacts, d.linear_words}, base);
  for (int k = 0; k < 6; ++k) d.linear_base[static_cast<std::size_t>(k) * d.linear_contacts + i] = base[k];
}
/// Computes the stresses of points without motion.
__global__ void __launch_bounds__(increment_threads) increment_prepare_points(IncrementView d) {
  const unsigned j = thread_number();
  if (j >= d.points) return;
  const IncrementContact& c = d.contact[d.point_contact[j]];
  double base[3];
  prepare_point(d.laws[c.pair], c.length, c.series, DeviceState{d.point_state + j, d.points, d.point_words}, base);
  for (int k = 0; k < 3; ++k) d.point_base[static_cast<std::size_t>(k) * d.points + j] = base[k];
}

/// Stores the loads of a contact on both ends.
__device__ inline void store_loads(const IncrementView& d, std::size_t contact, const double* force) {
  for (int end = 0; end < 2; ++end) load_on(d.contact[contact].frame, force, end, &d.loads[12 * contact + 6 * end]);
}
/// Stores the stiffness of a contact, or its symmetric part.
__device__ inline void store_stiffness(const IncrementView& d, std::size_t contact, const double (&k)[36],
                                       bool symmetric) {
  double* out = &d.stiffness[36 * contact];
#pragma unroll
  for (int r = 0; r < 6; ++r) {
#pragma unroll
    for (int c = 0; c < 6; ++c) out[6 * r + c] = symmetric ? 0.5 * (k[6 * r + c] + k[6 * c + r]) : k[6 * r + c];
  }
}

__global__ void __launch_bounds__(increment_threads) increment_linear_forces(IncrementView d, WallArgument wall) {
  const unsigned i = thread_number();
  if (i >= d.linear_contacts) return;
  const IncrementContact& c = d.contact[i];
  double u[6], base[6], force[6];
  d.relative(c, d.trial, wall, u);
  for (int k = 0; k < 6; ++k) base[k] = d.linear_base[static_cast<std::size_t>(k) * d.linear_contacts + i];
  linear_forces(d.laws[c.pair], d.linear[i], base, u, force);
  store_loads(d, i, force);
}
__global__ void __launch_bounds__(increment_threads) increment_linear_stiffness(IncrementView d) {
  const unsigned i = thread_number();
  if (i >= d.linear_contacts) return;
  double k[36];
  linear_stiffness(d.laws[d.contact[i].pair], d.linear[i], k);
  store_stiffness(d, i, k, false);
  for (int r = 0; r < 6; ++r) d.rate[6 * static_cast<std::size_t>(i) + r] = 0;
}

/// Returns point j of a contact at the beginning of the increment.
__device__ inline PointStart point_start(const IncrementView& d, unsigned j, double growing_area) {
  PointStart p;
  p.s = d.point_s[j], p.t = d.point_t[j], p.area = d.point_area[j];
  for (int k = 0; k < 3; ++k) p.base[k] = d.point_base[static_cast<std::size_t>(k) * d.points + j];
  const DeviceState state{d.point_state + j, d.points, d.point_words};
  p.old = {state(0, 1), {state(1, 1), state(2, 1)}, state(0, 2)};
  p.part = growing_area > 0 && d.grew[j] ? p.area / growing_area : 0;
  return p;
}

/// Sums numbers over the lanes of a contact.
template <int N>
__device__ void sum_lanes(double (&v)[N]) {
#pragma unroll
  for (int n = 0; n < N; ++n) {
#pragma unroll
    for (unsigned step = point_lanes / 2; step > 0; step /= 2) v[n] += __shfl_xor_sync(every_lane, v[n], step);
  }
}

/// Computes the forces of contacts with cracks, and which of their points grow. The sum of the openings of a block goes
/// to `partial`.
__global__ void __launch_bounds__(increment_threads)
    increment_point_forces(IncrementView d, WallArgument wall, double growing_area) {
  const unsigned number = d.linear_contacts + thread_number() / point_lanes, lane = threadIdx.x % point_lanes;
  PointSums sums;
  if (number < d.contacts) {
    const IncrementContact& c = d.contact[number];
    const IncrementLaw& law = d.laws[c.pair];
    const PointStiffness stiffness = PointStiffness::of(law, c.length, c.series);
    double u[6];
    d.relative(c, d.trial, wall, u);
    for (unsigned j = c.point_begin + lane; j < c.point_end; j += point_lanes)
      d.grows[j] = add_point(law, stiffness, point_start(d, j, growing_area), u, sums);
  }
  sum_lanes(sums.force);
  if (number < d.contacts && lane == 0) store_loads(d, number, sums.force);
  const double opening[1] = {sums.opening};
  sum_block<1>(opening, &d.partial[blockIdx.x]);
}

/// Computes the tangent stiffness of contacts with cracks.
__global__ void __launch_bounds__(increment_threads)
    increment_point_stiffness(IncrementView d, WallArgument wall, double growing_area, bool symmetric) {
  const unsigned number = d.linear_contacts + thread_number() / point_lanes, lane = threadIdx.x % point_lanes;
  PointSums sums;
  TangentSums tangent;
  if (number < d.contacts) {
    const IncrementContact& c = d.contact[number];
    const IncrementLaw& law = d.laws[c.pair];
    const PointStiffness stiffness = PointStiffness::of(law, c.length, c.series);
    double u[6];
    d.relative(c, d.trial, wall, u);
    for (unsigned j = c.point_begin + lane; j < c.point_end; j += point_lanes)
      add_point(law, stiffness, point_start(d, j, growing_area), u, sums, tangent);
  }
  sum_lanes(tangent.stiffness);
  sum_lanes(tangent.opening_rate);
  if (number >= d.contacts || lane > 0) return;
  store_stiffness(d, number, tangent.stiffness, symmetric);
  for (int k = 0; k < 6; ++k) d.rate[6 * static_cast<std::size_t>(number) + k] = tangent.opening_rate[k];
}

/// Number of sums in ContactEnergies.
inline constexpr int energy_sums = 9;
__device__ inline void sum_energies(const ContactEnergies& e, double* out) {
  const double list[energy_sums] = {e.elastic, e.viscous, e.crack,   e.friction, e.crack_work,
                                    e.opened,  e.growing, e.damping, e.drag};
  sum_block<energy_sums>(list, out);
}

/// Advance the states at the end of an increment. The energies of a block go to `partial`, from row `first` on.
__global__ void __launch_bounds__(increment_threads) increment_accept_linear(IncrementView d, WallArgument wall) {
  const unsigned i = thread_number();
  ContactEnergies energies;
  if (i < d.linear_contacts) {
    const IncrementContact& c = d.contact[i];
    double u[6], base[6];
    d.relative(c, d.trial, wall, u);
    for (int k = 0; k < 6; ++k) base[k] = d.linear_base[static_cast<std::size_t>(k) * d.linear_contacts + i];
    energies = accept_linear(d.laws[c.pair], d.linear[i], base, u,
                             DeviceState{d.linear_state + i, d.linear_contacts, d.linear_words});
  }
  sum_energies(energies, &d.partial[static_cast<std::size_t>(blockIdx.x) * energy_sums]);
}
__global__ void __launch_bounds__(increment_threads)
    increment_accept_points(IncrementView d, WallArgument wall, unsigned first, bool drags) {
  const unsigned j = thread_number();
  ContactEnergies energies;
  if (j < d.points) {
    const IncrementContact& c = d.contact[d.point_contact[j]];
    double u[6];
    d.relative(c, d.trial, wall, u);
    accept_point(d.laws[c.pair], c.length, c.series, d.point_s[j], d.point_t[j], d.point_area[j], d.grows[j], u,
                 DeviceState{d.point_state + j, d.points, d.point_words}, energies);
    d.grew[j] = d.grows[j];
    if (drags) {
      accept_drag(
          d.laws[c.pair], PointStiffness::of(d.laws[c.pair], c.length, c.series), d.point_s[j], d.point_t[j],
          d.point_area[j], u,
          [&](int k) -> double& { return d.point_drag[static_cast<std::size_t>(k) * d.points + j]; }, energies);
    }
  }
  sum_energies(energies, &d.partial[static_cast<std::size_t>(first + blockIdx.x) * energy_sums]);
}

/// Computes the part of the opening's change that each block of contacts causes when the particles move by `x`.
__global__ void __launch_bounds__(increment_threads) increment_opening_change(IncrementView d, const double* x) {
  const unsigned number = thread_number();
  double change[1] = {0};
  if (number < d.contacts) {
    const double* rate = &d.rate[6 * static_cast<std::size_t>(number)];
    double u[6];
    d.relative(d.contact[number], x, WallArgument{}, u);
    for (int k = 0; k < 6; ++k) change[0] += rate[k] * u[k];
  }
  sum_block<1>(change, &d.partial[blockIdx.x]);
}

/// Sums the area of the points that grow.
__global__ void __launch_bounds__(increment_threads) increment_growing_area(IncrementView d) {
  const unsigned j = thread_number();
  const double area[1] = {j < d.points && d.grows[j] ? d.point_area[j] : 0};
  sum_block<1>(area, &d.partial[blockIdx.x]);
}

/// Returns whether and how a point is broken.
__device__ inline Break break_of(const IncrementLaw& law, const DeviceState& state, double slip) {
  const auto& crack = law.advance.crack;
  if (!(state(0, 2) > 0 && state(0, 2) >= crack.curve.end)) return Break::none;
  return crack.slip_weight * slip > state(0, 1) ? Break::shear : Break::tension;
}

/// Number of sums over cracks: number and area of cracked points of each pair type, energy, and work of friction.
inline constexpr int crack_sums = 2 * pair_types + 2;
/// Sums the cracks of all points, and lists the broken ones; their order differs from run to run.
__global__ void __launch_bounds__(increment_threads)
    increment_crack_totals(IncrementView d, BrokenPoint* broken, unsigned* count) {
  const unsigned j = thread_number();
  double sums[crack_sums] = {};
  if (j < d.points) {
    const int pair = d.contact[d.point_contact[j]].pair;
    const IncrementLaw& law = d.laws[pair];
    const DeviceState state{d.point_state + j, d.points, d.point_words};
    const double slip = hypot(state(1, 1), state(2, 1)), area = d.point_area[j];
    const CrackNumbers found = crack_numbers(law, state, slip);
#pragma unroll
    for (int p = 0; p < pair_types; ++p) {
      const bool counts = p == pair && found.damage > 0;
      sums[2 * p] = counts ? 1 : 0, sums[2 * p + 1] = counts ? area : 0;
    }
    sums[2 * pair_types] = found.energy * area, sums[2 * pair_types + 1] = double(state(1, 2)) * area;
    const Break how = break_of(law, state, slip);
    if (how != Break::none) broken[atomicAdd(count, 1u)] = {d.point_of[j], how, state(0, 1), slip};
  }
  sum_block<crack_sums>(sums, &d.partial[static_cast<std::size_t>(blockIdx.x) * crack_sums]);
}

/// Fills in the cracks and breaks of points, in the order of the network.
__global__ void __launch_bounds__(increment_threads)
    increment_read_cracks(IncrementView d, laws::PointCrack* cracks, Break* breaks) {
  const unsigned j = thread_number();
  if (j >= d.points) return;
  const IncrementLaw& law = d.laws[d.contact[d.point_contact[j]].pair];
  const DeviceState state{d.point_state + j, d.points, d.point_words};
  const double slip = hypot(state(1, 1), state(2, 1));
  if (cracks) {
    const CrackNumbers found = crack_numbers(law, state, slip);
    laws::PointCrack& out = cracks[d.point_of[j]];
    out.opening = state(0, 1), out.slip = slip, out.damage = found.damage, out.energy = found.energy;
    out.friction = state(1, 2);
  }
  if (breaks) breaks[d.point_of[j]] = break_of(law, state, slip);
}

/// Sums the rows of `partial`, by one block.
template <int N>
__global__ void __launch_bounds__(increment_threads) increment_sum(const double* list, unsigned rows, double* out) {
  sum_rows<N>(list, rows, out);
}

}  // namespace macadam::kernels
