// SPDX-License-Identifier: GPL-3.0-or-later
// harmonic.cpp  Frequencies to linear systems and back, by iteration first and by factors where that does not do.
#include "macadam/harmonic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "host/harmonic/linear_solver.hpp"
#include "macadam/error.hpp"

namespace macadam {

using namespace harmonic;

const char* to_string(LinearMethod method) {
  return method == LinearMethod::automatic ? "auto" : method == LinearMethod::iterative ? "iterative" : "direct";
}

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void require_laws_of(const ContactNetwork& network, const std::array<std::optional<Law>, pair_types>& laws) {
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (network.count[pair] > 0 && !laws[pair]) {
      throw InputError(std::string("pair ") + to_string(static_cast<PairType>(pair)) + " has " +
                       std::to_string(network.count[pair]) + " contacts but no law");
    }
  }
}

double length(const Vector& x) {
  double sum = 0;
  for (const Complex& v : x) sum += std::norm(v);
  return std::sqrt(sum);
}

Stiffness modulus(Complex e) { return {std::abs(e), std::arg(e) * 180 / std::numbers::pi}; }

/// A task with what was found of it so far.
struct Work {
  LinearTask task;
  ModulusParts parts;  ///< of the motion, as sums over contacts
  double residual = 0, energy_error = 0;
  LinearMethod method = LinearMethod::iterative;
  bool good = false;
};

}  // namespace

void harmonic::require_not_stopped(const std::function<bool()>& stop) {
  if (stop && stop()) throw InterruptedError("interrupted in the frequency domain");
}

class Harmonic::Implementation {
 public:
  Implementation(const Specimen& specimen, const ContactNetwork& network,
                 const std::array<std::optional<Law>, pair_types>& laws, const Inertia& inertia,
                 const HarmonicOptions& options, double typical_frequency)
      : specimen_(specimen),
        network_(network),
        laws_(laws),
        inertia_(inertia),
        options_(options),
        contacts_(network, specimen.size()) {
    require_laws_of(network, laws);
    typical_ = pair_stiffness(laws, Complex(0, 2 * std::numbers::pi * typical_frequency));
    options_.backend = select_backend(options.backend, nullptr, options.device);
    free_ = find_free_motions(specimen, network, typical_, inertia);
    if (options.linear == LinearMethod::direct) {
      direct();
      return;
    }
    try {
      iterative_ = make_iterative_solver(specimen, network, typical_, inertia_, free_, options_.backend);
    } catch (const RunError& error) {
      if (options.linear == LinearMethod::iterative || specimen.size() > largest_direct) throw;
      direct();  // which says what is wrong, if it is
    }
  }

  std::vector<HarmonicResult> solve(const std::vector<HarmonicLoad>& loads) {
    const auto start = Clock::now();
    std::vector<Work> works;
    for (const HarmonicLoad& load : loads) works.push_back(work_of(load));
    if (iterative_) attempt(works, *iterative_, LinearMethod::iterative);
    if (options_.linear != LinearMethod::iterative && !all_good(works) && specimen_.size() <= largest_direct) {
      attempt(works, direct(), LinearMethod::direct);
    }
    if (solved_.size() + works.size() > most_kept) solved_.clear();
    for (std::size_t i = 0; i < works.size(); ++i) {
      if (works[i].good) solved_[key_of(loads[i])] = works[i].task.motion;
    }
    std::vector<HarmonicResult> out;
    for (std::size_t i = 0; i < works.size(); ++i) {
      if (!works[i].good) refuse(works[i], loads[i]);
      out.push_back(result_of(works[i], loads[i]));
      out.back().seconds = seconds_since(start) / static_cast<double>(works.size());
    }
    return out;
  }

 private:
  /// Forces of contacts that are far stiffer than the others, walls for instance, make up nearly all of ‖f‖, so that a
  /// small residual says nothing of the rest. The error in the energy norm over the energy of the solution does:
  /// √(rᴴ·P⁻¹·r / uᵀ·K·u). It enters E* squared, and reactions as it is.
  double energy_tolerance() const { return 100 * options_.tolerance; }

  LinearSolver& direct() {
    if (!direct_) direct_ = make_direct_solver(network_, contacts_, typical_, inertia_, free_);
    return *direct_;
  }

  Work work_of(const HarmonicLoad& load) {
    const Complex s = load.s();
    Work out;
    LinearTask& task = out.task;
    task.stiffness = pair_stiffness(laws_, s);
    task.inertia = -load.density_scaling * (s * s + s * load.viscous_damping);
    task.right = contacts_.wall_forces(task.stiffness);
    task.tolerance = 0.3 * options_.tolerance;  // rounding parts the solver's own residual from the true one
    if (const auto near = solved_.find(key_of(load)); near != solved_.end()) task.motion = near->second;
    return out;
  }

  /// Solutions of the same s with another inertia are near.
  static std::pair<double, double> key_of(const HarmonicLoad& load) { return {load.frequency_hz, load.growth}; }

  static bool all_good(const std::vector<Work>& works) {
    return std::all_of(works.begin(), works.end(), [](const Work& w) { return w.good; });
  }

