// SPDX-License-Identifier: GPL-3.0-or-later
// harmonic.cpp  Makes a linear system of each problem (a load at a frequency), solves the system, checks the solution,
// and computes E* from it. Systems that the iterative solver cannot solve go to the direct solver.
#include "macadam/harmonic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/harmonic/cell_pressure.hpp"
#include "host/harmonic/check_solutions.hpp"
#include "host/harmonic/linear_solver.hpp"
#include "host/harmonic/harmonic_code.hpp"
#include "host/harmonic/phase_derivatives.hpp"
#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam {

using namespace harmonic;

const char* to_string(LinearMethod method) {
  switch (method) {
    case LinearMethod::automatic:
      return "auto";
    case LinearMethod::iterative:
      return "iterative";
    case LinearMethod::direct:
      return "direct";
  }
  return "unknown";
}

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Checks that each pair with contacts has a law. \throws InputError naming a pair that has contacts but no law.
void require_laws_of(const ContactNetwork& network, const LawTable& laws) {
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (network.count[pair] > 0 && !laws[pair]) {
      throw InputError(std::string("pair ") + to_string(static_cast<PairType>(pair)) + " has " +
                       std::to_string(network.count[pair]) + " contacts but no law");
    }
  }
  for (const CellStiffness& cell : network.cells) {
    if (cell.weight != 0 && !laws[static_cast<std::size_t>(cell.law)])
      throw InputError(std::string("pair ") + to_string(cell.law) +
                       " has no law, but cells that resist a change of volume have the modulus of this law");
  }
}

/// Returns |E*| and φ.
Stiffness modulus(Complex e) { return {std::abs(e), std::arg(e) * 180 / std::numbers::pi}; }

/// A task (a linear system), and the results of the last check of its solution.
struct Work {
  LinearTask task;
  ModulusParts parts;  ///< parts of uᵀ·(K* − inertia·M)·u
  double residual = 0, beyond_rounding = 0, energy_error = 0;
  LinearMethod method = LinearMethod::iterative;
  std::string why_factors;
  bool tried = false, good = false;
};

}  // namespace

void harmonic::require_not_stopped(const std::function<bool()>& stop) {
  if (stop && stop()) throw InterruptedError("interrupted in the frequency domain");
}

class Harmonic::Implementation {
 public:
  Implementation(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws, const Inertia& inertia,
                 const HarmonicOptions& options, double typical_frequency)
      : specimen_(specimen),
        network_(network),
        laws_(laws),
        inertia_(inertia),
        options_(options),
        contacts_(network, specimen.size()) {
    require_laws_of(network, laws);
    typical_ = pair_stiffness(laws, Complex(options.typical_growth, 2 * std::numbers::pi * typical_frequency));
    if (!network.cells.empty()) {
      if (options.backend == Backend::cuda)
        throw InputError("harmonic", 0, "backend with a network of the rule \"volumetric\"", "cuda",
                         "cpu, because the solver on GPUs does not compute the pressures of cells");
      options_.backend = Backend::cpu;
    }
    options_.backend = select_backend(options_.backend, nullptr, options.devices);
    free_ = find_free_motions(specimen, network, typical_, inertia);
    if (options.linear == LinearMethod::direct) {
      direct();
      return;
    }
    try {
      iterative_ =
          make_iterative_solver(specimen, network, typical_, inertia_, free_, options_.backend, options_.devices);
    } catch (const NotIterable& error) {
      if (options.linear == LinearMethod::iterative || specimen.size() > largest_direct) throw;
      why_factors_ = error.what();
      // makes the direct solver; if the stiffness is singular, its error message names the particle that can move
      direct();
    }
  }

  std::vector<HarmonicResult> solve(const std::vector<HarmonicLoad>& loads) {
    const auto start = Clock::now();
    std::vector<Work> works;
    for (const HarmonicLoad& load : loads) works.push_back(work_of(load));
    std::vector<LinearTask*> tasks;
    for (Work& w : works) tasks.push_back(&w.task);
    for_each_in_parallel(loads.size(), [&](std::size_t i) {
      if (loads[i].near) tasks[i]->motion = without_free_motions(*loads[i].near);
    });
    if (iterative_) attempt(works, *iterative_, LinearMethod::iterative);
    if (options_.linear != LinearMethod::iterative && !all_good(works) && specimen_.size() <= largest_direct) {
      for (std::size_t i = 0; i < works.size(); ++i) {
        if (!works[i].good && iterative_) begin_again(works[i], loads[i]);
      }
      attempt(works, direct(), LinearMethod::direct);
    }
    std::vector<HarmonicResult> out;
    for (std::size_t i = 0; i < works.size(); ++i) {
      if (!works[i].good) throw RunError("harmonic: " + refusal(works[i], loads[i]));
      out.push_back(result_of(works[i], loads[i]));
    }
    for (HarmonicResult& r : out) r.seconds = seconds_since(start) / static_cast<double>(works.size());
    return out;
  }

