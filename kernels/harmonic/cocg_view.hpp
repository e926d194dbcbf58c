// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cocg_view.hpp  What the kernels of an iteration of conjugate gradients share. An iteration is five of them:
///
///   turn     p = z + coarse correction − free motions + β·p
///   apply    q = K·p;  pᵀq of every box
///   step     α = rᵀz / pᵀq
///   advance  x += α·p, r −= α·q, z = K_ii⁻¹·r;  rᵀz, Rᵀr and others of every box
///   coarse   (RᵀKR)⁻¹·Rᵀr;  where each load stands, and β
///
/// A segment is a run of bodies of one box that one block of threads works on; `first_segment` is that of the launch.
#pragma once

#include "kernels/harmonic/cocg_sums.hpp"
#include "kernels/harmonic/linear_system.hpp"

namespace macadam::kernels {

struct Segment {
  std::int32_t first, end;  ///< bodies
  std::int32_t box;
};

/// What the loads of a block have in common with no vector: on the device.
template <int F>
struct CocgScalars {
  double2 k[pair_types][F], inertia[F];
  double alpha[pair_types];
  double scale[F], tolerance[F], energy_limit[F];
  double2 rho[F], step[F], turn[F];  ///< rᵀz, α and β of the iteration
  double drop[most_free_motions][2 * F];
  LinearState state[F];
  bool done[F];
  bool inert, running;
  int most_iterations, iteration, best_at;
  double best;
};

/// Sums of a box: rᵀz straight and crossed, rᴴr, free motions in z; and Rᵀr behind them.
inline constexpr int sums_rr = 2, sums_drop = 3, fine_sums = 3 + most_free_motions, box_sums = fine_sums + 6;
/// Of the coarse correction: its product with Rᵀr straight and crossed, free motions in it.
inline constexpr int coarse_sums = 2 + most_free_motions;

/// K_ii⁻¹ of a body: its lower triangle, by rows, and a number that is not used.
inline constexpr int packed_block = 22;
MACADAM_HD constexpr int packed_at(int a, int b) { return a >= b ? a * (a + 1) / 2 + b : b * (b + 1) / 2 + a; }

/// What segments leave of a box: every device has it of all boxes.
struct CocgBoxes {
  double* products;  ///< [box][2][lanes]: pᵀq straight and crossed
  double* sums;      ///< [box][fine_sums][lanes]
  double* loads;     ///< [lanes][6·boxes]: Rᵀr
};

/// Where segments leave what is summed over their boxes, [segment][…][lanes]: every device has memory of its own for
/// it.
struct CocgScratch {
  double *products, *sums;  ///< numbers of segments: 2, and box_sums
  unsigned* box_ticket;
};

template <int F>
struct CocgView {
  static constexpr int lanes = 2 * F;
  const Segment* segment;
  const std::int32_t* box_segment;  ///< box → first segment; boxes + 1 entries
  const std::size_t* row_begin;
  const ContactEnd* ends;
  const double *mass, *inverse, *motion;
  const Lever* lever;
  const double *coarse, *weight;
  double *x, *r, *p, *q, *z;  ///< [6·bodies][lanes]
  CocgBoxes boxes_here;       ///< on the launch's device
  const CocgBoxes* all;       ///< on each device
  CocgScratch own, common;    ///< of the launch's device; of the first, for boxes that several devices work on
  double* fine;               ///< sums over all boxes, [fine_sums][lanes]
  double* boxes_move;         ///< [6·boxes][lanes]
  double* coarse_sums;        ///< [block of coarse][coarse_sums][lanes]
  unsigned* ticket;
  CocgScalars<F>* scalars;
  unsigned devices, boxes;
  int free;
};

/// Numbers whose lanes hold Σ re·re, Σ im·im (straight) and Σ re·im, Σ im·re (crossed, in any order of lanes).
__device__ inline double2 plain_product(const double* straight, const double* crossed, int f) {
  return {straight[2 * f] - straight[2 * f + 1], crossed[2 * f] + crossed[2 * f + 1]};
}
__device__ inline double conjugate_product(const double* straight, int f) {
  return straight[2 * f] + straight[2 * f + 1];
}

/// Adds up what the threads of this block have, v[N] a lane, over the segments of its box: put(box, i, sum) for
/// i < N·lanes, by the block that is the last of the box.
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
