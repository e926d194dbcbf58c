// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cocg_sums.hpp  Sums over the threads of a block and over the blocks of a launch, always in the same order.
#pragma once

#include "kernels/cuda/device/tuning.hpp"
#include "kernels/cuda/harmonic/cocg_lanes.hpp"

namespace macadam::kernels {

/// Sums v over all threads of a block that have the same lane (threadIdx.x modulo W). Writes the sums to out[N][W], in
/// global or shared memory.
template <int N, int W>
__device__ void block_sum(const double (&v)[N], double* out) {
  __shared__ double warps[cocg_threads / 32][N * W];
  const unsigned lane = threadIdx.x % 32, warp = threadIdx.x / 32;
  for (int n = 0; n < N; ++n) {
    double sum = v[n];
    for (unsigned step = W; step < 32; step *= 2) sum += __shfl_xor_sync(0xffffffffu, sum, step);
    if (lane < W) warps[warp][n * W + lane] = sum;
  }
  __syncthreads();
  for (unsigned i = threadIdx.x; i < N * W; i += cocg_threads) {
    double sum = 0;
    for (unsigned w = 0; w < cocg_threads / 32; ++w) sum += warps[w][i];
    out[i] = sum;
  }
  __syncthreads();
}

/// Returns whether this thread block is the last of `blocks` to call this. The last block then sees everything that the
/// other blocks have written. `several`: the blocks run on several devices.
__device__ inline bool comes_last(unsigned* counter, unsigned blocks, bool several) {
  __shared__ bool last;
  const auto fence = [several] {
    if (several)
      __threadfence_system();
    else
      __threadfence();
  };
  fence();
  __syncthreads();
  if (threadIdx.x == 0) {
    last = (several ? atomicAdd_system(counter, 1u) : atomicAdd(counter, 1u)) == blocks - 1;
    if (last) *counter = 0;
  }
  __syncthreads();
  if (last) fence();
  return last;
}

/// Sums `rows` rows of N·W numbers each, by the whole thread block, into out[N][W] in shared memory.
template <int N, int W>
__device__ void sum_lists(const double* rows_of, unsigned rows, unsigned stride, double* out) {
  double own[N] = {};
#pragma unroll 5  // there are few rows; unrolling loads several before the first has arrived
  for (unsigned r = threadIdx.x / W; r < rows; r += cocg_threads / W) {
    for (int n = 0; n < N; ++n)
      own[n] += __ldcg(&rows_of[static_cast<std::size_t>(r) * stride + n * W + threadIdx.x % W]);
  }
  block_sum<N, W>(own, out);
}

}  // namespace macadam::kernels