 private:
  /// Returns the largest accepted error in the energy norm relative to the energy of the solution, √(rᴴ·P⁻¹·r /
  /// uᵀ·K·u).
  ///
  /// Contacts that are far stiffer than the others, for instance with walls, make up nearly all of ‖f‖. A small
  /// residual then says nothing about the softer contacts, but this error does. The relative error of E* is the square
  /// of this error divided by the smallest eigenvalue of P⁻¹·K. This eigenvalue is about 1e-3, because some tens of
  /// iterations suffice. With a residual tolerance of 1e-8, this error is at most 1e-6, and the error of E* is about
  /// (1e-6)²/1e-3 = 1e-9. With a residual tolerance of 1e-11 the error of E* is below rounding.
  double energy_tolerance() const { return 100 * options_.tolerance; }

  LinearSolver& direct() {
    if (!direct_) direct_ = make_direct_solver(network_, contacts_, typical_, inertia_, free_);
    return *direct_;
  }

  /// Returns the linear system of a load. \throws InputError when a law has no finite, non-zero stiffness at this s.
  Work work_of(const HarmonicLoad& load) {
    const Complex s = load.s();
    Work out;
    LinearTask& task = out.task;
    task.stiffness = pair_stiffness(laws_, s);
    task.inertia = -load.density_scaling * (s * s + s * load.viscous_damping);
    task.wall = load.top;
    task.right = contacts_.wall_loads(task.stiffness, task.wall);
    // stricter than the option, because rounding makes the solver's own residual differ from the true one
    task.tolerance = 0.3 * options_.tolerance;
    for (std::size_t pair = 0; pair < pair_types; ++pair) {
      const Complex k = task.stiffness.k[pair];
      if (network_.count[pair] > 0 && !(std::isfinite(k.real()) && std::isfinite(k.imag()) && k != 0.0)) {
        throw InputError(
            fmt::format("harmonic: the law of {} is singular at s = {:g}{:+g}i 1/s: found a complex modulus of "
                        "{:g}{:+g}i Pa, expected a finite modulus that is not 0",
                        to_string(static_cast<PairType>(pair)), s.real(), s.imag(), k.real(), k.imag()));
      }
    }
    return out;
  }

  /// Removes the free motions (motions that no contact resists) from the start of an iteration. With inertia the
  /// iteration cannot remove the free motions by itself.
  Vector without_free_motions(Vector x) const {
    for (const FreeMotion& motion : free_.motions) motion.remove_from(x, inertia_);
    return x;
  }

  /// Prepares a task for the direct solver. The direct solver starts from the result of the iterative solver if this
  /// result has a relative residual below 1.
  void begin_again(Work& w, const HarmonicLoad& load) {
    w.why_factors = refusal(w, load);
    w.task.energy_limit = std::numeric_limits<double>::infinity();  // the old limit refers to another preconditioner
    if (!(w.residual < 1)) w.task.motion.clear();
    w.tried = false;
  }

  static bool all_good(const std::vector<Work>& works) {
    return std::all_of(works.begin(), works.end(), [](const Work& w) { return w.good; });
  }

  /// Solves the tasks whose solutions have not been accepted yet, in up to four rounds. The check after a round may
  /// require a smaller energy error in the next round. A task that did not converge is not solved again.
  void attempt(std::vector<Work>& works, LinearSolver& solver, LinearMethod method) {
    for (int round = 0; round < 4; ++round) {
      std::vector<Work*> open;
      for (Work& w : works) {
        const bool stuck = w.tried && !w.task.converged;
        if (!w.good && !stuck) open.push_back(&w);
      }
      if (open.empty()) return;
      std::vector<LinearTask*> tasks;
      for (Work* w : open) tasks.push_back(&w->task), w->method = method, w->tried = true;
      solver.solve(tasks, options_.stop);
      check(open);
    }
  }

  /// Checks solutions by residuals that are computed from the network, and by errors in the energy norm. The part of a
  /// residual that exceeds rounding takes longer to compute, so it is computed only when a residual exceeds the
  /// tolerance.
  void check(const std::vector<Work*>& works) {
    std::vector<const LinearTask*> tasks;
    for (const Work* w : works) tasks.push_back(&w->task);
    const auto checked = [&](double rounding) {
      return harmonic_code().check_solutions(network_, inertia_, tasks, rounding);
    };
    std::vector<SolutionCheck> found = checked(0);
    bool within = true;
    for (std::size_t i = 0; i < works.size(); ++i) {
      within = within && found[i].residual <= options_.tolerance * length(tasks[i]->right);
    }
    if (!within) found = checked(std::numeric_limits<double>::epsilon());
    for (std::size_t i = 0; i < works.size(); ++i) take(*works[i], found[i]);
  }

