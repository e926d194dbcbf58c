// SPDX-License-Identifier: GPL-3.0-or-later
/// \file linear_solver.hpp  Defines the linear systems (K*(s) − inertia·M)·u = f of the frequency domain, and the
/// interface of the two solvers, iterative and direct.
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

/// One linear system: its matrix and load, the start of the iteration, the required accuracy, and the solution. All
/// vectors have six numbers per particle.
struct LinearTask {
  PairStiffness stiffness;
  Complex inertia = 0;   ///< −(s² + s·β)·density scaling; 0: without inertia
  WallMotion wall;       ///< motion of the walls, which causes the load
  Loads right;           ///< f; particles that are not listed have no load
  double tolerance = 0;  ///< largest accepted ‖f − K·u‖ / ‖f‖
  /// Largest accepted rᴴ·P⁻¹·r, where P is the solver's preconditioner.
  double energy_limit = std::numeric_limits<double>::infinity();
  Vector motion;  ///< the start of the iteration (empty: at rest), then the solution
  /// rᴴ·P⁻¹·r of the solution. The residual r is computed from the solution, because the residual that the iteration
  /// updates has accumulated rounding errors.
  double energy = 0;
  int iterations = 0;  ///< increased by the iterations of each solve()
  /// Whether tolerance and energy limit are met, judged by the residual that the iteration updates; rounding errors
  /// make it differ from the true residual.
  bool converged = false;
};

/// A solver with a preconditioner that is made for one network. Free motions of the specimen (motions that no contact
/// resists) are removed from the solutions, or held by pins (springs to ground) that carry no force.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// Solves all tasks and stores the results in them. Tasks that do not converge have `converged` false.
  /// \throws InterruptedError when `stop` is given and returns true.
  virtual void solve(const std::vector<LinearTask*>& tasks, const std::function<bool()>& stop) = 0;
};

/// \throws InterruptedError when `stop` is given and returns true.
void require_not_stopped(const std::function<bool()>& stop);

/// Returns the direct solver: COCG preconditioned by Cholesky factors of Re K at one frequency. A solution takes about
/// ten iterations, but the memory of the solver grows as n^(4/3) with the number n of particles.
/// \throws RunError when the stiffness is singular or memory does not suffice.
std::unique_ptr<LinearSolver> make_direct_solver(const ContactNetwork& network, const ContactOperator& contacts,
                                                 const PairStiffness& typical, const Inertia& inertia,
                                                 const FreeMotions& free);

/// Thrown when the iterative solver cannot be set up for this network. The direct solver may still work.
class NotIterable : public RunError {
 public:
  using RunError::RunError;
};

/// Returns the number of boxes of particles that make_iterative_solver() uses by default. More boxes take fewer
/// iterations, but the dense coarse matrix grows as the square of their number.
std::size_t usual_boxes(std::size_t particles);

/// Returns the iterative solver: COCG preconditioned by each particle's own stiffness block and by the rigid motions of
/// boxes of particles. Only the small matrix of the boxes is factored. Up to four tasks are solved side by side.
/// `backend` is cpu or cuda; with cuda the whole iteration runs on `devices`. `boxes`, if given, is the approximate
/// number of boxes, in place of usual_boxes(). With 0 boxes the preconditioner has only the blocks of single particles.
/// \throws NotIterable when a single particle can move without force or the specimen has more than six free motions;
/// RunError when a device has too little memory.
std::unique_ptr<LinearSolver> make_iterative_solver(const Specimen& specimen, const ContactNetwork& network,
                                                    const PairStiffness& typical, const Inertia& inertia,
                                                    const FreeMotions& free, Backend backend = Backend::cpu,
                                                    const DeviceList& devices = {},
                                                    std::optional<std::size_t> boxes = {});

}  // namespace macadam::harmonic
