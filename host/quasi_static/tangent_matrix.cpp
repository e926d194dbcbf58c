// SPDX-License-Identifier: GPL-3.0-or-later
// tangent_matrix.cpp  Computes the blocks Gᵀ·K·G of each contact. Rows are independent of one another, so that threads
// need no locks and the bits do not depend on their number.
#include "host/quasi_static/tangent_matrix.hpp"

#include <algorithm>

#include "host/quasi_static/pieces.hpp"

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

/// Number of rows in a piece of parallel work.
static constexpr std::size_t rows_at_once = 256;

void TangentMatrix::assemble(const ContactIncrements& contacts, bool symmetric) {
  symmetric_ = symmetric;
  for_pieces(particles(), rows_at_once, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      Block sum = Block::Zero();
      Eigen::Matrix<double, 6, 1> top = Eigen::Matrix<double, 6, 1>::Zero();
      std::size_t at = begin_[i];
      for (const std::uint32_t number : network_.row(i)) {
        const Contact& c = network_.contacts[number];
        Block k = Eigen::Map<const Block>(contacts.stiffness(number).data());
        if (symmetric) k = (0.5 * (k + k.transpose())).eval();
        const int end = c.a == static_cast<std::int32_t>(i) ? 0 : 1;
        const SixBySix own = motion_matrix(c, end), far = motion_matrix(c, 1 - end);
        const Block left = Eigen::Map<const Block>(own.data()).transpose() * k;
        sum.noalias() += left * Eigen::Map<const Block>(own.data());
        if (c.b >= 0)
          blocks_[at++].noalias() = left * Eigen::Map<const Block>(far.data());
        else if (c.b == wall_z_hi)
          top.noalias() += left * Eigen::Map<const Block>(far.data()).col(2);
      }
      diagonal_[i] = sum;
      std::copy(top.data(), top.data() + 6, top_.begin() + static_cast<std::ptrdiff_t>(6 * i));
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
