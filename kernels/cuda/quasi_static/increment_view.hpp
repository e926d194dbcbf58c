// SPDX-License-Identifier: GPL-3.0-or-later
/// \file increment_view.hpp  Lists the arrays of quasi-static increments as kernels see them.
#pragma once

#include "kernels/cuda/quasi_static/fixed_sums.hpp"
#include "kernels/quasi_static/increment_system.hpp"

namespace macadam::kernels {

/// The displacements of the walls, as an argument of kernels.
struct WallArgument {
  Vec3d of[wall_count];
};

/// The constant arrays are those of IncrementSystem.
struct IncrementView {
  unsigned bodies, boxes, contacts, linear_contacts, points;
  int linear_words, point_words;
  const IncrementContact* contact;
  const LinearContact* linear;
  const std::uint32_t *point_of, *point_contact;
  const double *point_s, *point_t, *point_area;
  const std::uint32_t *end_begin, *ends;
  const std::int32_t* end_entry;
  const std::uint32_t* entry_begin;
  const std::int32_t *entry_row, *entry_column;
  const std::uint32_t *wall_begin, *wall_contact;
  const std::int32_t* box_body;
  const Vec3d* lever;
  const BoxPair* pairs;
  const std::uint32_t* pair_entry;
  const double* intact;      ///< [6·bodies]
  const IncrementLaw* laws;  ///< by pair type

  double *linear_state, *point_state;  ///< in the order of IncrementStates
  double *linear_base, *point_base;    ///< [component][contact or point]
  double* point_drag;                  ///< [component][point]: stresses of the drag at the end of the last increment
  std::uint8_t *grew, *grows;          ///< [point]

  double *displacement, *trial, *kept, *residual, *top;  ///< [6·bodies]
  double* loads;                                         ///< [contact][end][6]: loads on both ends
  double* stiffness;                                     ///< [contact][36]
  double* rate;                                          ///< [contact][6] derivatives of the opening
  double* blocks;                                        ///< [entry][36], column by column
  double* partial;                                       ///< sums of thread blocks

  /// Relative displacements of a contact when the particles move by `x` and the walls by `wall`.
  __device__ void relative(const IncrementContact& c, const double* x, const WallArgument& wall, double (&u)[6]) const {
    const auto twist = [x](std::int32_t body) {
      const double* v = &x[6 * static_cast<std::size_t>(body)];
      return Twist<double>{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
    };
    const Twist<double> a = twist(c.a);
    const Twist<double> b = c.b >= 0 ? twist(c.b) : Twist<double>{wall.of[-1 - c.b], {0, 0, 0}};
    relative_rates(c.frame, a, b, u);
  }
};

/// Gives access to number n of component k of a contact or point.
struct DeviceState {
  double* first;
  std::size_t stride;
  int words;
  __device__ double& operator()(int k, int n) const { return first[static_cast<std::size_t>(k * words + n) * stride]; }
};

/// Returns the index of this thread among all threads of the launch.
__device__ inline unsigned thread_number() { return blockIdx.x * blockDim.x + threadIdx.x; }
/// Returns the index of this warp among all warps of the launch.
__device__ inline unsigned warp_number() { return thread_number() / 32; }

}  // namespace macadam::kernels
