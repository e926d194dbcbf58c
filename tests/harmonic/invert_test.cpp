// SPDX-License-Identifier: GPL-3.0-or-later
// invert_test.cpp  Tests the parallel inverse of a dense matrix, for sizes below, at and above the block size.
#include "host/harmonic/iterative/invert.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <limits>

namespace macadam::test {
namespace {

/// Returns a symmetric matrix with eigenvalues of at least 1. For a large size the largest eigenvalue is about
/// 4/3·`size`, because the entries of `a` are uniform in [−1, 1] and have variance 1/3.
Eigen::MatrixXd positive_matrix(Eigen::Index size) {
  std::srand(1);  // seeds the random numbers of Eigen
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(size, size);
  return a * a.transpose() + Eigen::MatrixXd::Identity(size, size);
}

TEST(Invert, TimesTheMatrixIsOne) {
  for (const Eigen::Index size : {1, 6, 47, 48, 49, 96, 200}) {
    const Eigen::MatrixXd matrix = positive_matrix(size);
    Eigen::MatrixXd inverse = matrix;
    inverse.triangularView<Eigen::StrictlyUpper>().setConstant(std::numeric_limits<double>::quiet_NaN());
    ASSERT_TRUE(harmonic::invert_in_parallel(inverse)) << size;
    // Condition number × rounding × number of terms is at most about 270 × 1.1e-16 × 200 = 6e-12. The bound is eight
    // times as large.
    EXPECT_LT((inverse - inverse.transpose()).cwiseAbs().maxCoeff(), 5e-11) << size;
    EXPECT_LT((matrix * inverse - Eigen::MatrixXd::Identity(size, size)).cwiseAbs().maxCoeff(), 5e-11) << size;
  }
}

TEST(Invert, SameBitsForAnyNumberOfThreads) {
  const Eigen::MatrixXd matrix = positive_matrix(150);
  const int before = omp_get_max_threads();
  Eigen::MatrixXd first;
  for (const int threads : {1, 2, 5}) {
    omp_set_num_threads(threads);
    Eigen::MatrixXd inverse = matrix;
    ASSERT_TRUE(harmonic::invert_in_parallel(inverse));
    if (threads == 1) first = inverse;
    EXPECT_TRUE(inverse == first) << threads;
  }
  omp_set_num_threads(before);
}

// The matrix has one eigenvalue of −1, which appears only in the last block.
TEST(Invert, AMatrixThatIsNotPositiveDefiniteIsRefused) {
  Eigen::MatrixXd matrix = positive_matrix(100);
  matrix.bottomRows(1).setZero();
  matrix.rightCols(1).setZero();
  matrix(99, 99) = -1;
  EXPECT_FALSE(harmonic::invert_in_parallel(matrix));
}

}  // namespace
}  // namespace macadam::test
