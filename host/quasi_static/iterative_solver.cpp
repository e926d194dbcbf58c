// SPDX-License-Identifier: GPL-3.0-or-later
// iterative_solver.cpp  Solves large systems by conjugate gradients, or by GMRES if the matrix is not symmetric. Sums
// have a fixed order, so that the bits do not depend on the number of threads.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "host/quasi_static/rigid_boxes.hpp"
#include "host/quasi_static/tangent_solver.hpp"
#include "kernels/base/parallel.hpp"
#include "kernels/quasi_static/increment_system.hpp"
#include "kernels/quasi_static/particle_inverse.hpp"

namespace macadam::quasi_static {
namespace {

constexpr std::size_t degrees_at_once = 6144;  ///< degrees of freedom per piece of parallel work
constexpr double particles_per_box = 60;
/// The preconditioner is made again when a solution takes this many times the iterations of the first one with it.
constexpr double more_iterations = 1.3;
constexpr std::size_t restart = kernels::gmres_vectors;

double product(const Vector& a, const Vector& b) {
  return sum_in_parallel<double>(a.size(), [&](std::size_t i) { return a[i] * b[i]; });
}

/// Computes y += a·x.
void add_multiple(double a, const Vector& x, Vector& y) {
  for_pieces(x.size(), degrees_at_once, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) y[i] += a * x[i];
  });
}

/// Computes y = x/a.
void divide(const Vector& x, double a, Vector& y) {
  y.resize(x.size());
  for_pieces(x.size(), degrees_at_once, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) y[i] = x[i] / a;
  });
}

class IterativeSolver : public TangentSolver {
 public:
  explicit IterativeSolver(const Specimen& specimen) : boxes_(specimen, particles_per_box) {}
  bool wants_symmetric() const override { return true; }
  const char* name() const override { return "iterative solver"; }

  LinearReport prepare(const TangentMatrix& matrix) override {
    matrix_ = &matrix;
    if (inverse_.empty() || stale_) make_preconditioner();
    LinearReport out;
    out.solved = true;
    return out;
  }

  LinearReport solve(const Vector& right, Vector& x, double tolerance) override {
    LinearReport out = matrix_->is_symmetric() ? conjugate_gradients(right, x, tolerance) : gmres(right, x, tolerance);
    // A tolerance and its number of iterations are compared by the mean gain per iteration
    const double rate = out.iterations / -std::log(std::min(tolerance, 0.5));
    double& first = first_rate_[matrix_->is_symmetric()];
    if (first == 0) first = rate;
    stale_ = rate > more_iterations * first || !out.solved;
    return out;
  }

 private:
  void make_preconditioner() {
    const TangentMatrix& k = *matrix_;
    inverse_.resize(k.particles());
    for_pieces(6 * k.particles(), degrees_at_once, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from / 6; i < to / 6; ++i) {
        double block[36];
        Eigen::Map<Block>(block, 6, 6) = k.diagonal(i);
        kernels::invert_particle_block(block);
        inverse_[i] = Eigen::Map<const Block>(block, 6, 6);
      }
    });
    boxes_.factor(k);
    stale_ = false;
    first_rate_ = {};
  }

  void precondition(const Vector& r, Vector& z) const {
    using Six1 = Eigen::Matrix<double, 6, 1>;
    z.resize(r.size());
    for_pieces(r.size(), degrees_at_once, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from / 6; i < to / 6; ++i)
        Eigen::Map<Six1>(&z[6 * i]).noalias() = inverse_[i] * Eigen::Map<const Six1>(&r[6 * i]);
    });
    boxes_.add_solution(r, z);
  }

  LinearReport conjugate_gradients(const Vector& right, Vector& x, double tolerance) {
    LinearReport out;
    x.assign(right.size(), 0.0);
    r_ = right;
    precondition(r_, z_);
    p_ = z_;
    double rz = product(r_, z_);
    const double goal = tolerance * tolerance * rz;
    if (!(rz > 0)) return out.solved = rz == 0, out;
    while (out.iterations < kernels::most_increment_iterations) {
      ++out.iterations;
      matrix_->multiply(p_, q_);
      const double curvature = product(p_, q_);
      if (!(curvature > 0)) {
        out.negative = curvature < 0;
        return out;
      }
      const double step = rz / curvature;
      for_pieces(x.size(), degrees_at_once, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) x[i] += step * p_[i], r_[i] -= step * q_[i];
      });
      precondition(r_, z_);
      const double next = product(r_, z_);
      if (next <= goal) return out.solved = true, out;
      const double keep = next / rz;
      rz = next;
      for_pieces(x.size(), degrees_at_once, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) p_[i] = z_[i] + keep * p_[i];
      });
    }
    return out;
  }

  /// Restarted GMRES with the preconditioner on the right.
  LinearReport gmres(const Vector& right, Vector& x, double tolerance) {
    LinearReport out;
    x.assign(right.size(), 0.0);
    const double goal = tolerance * std::sqrt(product(right, right));
    if (goal == 0) return out.solved = true, out;
    std::vector<Vector> basis(restart + 1);
    Eigen::MatrixXd h(restart + 1, restart);
    double before = 0;  // residual of the last start
    while (out.iterations < kernels::most_increment_iterations) {
      matrix_->multiply(x, q_);
      r_ = right;
      add_multiple(-1, q_, r_);
      const double size = std::sqrt(product(r_, r_));
      if (size <= goal) return out.solved = true, out;
      if (kernels::is_too_slow(before, size, goal, kernels::most_increment_iterations - out.iterations)) return out;
      before = size;
      divide(r_, size, basis[0]);
      h.setZero();
      Eigen::VectorXd left = Eigen::VectorXd::Zero(restart + 1), answer;
      left(0) = size;
      std::size_t used = 0;
      for (std::size_t k = 0; k < restart; ++k) {
        ++out.iterations;
        precondition(basis[k], z_);
        matrix_->multiply(z_, basis[k + 1]);
        for (std::size_t j = 0; j <= k; ++j) {
          const double along = product(basis[k + 1], basis[j]);
          h(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)) = along;
          add_multiple(-along, basis[j], basis[k + 1]);
        }
        const double remains = std::sqrt(product(basis[k + 1], basis[k + 1]));
        const auto n = static_cast<Eigen::Index>(k) + 1;
        h(n, n - 1) = remains;
        used = k + 1;
        const Eigen::MatrixXd part = h.topLeftCorner(n + 1, n);
        answer = part.colPivHouseholderQr().solve(left.head(n + 1));
        if ((part * answer - left.head(n + 1)).norm() <= goal || !(remains > 0)) break;
        divide(basis[k + 1], remains, basis[k + 1]);
      }
      q_.assign(x.size(), 0.0);
      for (std::size_t k = 0; k < used; ++k) add_multiple(answer(static_cast<Eigen::Index>(k)), basis[k], q_);
      precondition(q_, z_);
      add_multiple(1, z_, x);
    }
    return out;
  }

  RigidBoxes boxes_;
  const TangentMatrix* matrix_ = nullptr;
  std::vector<Eigen::Matrix<double, 6, 6>> inverse_;
  std::array<double, 2> first_rate_{};  ///< with the present preconditioner, of GMRES and of conjugate gradients
  bool stale_ = false;
  Vector r_, z_, p_, q_;
};

}  // namespace

std::unique_ptr<TangentSolver> make_iterative_solver(const Specimen& specimen) {
  return std::make_unique<IterativeSolver>(specimen);
}

}  // namespace macadam::quasi_static