  /// Stores the results of the check of a solution, decides whether the solution is accepted, and sets the energy limit
  /// of the next round.
  void take(Work& w, const SolutionCheck& found) const {
    LinearTask& task = w.task;
    const double whole = std::abs(found.parts.modulus()), scale = length(task.right);
    w.parts = found.parts;
    w.parts.inertia = -task.inertia * found.inertia;
    w.residual = found.residual / scale;
    w.beyond_rounding = found.beyond_rounding / scale;
    w.energy_error = std::sqrt(task.energy / whole);
    w.good = task.converged && w.beyond_rounding <= options_.tolerance && w.energy_error <= energy_tolerance();
    task.energy_limit = 0.1 * energy_tolerance() * energy_tolerance() * whole;
  }

  /// Returns why a solution is not accepted, for messages.
  std::string refusal(const Work& w, const HarmonicLoad& load) const {
    const std::string larger =
        specimen_.size() > largest_direct && options_.linear == LinearMethod::automatic
            ? fmt::format("; the direct solver is not tried for more than {} particles", largest_direct)
            : "";
    return fmt::format(
        "the residual is {:.1e}, of which {:.1e} is beyond rounding (expected at most {:.1e}), and the error in the "
        "energy norm is {:.1e} (expected at most {:.1e}) after {} iterations at {:g} Hz{}, {} solver: the frequency is "
        "near a resonance, or the stiffness is nearly singular{}",
        w.residual, w.beyond_rounding, options_.tolerance, w.energy_error, energy_tolerance(), w.task.iterations,
        load.frequency_hz,
        load.growth == 0 ? "" : fmt::format(" with a load whose amplitude grows as exp(t * {:g} 1/s)", load.growth),
        to_string(w.method), larger);
  }

  /// Returns the result of a solved task. The reaction of the top wall at unit motion is uᵀ·(K* − inertia·M)·u,
  /// without conjugates. In this form the error of the solution enters squared, and nothing cancels when the wall is
  /// far stiffer than the specimen.
  HarmonicResult result_of(Work& w, const HarmonicLoad& load) const {
    const LinearTask& task = w.task;
    const Vector& x = task.motion;
    HarmonicResult out;
    out.pressures = cell_pressures(network_, task.stiffness, x, task.wall);
    out.parts = w.parts;
    add_phase_derivatives(network_, task.stiffness, x, task.wall, out.pressures, out.parts);
    const double top = std::abs(out.parts.modulus());
    // converts the reaction at unit displacement into stress over strain, or the torque at unit turn into G*
    const double section = task.wall.turns() ? specimen_.box.torsion_constant().value() : section_area(specimen_);
    const double to_modulus = gauge_length(specimen_) / section;
    out.frequency_hz = load.frequency_hz;
    out.growth = load.growth;
    out.wall = task.wall;
    out.linear = w.method;
    out.residual = w.residual;
    out.iterations = task.iterations;
    out.why_factors = w.why_factors.empty() ? why_factors_ : w.why_factors;
    for (auto* part : {&out.parts.normal, &out.parts.shear, &out.parts.normal_rock, &out.parts.shear_rock}) {
      for (Complex& e : *part) e *= to_modulus;
    }
    for (Complex* part : {&out.parts.inertia, &out.parts.pressure_of_mastic, &out.parts.mastic_poisson_ratio,
                          &out.parts.rock_poisson_ratio})
      *part *= to_modulus;
    out.top = modulus(out.parts.modulus());
    out.bottom = modulus(-to_modulus * contacts_.bottom_load(task.stiffness, x, task.wall));
    if (task.inertia == 0.0 && w.method == LinearMethod::direct) {
      for (const Pin& pin : free_.pins) out.held_force += std::abs(pin.force(x));
      out.held_force /= top;
    }
    out.motion = std::move(w.task.motion);
    return out;
  }

  const Specimen& specimen_;
  const ContactNetwork& network_;
  LawTable laws_;
  Inertia inertia_;
  HarmonicOptions options_;
  ContactOperator contacts_;
  PairStiffness typical_;
  FreeMotions free_;
  std::unique_ptr<LinearSolver> iterative_, direct_;
  std::string why_factors_;  ///< why the iterative solver could not be set up; empty if it could
};

Harmonic::Harmonic(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                   const Inertia& inertia, const HarmonicOptions& options, double typical_frequency)
    : implementation_(std::make_unique<Implementation>(specimen, network, laws, inertia, options, typical_frequency)) {}
Harmonic::~Harmonic() = default;

HarmonicResult Harmonic::solve(double frequency_hz, double density_scaling, double viscous_damping) {
  return implementation_->solve({{frequency_hz, density_scaling, viscous_damping}}).front();
}

std::vector<HarmonicResult> Harmonic::solve(const std::vector<HarmonicLoad>& loads) {
  return implementation_->solve(loads);
}

}  // namespace macadam
