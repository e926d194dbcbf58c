// SPDX-License-Identifier: GPL-3.0-or-later
// invert.cpp  Computes the Cholesky factors by blocks, then the columns of the inverse by triangular solves. Eigen
// would use only one thread for the factorisation and the solves.
#include "host/harmonic/iterative/invert.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <vector>

#include "kernels/base/parallel.hpp"

namespace macadam::harmonic {
namespace {

constexpr Eigen::Index width = 48;  ///< rows of a block: small enough to give work to a dozen threads

/// A matrix seen as square blocks.
struct Blocks {
  Eigen::MatrixXd& matrix;
  Eigen::Index count = (matrix.rows() + width - 1) / width;

  Eigen::Index size(Eigen::Index k) const { return std::min(width, matrix.rows() - width * k); }
  Eigen::Block<Eigen::MatrixXd> at(Eigen::Index i, Eigen::Index j) const {
    return matrix.block(width * i, width * j, size(i), size(j));
  }
};

/// Replaces the lower triangle by its Cholesky factor L; the upper triangle is not touched. Returns false if the matrix
/// is not positive definite.
bool factor(const Blocks& blocks) {
  for (Eigen::Index j = 0; j < blocks.count; ++j) {
    const Eigen::LLT<Eigen::MatrixXd> own(blocks.at(j, j));
    if (own.info() != Eigen::Success) return false;
    const Eigen::MatrixXd low = own.matrixL();
    blocks.at(j, j) = low;
    const Eigen::Index below = blocks.count - j - 1;
    for_each_in_parallel(static_cast<std::size_t>(below), [&](std::size_t k) {
      auto block = blocks.at(j + 1 + static_cast<Eigen::Index>(k), j);
      low.transpose().triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(block);
    });
    std::vector<std::pair<Eigen::Index, Eigen::Index>> rest;
    for (Eigen::Index i = j + 1; i < blocks.count; ++i) {
      for (Eigen::Index k = j + 1; k <= i; ++k) rest.emplace_back(i, k);
    }
    for_each_in_parallel(rest.size(), [&](std::size_t number) {
      const auto [i, k] = rest[number];
      blocks.at(i, k).noalias() -= blocks.at(i, j) * blocks.at(k, j).transpose();
    });
  }
  return true;
}

}  // namespace

bool invert_in_parallel(Eigen::MatrixXd& matrix) {
  const Blocks blocks{matrix};
  if (!factor(blocks)) return false;
  const Eigen::Index size = matrix.rows();
  Eigen::MatrixXd inverse(size, size);
  // The inverse is symmetric. So each block of columns is computed from the diagonal downwards, and the part above the
  // diagonal is copied from it.
  for_each_in_parallel(static_cast<std::size_t>(blocks.count), [&](std::size_t number) {
    const auto j = static_cast<Eigen::Index>(number);
    const Eigen::Index first = width * j, rest = size - first, columns = blocks.size(j);
    const auto low = matrix.bottomRightCorner(rest, rest).triangularView<Eigen::Lower>();
    Eigen::MatrixXd x = Eigen::MatrixXd::Identity(rest, columns);
    low.solveInPlace(x);
    low.transpose().solveInPlace(x);
    inverse.block(first, first, rest, columns) = x;
    inverse.block(first, first, columns, rest) = x.transpose();
  });
  matrix = std::move(inverse);
  return true;
}

}  // namespace macadam::harmonic
