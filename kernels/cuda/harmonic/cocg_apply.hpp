// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cocg_apply.hpp  Defines the kernels apply and step of the iteration (cocg_view.hpp). The iteration solves
/// linear systems of the frequency domain on devices (GPUs). apply computes q = K·p with one warp per body. step
/// computes the step length α.
#pragma once

#include <cuda_pipeline.h>

#include "kernels/cuda/harmonic/cocg_view.hpp"
#include "kernels/harmonic/particle_block.hpp"

namespace macadam::kernels {

/// Buffer for contact ends in shared memory. An unused part of 16 bytes after each end makes threads that read
/// different ends access different banks.
template <unsigned N>
struct alignas(16) StagedEnds {
  static constexpr unsigned parts = sizeof(ContactEnd) / 16;
  uint4 end[N][parts + 1];

  /// Starts the asynchronous copy of `count` ends, or of N if there are more. Called by a whole warp.
  __device__ void send(const ContactEnd* from, unsigned count) {
    const auto* at = reinterpret_cast<const uint4*>(from);
    for (unsigned part = threadIdx.x % 32; part < N * parts; part += 32) {
      if (part < count * parts) __pipeline_memcpy_async(&end[part / parts][part % parts], &at[part], 16);
    }
    __pipeline_commit();
  }
  __device__ const ContactEnd& operator[](unsigned i) const { return *reinterpret_cast<const ContactEnd*>(end[i]); }
};

/// Iterates over those bodies of a warp that have few contacts. A warp consists of slices (groups of W threads), each
/// of which takes one contact at a time.
struct WarpBodies {
  /// Consecutive contacts of one body of the warp.
  struct Place {
    int body;
    /// First contact, counted from the first contact of the segment, and number of contacts from it on.
    unsigned begin, left;
  };
  const std::size_t* row_begin;
  Segment segment;
  std::size_t first_row;
  /// First contact and number of contacts of the body that this thread has looked up. A warp looks up 32 bodies at
  /// once.
  unsigned begin = 0, count = 0;

  __device__ WarpBodies(const std::size_t* rows, const Segment& of)
      : row_begin(rows), segment(of), first_row(rows[of.first]) {}
  /// Returns the index of body number `number` of this warp.
  __device__ int body(int number) const {
    return segment.first + static_cast<int>(threadIdx.x / 32) + number * static_cast<int>(cocg_threads / 32);
  }
  /// Returns the first body from `number` on that has few contacts.
  __device__ Place from(int number) {
    for (; body(number) < segment.end; ++number) {
      if (number % 32 == 0) look_up(body(number + static_cast<int>(threadIdx.x % 32)));
      const unsigned found = __shfl_sync(0xffffffffu, count, number % 32);
      if (found < many_contacts) return {number, __shfl_sync(0xffffffffu, begin, number % 32), found};
    }
    return {number, 0, 0};
  }
  /// Returns the next contacts of the body or, after its last ones, of the next body.
  __device__ Place after(const Place& at, unsigned step) {
    if (at.left > step) return {at.body, at.begin + step, at.left - step};
    return from(at.body + 1);
  }
  __device__ bool there(const Place& at) const { return body(at.body) < segment.end; }

