// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cocg_view.hpp  Defines the arrays, sums and indices that the kernels of the iteration share. The iteration is
/// the conjugate gradient method for complex symmetric matrices (COCG), preconditioned as linear_system.hpp says. Each
/// iteration runs five kernels:
///
///   turn     p = z + coarse correction − free motions + β·p
///   apply    q = K·p;  pᵀq of every box
///   step     α = rᵀz / pᵀq
///   advance  x += α·p, r −= α·q, z = K_ii⁻¹·r;  rᵀz, Rᵀr and other sums of every box
///   coarse   (RᵀKR)⁻¹·Rᵀr;  which loads are solved, and β
///
/// A segment is a range of bodies of one box that one thread block works on; `first_segment` is the first one of a
/// launch. A box is a group of neighbouring particles whose six rigid motions are unknowns of the coarse correction. A
/// load is one right-hand side with its stiffness; F loads are solved side by side.
#pragma once

#include "kernels/cuda/harmonic/cocg_sums.hpp"
#include "kernels/harmonic/linear_system.hpp"

namespace macadam::kernels {

/// Bodies of one box that one thread block works on.
struct Segment {
  std::int32_t first, end;  ///< bodies
  std::int32_t box;
};

/// Scalars of an iteration of F loads, on the device.
template <int F>
struct CocgScalars {
  double2 k[pair_types][F], inertia[F];
  double alpha[pair_types];
  double scale[F], tolerance[F], energy_limit[F];
  double2 rho[F], step[F], turn[F];  ///< of the iteration: rᵀz, α, β
  double drop[most_free_motions][2 * F];
  LinearState state[F];
  bool done[F];
  bool inert, running;
  int most_iterations, iteration, best_at;
  double best;
};

/// Positions of the sums of a box, and how many there are. The sums are, in this order: two parts of rᵀz (straight and
/// crossed, see plain_product()), rᴴr, the amounts of the free motions in z, and Rᵀr.
inline constexpr int sums_rr = 2, sums_drop = 3, fine_sums = 3 + most_free_motions, box_sums = fine_sums + 6;
/// Number of sums of the coarse correction: two parts of its product with Rᵀr (straight and crossed, see
/// plain_product()), and the amount of each free motion in the coarse correction.
inline constexpr int coarse_sums = 2 + most_free_motions;

/// Size of a packed K_ii⁻¹ of a body: its lower triangle, by rows, and one unused number.
inline constexpr int packed_block = 22;
MACADAM_HD constexpr int packed_at(int a, int b) { return a >= b ? a * (a + 1) / 2 + b : b * (b + 1) / 2 + a; }

/// Sums of all boxes; every device has a copy.
struct CocgBoxes {
  double* products;  ///< [box][2][lanes]: pᵀq, straight and crossed
  double* sums;      ///< [box][fine_sums][lanes]
  double* loads;     ///< [lanes][6·boxes]: Rᵀr
};

/// Memory for the sums of segments before they are added up for a box, [segment][…][lanes]. Every device has its own.
struct CocgScratch {
  double *products, *sums;  ///< 2 numbers per segment; box_sums numbers per segment
  unsigned* box_ticket;
};

/// Arguments of the kernels of an iteration on one device.
template <int F>
struct CocgView {
  static constexpr int lanes = 2 * F;
  const Segment* segment;
  const std::int32_t* box_segment;  ///< box → first segment; boxes + 1 entries
  const std::size_t* row_begin;
  const ContactEnd* ends;
  const double* series;  ///< [end] Contact::series [1/Pa]; null if it is zero everywhere
  const double *mass, *inverse, *motion;
  const Lever* lever;
  const double *coarse, *weight;
  double *x, *r, *p, *q, *z;  ///< [6·bodies][lanes]
  CocgBoxes boxes_here;       ///< sums on the device of the launch
  const CocgBoxes* all;       ///< [device]
  /// own: scratch memory of the device of the launch. common: scratch memory of the first device, for boxes whose
  /// bodies are on several devices.
  CocgScratch own, common;
  double* fine;         ///< sums over all boxes, [fine_sums][lanes]
  double* boxes_move;   ///< [6·boxes][lanes]
  double* coarse_sums;  ///< [thread block of coarse][coarse_sums][lanes]
  unsigned* ticket;
  CocgScalars<F>* scalars;
  unsigned devices, boxes;
  int free;
};

/// Returns the product aᵀb of load f. Two lanes of `straight` hold Σ re·re and Σ im·im; two lanes of `crossed` hold Σ
/// re·im and Σ im·re, in any order.
__device__ inline double2 plain_product(const double* straight, const double* crossed, int f) {
  return {straight[2 * f] - straight[2 * f + 1], crossed[2 * f] + crossed[2 * f + 1]};
}
/// Returns the real part of the product aᴴb of load f. `straight`: as in plain_product(). The callers use only products
/// whose imaginary part is zero.
__device__ inline double conjugate_product(const double* straight, int f) {
  return straight[2 * f] + straight[2 * f + 1];
}

/// Sums v[N] per lane over the threads of this block and over the segments of its box. The last thread block of the box
/// calls put(box, i, sum) for i < N·lanes.
template <int N, int F, class Put>
__device__ void sum_over_box(const CocgView<F>& d, unsigned number, unsigned first_segment, const double (&v)[N],
                             double* CocgScratch::*of_segments, Put&& put) {
  constexpr unsigned row = N * 2 * F;
  const auto box = static_cast<unsigned>(d.segment[number].box);
  const auto begin = static_cast<unsigned>(d.box_segment[box]), end = static_cast<unsigned>(d.box_segment[box + 1]);
  const bool here = begin >= first_segment && end <= first_segment + gridDim.x;
  const CocgScratch& scratch = here ? d.own : d.common;
  double* const rows = scratch.*of_segments;
  block_sum<N, 2 * F>(v, &rows[static_cast<std::size_t>(number) * row]);
  if (!comes_last(&scratch.box_ticket[box], end - begin, !here)) return;
  for (unsigned i = threadIdx.x; i < row; i += cocg_threads) {
    double sum = 0;
#pragma unroll 8
    for (unsigned s = begin; s < end; ++s) sum += __ldcg(&rows[static_cast<std::size_t>(s) * row + i]);
    put(box, i, sum);
  }
}

}  // namespace macadam::kernels
