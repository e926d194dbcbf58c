// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tangent_matrix.hpp  Assembles the tangent stiffness of a specimen from its contacts, in blocks of 6 × 6.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "host/quasi_static/contact_increments.hpp"

namespace macadam::quasi_static {

using Vector = std::vector<double>;  ///< [6·particles]: three displacements and three rotations per particle
using Block = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// The derivatives of the loads on the particles with respect to their motions, row by row.
class TangentMatrix {
 public:
  TangentMatrix(const ContactNetwork& network, std::size_t particles);

  /// Computes all blocks. `symmetric`: of the symmetric part of the contacts' stiffnesses.
  void assemble(const ContactIncrements& contacts, bool symmetric);
  bool is_symmetric() const { return symmetric_; }
  /// Takes blocks that another processor has assembled: the diagonal block of each row and then its other blocks in the
  /// order of ContactNetwork::row(), each of them [6][6] column by column. first(particle): number of the first block
  /// of a row. The top column is not known then.
  template <class F>
  void set(const std::vector<double>& numbers, bool symmetric, F&& first) {
    symmetric_ = symmetric;
    for (std::size_t i = 0; i < particles(); ++i) {
      const auto block = [&, from = &numbers[36 * first(i)]](std::size_t k) {
        return Eigen::Map<const Eigen::Matrix<double, 6, 6>>(from + 36 * k);
      };
      diagonal_[i] = block(0);
      for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k) blocks_[k] = block(1 + k - begin_[i]);
    }
  }

  std::size_t particles() const { return diagonal_.size(); }
  const Block& diagonal(std::size_t particle) const { return diagonal_[particle]; }
  /// Adds to the diagonal, for example a small part of the intact stiffness.
  void add_to_diagonal(std::size_t degree, double value) {
    diagonal_[degree / 6](static_cast<Eigen::Index>(degree % 6), static_cast<Eigen::Index>(degree % 6)) += value;
  }
  /// Computes out = K·x.
  void multiply(const Vector& x, Vector& out) const;
  /// Derivatives of the loads with respect to the displacement of the top wall along z.
  const Vector& top_column() const { return top_; }

  /// Calls f(row particle, column particle, block) for all blocks, row by row.
  template <class F>
  void for_each_block(F&& f) const {
    for (std::size_t i = 0; i < particles(); ++i) {
      f(i, i, diagonal_[i]);
      for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k) f(i, static_cast<std::size_t>(far_[k]), blocks_[k]);
    }
  }
  /// Calls f(column particle, block) for the blocks of a row.
  template <class F>
  void for_each_block_of(std::size_t i, F&& f) const {
    f(i, diagonal_[i]);
    for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k) f(static_cast<std::size_t>(far_[k]), blocks_[k]);
  }
  std::int64_t bytes() const { return static_cast<std::int64_t>((diagonal_.size() + blocks_.size()) * sizeof(Block)); }

 private:
  const ContactNetwork& network_;
  bool symmetric_ = true;
  std::vector<Block> diagonal_, blocks_;
  std::vector<std::size_t> begin_;  ///< of each particle in blocks_
  std::vector<std::int32_t> far_;   ///< other particle of each block
  Vector top_;
};

}  // namespace macadam::quasi_static
