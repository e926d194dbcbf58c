// SPDX-License-Identifier: GPL-3.0-or-later
// direct_solver.cpp  Solves by COCG (conjugate gradients for complex symmetric matrices) with a real Cholesky
// preconditioner.
//
// K*(s) is a sum over the contacts, in which each contact has the complex stiffness of its pair type as a factor. The
// preconditioner is the same sum with the real parts of these stiffnesses at one frequency. The eigenvalues of the
// preconditioned matrix lie close to the ratios of complex stiffness to real part. There are only a few such ratios,
// one for each pair type, so about ten iterations suffice.
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/harmonic/direct/cholesky.hpp"
#include "host/harmonic/linear_solver.hpp"

namespace macadam::harmonic {
namespace {

constexpr int most_iterations = 500;

/// Returns xᵀ·y without conjugates, summed in a fixed order.
Complex product(const Vector& x, const Vector& y) {
  Complex sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}
/// Returns rᴴ·z, not below 0.
double energy_of(const Vector& r, const Vector& z) {
  double sum = 0;
  for (std::size_t i = 0; i < r.size(); ++i) sum += (std::conj(r[i]) * z[i]).real();
  return std::max(sum, 0.0);  // the sum may be negative if r consists of rounding errors only
}
/// The solver that make_direct_solver() returns.
class DirectSolver : public LinearSolver {
 public:
  DirectSolver(const ContactNetwork& network, const ContactOperator& contacts, const PairStiffness& typical,
               const Inertia& inertia, const FreeMotions& free)
      : contacts_(contacts),
        inertia_(inertia),
        free_(free),
        factors_(network, inertia.mass.size(), typical, free.pins) {}

  void solve(const std::vector<LinearTask*>& tasks, const std::function<bool()>& stop) override {
    for (LinearTask* task : tasks) solve(*task, stop);
  }

 private:
  /// Solves a task, then computes its energy rᴴ·P⁻¹·r from r = f − K·x. The r that the iteration updates is not used
  /// for this, because it has accumulated rounding errors.
  void solve(LinearTask& task, const std::function<bool()>& stop) const {
    iterate(task, stop);
    Vector r, z;
    rest(task, r);
    precondition(task, r, z);
    task.energy = energy_of(r, z);
  }

  /// Iterates until the task has converged, at most most_iterations times.
  void iterate(LinearTask& task, const std::function<bool()>& stop) const {
    Vector& x = task.motion;
    if (x.empty()) x.assign(6 * inertia_.mass.size(), 0);
    Vector r, z, p, q;
    rest(task, r);
    const double scale = length(task.right);
    Complex rho_before = 0;
    for (int k = 0;; ++k) {
      require_not_stopped(stop);
      precondition(task, r, z);
      task.energy = energy_of(r, z);
      const double residual = length(r) / scale;
      task.converged = residual <= task.tolerance && task.energy <= task.energy_limit;
      if (task.converged || k >= most_iterations || !std::isfinite(residual)) return;
      const Complex rho = product(r, z);
      if (k == 0) {
        p = z;
      } else {
        const Complex beta = rho / rho_before;
        for (std::size_t i = 0; i < p.size(); ++i) p[i] = z[i] + beta * p[i];
      }
      apply(task, p, q);
      const Complex alpha = rho / product(p, q);
      for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] += alpha * p[i];
        r[i] -= alpha * q[i];
      }
      rho_before = rho;
      ++task.iterations;
    }
  }

  /// Computes the residual r = f − K·x.
  void rest(const LinearTask& task, Vector& r) const {
    apply(task, task.motion, r);
    for (Complex& z : r) z = -z;
    for (const ParticleLoad& f : task.right) {
      for (std::size_t c = 0; c < 6; ++c) r[6 * static_cast<std::size_t>(f.particle) + c] += f.load[c];
    }
  }

  /// Computes z = P⁻¹·r.
  void precondition(const LinearTask& task, const Vector& r, Vector& z) const {
    factors_.solve(r, z);
    // The load does not act on the free motions, so with inertia they are absent from the solution. The preconditioner,
    // which has pins in place of inertia, would add some of these motions to z. Without removing them, the number of
    // iterations would triple.
    if (task.inertia == 0.0) return;
    for (const FreeMotion& motion : free_.motions) motion.remove_from(z, inertia_);
  }

  /// Computes out = (K* − inertia·M)·x with inertia, or (K* + pins)·x without. With inertia the matrix is not singular,
  /// so free motions need no pins.
  void apply(const LinearTask& task, const Vector& x, Vector& out) const {
    contacts_.resistance(task.stiffness, task.inertia, inertia_, x, out);
    if (task.inertia != 0.0) return;
    for (const Pin& pin : free_.pins) {
      const Complex force = pin.force(x);
      for (std::size_t c = 0; c < 6; ++c) out[6 * pin.particle + c] += pin.direction[c] * force;
    }
  }

  const ContactOperator& contacts_;
  const Inertia& inertia_;
  const FreeMotions& free_;
  Cholesky factors_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_direct_solver(const ContactNetwork& network, const ContactOperator& contacts,
                                                 const PairStiffness& typical, const Inertia& inertia,
                                                 const FreeMotions& free) {
  return std::make_unique<DirectSolver>(network, contacts, typical, inertia, free);
}

}  // namespace macadam::harmonic
