// SPDX-License-Identifier: GPL-3.0-or-later
/// \file linear_solver.hpp  (K*(s) − inertia·M)·u = f, by whichever means.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "host/harmonic/contact_operator.hpp"
#include "host/harmonic/rigid_motions.hpp"
#include "macadam/error.hpp"
#include "macadam/specimen.hpp"

namespace macadam::harmonic {

/// One system to be solved: six numbers a particle.
struct LinearTask {
  PairStiffness stiffness;
  Complex inertia = 0;   ///< −(s² + s·β)·density scaling; 0: without inertia
  Loads right;           ///< f: nothing on all other particles
  double tolerance = 0;  ///< of ‖f − K·u‖ / ‖f‖
  double energy_limit = std::numeric_limits<double>::infinity();  ///< of rᴴ·P⁻¹·r, P the solver's preconditioner
  Vector motion;                                                  ///< where to begin, then the solution
  /// rᴴ·P⁻¹·r of the solution's residual, computed anew: that of the iteration has gathered rounding.
  double energy = 0;
  int iterations = 0;      ///< added to
  bool converged = false;  ///< by the solver's own residual, which rounding may have parted from the true one
};

/// A way of solving, made ready for one network. Motions of the whole that nothing resists stay out of the solutions,
/// or are held by pins without force.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// \throws InterruptedError where `stop`, if there is one, says so.
  virtual void solve(const std::vector<LinearTask*>& tasks, const std::function<bool()>& stop) = 0;
};

/// \throws InterruptedError where `stop`, if there is one, says so.
void require_not_stopped(const std::function<bool()>& stop);

/// Preconditioned by Cholesky factors of Re K at one frequency: some ten iterations, but memory grows as n^(4/3).
/// \throws RunError when the stiffness is singular, or memory does not suffice.
std::unique_ptr<LinearSolver> make_direct_solver(const ContactNetwork& network, const ContactOperator& contacts,
                                                 const PairStiffness& typical, const Inertia& inertia,
                                                 const FreeMotions& free);

/// The iteration cannot be set up for this network; factors may do.
class NotIterable : public RunError {
 public:
  using RunError::RunError;
};

/// Boxes of particles that make_iterative_solver() takes: more take fewer iterations, but a dense matrix that grows as
/// their square.
std::size_t usual_boxes(std::size_t particles);

/// Preconditioned by each particle itself and by the rigid motions of boxes of particles: no factors but of a small
/// matrix. Up to four tasks are solved side by side. `backend`: cpu, or cuda on `devices`, where all of the iteration
/// runs. `boxes`: another number of them, about; 0: each particle alone. \throws NotIterable when
/// a particle alone can move without force, or the whole in more than six ways; RunError when a device has too little
/// memory.
std::unique_ptr<LinearSolver> make_iterative_solver(const Specimen& specimen, const ContactNetwork& network,
                                                    const PairStiffness& typical, const Inertia& inertia,
                                                    const FreeMotions& free, Backend backend = Backend::cpu,
                                                    const DeviceList& devices = {},
                                                    std::optional<std::size_t> boxes = {});

}  // namespace macadam::harmonic
