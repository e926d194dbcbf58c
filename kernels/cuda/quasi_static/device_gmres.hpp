// SPDX-License-Identifier: GPL-3.0-or-later
/// \file device_gmres.hpp  Solves unsymmetric systems of increments on a device by restarted GMRES, with the
/// preconditioner on the right. Vectors stay on the device; the small matrix is on the host.
#pragma once

#include <cmath>

#include "kernels/cuda/quasi_static/body_kernels.hpp"
#include "kernels/cuda/quasi_static/device_gradients.hpp"

namespace macadam::kernels {

/// Subtracts sum·x from y, where `sum` is a number on the device.
__global__ void __launch_bounds__(increment_threads)
    increment_subtract(unsigned n, const double* sum, const double* x, double* y) {
  const unsigned i = thread_number();
  if (i < n) y[i] -= *sum * x[i];
}

class DeviceGmres {
 public:
  DeviceGmres(const DeviceTeam& team, IncrementMemory& memory, DeviceGradients& gradients)
      : team_(team),
        m_(memory),
        gradients_(gradients),
        degrees_(6 * memory.view.bodies),
        basis_(std::size_t{degrees_} * (restart + 1)),
        column_(restart + 1),
        columns_(team, restart + 1) {}

  /// Solves K·x = r, where `r` is in gradients.r. x is then in gradients.x.
  IncrementSolution solve(double tolerance) {
    const GradientView& g = m_.gradients;
    IncrementSolution out;
    DeviceArray<double> right(degrees_);
    copy(g.r, right.data());
    check_cuda(cudaMemsetAsync(g.x, 0, sizeof(double) * degrees_, team_.stream()), "solution");
    const double goal = tolerance * size_of(right.data());
    out.solved = goal == 0;
    while (!out.solved && out.iterations < most_increment_iterations && std::isfinite(goal)) {
      multiply(g.x, g.q);
      combine(1, right.data(), -1, g.q, basis(0));
      const double size = size_of(basis(0));
      out.solved = size <= goal;
      if (out.solved || !std::isfinite(size)) break;
      combine(1 / size, basis(0), 0, basis(0), basis(0));
      const int used = extend_basis(size, goal, out.iterations);
      // back substitution, and the sum of the basis
      for (int i = used - 1; i >= 0; --i) {
        for (int j = i + 1; j < used; ++j) answer_[i] -= h_[j][i] * answer_[j];
        answer_[i] /= h_[i][i];
      }
      combine(answer_[0], basis(0), 0, basis(0), g.q);
      for (int k = 1; k < used; ++k) combine(1, g.q, answer_[k], basis(k), g.q);
      gradients_.apply(g.q, g.p);
      combine(1, g.x, 1, g.p, g.x);
    }
    team_.wait("GMRES");  // `right` is freed
    return out;
  }

 private:
  static constexpr int restart = 50;

  /// Extends the basis by Arnoldi's method until the residual is below `goal`. Returns the number of vectors; h_ is
  /// then triangular, and answer_ its right-hand side.
  int extend_basis(double size, double goal, int& iterations) {
    const GradientView& g = m_.gradients;
    double cosine[restart], sine[restart];
    answer_[0] = size;
    for (int k = 0; k < restart; ++k) {
      ++iterations;
      gradients_.apply(basis(k), g.p);
      multiply(g.p, basis(k + 1));
      for (int j = 0; j <= k; ++j) {
        dot(basis(k + 1), basis(j), column_.data() + j);
        gradients_.run("subtract", increment_subtract, blocks_of(degrees_), degrees_, column_.data() + j, basis(j),
                       basis(k + 1));
      }
      dot(basis(k + 1), basis(k + 1), column_.data() + k + 1);
      columns_.copy(column_.data(), static_cast<std::size_t>(k) + 2, 0);
      const double* found = columns_.wait(0);
      double* h = h_[k];
      std::copy(found, found + k + 1, h);
      const double remains = std::sqrt(found[k + 1]);
      for (int j = 0; j < k; ++j) {
        const double upper = cosine[j] * h[j] + sine[j] * h[j + 1];
        h[j + 1] = cosine[j] * h[j + 1] - sine[j] * h[j];
        h[j] = upper;
      }
      const double length = std::hypot(h[k], remains);
      cosine[k] = length > 0 ? h[k] / length : 1, sine[k] = length > 0 ? remains / length : 0;
      h[k] = length;
      answer_[k + 1] = -sine[k] * answer_[k];
      answer_[k] *= cosine[k];
      if (std::abs(answer_[k + 1]) <= goal || !(remains > 0) || k + 1 == restart) return k + 1;
      combine(1 / remains, basis(k + 1), 0, basis(k + 1), basis(k + 1));
    }
    return restart;
  }

  double* basis(int k) const { return basis_.data() + std::size_t{degrees_} * static_cast<std::size_t>(k); }
  void copy(const double* from, double* to) const {
    check_cuda(cudaMemcpyAsync(to, from, sizeof(double) * degrees_, cudaMemcpyDeviceToDevice, team_.stream()), "copy");
  }
  void multiply(const double* x, double* out) const {
    gradients_.run("multiply", increment_multiply, product_blocks, m_.view, x, out, nullptr, nullptr, 0);
  }
  void combine(double a, const double* x, double b, const double* y, double* out) const {
    gradients_.run("vectors", increment_combine, blocks_of(degrees_), degrees_, a, x, b, y, out);
  }
  /// Enqueues the product of two vectors, into a number on the device.
  void dot(const double* x, const double* y, double* out) const {
    gradients_.run("product", increment_product, product_blocks, degrees_, x, y, m_.gradients.products);
    gradients_.run("sum", increment_sum<1>, 1u, m_.gradients.products, product_blocks, out);
  }
  double size_of(const double* x) const {
    dot(x, x, column_.data());
    columns_.copy(column_.data(), 1, 0);
    return std::sqrt(*columns_.wait(0));
  }

  const DeviceTeam& team_;
  IncrementMemory& m_;
  DeviceGradients& gradients_;
  unsigned degrees_;
  DeviceArray<double> basis_, column_;
  PinnedCopies<double> columns_;
  double h_[restart][restart + 1] = {}, answer_[restart + 1] = {};
};

}  // namespace macadam::kernels
