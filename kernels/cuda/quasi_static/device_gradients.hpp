// SPDX-License-Identifier: GPL-3.0-or-later
/// \file device_gradients.hpp  Solves the linear systems of increments on a device: conjugate gradients in batches of
/// recorded iterations, and the preconditioner.
#pragma once

#include "kernels/cuda/multi_gpu/pinned_copies.hpp"
#include "kernels/cuda/quasi_static/increment_memory.hpp"

namespace macadam::kernels {

class DeviceGradients {
 public:
  DeviceGradients(const DeviceTeam& team, IncrementMemory& memory) : team_(team), m_(memory), states_(team) {}
  DeviceGradients(const DeviceGradients&) = delete;
  ~DeviceGradients() {
    if (batch_) cudaGraphExecDestroy(batch_);
  }

  /// Inverts the blocks of the particles and, if `coarse`, the matrix of the rigid motions of boxes.
  void precondition(bool coarse) {
    const IncrementView& d = m_.view;
    run("particle blocks", increment_invert_blocks, blocks_of(d.bodies), d, m_.inverse());
    if (!coarse) return;
    const unsigned stride = m_.gradients.coarse_stride, size = 6 * d.boxes;
    double* const a = m_.coarse;
    check_cuda(cudaMemsetAsync(a, 0, sizeof(double) * std::size_t{stride} * stride, team_.stream()), "coarse matrix");
    run("coarse matrix", increment_coarse_matrix, warp_blocks(m_.pairs), d, m_.pairs, a, stride);
    run("coarse diagonal", increment_fill_diagonal, blocks_of(stride), a, size, stride, m_.least_pivots);
    for (unsigned k = 0; k < m_.tiles; ++k) {
      launch("coarse tile", increment_invert_tile, 1, tile_numbers, 0, team_.stream(), a, stride, k, m_.least_pivots,
             m_.pivot_tile);
      run("coarse panels", increment_panels, m_.tiles, a, stride, k, m_.pivot_tile, m_.row_tiles, m_.column_tiles);
      increment_eliminate<<<dim3(m_.tiles, m_.tiles), increment_threads, 0, team_.stream()>>>(
          a, stride, k, m_.pivot_tile, m_.row_tiles, m_.column_tiles);
      check_launch("coarse elimination", team_.stream());
    }
  }

  /// Solves K·x = r, where `r` is in gradients.r; x is then in gradients.x.
  IncrementSolution solve(double tolerance) {
    const GradientView& g = m_.gradients;
    check_cuda(cudaMemsetAsync(g.x, 0, sizeof(double) * 6 * m_.view.bodies, team_.stream()), "solution");
    launch("begin", increment_begin_gradients, 1, 1, 0, team_.stream(), g.state, tolerance * tolerance);
    improve(g, 1, true);
    if (!batch_ && !waits_for_launches()) batch_ = team_.record([&] { enqueue_batch(); });
    for (int batch = 0;; ++batch) {
      if (batch_)
        check_cuda(cudaGraphLaunch(batch_, team_.stream()), "iterations");
      else
        enqueue_batch();
      states_.copy(g.state, 1, batch % 2);
      if (batch == 0) continue;
      // The next batch is enqueued before the result of a batch is examined; if the system is solved, it does nothing
      const GradientState& before = *states_.wait((batch - 1) % 2);
      if (!before.running[0]) return {before.solved != 0, before.negative != 0, before.iterations};
    }
  }

  /// Computes out = P·v for the preconditioner P, without any iteration.
  void apply(double* v, double* out) {
    GradientView g = m_.gradients;
    g.r = v, g.p = out;
    launch("begin", increment_begin_gradients, 1, 1, 0, team_.stream(), g.state, 0.0);
    improve(g, 1, true);
  }

  template <class Kernel, class... Arguments>
  void run(const char* name, Kernel kernel, unsigned blocks, Arguments&&... arguments) const {
    launch(name, kernel, blocks, increment_threads, 0, team_.stream(), std::forward<Arguments>(arguments)...);
  }

 private:
  /// Enqueues the second part of an iteration: x and r, the preconditioner, and the next direction.
  void improve(const GradientView& g, int parity, bool first) {
    const IncrementView& d = m_.view;
    run("advance", increment_advance, d.boxes, d, g, parity, first);
    run("coarse", increment_coarse, g.coarse_blocks, d, g, parity);
    run("direction", increment_direction, d.boxes, d, g, parity, first);
  }
  void enqueue_batch() {
    static_assert(increment_batch % 2 == 0, "a batch ends with the parity with which it begins");
    const GradientView& g = m_.gradients;
    for (int k = 0; k < increment_batch; ++k) {
      run("multiply", increment_multiply, product_blocks, m_.view, g.p, g.q, g.products, g.state, k % 2);
      improve(g, k % 2, false);
    }
  }

  const DeviceTeam& team_;
  IncrementMemory& m_;
  PinnedCopies<GradientState> states_;
  cudaGraphExec_t batch_ = nullptr;
};

}  // namespace macadam::kernels
