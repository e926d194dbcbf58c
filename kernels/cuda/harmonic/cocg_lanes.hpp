// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cocg_lanes.hpp  Defines how threads divide the complex numbers of F loads (right-hand sides) among them.
///
/// Every vector holds the real and imaginary parts of F loads side by side: W = 2F lanes. A thread works on one lane:
/// its thread number modulo W. The partner of a lane holds the other part (real or imaginary) of the same complex
/// number. Linear operations are computed lane by lane. From memory, a lane and its partner load whole complex numbers:
/// the even lane loads components 0, 2 and 4 of a body, the odd lane components 1, 3 and 5. So no memory line is loaded
/// twice.
#pragma once

#include <cuda_runtime.h>

#include <cstddef>
#include <type_traits>

namespace macadam::kernels {

/// Returns v of the partner lane.
__device__ inline double partner(double v) { return __shfl_xor_sync(0xffffffffu, v, 1); }

/// A complex factor as one lane needs it: factor·x = own·x + cross·partner(x).
struct LaneFactor {
  double own, cross;
  __device__ double operator()(double x) const { return own * x + cross * partner(x); }
};
__device__ inline LaneFactor lane_factor(double2 z, bool imaginary) { return {z.x, imaginary ? z.y : -z.y}; }

/// Complex product and quotient.
__device__ inline double2 times(double2 a, double2 b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
__device__ inline double2 over(double2 a, double2 b) {
  const double scale = 1 / (fabs(b.x) + fabs(b.y)), x = scale * b.x, y = scale * b.y, square = x * x + y * y;
  return {scale * (a.x * x + a.y * y) / square, scale * (a.y * x - a.x * y) / square};
}

/// Returns the factor of a stiffness in series with a spring of compliance `series`: of 1/(1/k + series).
__device__ inline LaneFactor in_series(const LaneFactor& k, double series) {
  const double one = 1 + series * k.own, turn = series * k.cross, scale = 1 / (one * one + turn * turn);
  return {scale * (k.own + series * (k.own * k.own + k.cross * k.cross)), scale * k.cross};
}

/// Three of a body's six components, as complex numbers of the lane's load: components 0, 2 and 4 in an even lane, 1, 3
/// and 5 in an odd one.
struct ComplexThree {
  double2 z[3];
};

/// Returns the address of a lane's three components of a body; they are W apart.
template <unsigned W, class Number>
__device__ auto* three_at(Number* vector, std::size_t body, unsigned lane) {
  const unsigned odd = lane % 2;
  auto* const first = vector + (6 * body + odd) * W + (lane - odd);
  if constexpr (std::is_const_v<Number>)
    return reinterpret_cast<const double2*>(first);
  else
    return reinterpret_cast<double2*>(first);
}
template <unsigned W>
__device__ ComplexThree load_three(const double* vector, std::size_t body, unsigned lane) {
  const double2* at = three_at<W>(vector, body, lane);
  return {{at[0], at[W], at[2 * W]}};
}
/// Returns the same as load_three(), for a vector that the kernel does not change.
template <unsigned W>
__device__ ComplexThree load_constant_three(const double* vector, std::size_t body, unsigned lane) {
  const double2* at = three_at<W>(vector, body, lane);
  return {{__ldg(at), __ldg(at + W), __ldg(at + 2 * W)}};
}
template <unsigned W>
__device__ void store_three(double* vector, std::size_t body, unsigned lane, const ComplexThree& v) {
  double2* at = three_at<W>(vector, body, lane);
  for (int k = 0; k < 3; ++k) at[k * W] = v.z[k];
}

/// Converts between the three complex components and all six components of the lane. Called by a whole warp.
__device__ inline void to_lane(const ComplexThree& v, unsigned lane, double (&six)[6]) {
  const bool odd = lane % 2;
  for (int k = 0; k < 3; ++k) {
    const double given = partner(odd ? v.z[k].x : v.z[k].y);
    six[2 * k] = odd ? given : v.z[k].x;
    six[2 * k + 1] = odd ? v.z[k].y : given;
  }
}
__device__ inline ComplexThree to_three(const double (&six)[6], unsigned lane) {
  const bool odd = lane % 2;
  ComplexThree out;
  for (int k = 0; k < 3; ++k) {
    const double given = partner(odd ? six[2 * k] : six[2 * k + 1]);
    out.z[k] = odd ? double2{given, six[2 * k + 1]} : double2{six[2 * k], given};
  }
  return out;
}

/// Result of spread_sums(): six sums, one per component, over the slices of a warp (a slice is W consecutive threads).
/// The sums are distributed: this thread holds sums first … first + count − 1; `count` may be 0.
template <unsigned W>
struct SpreadSums {
  static constexpr int most = W <= 4 ? 1 : 2;
  double sum[most];
  int first, count;
};

/// Sums v over the threads of a warp that have the same position in their slices, and so work on the same lane of the
/// solver. In each step two threads exchange halves of the numbers that they hold, and each keeps the sums of one half.
/// Steps repeat until the sums are distributed over the threads as SpreadSums says.
template <unsigned W>
__device__ SpreadSums<W> spread_sums(const double (&v)[6]) {
  double held[6];
  for (int k = 0; k < 6; ++k) held[k] = v[k];
  SpreadSums<W> out{{}, 0, 6};
  int size = 6;  // numbers that a thread holds; a compile-time constant after unrolling
#pragma unroll
  for (unsigned far = W; far < 32; far *= 2) {
    const bool upper = threadIdx.x & far;
    if (size == 1) {  // both threads now hold the same sum; only the lower one keeps it
      held[0] += __shfl_xor_sync(0xffffffffu, held[0], far);
      if (upper) out.count = 0;
      continue;
    }
    const int half = (size + 1) / 2;
#pragma unroll
    for (int k = 0; k < 3; ++k) {
      if (k >= half) continue;
      const double high = half + k < size ? held[half + k] : 0;
      held[k] = (upper ? high : held[k]) + __shfl_xor_sync(0xffffffffu, upper ? held[k] : high, far);
    }
    if (upper) out.first += half;
    out.count = upper ? max(out.count - half, 0) : min(out.count, half);
    size = half;
  }
  for (int k = 0; k < SpreadSums<W>::most; ++k) out.sum[k] = held[k];
  return out;
}

}  // namespace macadam::kernels
