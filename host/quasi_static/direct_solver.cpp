// SPDX-License-Identifier: GPL-3.0-or-later
// direct_solver.cpp  Solves small systems by the factors of Eigen. The signs of the pivots of LDLᵀ tell whether the
// equilibrium is stable.
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <cmath>

#include "host/quasi_static/tangent_solver.hpp"

namespace macadam::quasi_static {
namespace {

class DirectSolver : public TangentSolver {
 public:
  bool wants_symmetric() const override { return false; }
  const char* name() const override { return "direct solver"; }

  LinearReport prepare(const TangentMatrix& matrix) override {
    std::vector<Eigen::Triplet<double>> entries;
    double asymmetry = 0;
    matrix.for_each_block([&](std::size_t i, std::size_t j, const Block& block) {
      for (int r = 0; r < 6; ++r) {
        for (int c = 0; c < 6; ++c)
          entries.emplace_back(static_cast<int>(6 * i) + r, static_cast<int>(6 * j) + c, block(r, c));
      }
      if (i == j) asymmetry = std::max(asymmetry, (block - block.transpose()).norm() / (block.norm() + 1e-300));
    });
    const auto n = static_cast<Eigen::Index>(6 * matrix.particles());
    Eigen::SparseMatrix<double> full(n, n);
    full.setFromTriplets(entries.begin(), entries.end());
    symmetric_ = asymmetry < 1e-10;
    const Eigen::SparseMatrix<double> even = 0.5 * (full + Eigen::SparseMatrix<double>(full.transpose()));
    if (!analysed_) {
      cholesky_.analyzePattern(even);
      analysed_ = true;
    }
    cholesky_.factorize(even);
    LinearReport out;
    const bool factored = cholesky_.info() == Eigen::Success;
    if (factored) out.negative_pivots = static_cast<int>((cholesky_.vectorD().array() < 0).count());
    out.negative = out.negative_pivots > 0;
    if (!factored) symmetric_ = false;
    if (!symmetric_) {
      full.makeCompressed();
      lu_.compute(full);
      out.solved = lu_.info() == Eigen::Success;
    } else {
      out.solved = true;
    }
    return out;
  }

  LinearReport solve(const Vector& right, Vector& x, double) override {
    const Eigen::Map<const Eigen::VectorXd> b(right.data(), static_cast<Eigen::Index>(right.size()));
    const Eigen::VectorXd found = symmetric_ ? Eigen::VectorXd(cholesky_.solve(b)) : Eigen::VectorXd(lu_.solve(b));
    x.assign(found.data(), found.data() + found.size());
    LinearReport out;
    out.solved = found.allFinite();
    return out;
  }

 private:
  bool analysed_ = false, symmetric_ = true;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> cholesky_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu_;
};

}  // namespace

std::unique_ptr<TangentSolver> make_direct_solver() { return std::make_unique<DirectSolver>(); }

}  // namespace macadam::quasi_static
