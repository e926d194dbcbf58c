// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cocg_kernels.hpp  An iteration of conjugate gradients on a device: four kernels, whose last blocks do the
/// scalars.
///
///   turn     p = z + coarse correction − free motions + β·p
///   apply    q = K·p;  α = rᵀz / pᵀq
///   advance  x += α·p, r −= α·q, z = K_ii⁻¹·r;  Rᵀr of every box
///   coarse   (RᵀKR)⁻¹·Rᵀr;  where each load stands, and β
///
/// A segment is a run of bodies of one box that one block of threads works on; `first_segment` is that of the launch.
#pragma once

#include "kernels/harmonic/cocg_sums.hpp"
#include "kernels/harmonic/linear_system.hpp"
#include "kernels/harmonic/particle_block.hpp"

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

/// Sums of a box: rᵀz straight and crossed, rᴴr, free motions in z, Rᵀr.
inline constexpr int sums_rr = 2, sums_drop = 3, sums_load = 3 + most_free_motions, box_sums = sums_load + 6;

template <int F>
struct CocgView {
  static constexpr int lanes = 2 * F;
  const Segment* segment;
  const std::int32_t* box_segment;  ///< box → first segment; boxes + 1 entries
  const std::size_t* row_begin;
  const ContactEnd* ends;
  const double *mass, *inverse, *coarse, *motion, *weight;
  const Lever* lever;
  double *x, *r, *p, *q, *z;    ///< [6·bodies][lanes]
  double* products;             ///< [segment][2][lanes]: pᵀq straight and crossed
  double *segment_sums, *sums;  ///< [segment], [box]: [box_sums][lanes]
  double* boxes_move;           ///< [6·boxes][lanes]
  unsigned *ticket, *box_ticket;
  CocgScalars<F>* scalars;
  unsigned segments, boxes;
  int free;
  bool several;  ///< devices work on it
};

/// Numbers whose lanes hold Σ re·re, Σ im·im (straight) and Σ re·im, Σ im·re (crossed).
__device__ inline double2 plain_product(const double* straight, const double* crossed, int f) {
  return {straight[2 * f] - straight[2 * f + 1], crossed[2 * f] + crossed[2 * f + 1]};
}
__device__ inline double conjugate_product(const double* straight, int f) {
  return straight[2 * f] + straight[2 * f + 1];
}

/// From so many contacts on, all warps of a block work on a body: a large aggregate has hundreds, which take one warp
/// longer than the rest of the specimen takes all others.
inline constexpr unsigned many_contacts = 64;