  /// Solves what is not good yet, with what a check of the solution asks for, as long as the solver gets there.
  void attempt(std::vector<Work>& works, LinearSolver& solver, LinearMethod method) {
    for (int round = 0; round < 4; ++round) {
      std::vector<LinearTask*> open;
      for (Work& w : works) {
        const bool stuck = round > 0 && !w.task.converged;
        if (!w.good && !stuck) open.push_back(&w.task), w.method = method;
      }
      if (open.empty()) return;
      solver.solve(open, options_.stop);
      for (Work& w : works) {
        if (!w.good) check(w);
      }
    }
  }

  /// The residual computed anew, and the error in the energy norm.
  void check(Work& w) const {
    LinearTask& task = w.task;
    Vector rest;
    double magnitude = 0;
    contacts_.resistance(task.stiffness, task.inertia, inertia_, task.motion, rest, &magnitude);
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = task.right[i] - rest[i];
    w.parts = contacts_.energy_parts(task.stiffness, task.motion, 1.0);
    const double whole = std::abs(w.parts.modulus());
    const double scale = length(task.right);
    w.residual = length(rest) / scale;
    w.energy_error = std::sqrt(task.energy / whole);
    // Motions are known to rounding, and loads of stiff contacts to that of them: where f is far less, that is all.
    const double rounding = std::numeric_limits<double>::epsilon() * magnitude / scale;
    w.good =
        task.converged && w.residual <= std::max(options_.tolerance, rounding) && w.energy_error <= energy_tolerance();
    task.energy_limit = 0.1 * energy_tolerance() * energy_tolerance() * whole;
  }

  [[noreturn]] void refuse(const Work& w, const HarmonicLoad& load) const {
    const std::string larger = specimen_.size() > largest_direct && options_.linear == LinearMethod::automatic
                                   ? fmt::format("; of more than {} particles nothing is factored", largest_direct)
                                   : "";
    throw RunError(fmt::format(
        "harmonic: residual {:.1e} (expected at most {:.1e}) and error in the energy norm {:.1e} (at most {:.1e}) "
        "after {} iterations at {:g} Hz{}, {}: near a resonance, or a nearly singular stiffness{}",
        w.residual, options_.tolerance, w.energy_error, energy_tolerance(), w.task.iterations, load.frequency_hz,
        load.growth == 0 ? "" : fmt::format(" and a growth of {:g} 1/s", load.growth), to_string(w.method), larger));
  }

  /// The top wall's reaction at unit displacement is uᵀ·(K* − inertia·M)·u, without conjugates: the error of the
  /// solution enters it squared, and nothing cancels where the wall is far stiffer than the specimen.
  HarmonicResult result_of(Work& w, const HarmonicLoad& load) const {
    const LinearTask& task = w.task;
    const Vector& x = task.motion;
    HarmonicResult out;
    out.parts = w.parts;
    if (task.inertia != 0.0) {
      for (std::size_t i = 0; i < x.size(); ++i) {
        out.parts.inertia -= task.inertia * inertia_at(inertia_, i) * x[i] * x[i];
      }
    }
    const double top = std::abs(out.parts.modulus());
    const Vec3d& box = specimen_.box.size;
    const double to_modulus = box.z / (box.x * box.y);  // stress per strain of a unit displacement
    out.frequency_hz = load.frequency_hz;
    out.growth = load.growth;
    out.linear = w.method;
    out.residual = w.residual;
    out.iterations = task.iterations;
    for (auto* part : {&out.parts.normal, &out.parts.shear}) {
      for (Complex& e : *part) e *= to_modulus;
    }
    out.parts.inertia *= to_modulus;
    out.top = modulus(out.parts.modulus());
    out.bottom = modulus(-to_modulus * contacts_.bottom_force(task.stiffness, x));
    if (task.inertia == 0.0 && w.method == LinearMethod::direct) {
      for (const Pin& pin : free_.pins) out.held_force += std::abs(pin.stiffness * x[pin.dof]);
      out.held_force /= top;
    }
    out.motion = std::move(w.task.motion);
    return out;
  }

  static constexpr std::size_t most_kept = 8;
  const Specimen& specimen_;
  const ContactNetwork& network_;
  std::array<std::optional<Law>, pair_types> laws_;
  Inertia inertia_;
  HarmonicOptions options_;
  ContactOperator contacts_;
  PairStiffness typical_;
  FreeMotions free_;
  std::unique_ptr<LinearSolver> iterative_, direct_;
  std::map<std::pair<double, double>, Vector> solved_;
};

Harmonic::Harmonic(const Specimen& specimen, const ContactNetwork& network,
                   const std::array<std::optional<Law>, pair_types>& laws, const Inertia& inertia,
                   const HarmonicOptions& options, double typical_frequency)
    : implementation_(std::make_unique<Implementation>(specimen, network, laws, inertia, options, typical_frequency)) {}
Harmonic::~Harmonic() = default;

HarmonicResult Harmonic::solve(double frequency_hz, double density_scaling, double viscous_damping) {
  return implementation_->solve({{frequency_hz, density_scaling, viscous_damping}}).front();
}

std::vector<HarmonicResult> Harmonic::solve(const std::vector<HarmonicLoad>& loads) {
  return implementation_->solve(loads);
}

}  // namespace macadam
