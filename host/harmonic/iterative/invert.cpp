// SPDX-License-Identifier: GPL-3.0-or-later
// invert.cpp  Cholesky factors block by block, and then columns of the inverse. Eigen does this by one thread.
#include "host/harmonic/iterative/invert.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <vector>

#include "kernels/parallel.hpp"

namespace macadam::harmonic {
namespace {

constexpr Eigen::Index width = 48;  ///< of a block: small enough for a dozen threads

struct Blocks {
  Eigen::MatrixXd& matrix;
  Eigen::Index count = (matrix.rows() + width - 1) / width;

  Eigen::Index size(Eigen::Index k) const { return std::min(width, matrix.rows() - width * k); }
  Eigen::Block<Eigen::MatrixXd> at(Eigen::Index i, Eigen::Index j) const {
    return matrix.block(width * i, width * j, size(i), size(j));
  }
};

/// The lower triangle by its factor L; what is above keeps what it has.
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
  // The inverse is symmetric: of a block of columns, the part from the diagonal down is computed, and mirrored.
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