/// A warp a body. W threads, one a lane, take a contact; the 32/W such groups of a warp share the body's contacts.
template <int F>
__global__ void __launch_bounds__(cocg_threads)
    cocg_apply(CocgView<F> d, unsigned first_segment, const double* from, bool first) {
  constexpr unsigned W = 2 * F, slices = 32 / W, warps = cocg_threads / 32;
  CocgScalars<F>& s = *d.scalars;
  if (!s.running) return;
  __shared__ double own_k[pair_types][W], cross_k[pair_types][W], alpha[pair_types];
  const unsigned lane = threadIdx.x % W, slice = threadIdx.x % 32 / W, warp = threadIdx.x / 32;
  const bool imaginary = lane % 2;
  if (threadIdx.x < W) {
    for (int pair = 0; pair < pair_types; ++pair) {
      const LaneFactor k = lane_factor(s.k[pair][lane / 2], imaginary);
      own_k[pair][lane] = k.own, cross_k[pair][lane] = k.cross, alpha[pair] = s.alpha[pair];
    }
  }
  const LaneFactor inertia = lane_factor(s.inertia[lane / 2], imaginary);
  __syncthreads();
  const unsigned number = first_segment + blockIdx.x;
  const Segment segment = d.segment[number];
  const auto contacts_of = [&](std::size_t body) {
    return static_cast<unsigned>(d.row_begin[body + 1] - d.row_begin[body]);
  };
  const auto twist = [&](std::size_t i) {
    double v[6];
    for (int c = 0; c < 6; ++c) v[c] = __ldg(&from[(6 * i + c) * W + lane]);
    return to_twist(v);
  };
  // Σ of the loads on a body by its contacts number mine, mine + step, …, over the slices of a warp.
  const auto add_loads = [&](std::size_t body, unsigned mine, unsigned step, double(&held)[6]) {
    const std::size_t begin = d.row_begin[body];
    const unsigned count = contacts_of(body);
    const Twist<double> own = twist(body);
    Twist<double> sum;
    for (unsigned base = 0; base < count; base += step) {  // alike for a whole warp, whose lanes exchange numbers
      const unsigned i = base + mine;
      const ContactEnd& e = d.ends[begin + (i < count ? i : 0)];
      const LaneFactor k{own_k[e.pair][lane], cross_k[e.pair][lane]};
      const Twist<double> load =
          end_load(e, own, e.other >= 0 ? twist(static_cast<std::size_t>(e.other)) : Twist<double>{}, k, alpha[e.pair]);
      if (i < count) {
        sum.linear += load.linear;
        sum.angular += load.angular;
      }
    }
    to_array(sum, held);
    for (int c = 0; c < 6; ++c) {
      for (unsigned far = W; far < 32; far *= 2) held[c] += __shfl_xor_sync(0xffffffffu, held[c], far);
    }
  };
  double product[2] = {0, 0};
  const auto finish = [&](std::size_t body, const double(&held)[6]) {
    double at[6];
    to_array(twist(body), at);
    for (int c = 0; c < 6; ++c) {
      double q = -held[c];
      if (!s.inert) q -= __ldg(&d.mass[2 * body + c / 3]) * inertia(at[c]);
      const double q_partner = partner(q);
      if (slice == 0) {
        d.q[(6 * body + c) * W + lane] = q;
        product[0] += at[c] * q;
        product[1] += at[c] * q_partner;
      }
    }
  };
  for (int i = segment.first + static_cast<int>(warp); i < segment.end; i += warps) {
    const auto body = static_cast<std::size_t>(i);
    if (contacts_of(body) >= many_contacts) continue;
    double held[6];
    add_loads(body, slice, slices, held);
    finish(body, held);
  }
  __shared__ double of_warps[warps][6][W];
  __shared__ unsigned has_many[warps];  // a bit a body
  for (int base = segment.first; base < segment.end; base += cocg_threads) {
    const int asked = base + static_cast<int>(threadIdx.x);
    const bool has = asked < segment.end && contacts_of(static_cast<std::size_t>(asked)) >= many_contacts;
    const unsigned bits = __ballot_sync(0xffffffffu, has);
    if (threadIdx.x % 32 == 0) has_many[warp] = bits;
    __syncthreads();
    for (unsigned word = 0; word < warps; ++word) {
      for (unsigned left = has_many[word]; left != 0; left &= left - 1) {
        const auto body =
            static_cast<std::size_t>(base + static_cast<int>(32 * word) + __ffs(static_cast<int>(left)) - 1);
        double held[6];
        add_loads(body, warp * slices + slice, warps * slices, held);
        for (int c = 0; c < 6; ++c) {
          if (slice == 0) of_warps[warp][c][lane] = held[c];
        }
        __syncthreads();
        if (warp == 0) {
          for (int c = 0; c < 6; ++c) {
            for (unsigned other = 1; other < warps; ++other) held[c] += of_warps[other][c][lane];
          }
          finish(body, held);
        }
        __syncthreads();
      }
    }
    __syncthreads();
  }
  block_sum<2, W>(product, &d.products[number * 2 * W]);
  if (!comes_last(d.ticket, d.segments, d.several)) return;
  __shared__ double whole[2 * W];
  sum_rows<2, W>(d.products, d.segments, 2 * W, whole);
  if (threadIdx.x < F) {
    const int f = static_cast<int>(threadIdx.x);
    const double2 pq = plain_product(whole, whole + W, f);
    const bool still = s.done[f] || (pq.x == 0 && pq.y == 0);
    s.step[f] = first ? double2{1, 0} : still ? double2{0, 0} : over(s.rho[f], pq);
  }
}

