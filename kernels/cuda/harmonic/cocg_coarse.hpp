// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cocg_coarse.hpp  Defines the kernel coarse of the iteration (cocg_view.hpp). It computes the coarse correction
/// of the residual and decides which loads are solved.
#pragma once

#include "kernels/cuda/harmonic/cocg_view.hpp"

namespace macadam::kernels {

/// Decides which loads (right-hand sides) are solved, and computes β = rᵀz / (rᵀz of the previous iteration). The
/// solution of a solved load no longer changes. Called by one thread block.
template <int F>
__device__ void judge(CocgScalars<F>& s, const double* sums, const double* coarse) {
  constexpr int W = 2 * F;
  __shared__ double open[F];  // residuals of loads that are not solved
  if (threadIdx.x < F) {
    const int f = static_cast<int>(threadIdx.x);
    LinearState& state = s.state[f];
    bool done = s.done[f];
    open[f] = 0;
    if (!done) {
      state.residual = sqrt(conjugate_product(sums + sums_rr * W, f)) / s.scale[f];
      state.energy = fmax(conjugate_product(sums, f) + conjugate_product(coarse, f), 0.0);
      state.converged = done = state.residual <= s.tolerance[f] && state.energy <= s.energy_limit[f];
      state.iterations += s.iteration > 0;
      if (!isfinite(state.residual)) done = true;  // this load has failed; the other loads continue
      if (!done) open[f] = state.residual;
      s.done[f] = done;
    }
    const double2 fine_product = plain_product(sums, sums + W, f),
                  coarse_product = plain_product(coarse, coarse + W, f), before = s.rho[f];
    const double2 rho =
        done ? double2{0, 0} : double2{fine_product.x + coarse_product.x, fine_product.y + coarse_product.y};
    const bool begins = s.iteration == 0 || (before.x == 0 && before.y == 0);
    s.turn[f] = done || begins ? double2{0, 0} : over(rho, before);
    s.rho[f] = rho;
  }
  __syncthreads();
  if (threadIdx.x > 0) return;
  double worst = 0;
  for (const double residual : open) worst = fmax(worst, residual);
  if (worst < 0.9 * s.best) s.best = worst, s.best_at = s.iteration;
  s.running = worst > 0 && s.iteration < s.most_iterations && s.iteration - s.best_at <= most_stagnant;
  ++s.iteration;
}

/// Number of rows of the coarse matrix per thread block; each warp computes one row. One further thread block adds up,
/// over all boxes, the sums that the kernel advance has stored for each box.
inline constexpr unsigned coarse_rows = cocg_threads / 32;
inline unsigned row_blocks(std::size_t boxes) {
  return static_cast<unsigned>((6 * boxes + coarse_rows - 1) / coarse_rows);
}

/// Multiplies (RᵀKR)⁻¹ by Rᵀr. The last thread block that finishes adds up the sums of all thread blocks and calls
/// judge().
template <int F>
__global__ void __launch_bounds__(cocg_threads) cocg_coarse(CocgView<F> d) {
  constexpr unsigned W = 2 * F;
  CocgScalars<F>& s = *d.scalars;
  if (!s.running) return;
  const unsigned size = 6 * d.boxes, row = blockIdx.x * coarse_rows + threadIdx.x / 32, rows = gridDim.x - 1;
  const unsigned lane = threadIdx.x % W;
  const double* const loads = d.boxes_here.loads;
  if (blockIdx.x == rows) {
    sum_lists<fine_sums, W>(d.boxes_here.sums, d.boxes, fine_sums * W, d.fine);
  } else {
    double own[coarse_sums] = {};
    if (row < size) {
      const double* k = &d.coarse[static_cast<std::size_t>(row) * size];
      double sum[W] = {};
#pragma unroll(24 / W)  // rows are long: several terms are loaded at a time
      for (unsigned b = threadIdx.x % 32; b < size; b += 32) {
        const double stiffness = __ldg(&k[b]);
#pragma unroll
        for (unsigned w = 0; w < W; ++w) sum[w] += stiffness * __ldg(&loads[w * size + b]);
      }
      double move = 0;
#pragma unroll
      for (unsigned w = 0; w < W; ++w) {
#pragma unroll
        for (unsigned step = 16; step > 0; step /= 2) sum[w] += __shfl_xor_sync(0xffffffffu, sum[w], step);
        if (w == lane) move = sum[w];
      }
      if (threadIdx.x % 32 < W) {
        d.boxes_move[row * W + lane] = move;
        own[0] = loads[lane * size + row] * move;
        own[1] = loads[(lane ^ 1) * size + row] * move;
        for (int m = 0; m < most_free_motions; ++m) {
          if (m < d.free) own[2 + m] = d.weight[static_cast<std::size_t>(m) * size + row] * move;
        }
      }
    }
    block_sum<coarse_sums, W>(own, &d.coarse_sums[blockIdx.x * coarse_sums * W]);
  }
  if (!comes_last(d.ticket, gridDim.x, false)) return;
  __shared__ double fine[fine_sums * W], of_boxes[coarse_sums * W];
  for (unsigned i = threadIdx.x; i < fine_sums * W; i += cocg_threads) fine[i] = __ldcg(&d.fine[i]);
  sum_lists<coarse_sums, W>(d.coarse_sums, rows, coarse_sums * W, of_boxes);
  for (unsigned i = threadIdx.x; i < d.free * W; i += cocg_threads) {
    s.drop[i / W][i % W] = fine[sums_drop * W + i] + of_boxes[2 * W + i];
  }
  judge(s, fine, of_boxes);
}

}  // namespace macadam::kernels