 private:
  /// Reads first contact and number of contacts of a body.
  __device__ void look_up(int mine) {
    if (mine >= segment.end) return;
    const std::size_t first = row_begin[mine];
    begin = static_cast<unsigned>(first - first_row);
    count = static_cast<unsigned>(row_begin[mine + 1] - first);
  }
};

/// Computes q = K·p. W threads, one per lane, compute one contact; the 32/W slices of a warp divide the contacts of a
/// body. pᵀq is summed for every box. `Series`: contacts have rock in series with their laws.
template <int F, bool Series>
__global__ void __launch_bounds__(cocg_threads, 2)
    cocg_apply(CocgView<F> d, unsigned first_segment, const double* from) {
  constexpr unsigned W = 2 * F, slices = 32 / W, warps = cocg_threads / 32;
  CocgScalars<F>& s = *d.scalars;
  if (!s.running) return;
  __shared__ double own_k[pair_types][W], cross_k[pair_types][W], alpha[pair_types];
  __shared__ StagedEnds<slices> staged[warps][2];
  const unsigned lane = threadIdx.x % W, slice = threadIdx.x % 32 / W, warp = threadIdx.x / 32;
  const bool imaginary = lane % 2;
  if (threadIdx.x < W) {
    for (int pair = 0; pair < pair_types; ++pair) {
      const LaneFactor k = lane_factor(s.k[pair][lane / 2], imaginary);
      own_k[pair][lane] = k.own, cross_k[pair][lane] = k.cross, alpha[pair] = s.alpha[pair];
    }
  }
  const LaneFactor inertia = lane_factor(s.inertia[lane / 2], imaginary);
  const bool inert = s.inert;
  __syncthreads();
  const unsigned number = first_segment + blockIdx.x;
  const Segment segment = d.segment[number];
  const auto three = [&](std::size_t body) { return load_constant_three<W>(from, body, lane); };
  const auto twist = [&](const ComplexThree& of) {
    double six[6];
    to_lane(of, lane, six);
    return to_twist(six);
  };
  // Adds the load that end number `slice` of `count` puts on the body. `first`: index of the first of these ends.
  const auto add_load = [&](const StagedEnds<slices>& ends, std::size_t first, unsigned count, const Twist<double>& own,
                            Twist<double>& sum) {
    const unsigned mine = slice < count ? slice : 0;
    const ContactEnd& e = ends[mine];
    LaneFactor normal{own_k[e.pair][lane], cross_k[e.pair][lane]}, shear = normal;
    if constexpr (Series) {
      const double series = __ldg(&d.series[first + mine]);
      shear = in_series(normal, alpha[e.pair] * series);
      normal = in_series(normal, series);
    }
    const auto k = [&](double u, bool in_shear) {
      if constexpr (!Series) return normal(u);
      return in_shear ? shear(u) : normal(u);
    };
    const Twist<double> other = twist(three(static_cast<std::size_t>(e.other >= 0 ? e.other : 0)));
    const Twist<double> load = end_load(e, own, e.other >= 0 ? other : Twist<double>{}, k, alpha[e.pair]);
    if (slice < count) {
      sum.linear += load.linear;
      sum.angular += load.angular;
    }
  };
  double product[2] = {0, 0};
  // Writes component c of q for a body. `held`: component c of the sum of the contact loads on the body.
  const auto finish = [&](std::size_t body, int c, double held, bool counts) {
    const double at = __ldg(&from[(6 * body + c) * W + lane]);
    double q = -held;
    if (!inert) q -= __ldg(&d.mass[2 * body + c / 3]) * inertia(at);
    const double q_partner = partner(q);
    if (!counts) return;
    d.q[(6 * body + c) * W + lane] = q;
    product[0] += at * q;
    product[1] += at * q_partner;
  };
  WarpBodies bodies(d.row_begin, segment);
  const ContactEnd* const ends = &d.ends[bodies.first_row];
  WarpBodies::Place now = bodies.from(0);
  unsigned turn = 0;
  Twist<double> own, sum;
  ComplexThree next_own{};
  if (bodies.there(now)) {
    staged[warp][0].send(ends + now.begin, now.left);
    own = twist(three(static_cast<std::size_t>(bodies.body(now.body))));
  }
  while (bodies.there(now)) {
    // The contacts of `next` are copied while the contacts of `now` are computed
    const WarpBodies::Place next = bodies.after(now, slices);
    const bool last = !bodies.there(next), ends_body = next.body != now.body;
    if (!last) staged[warp][turn ^ 1].send(ends + next.begin, next.left);
    if (!last && ends_body) next_own = three(static_cast<std::size_t>(bodies.body(next.body)));
    if (last)
      __pipeline_wait_prior(0);
    else
      __pipeline_wait_prior(1);
    __syncwarp();
    add_load(staged[warp][turn], bodies.first_row + now.begin, now.left, own, sum);
    __syncwarp();
    if (ends_body) {
      double held[6];
      to_array(sum, held);
      const SpreadSums<W> mine = spread_sums<W>(held);
      for (int k = 0; k < SpreadSums<W>::most; ++k) {
        const bool counts = k < mine.count;
        finish(static_cast<std::size_t>(bodies.body(now.body)), counts ? mine.first + k : 0, mine.sum[k], counts);
      }
      sum = {};
      own = twist(next_own);
    }
    now = next;
    turn ^= 1;
  }
  __shared__ double of_warps[warps][6][W];
  __shared__ unsigned has_many[warps];  // one bit per body
  const auto contacts_of = [&](std::size_t body) {
    return static_cast<unsigned>(d.row_begin[body + 1] - d.row_begin[body]);
  };
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
        const unsigned count = contacts_of(body);
        const Twist<double> held_own = twist(three(body));
        Twist<double> part;
        for (unsigned i = warp * slices; i < count; i += warps * slices) {
          staged[warp][0].send(&d.ends[d.row_begin[body] + i], count - i);
          __pipeline_wait_prior(0);
          __syncwarp();
          add_load(staged[warp][0], d.row_begin[body] + i, count - i, held_own, part);
          __syncwarp();
        }
        double held[6];
        to_array(part, held);
        const SpreadSums<W> mine = spread_sums<W>(held);
        for (int k = 0; k < SpreadSums<W>::most; ++k) {
          if (k < mine.count) of_warps[warp][mine.first + k][lane] = mine.sum[k];
        }
        __syncthreads();
        if (warp == 0) {
          for (unsigned first_of = 0; first_of < 6; first_of += slices) {
            const unsigned c = first_of + slice;
            const bool counts = c < 6;
            double sum_of_warps = 0;
            for (unsigned w = 0; counts && w < warps; ++w) sum_of_warps += of_warps[w][c][lane];
            finish(body, counts ? static_cast<int>(c) : 0, sum_of_warps, counts);
          }
        }
        __syncthreads();
      }
    }
    __syncthreads();
  }
  sum_over_box<2>(d, number, first_segment, product, &CocgScratch::products, [&](unsigned box, unsigned i, double sum) {
    for (unsigned m = 0; m < d.devices; ++m) d.all[m].products[box * 2 * W + i] = sum;
  });
}

/// Computes α of every load, by one thread block. `first`: this call prepares the iteration; then α = 1, so that the
/// residual becomes r = f − K·x.
template <int F>
__global__ void __launch_bounds__(cocg_threads) cocg_step(CocgView<F> d, bool first) {
  constexpr unsigned W = 2 * F;
  CocgScalars<F>& s = *d.scalars;
  if (!s.running) return;
  __shared__ double whole[2 * W];
  sum_lists<2, W>(d.boxes_here.products, d.boxes, 2 * W, whole);
  if (threadIdx.x < F) {
    const int f = static_cast<int>(threadIdx.x);
    const double2 pq = plain_product(whole, whole + W, f);
    const bool still = s.done[f] || (pq.x == 0 && pq.y == 0);
    s.step[f] = first ? double2{1, 0} : still ? double2{0, 0} : over(s.rho[f], pq);
  }
}

}  // namespace macadam::kernels
