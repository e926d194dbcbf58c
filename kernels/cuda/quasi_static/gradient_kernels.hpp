// SPDX-License-Identifier: GPL-3.0-or-later
/// \file gradient_kernels.hpp  Defines the kernels of conjugate gradients. An iteration consists of multiply (q = K·p),
/// advance (x, r, and the preconditioner of each particle), coarse (the rigid motions of boxes) and direction (p).
///
/// Every thread block of a kernel that needs a scalar sums it itself, in the same order, so no kernel waits for another
/// block. No kernel reads a number of GradientState that it writes, because its blocks start at different times: rz and
/// running are stored by the parity of the iteration.
#pragma once

#include "kernels/cuda/quasi_static/increment_view.hpp"
#include "kernels/quasi_static/particle_inverse.hpp"

namespace macadam::kernels {

/// Scalars of the iteration, in device memory.
struct GradientState {
  double rz[2];  ///< rᵀz
  double goal;   ///< rᵀz at which the system is solved; before the first direction, its ratio to the first rᵀz
  int running[2];
  int stopped, negative;  ///< whether pᵀKp is not positive, and whether it is negative
  int solved, iterations;
};

/// The arrays of the iteration.
struct GradientView {
  double *x, *r, *z, *p, *q;  ///< [6·bodies]
  const double* inverse;      ///< [body][36] inverse blocks of the particles
  const double* coarse;       ///< [6·boxes] rows of `coarse_stride` numbers: inverse matrix of the rigid motions
  unsigned coarse_stride, coarse_blocks;
  double *box_loads, *box_moves;          ///< [6·boxes]
  double *products, *fine, *coarse_sums;  ///< sums of thread blocks
  GradientState* state;
};

/// Prepares the scalars. `goal`: rᵀz at the end over rᵀz at the beginning.
__global__ void increment_begin_gradients(GradientState* s, double goal) { *s = {{0, 0}, goal, {0, 1}, 0, 0, 0, 0}; }

/// Computes out = K·x, and xᵀKx if `partial` is given. `state`: of the iteration, which may have ended; or null.
__global__ void __launch_bounds__(increment_threads)
    increment_multiply(IncrementView d, const double* x, double* out, double* partial, const GradientState* state,
                       int parity) {
  if (state && !state->running[parity]) return;
  const SixLanes lanes;
  double sum[1] = {0};
  for (unsigned body = warp_number(); body < d.bodies; body += gridDim.x * increment_warps) {
    double v = 0;
    if (lanes.works()) {
      const unsigned end = d.entry_begin[body + 1];
#pragma unroll 2
      for (unsigned e = d.entry_begin[body] + lanes.group; e < end; e += SixLanes::groups) {
        const double* k = &d.blocks[36 * static_cast<std::size_t>(e) + lanes.row];
        const auto* from = reinterpret_cast<const double2*>(&x[6 * static_cast<std::size_t>(d.entry_column[e])]);
        const double2 first = from[0], second = from[1], third = from[2];
        v += k[0] * first.x + k[6] * first.y + k[12] * second.x + k[18] * second.y + k[24] * third.x + k[30] * third.y;
      }
    }
    v = lanes.sum(v);
    if (threadIdx.x % 32 < 6) {
      const std::size_t at = 6 * static_cast<std::size_t>(body) + lanes.row;
      out[at] = v;
      sum[0] += v * x[at];
    }
  }
  if (partial) sum_block<1>(sum, &partial[blockIdx.x]);
}

/// Returns component `k` of lever × force.
__device__ inline double moment_of(const Vec3d& lever, const double* force, unsigned k) {
  return k == 0   ? lever.y * force[2] - lever.z * force[1]
         : k == 1 ? lever.z * force[0] - lever.x * force[2]
                  : lever.x * force[1] - lever.y * force[0];
}

/// Updates x and r (unless `first`), computes z for the blocks of the particles, and sums the loads of each box. One
/// thread block per box.
__global__ void __launch_bounds__(increment_threads)
    increment_advance(IncrementView d, GradientView g, int parity, bool first) {
  GradientState& s = *g.state;
  if (!s.running[parity]) return;
  constexpr unsigned used = increment_threads / 6 * 6;  // threads of whole particles
  __shared__ double curvature, shared[used];
  double step = 0;
  if (!first) {
    sum_rows<1>(g.products, product_blocks, &curvature);
    if (!(curvature > 0)) {
      if (blockIdx.x == 0 && threadIdx.x == 0) s.stopped = 1, s.negative = curvature < 0;
      return;
    }
    step = s.rz[parity] / curvature;
  }
  const unsigned component = threadIdx.x % 6, box = blockIdx.x;
  const unsigned begin = 6 * static_cast<unsigned>(d.box_body[box]),
                 end = 6 * static_cast<unsigned>(d.box_body[box + 1]);
  const bool works = threadIdx.x < used;
  double load = 0, product[1] = {0};
  for (unsigned from = begin; from < end; from += used) {
    const unsigned i = from + threadIdx.x;
    const bool mine = works && i < end;
    double r = 0;
    if (mine) {
      r = g.r[i];
      if (!first) {
        g.x[i] += step * g.p[i];
        r -= step * g.q[i];
        g.r[i] = r;
      }
    }
    __syncthreads();
    if (works) shared[threadIdx.x] = r;
    __syncthreads();
    if (mine) {
      const double *own = &shared[threadIdx.x - component], *inverse = &g.inverse[36 * static_cast<std::size_t>(i / 6)];
      double z = 0;
#pragma unroll
      for (unsigned c = 0; c < 6; ++c) z += inverse[6 * c + component] * own[c];
      g.z[i] = z;
      product[0] += r * z;
      load += component < 3 ? r : r + moment_of(d.lever[i / 6], own, component - 3);
    }
  }
  __syncthreads();
  if (works) shared[threadIdx.x] = load;
  __syncthreads();
  if (threadIdx.x < 6) {
    double sum = 0;
    for (unsigned t = component; t < used; t += 6) sum += shared[t];
    g.box_loads[6 * box + component] = sum;
  }
  sum_block<1>(product, &g.fine[box]);
}

/// Computes the rigid motions of all boxes: one warp per row of the coarse matrix.
__global__ void __launch_bounds__(increment_threads) increment_coarse(IncrementView d, GradientView g, int parity) {
  if (!g.state->running[parity] || g.state->stopped) return;
  const unsigned row = warp_number(), size = 6 * d.boxes;
  double product[1] = {0};
  if (row < size) {
    const double* k = &g.coarse[static_cast<std::size_t>(row) * g.coarse_stride];
    double sum = 0;
#pragma unroll 4
    for (unsigned b = threadIdx.x % 32; b < size; b += 32) sum += k[b] * g.box_loads[b];
    for (unsigned step = 16; step > 0; step /= 2) sum += __shfl_xor_sync(every_lane, sum, step);
    if (threadIdx.x % 32 == 0) {
      g.box_moves[row] = sum;
      product[0] = g.box_loads[row] * sum;
    }
  }
  sum_block<1>(product, &g.coarse_sums[blockIdx.x]);
}

/// Computes the next direction p = z + R·(motions of the boxes) + β·p, and decides whether the iteration ends. `first`:
/// β = 0. One thread block per box.
__global__ void __launch_bounds__(increment_threads)
    increment_direction(IncrementView d, GradientView g, int parity, bool first) {
  GradientState& s = *g.state;
  const bool decides = blockIdx.x == 0 && threadIdx.x == 0;
  if (!s.running[parity] || s.stopped) {
    if (decides) s.running[parity ^ 1] = 0;
    return;
  }
  __shared__ double fine, coarse, move[6];
  sum_rows<1>(g.fine, d.boxes, &fine);
  sum_rows<1>(g.coarse_sums, g.coarse_blocks, &coarse);
  const unsigned box = blockIdx.x;
  if (threadIdx.x < 6) move[threadIdx.x] = g.box_moves[6 * box + threadIdx.x];
  __syncthreads();
  const double next = fine + coarse, keep = first ? 0 : next / s.rz[parity];
  const unsigned begin = 6 * static_cast<unsigned>(d.box_body[box]),
                 end = 6 * static_cast<unsigned>(d.box_body[box + 1]);
  for (unsigned i = begin + threadIdx.x; i < end; i += increment_threads) {
    const unsigned component = i % 6;
    double p = g.z[i] + move[component];
    // the displacement by a rotation is rotation × lever = −(lever × rotation)
    if (component < 3) p -= moment_of(d.lever[i / 6], &move[3], component);
    g.p[i] = first ? p : p + keep * g.p[i];
  }
  if (!decides) return;
  s.rz[parity ^ 1] = next;
  if (first) {
    s.goal *= next;
    s.solved = next == 0;
    s.running[parity ^ 1] = next > 0;
  } else {
    ++s.iterations;
    s.solved = next <= s.goal;
    s.running[parity ^ 1] = !s.solved && s.iterations < most_increment_iterations;
  }
}

/// Inverts the diagonal blocks of the particles.
__global__ void __launch_bounds__(increment_threads) increment_invert_blocks(IncrementView d, double* inverse) {
  const unsigned body = thread_number();
  if (body >= d.bodies) return;
  double a[36];
  const double* from = &d.blocks[36 * static_cast<std::size_t>(d.entry_begin[body])];
#pragma unroll
  for (int k = 0; k < 36; ++k) a[k] = from[k];
  invert_particle_block(a);
#pragma unroll
  for (int k = 0; k < 36; ++k) inverse[36 * static_cast<std::size_t>(body) + k] = a[k];
}

}  // namespace macadam::kernels
