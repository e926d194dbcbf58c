// SPDX-License-Identifier: GPL-3.0-or-later
/// \file body_kernels.hpp  Defines the kernels that sum loads and assemble the tangent: one warp per body.
#pragma once

#include "kernels/cuda/quasi_static/increment_view.hpp"

namespace macadam::kernels {

/// Sums the loads of each body. `partial` receives two sums per block: of the residual, and of all
/// loads of contacts.
__global__ void __launch_bounds__(increment_threads) increment_body_loads(IncrementView d, double* partial) {
  const unsigned body = warp_number();
  const SixLanes lanes;
  double sums[2] = {0, 0};
  if (body < d.bodies) {
    double load = 0, size = 0;
    if (lanes.works()) {
#pragma unroll 2
      for (unsigned e = d.end_begin[body] + lanes.group; e < d.end_begin[body + 1]; e += SixLanes::groups) {
        const double v = d.loads[6 * static_cast<std::size_t>(d.ends[e]) + lanes.row];
        load += v, size += fabs(v);
      }
    }
    load = lanes.sum(load), size = lanes.sum(size);
    if (threadIdx.x % 32 < 6) {
      const std::size_t at = 6 * static_cast<std::size_t>(body) + lanes.row;
      d.residual[at] = load;
      const double weight = 1 / d.intact[at];
      sums[0] = load * load * weight, sums[1] = size * size * weight;
    }
  }
  sum_block<2>(sums, &partial[2 * static_cast<std::size_t>(blockIdx.x)]);
}

/// Sums the reactions of the walls, one block per wall, into out->reaction.
__global__ void __launch_bounds__(increment_threads) increment_reactions(IncrementView d, IncrementSums* out) {
  double force[3] = {};
  for (unsigned i = d.wall_begin[blockIdx.x] + threadIdx.x; i < d.wall_begin[blockIdx.x + 1]; i += increment_threads) {
    for (int k = 0; k < 3; ++k) force[k] += d.loads[12 * static_cast<std::size_t>(d.wall_contact[i]) + 6 + k];
  }
  sum_block<3>(force, out->reaction[blockIdx.x]);
}

/// Completes the sums of an evaluation from those of the thread blocks, by one block.
__global__ void __launch_bounds__(increment_threads)
    increment_finish_sums(const double* loads, unsigned load_rows, const double* openings, unsigned opening_rows,
                          IncrementSums* out) {
  __shared__ double sizes[2], opening;
  sum_rows<2>(loads, load_rows, sizes);
  sum_rows<1>(openings, opening_rows, &opening);
  if (threadIdx.x > 0) return;
  out->size = sizes[0], out->scale = sizes[1], out->opening = opening;
}

/// Assembles the rows of the tangent, and its column for the top wall. Lane `row` of a group computes column `row` of a
/// block. Counts the bodies with less than `loose` of their intact stiffness.
__global__ void __launch_bounds__(increment_threads)
    increment_assemble(IncrementView d, double held, double loose, int top_wall, unsigned long long* count) {
  const unsigned body = warp_number();
  if (body >= d.bodies) return;
  const SixLanes lanes;
  const int axis = static_cast<int>(lanes.row);
  double own[6] = {}, top[6] = {};
  if (lanes.works()) {
    for (unsigned e = d.end_begin[body] + lanes.group; e < d.end_begin[body + 1]; e += SixLanes::groups) {
      const unsigned contact = d.ends[e] / 2;
      const int end = static_cast<int>(d.ends[e] % 2);
      const IncrementContact& c = d.contact[contact];
      const double* k = &d.stiffness[36 * static_cast<std::size_t>(contact)];
      double column[6];
      tangent_column(c.frame, k, end, end, axis, column);
      for (int r = 0; r < 6; ++r) own[r] += column[r];
      if (c.b < 0 && c.b != top_wall) continue;
      tangent_column(c.frame, k, end, 1 - end, axis, column);
      if (c.b >= 0) {
        double* out = &d.blocks[36 * static_cast<std::size_t>(d.end_entry[e]) + 6 * axis];
        for (int r = 0; r < 6; ++r) out[r] = column[r];
      } else if (axis == 2) {
        for (int r = 0; r < 6; ++r) top[r] += column[r];
      }
    }
  }
  double diagonal = 0, mine = 0;
#pragma unroll
  for (int r = 0; r < 6; ++r) {
    own[r] = lanes.sum(own[r]);  // number r of column `axis`
    const double of_top = lanes.sum(top[r]);
    // lanes of row 2 have summed the column of the top wall
    const double whole = __shfl_sync(every_lane, of_top, 2);
    if (r == axis) diagonal = own[r], mine = whole;
  }
  const std::size_t at = 6 * static_cast<std::size_t>(body) + lanes.row;
  const double intact = d.intact[at];
  double now = 0, before = 0;
  for (unsigned k = 0; k < 3; ++k)
    now += __shfl_sync(every_lane, diagonal, k), before += __shfl_sync(every_lane, intact, k);
  const bool is_loose = now < loose * before;
  if (threadIdx.x % 32 >= 6) return;
  if (is_loose && lanes.row == 0) atomicAdd(count, 1ull);
  d.top[at] = mine;
  double* out = &d.blocks[36 * static_cast<std::size_t>(d.entry_begin[body]) + 6 * axis];
#pragma unroll
  for (int r = 0; r < 6; ++r) out[r] = r == axis ? own[r] + (is_loose ? loose : held) * intact : own[r];
}

/// Computes the derivative of the top wall's reaction along z with respect to its displacement, by one block.
__global__ void __launch_bounds__(increment_threads)
    increment_wall_stiffness(IncrementView d, unsigned wall, double* out) {
  double sum[1] = {0};
  for (unsigned i = d.wall_begin[wall] + threadIdx.x; i < d.wall_begin[wall + 1]; i += increment_threads) {
    const unsigned contact = d.wall_contact[i];
    double column[6];
    tangent_column(d.contact[contact].frame, &d.stiffness[36 * static_cast<std::size_t>(contact)], 1, 1, 2, column);
    sum[0] += column[2];
  }
  sum_block<1>(sum, out);
}

/// Copies the diagonal of the tangent.
__global__ void __launch_bounds__(increment_threads) increment_diagonal(IncrementView d, double* out) {
  const unsigned i = thread_number();
  if (i >= 6 * d.bodies) return;
  out[i] = d.blocks[36 * static_cast<std::size_t>(d.entry_begin[i / 6]) + 7 * (i % 6)];
}

/// out[i] = a·x[i] + b·y[i]; a vector whose factor is zero is not read.
__global__ void __launch_bounds__(increment_threads)
    increment_combine(unsigned n, double a, const double* x, double b, const double* y, double* out) {
  const unsigned i = thread_number();
  if (i >= n) return;
  out[i] = (a != 0 ? a * x[i] : 0) + (b != 0 ? b * y[i] : 0);
}

/// Sums a product of vectors, one sum per block.
__global__ void __launch_bounds__(increment_threads)
    increment_product(unsigned n, const double* x, const double* y, double* partial) {
  double sum[1] = {0};
  for (unsigned i = thread_number(); i < n; i += gridDim.x * blockDim.x) sum[0] += x[i] * y[i];
  sum_block<1>(sum, &partial[blockIdx.x]);
}

}  // namespace macadam::kernels
