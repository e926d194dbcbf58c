// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cocg_setup.hpp  Defines the kernels that run before and after the iterations. They compute the blocks of the
/// preconditioner, the right-hand sides and the initial vectors, and write the solution.
#pragma once

#include <cuda_runtime.h>

#include "kernels/cuda/harmonic/cocg_view.hpp"
#include "kernels/harmonic/particle_block.hpp"

namespace macadam::kernels {

/// Computes K_ii⁻¹ of every body, packed. `own_motions`: the number of motions of each body that its contacts are known
/// not to resist. `singular_body` receives the first body that has more motions without stiffness.
static __global__ void invert_blocks(std::size_t bodies, const std::size_t* row_begin, const ContactEnd* ends,
                                     const double* series, RealStiffness typical, const std::uint8_t* own_motions,
                                     double* inverse, unsigned long long* singular_body) {
  const std::size_t i = blockIdx.x * static_cast<std::size_t>(blockDim.x) + threadIdx.x;
  if (i >= bodies) return;
  double block[36] = {};
  for (std::size_t at = row_begin[i]; at < row_begin[i + 1]; ++at) {
    const auto pair = static_cast<std::size_t>(ends[at].pair);
    add_block(ends[at], typical.k[pair], typical.alpha[pair], series ? series[at] : 0, block);
  }
  if (invert_block(block) > own_motions[i]) atomicMin(singular_body, static_cast<unsigned long long>(i));
  for (int a = 0; a < 6; ++a) {
    for (int b = 0; b <= a; ++b) inverse[packed_block * i + packed_at(a, b)] = block[6 * a + b];
  }
}

/// to_lanes() copies the vector of load number f, [6·particles] in the order of the specimen, into the vectors of all F
/// loads, [6·bodies][2·F]; from_lanes() copies it back.
template <int F>
__global__ void to_lanes(const double2* one, const std::int32_t* particle, double* all, std::size_t size, int f) {
  const std::size_t i = blockIdx.x * static_cast<std::size_t>(blockDim.x) + threadIdx.x;
  if (i >= size) return;
  const double2 z = one[6 * static_cast<std::size_t>(particle[i / 6]) + i % 6];
  all[i * 2 * F + 2 * f] = z.x, all[i * 2 * F + 2 * f + 1] = z.y;
}
template <int F>
__global__ void from_lanes(const double* all, const std::int32_t* particle, double2* one, std::size_t size, int f) {
  const std::size_t i = blockIdx.x * static_cast<std::size_t>(blockDim.x) + threadIdx.x;
  if (i >= size) return;
  one[6 * static_cast<std::size_t>(particle[i / 6]) + i % 6] = {all[i * 2 * F + 2 * f], all[i * 2 * F + 2 * f + 1]};
}

/// Writes the forces and moments of load number f on bodies into the vectors of all F loads.
template <int F>
__global__ void set_loads(const BodyLoad* on, std::size_t bodies, double* all, int f) {
  const std::size_t i = blockIdx.x * static_cast<std::size_t>(blockDim.x) + threadIdx.x;
  if (i >= 6 * bodies) return;
  const auto* z = reinterpret_cast<const double*>(&on[i / 6].load[i % 6]);
  double* to = &all[(6 * static_cast<std::size_t>(on[i / 6].body) + i % 6) * 2 * F + 2 * f];
  to[0] = z[0], to[1] = z[1];
}

}  // namespace macadam::kernels