/// W threads a body.
template <int F>
__global__ void __launch_bounds__(cocg_threads) cocg_advance(CocgView<F> d, unsigned first_segment) {
  constexpr unsigned W = 2 * F;
  const CocgScalars<F>& s = *d.scalars;
  if (!s.running) return;
  const unsigned lane = threadIdx.x % W;
  const LaneFactor step = lane_factor(s.step[lane / 2], lane % 2);
  const unsigned number = first_segment + blockIdx.x;
  const Segment segment = d.segment[number];
  double sums[box_sums] = {};
  for (int base = segment.first; base < segment.end; base += cocg_threads / W) {
    const int asked = base + static_cast<int>(threadIdx.x / W);
    const bool active = asked < segment.end;
    const std::size_t body = static_cast<std::size_t>(active ? asked : segment.first);
    // All is asked for before the first is stored: each load would else wait for the one before.
    double x[6], r[6], z[6] = {};
    for (int c = 0; c < 6; ++c) {
      const std::size_t at = (6 * body + c) * W + lane;
      x[c] = d.x[at] + step(d.p[at]);
      r[c] = d.r[at] - step(d.q[at]);
    }
    const double* inverse = &d.inverse[36 * body];
    for (int a = 0; a < 6; ++a) {
      for (int b = 0; b < 6; ++b) z[a] += __ldg(&inverse[6 * a + b]) * r[b];
    }
    double z_partner[6];
    for (int a = 0; a < 6; ++a) z_partner[a] = partner(z[a]);
    if (active) {
      for (int a = 0; a < 6; ++a) {
        sums[0] += r[a] * z[a];
        sums[1] += r[a] * z_partner[a];
        sums[sums_rr] += r[a] * r[a];
      }
      for (int m = 0; m < most_free_motions; ++m) {
        if (m >= d.free) break;
        for (int a = 0; a < 6; ++a)
          sums[sums_drop + m] +=
              __ldg(&d.mass[2 * body + a / 3]) * __ldg(&d.motion[(body * d.free + m) * 6 + a]) * z[a];
      }
      for (int c = 0; c < 6; ++c) {
        const std::size_t at = (6 * body + c) * W + lane;
        d.x[at] = x[c];
        d.r[at] = r[c];
        d.z[at] = z[c];
      }
    }
    if (active) {
      double load[6] = {};
      add_to_box(d.lever[body], to_twist(r), load);
      for (int c = 0; c < 6; ++c) sums[sums_load + c] += load[c];
    }
  }
  constexpr std::size_t row = box_sums * W;
  block_sum<box_sums, W>(sums, &d.segment_sums[number * row]);
  const auto box = static_cast<unsigned>(segment.box);
  const auto begin = static_cast<unsigned>(d.box_segment[box]), end = static_cast<unsigned>(d.box_segment[box + 1]);
  if (!comes_last(&d.box_ticket[box], end - begin, d.several)) return;
  for (unsigned i = threadIdx.x; i < row; i += cocg_threads) {
    double sum = 0;
    for (unsigned b = begin; b < end; ++b) sum += __ldcg(&d.segment_sums[b * row + i]);
    d.sums[box * row + i] = sum;
  }
}

/// Looks where each load stands, and finds β = rᵀz / rᵀz before. What is done no longer moves.
template <int F>
__device__ void judge(CocgScalars<F>& s, const double* sums, const double* coarse_product) {
  constexpr int W = 2 * F;
  double worst = 0;
  for (int f = 0; f < F; ++f) {
    LinearState& state = s.state[f];
    const double2 fine = plain_product(sums, sums + W, f),
                  coarse = plain_product(coarse_product, coarse_product + W, f);
    if (!s.done[f]) {
      state.residual = sqrt(conjugate_product(sums + sums_rr * W, f)) / s.scale[f];
      state.energy = fmax(conjugate_product(sums, f) + conjugate_product(coarse_product, f), 0.0);
      state.converged = s.done[f] = state.residual <= s.tolerance[f] && state.energy <= s.energy_limit[f];
      state.iterations += s.iteration > 0;
      if (!isfinite(state.residual)) s.done[f] = true;  // lost; the others go on
      if (!s.done[f]) worst = fmax(worst, state.residual);
    }
    const double2 rho = s.done[f] ? double2{0, 0} : double2{fine.x + coarse.x, fine.y + coarse.y};
    const bool begins = s.iteration == 0 || (s.rho[f].x == 0 && s.rho[f].y == 0);
    s.turn[f] = s.done[f] || begins ? double2{0, 0} : over(rho, s.rho[f]);
    s.rho[f] = rho;
  }
  if (worst < 0.9 * s.best) s.best = worst, s.best_at = s.iteration;
  s.running = worst > 0 && s.iteration < s.most_iterations && s.iteration - s.best_at <= most_stagnant;
  ++s.iteration;
}

