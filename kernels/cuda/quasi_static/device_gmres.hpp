// SPDX-License-Identifier: GPL-3.0-or-later
/// \file device_gmres.hpp  Solves unsymmetric systems of increments on a device by restarted GMRES, with the
/// preconditioner on the right. Vectors stay on the device; the small matrix is on the host.
#pragma once

#include <cmath>

#include "kernels/cuda/quasi_static/body_kernels.hpp"
#include "kernels/cuda/quasi_static/device_gradients.hpp"

namespace macadam::kernels {

/// Number of products of two vectors that a thread block sums at once, and the length of a row of such sums.
inline constexpr int products_at_once = 8, products_in_row = 56;
static_assert(products_in_row >= gmres_vectors && products_in_row % products_at_once == 0);

/// Computes the products of y with `count` vectors of n numbers each. Block (x, y) computes products_at_once of them
/// for its part of the vectors, in row x of `partial`.
__global__ void __launch_bounds__(increment_threads)
    increment_basis_products(unsigned n, int count, const double* basis, const double* y, double* partial) {
  const int first = products_at_once * static_cast<int>(blockIdx.y);
  double sum[products_at_once] = {};
  for (unsigned i = thread_number(); i < n; i += gridDim.x * increment_threads) {
    const double v = y[i];
#pragma unroll
    for (int k = 0; k < products_at_once; ++k) {
      if (first + k < count) sum[k] += v * basis[static_cast<std::size_t>(first + k) * n + i];
    }
  }
  sum_block<products_at_once>(sum, &partial[static_cast<std::size_t>(blockIdx.x) * products_in_row + first]);
}
/// Sums column blockIdx.x of `rows` rows of products.
__global__ void __launch_bounds__(increment_threads)
    increment_sum_products(const double* partial, unsigned rows, double* out) {
  double sum[1] = {};
  for (unsigned r = threadIdx.x; r < rows; r += increment_threads)
    sum[0] += partial[static_cast<std::size_t>(r) * products_in_row + blockIdx.x];
  sum_block<1>(sum, &out[blockIdx.x]);
}
/// Subtracts from y its parts along `count` vectors, given its products with them. `squares` receives the sum of y² of
/// each block.
__global__ void __launch_bounds__(increment_threads)
    increment_subtract_basis(unsigned n, int count, const double* products, const double* basis, double* y,
                             double* squares) {
  double sum[1] = {};
  for (unsigned i = thread_number(); i < n; i += gridDim.x * increment_threads) {
    double v = y[i];
#pragma unroll 8
    for (int j = 0; j < count; ++j) v -= products[j] * basis[static_cast<std::size_t>(j) * n + i];
    y[i] = v;
    sum[0] += v * v;
  }
  sum_block<1>(sum, &squares[blockIdx.x]);
}

class DeviceGmres {
 public:
  DeviceGmres(const DeviceTeam& team, IncrementMemory& memory, DeviceGradients& gradients)
      : team_(team),
        m_(memory),
        gradients_(gradients),
        degrees_(6 * memory.view.bodies),
        basis_(std::size_t{degrees_} * (gmres_vectors + 1)),
        partial_(std::size_t{product_blocks} * products_in_row),
        column_(column_numbers),
        columns_(team, column_numbers) {}

  /// Solves K·x = r, where `r` is in gradients.r. x is then in gradients.x.
  IncrementSolution solve(double tolerance) {
    const GradientView& g = m_.gradients;
    IncrementSolution out;
    DeviceArray<double> right(degrees_);
    copy(g.r, right.data());
    check_cuda(cudaMemsetAsync(g.x, 0, sizeof(double) * degrees_, team_.stream()), "solution");
    const double goal = tolerance * size_of(right.data());
    out.solved = goal == 0;
    double before = 0;  // residual of the last start
    while (!out.solved && out.iterations < most_increment_iterations && std::isfinite(goal)) {
      multiply(g.x, g.q);
      combine(1, right.data(), -1, g.q, basis(0));
      const double size = size_of(basis(0));
      out.solved = size <= goal;
      if (out.solved || !std::isfinite(size)) break;
      if (is_too_slow(before, size, goal, most_increment_iterations - out.iterations)) break;
      before = size;
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
  /// A column of the small matrix on the device: two rows of products, and the square of the remaining vector.
  static constexpr std::size_t second_products = products_in_row, square = 2 * products_in_row,
                               column_numbers = square + 1;

  /// Extends the basis by Arnoldi's method until the residual is below `goal`. Returns the number of vectors; h_ is
  /// then triangular, and answer_ its right-hand side.
  int extend_basis(double size, double goal, int& iterations) {
    const GradientView& g = m_.gradients;
    double cosine[gmres_vectors], sine[gmres_vectors];
    answer_[0] = size;
    for (int k = 0; k < gmres_vectors; ++k) {
      ++iterations;
      gradients_.apply(basis(k), g.p);
      multiply(g.p, basis(k + 1));
      // Once more, because rounding errors of large parts along the basis remain (Giraud et al., "twice is enough")
      subtract_basis(k + 1, column_.data());
      subtract_basis(k + 1, column_.data() + second_products);
      gradients_.run("sum", increment_sum<1>, 1u, m_.gradients.products, product_blocks, column_.data() + square);
      columns_.copy(column_.data(), column_numbers, 0);
      const double* found = columns_.wait(0);
      double* h = h_[k];
      for (int j = 0; j <= k; ++j) h[j] = found[j] + found[second_products + static_cast<std::size_t>(j)];
      const double remains = std::sqrt(found[square]);
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
      if (std::abs(answer_[k + 1]) <= goal || !(remains > 0) || k + 1 == gmres_vectors) return k + 1;
      combine(1 / remains, basis(k + 1), 0, basis(k + 1), basis(k + 1));
    }
    return gmres_vectors;
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
  /// Enqueues the removal of the parts of vector `count` of the basis along the vectors before it. `products`: the
  /// products with them, on the device.
  void subtract_basis(int count, double* products) const {
    const dim3 blocks(product_blocks, static_cast<unsigned>((count + products_at_once - 1) / products_at_once));
    increment_basis_products<<<blocks, increment_threads, 0, team_.stream()>>>(degrees_, count, basis_.data(),
                                                                               basis(count), partial_.data());
    check_launch("products", team_.stream());
    gradients_.run("sums", increment_sum_products, static_cast<unsigned>(count), partial_.data(), product_blocks,
                   products);
    gradients_.run("subtract", increment_subtract_basis, product_blocks, degrees_, count, products, basis_.data(),
                   basis(count), m_.gradients.products);
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
  DeviceArray<double> basis_, partial_, column_;
  PinnedCopies<double> columns_;
  double h_[gmres_vectors][gmres_vectors + 1] = {}, answer_[gmres_vectors + 1] = {};
};

}  // namespace macadam::kernels
