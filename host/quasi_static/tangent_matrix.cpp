// SPDX-License-Identifier: GPL-3.0-or-later
// tangent_matrix.cpp  Computes the blocks Gᵀ·K·G of each contact. Rows are independent of one another, so that threads
// need no locks and the bits do not depend on their number.
#include "host/quasi_static/tangent_matrix.hpp"

#include <algorithm>

#include "kernels/base/parallel.hpp"

namespace macadam::quasi_static {
TangentMatrix::TangentMatrix(const ContactNetwork& network, std::size_t particles)
    : network_(network), diagonal_(particles), begin_(1, 0), top_(6 * particles) {
  for (std::size_t i = 0; i < particles; ++i) {
    for (const std::uint32_t number : network.row(i)) {
      const Contact& c = network.contacts[number];
      if (c.b >= 0) far_.push_back(c.a == static_cast<std::int32_t>(i) ? c.b : c.a);
    }
    begin_.push_back(far_.size());
  }
  blocks_.resize(far_.size());
}

namespace {

/// Number of rows in a piece of parallel work.
constexpr std::size_t rows_at_once = 256;

/// Computes out = Gᵀ·k, where G is the motion matrix of an end of the contact (motion_matrix()). Half of the numbers in
/// G are zero, and each row of the result is a sum of three or five rows of k.
void project(const Contact& c, int end, const SixBySix& k, SixBySix& out) {
  const double sign = end == 0 ? -1 : 1, arm = end == 0 ? c.arm_a : c.arm_b;
  const double* row[6];
  for (std::size_t i = 0; i < 6; ++i) row[i] = &k[6 * i];
  std::size_t at = 0;
  for (double Vec3d::*x : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
    const double n = sign * (c.n.*x), s = sign * (c.s.*x), t = sign * (c.t.*x), across = arm * (c.s.*x),
                 along = arm * (c.t.*x);
    for (std::size_t j = 0; j < 6; ++j) {
      out[6 * at + j] = n * row[0][j] + s * row[3][j] + t * row[4][j];
      out[6 * (at + 3) + j] = s * row[2][j] - t * row[1][j] + n * row[5][j] + (across * row[4][j] - along * row[3][j]);
    }
    ++at;
  }
}

void transpose(const SixBySix& k, SixBySix& out) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) out[6 * j + i] = k[6 * i + j];
  }
}

}  // namespace

void TangentMatrix::assemble(const ContactIncrements& contacts, bool symmetric) {
  symmetric_ = symmetric;
  for_pieces(particles(), rows_at_once, [&](std::size_t from, std::size_t to) {
    SixBySix k, left, turned, product;
    for (std::size_t i = from; i < to; ++i) {
      SixBySix sum{};
      Six top{};
      std::size_t at = begin_[i];
      for (const std::uint32_t number : network_.row(i)) {
        const Contact& c = network_.contacts[number];
        const SixBySix& own = contacts.stiffness(number);
        const int end = c.a == static_cast<std::int32_t>(i) ? 0 : 1;
        transpose(own, turned);
        if (symmetric) {
          for (std::size_t j = 0; j < 36; ++j) k[j] = 0.5 * (own[j] + turned[j]);
        } else {
          k = own;
        }
        // Gᵀ·K·G is the transpose of Gᵀ·(Gᵀ·K)ᵀ
        project(c, end, k, left);
        transpose(left, turned);
        project(c, end, turned, product);
        for (std::size_t j = 0; j < 36; ++j) sum[j] += product[j];
        if (c.b >= 0 || c.b == wall_z_hi) project(c, 1 - end, turned, product);
        if (c.b >= 0) {
          Block& block = blocks_[at++];
          for (std::size_t r = 0; r < 6; ++r) {
            for (std::size_t j = 0; j < 6; ++j) block.data()[6 * r + j] = product[6 * j + r];
          }
        } else if (c.b == wall_z_hi) {
          for (std::size_t j = 0; j < 6; ++j) top[j] += product[12 + j];
        }
      }
      transpose(sum, turned);
      std::copy(turned.begin(), turned.end(), diagonal_[i].data());
      std::copy(top.begin(), top.end(), top_.begin() + static_cast<std::ptrdiff_t>(6 * i));
    }
  });
}

void TangentMatrix::multiply(const Vector& x, Vector& out) const {
  using Six1 = Eigen::Matrix<double, 6, 1>;
  out.resize(x.size());
  for_pieces(particles(), rows_at_once, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      Six1 sum = diagonal_[i] * Eigen::Map<const Six1>(&x[6 * i]);
      for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k)
        sum.noalias() += blocks_[k] * Eigen::Map<const Six1>(&x[6 * static_cast<std::size_t>(far_[k])]);
      std::copy(sum.data(), sum.data() + 6, out.begin() + static_cast<std::ptrdiff_t>(6 * i));
    }
  });
}

}  // namespace macadam::quasi_static
