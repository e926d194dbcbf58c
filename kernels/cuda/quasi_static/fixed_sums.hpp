// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fixed_sums.hpp  Sums over threads, always in the same order.
#pragma once

#include "kernels/cuda/device/tuning.hpp"

namespace macadam::kernels {

inline constexpr unsigned every_lane = 0xffffffffu;
inline constexpr unsigned increment_warps = increment_threads / 32;

/// Sums v over the threads of a block. Writes the N sums to `out`, in global or shared memory; after the call the whole
/// block may read them.
template <int N>
__device__ void sum_block(const double (&v)[N], double* out) {
  __shared__ double of_warp[increment_warps][N];
  for (int n = 0; n < N; ++n) {
    double sum = v[n];
    for (unsigned step = 16; step > 0; step /= 2) sum += __shfl_xor_sync(every_lane, sum, step);
    if (threadIdx.x % 32 == 0) of_warp[threadIdx.x / 32][n] = sum;
  }
  __syncthreads();
  if (threadIdx.x < N) {
    double sum = 0;
    for (unsigned w = 0; w < increment_warps; ++w) sum += of_warp[w][threadIdx.x];
    out[threadIdx.x] = sum;
  }
  __syncthreads();
}

/// Sums `rows` rows of N numbers each, by the whole block, into `out`.
template <int N>
__device__ void sum_rows(const double* list, unsigned rows, double* out) {
  double own[N] = {};
  for (unsigned r = threadIdx.x; r < rows; r += increment_threads) {
    for (int n = 0; n < N; ++n) own[n] += __ldcg(&list[static_cast<std::size_t>(r) * N + n]);
  }
  sum_block<N>(own, out);
}

/// A warp computes the six numbers of one body: five groups of six lanes each take every fifth contact or entry. Lanes
/// 30 and 31 have no group.
struct SixLanes {
  unsigned group, row;
  __device__ SixLanes() : group(threadIdx.x % 32 / 6), row(threadIdx.x % 32 % 6) {}
  static constexpr unsigned groups = 5;
  __device__ bool works() const { return group < groups; }
  /// Returns the sum over the groups of the lanes with the same row. Called by the whole warp.
  __device__ double sum(double v) const {
    double out = __shfl_sync(every_lane, v, row);
    for (unsigned g = 1; g < groups; ++g) out += __shfl_sync(every_lane, v, row + 6 * g);
    return out;
  }
};

}  // namespace macadam::kernels
