// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cocg_vectors.hpp  Defines the kernels advance and turn of the iteration (cocg_view.hpp). They update solution,
/// residual and direction, with W threads per body.
#pragma once

#include "kernels/cuda/harmonic/cocg_view.hpp"
#include "kernels/harmonic/particle_block.hpp"

namespace macadam::kernels {

/// Computes x += α·p, r −= α·q, z = K_ii⁻¹·r, and the sums of every box (box_sums).
template <int F>
__global__ void __launch_bounds__(cocg_threads) cocg_advance(CocgView<F> d, unsigned first_segment) {
  constexpr unsigned W = 2 * F;
  const CocgScalars<F>& s = *d.scalars;
  if (!s.running) return;
  const unsigned lane = threadIdx.x % W;
  const double2 step = s.step[lane / 2];
  const unsigned number = first_segment + blockIdx.x;
  const Segment segment = d.segment[number];
  double sums[box_sums] = {};
  for (int base = segment.first; base < segment.end; base += cocg_threads / W) {
    const int asked = base + static_cast<int>(threadIdx.x / W);
    const bool active = asked < segment.end;
    const std::size_t body = static_cast<std::size_t>(active ? asked : segment.first);
    // All loads from memory come before the first store; otherwise each would wait until the previous one has finished.
    ComplexThree x = load_three<W>(d.x, body, lane), r = load_three<W>(d.r, body, lane);
    const ComplexThree p = load_three<W>(d.p, body, lane), q = load_three<W>(d.q, body, lane);
    double inverse[packed_block];
    const auto* packed = reinterpret_cast<const double2*>(&d.inverse[packed_block * body]);
    for (int k = 0; k < packed_block / 2; ++k) {
      const double2 two = __ldg(packed + k);
      inverse[2 * k] = two.x, inverse[2 * k + 1] = two.y;
    }
    for (int k = 0; k < 3; ++k) {
      const double2 along_x = times(step, p.z[k]), along_r = times(step, q.z[k]);
      x.z[k].x += along_x.x, x.z[k].y += along_x.y;
      r.z[k].x -= along_r.x, r.z[k].y -= along_r.y;
    }
    double six_r[6], six_z[6] = {};
    to_lane(r, lane, six_r);
    for (int a = 0; a < 6; ++a) {
      for (int b = 0; b < 6; ++b) six_z[a] += inverse[packed_at(a, b)] * six_r[b];
    }
    const ComplexThree z = to_three(six_z, lane);
    if (!active) continue;
    store_three<W>(d.x, body, lane, x);
    store_three<W>(d.r, body, lane, r);
    store_three<W>(d.z, body, lane, z);
    for (int a = 0; a < 6; ++a) {
      sums[0] += six_r[a] * six_z[a];
      sums[sums_rr] += six_r[a] * six_r[a];
    }
    for (int k = 0; k < 3; ++k) sums[1] += r.z[k].x * z.z[k].y + r.z[k].y * z.z[k].x;
    for (int m = 0; m < most_free_motions; ++m) {
      if (m >= d.free) break;
      for (int a = 0; a < 6; ++a) {
        sums[sums_drop + m] +=
            __ldg(&d.mass[2 * body + a / 3]) * __ldg(&d.motion[(body * d.free + m) * 6 + a]) * six_z[a];
      }
    }
    double load[6] = {};
    add_to_box(d.lever[body], to_twist(six_r), load);
    for (int c = 0; c < 6; ++c) sums[fine_sums + c] += load[c];
  }
  const auto put = [&](unsigned box, unsigned i, double sum) {
    constexpr unsigned fine = fine_sums * W;
    for (unsigned m = 0; m < d.devices; ++m) {
      const CocgBoxes& to = d.all[m];
      (i < fine ? to.sums[box * fine + i] : to.loads[i % W * 6 * d.boxes + 6 * box + (i - fine) / W]) = sum;
    }
  };
  sum_over_box<box_sums>(d, number, first_segment, sums, &CocgScratch::sums, put);
}

/// Computes p = z + coarse correction − free motions + β·p.
template <int F>
__global__ void __launch_bounds__(cocg_threads, 3) cocg_turn(CocgView<F> d, unsigned first_segment) {
  constexpr unsigned W = 2 * F;
  const CocgScalars<F>& s = *d.scalars;
  if (!s.running) return;
  const unsigned lane = threadIdx.x % W;
  const double2 turn = s.turn[lane / 2];
  const unsigned number = first_segment + blockIdx.x;
  const Segment segment = d.segment[number];
  double y[6], drop[most_free_motions];
  for (int c = 0; c < 6; ++c) y[c] = d.boxes_move[(6 * segment.box + c) * W + lane];
  for (int m = 0; m < most_free_motions; ++m) drop[m] = m < d.free ? s.drop[m][lane] : 0;
  for (int base = segment.first; base < segment.end; base += cocg_threads / W) {
    const int asked = base + static_cast<int>(threadIdx.x / W);
    const bool active = asked < segment.end;
    const std::size_t body = static_cast<std::size_t>(active ? asked : segment.first);
    const ComplexThree z = load_three<W>(d.z, body, lane);
    ComplexThree p = load_three<W>(d.p, body, lane);
    double add[6];
    to_array(moved_with_box(d.lever[body], y), add);
    for (int m = 0; m < most_free_motions; ++m) {
      if (m >= d.free) break;
      for (int c = 0; c < 6; ++c) add[c] -= __ldg(&d.motion[(body * d.free + m) * 6 + c]) * drop[m];
    }
    const ComplexThree added = to_three(add, lane);
    for (int k = 0; k < 3; ++k) {
      const double2 along = times(turn, p.z[k]);
      p.z[k] = {z.z[k].x + along.x + added.z[k].x, z.z[k].y + along.y + added.z[k].y};
    }
    if (active) store_three<W>(d.p, body, lane, p);
  }
}

}  // namespace macadam::kernels