/// A warp a row of the coarse matrix.
template <int F>
__global__ void __launch_bounds__(cocg_threads) cocg_coarse(CocgView<F> d) {
  constexpr unsigned W = 2 * F;
  CocgScalars<F>& s = *d.scalars;
  if (!s.running) return;
  const unsigned size = 6 * d.boxes, row = blockIdx.x * (cocg_threads / 32) + threadIdx.x / 32, lane = threadIdx.x % 32;
  const auto load_of = [&](unsigned b) { return &d.sums[(b / 6 * box_sums + sums_load + b % 6) * W]; };
  if (row < size) {
    double sum[W] = {};
#pragma unroll 3  // a row is long: some of its terms are asked for at a time
    for (unsigned b = lane; b < size; b += 32) {
      const double k = d.coarse[static_cast<std::size_t>(row) * size + b];
      const double* load = load_of(b);
      for (unsigned w = 0; w < W; ++w) sum[w] += k * load[w];
    }
    for (unsigned w = 0; w < W; ++w) {
      for (unsigned step = 16; step > 0; step /= 2) sum[w] += __shfl_xor_sync(0xffffffffu, sum[w], step);
      if (lane == w) d.boxes_move[row * W + w] = sum[w];
    }
  }
  if (!comes_last(d.ticket, gridDim.x, false)) return;
  __shared__ double sums[sums_load * W], of_boxes[(2 + most_free_motions) * W];
  sum_rows<sums_load, W>(d.sums, d.boxes, box_sums * W, sums);
  double own[2 + most_free_motions] = {};
  const unsigned mine = threadIdx.x % W;
#pragma unroll 6
  for (unsigned a = threadIdx.x / W; a < size; a += cocg_threads / W) {
    const double move = __ldcg(&d.boxes_move[a * W + mine]);
    own[0] += load_of(a)[mine] * move;
    own[1] += load_of(a)[mine ^ 1] * move;
    for (int m = 0; m < most_free_motions; ++m) {
      if (m < d.free) own[2 + m] += d.weight[static_cast<std::size_t>(m) * size + a] * move;
    }
  }
  block_sum<2 + most_free_motions, W>(own, of_boxes);
  __syncthreads();
  for (unsigned i = threadIdx.x; i < d.free * W; i += cocg_threads) {
    s.drop[i / W][i % W] = sums[sums_drop * W + i] + of_boxes[2 * W + i];
  }
  if (threadIdx.x == 0) judge(s, sums, of_boxes);
}

/// W threads a body.
template <int F>
__global__ void __launch_bounds__(cocg_threads) cocg_turn(CocgView<F> d, unsigned first_segment) {
  constexpr unsigned W = 2 * F;
  const CocgScalars<F>& s = *d.scalars;
  if (!s.running) return;
  const unsigned lane = threadIdx.x % W;
  const LaneFactor turn = lane_factor(s.turn[lane / 2], lane % 2);
  const unsigned number = first_segment + blockIdx.x;
  const Segment segment = d.segment[number];
  double y[6], drop[most_free_motions];
  for (int c = 0; c < 6; ++c) y[c] = d.boxes_move[(6 * segment.box + c) * W + lane];
  for (int m = 0; m < most_free_motions; ++m) drop[m] = m < d.free ? s.drop[m][lane] : 0;
  for (int base = segment.first; base < segment.end; base += cocg_threads / W) {
    const int asked = base + static_cast<int>(threadIdx.x / W);
    const bool active = asked < segment.end;
    const std::size_t body = static_cast<std::size_t>(active ? asked : segment.first);
    double p[6], add[6];
    for (int c = 0; c < 6; ++c) {  // all is asked for before the first is stored
      const std::size_t at = (6 * body + c) * W + lane;
      p[c] = d.z[at] + turn(d.p[at]);
    }
    to_array(moved_with_box(d.lever[body], y), add);
    for (int m = 0; m < most_free_motions; ++m) {
      if (m >= d.free) break;
      for (int c = 0; c < 6; ++c) add[c] -= __ldg(&d.motion[(body * d.free + m) * 6 + c]) * drop[m];
    }
    for (int c = 0; c < 6; ++c) {
      if (active) d.p[(6 * body + c) * W + lane] = p[c] + add[c];
    }
  }
}

}  // namespace macadam::kernels
