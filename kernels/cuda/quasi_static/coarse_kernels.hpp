// SPDX-License-Identifier: GPL-3.0-or-later
/// \file coarse_kernels.hpp  Defines the kernels that make the coarse level of the preconditioner: RᵀKR for the rigid
/// motions R of boxes, and its inverse by elimination in tiles of 32 × 32 numbers.
///
/// The elimination replaces the matrix by its inverse. Step k inverts tile (k, k) to W, multiplies the tiles of row k
/// by W, subtracts (column k)·(new row k) from all other tiles, and multiplies column k by −W. A negative
/// pivot is replaced by its magnitude before the elimination goes on. So the result is the inverse of RᵀKR plus a
/// diagonal without negative numbers; it is positive definite also where cracks make K lose its stability.
#pragma once

#include "kernels/cuda/quasi_static/gradient_kernels.hpp"

namespace macadam::kernels {

inline constexpr unsigned tile = 32, tile_numbers = tile * tile;

/// Computes RᵀKR, one warp per pair of boxes; the matrix must be zero before. Lane `row` of a group computes column
/// `row` of a block.
__global__ void __launch_bounds__(increment_threads)
    increment_coarse_matrix(IncrementView d, unsigned pairs, double* matrix, unsigned stride) {
  const unsigned number = warp_number();
  if (number >= pairs) return;
  const SixLanes lanes;
  const BoxPair pair = d.pairs[number];
  const unsigned end = d.pairs[number + 1].begin, column = lanes.row;
  double sum[6] = {};
  if (lanes.works()) {
    for (unsigned i = pair.begin + lanes.group; i < end; i += SixLanes::groups) {
      const unsigned e = d.pair_entry[i];
      const Vec3d near = d.lever[d.entry_row[e]], far = d.lever[d.entry_column[e]];
      const double* k = &d.blocks[36 * static_cast<std::size_t>(e)];
      // motion of the far particle under unit motion `column` of its box
      double unit[3] = {}, motion[6] = {};
      if (column >= 3) unit[column - 3] = 1;
      for (unsigned c = 0; c < 6; ++c) motion[c] = c == column ? 1 : 0;
      if (column >= 3)
        for (unsigned c = 0; c < 3; ++c) motion[c] = -moment_of(far, unit, c);
      double v[6];
#pragma unroll
      for (int r = 0; r < 6; ++r) {
        v[r] = 0;
#pragma unroll
        for (int c = 0; c < 6; ++c) v[r] += k[6 * c + r] * motion[c];
      }
      for (unsigned r = 0; r < 3; ++r) {
        sum[r] += v[r];
        sum[3 + r] += v[3 + r] + moment_of(near, v, r);
      }
    }
  }
  const std::size_t row = 6 * static_cast<std::size_t>(pair.row), to = 6 * static_cast<std::size_t>(pair.column);
#pragma unroll
  for (unsigned r = 0; r < 6; ++r) {
    const double whole = lanes.sum(sum[r]);
    // of a box with itself, the upper triangle is taken; K may be unsymmetric
    if (threadIdx.x % 32 >= 6 || (pair.row == pair.column && r > column)) continue;
    matrix[(row + r) * stride + to + column] = whole;
    matrix[(to + column) * stride + row + r] = whole;
  }
}

/// Fills the diagonal up to the end of the last tile with ones, and stores the least pivots: a part of the diagonal,
/// which motions of the whole specimen need that no wall resists.
__global__ void increment_fill_diagonal(double* matrix, unsigned size, unsigned stride, double* least_pivots) {
  constexpr double least_part = 1e-9;
  const unsigned i = thread_number();
  if (i >= stride) return;
  double& number = matrix[static_cast<std::size_t>(i) * (stride + 1)];
  if (i >= size) number = 1;
  least_pivots[i] = least_part * fabs(number);
}

/// Inverts tile (k, k) to `inverse`, by one block.
__global__ void __launch_bounds__(tile_numbers) increment_invert_tile(const double* matrix, unsigned stride, unsigned k,
                                                                      const double* least_pivots, double* inverse) {
  __shared__ double a[tile][tile + 1];
  const unsigned row = threadIdx.x / tile, column = threadIdx.x % tile;
  a[row][column] = matrix[static_cast<std::size_t>(k * tile + row) * stride + k * tile + column];
  __syncthreads();
  for (unsigned p = 0; p < tile; ++p) {
    const double pivot = fmax(fabs(a[p][p]), least_pivots[k * tile + p]);
    const double own = a[row][column], in_row = a[p][column], in_column = a[row][p];
    __syncthreads();
    const double over = 1 / pivot;
    a[row][column] = row == p ? (column == p ? over : in_row * over)
                              : (column == p ? -in_column * over : own - in_column * over * in_row);
    __syncthreads();
  }
  inverse[threadIdx.x] = a[row][column];
}

/// Multiplies tiles: out[l] −= Σ left[row][·]·right[·][column] for the four rows row, row + 8, … of this thread.
__device__ inline void subtract_product(const double (&left)[tile][tile + 1], const double (&right)[tile][tile + 1],
                                        double (&out)[4]) {
  const unsigned row = threadIdx.x / tile, column = threadIdx.x % tile;
#pragma unroll 8
  for (unsigned m = 0; m < tile; ++m) {
#pragma unroll
    for (unsigned l = 0; l < 4; ++l) out[l] -= left[row + 8 * l][m] * right[m][column];
  }
}

/// Computes row k of tiles times the inverse tile, and copies column k, both into buffers; tile number blockIdx.x.
__global__ void __launch_bounds__(increment_threads)
    increment_panels(const double* matrix, unsigned stride, unsigned k, const double* inverse, double* rows,
                     double* columns) {
  __shared__ double left[tile][tile + 1], right[tile][tile + 1];
  const unsigned t = blockIdx.x, row = threadIdx.x / tile, column = threadIdx.x % tile;
  double out[4] = {};
  for (unsigned l = 0; l < 4; ++l) {
    const unsigned r = row + 8 * l;
    left[r][column] = inverse[r * tile + column];
    right[r][column] = matrix[static_cast<std::size_t>(k * tile + r) * stride + t * tile + column];
    columns[static_cast<std::size_t>(t) * tile_numbers + r * tile + column] =
        matrix[static_cast<std::size_t>(t * tile + r) * stride + k * tile + column];
  }
  __syncthreads();
  subtract_product(left, right, out);
  for (unsigned l = 0; l < 4; ++l)
    rows[static_cast<std::size_t>(t) * tile_numbers + (row + 8 * l) * tile + column] = -out[l];
}

/// Completes step k for tile (blockIdx.y, blockIdx.x).
__global__ void __launch_bounds__(increment_threads)
    increment_eliminate(double* matrix, unsigned stride, unsigned k, const double* inverse, const double* rows,
                        const double* columns) {
  __shared__ double left[tile][tile + 1], right[tile][tile + 1];
  const unsigned i = blockIdx.y, j = blockIdx.x, row = threadIdx.x / tile, column = threadIdx.x % tile;
  const double* from = j == k ? inverse : &rows[static_cast<std::size_t>(j) * tile_numbers];
  double* to = &matrix[static_cast<std::size_t>(i * tile) * stride + j * tile];
  double out[4] = {};
  for (unsigned l = 0; l < 4; ++l) {
    const unsigned r = row + 8 * l;
    right[r][column] = from[r * tile + column];
    left[r][column] = columns[static_cast<std::size_t>(i) * tile_numbers + r * tile + column];
    if (i != k && j != k) out[l] = to[static_cast<std::size_t>(r) * stride + column];
  }
  __syncthreads();
  if (i != k) subtract_product(left, right, out);
  for (unsigned l = 0; l < 4; ++l) {
    const unsigned r = row + 8 * l;
    to[static_cast<std::size_t>(r) * stride + column] = i == k ? right[r][column] : out[l];
  }
}

}  // namespace macadam::kernels
