// SPDX-License-Identifier: GPL-3.0-or-later
// harmonic.cpp  COCG (conjugate gradients for complex symmetric matrices) with a real Cholesky preconditioner.
//
// K*(ω) is the real network with each contact multiplied by the complex number of its pair. Preconditioned by the real
// parts at one frequency, its eigenvalues gather about a few such ratios: some ten iterations do.
#include "macadam/harmonic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/harmonic/contact_operator.hpp"
#include "host/harmonic/preconditioner.hpp"
#include "host/harmonic/rigid_motions.hpp"
#include "macadam/error.hpp"

namespace macadam {

using namespace harmonic;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void require_laws_of(const ContactNetwork& network, const std::array<std::optional<Law>, pair_types>& laws) {
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (network.count[pair] > 0 && !laws[pair]) {
      throw InputError(std::string("pair ") + to_string(static_cast<PairType>(pair)) + " has " +
                       std::to_string(network.count[pair]) + " contacts but no law");
    }
  }
}

/// xᵀ·y without conjugation, and ‖x‖; sums in a fixed order.
Complex product(const Vector& x, const Vector& y) {
  Complex sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}
double length(const Vector& x) {
  double sum = 0;
  for (const Complex& v : x) sum += std::norm(v);
  return std::sqrt(sum);
}

}  // namespace

class Harmonic::Implementation {
 public:
  Implementation(const Specimen& specimen, const ContactNetwork& network,
                 const std::array<std::optional<Law>, pair_types>& laws, const Inertia& inertia,
                 const HarmonicOptions& options, double typical_frequency)
      : box_(specimen.box), laws_(laws), inertia_(inertia), options_(options), contacts_(network, specimen.size()) {
    require_laws_of(network, laws);
    const PairStiffness typical = pair_stiffness(laws, 2 * std::numbers::pi * typical_frequency);
    free_ = find_free_motions(specimen, network, typical, inertia);
    preconditioner_ = std::make_unique<Preconditioner>(network, specimen.size(), typical, free_.pins);
  }

  HarmonicResult solve(double frequency, double density_scaling, double damping) {
    const auto start = std::chrono::steady_clock::now();
    const double omega = 2 * std::numbers::pi * frequency;
    const Complex inertia = density_scaling * Complex(omega * omega, -omega * damping);
    const PairStiffness stiffness = pair_stiffness(laws_, omega);
    HarmonicResult out;
    out.frequency_hz = frequency;

    Vector x(6 * inertia_.mass.size(), 0), right, r, z, p, q;
    contacts_.forces(stiffness, x, 1.0, right);  // of a unit displacement of the top wall
    const double scale = length(right);
    r = right;
    if (frequency == last_frequency_) {  // another inertia at the same frequency: begin from what is near
      x = last_;
      if (inertia != 0.0) remove_free_motions(x);
      apply(stiffness, inertia, x, q);
      for (std::size_t i = 0; i < r.size(); ++i) r[i] -= q[i];
    }
    Complex rho_before = 0;
    double residual = length(r) / scale;
    double energy_error = 0, wanted_energy = infinity;
    // the recurrence drifts from the true residual by rounding: it is computed anew, and the recurrence restarted
    for (int restart = 0; restart < 4 && !(residual <= options_.tolerance && energy_error <= energy_tolerance());
         ++restart) {
      for (int k = 0; out.iterations < options_.max_iterations; ++k) {
        if (residual <= 0.3 * options_.tolerance && wanted_energy == infinity) break;
        preconditioner_->solve(r, z);
        if (inertia != 0.0) remove_free_motions(z);
        if (residual <= 0.3 * options_.tolerance && energy(r, z) <= wanted_energy) break;
        const Complex rho = product(r, z);
        if (k == 0) {
          p = z;
        } else {
          const Complex beta = rho / rho_before;
          for (std::size_t i = 0; i < p.size(); ++i) p[i] = z[i] + beta * p[i];
        }
        apply(stiffness, inertia, p, q);
        const Complex alpha = rho / product(p, q);
        for (std::size_t i = 0; i < x.size(); ++i) {
          x[i] += alpha * p[i];
          r[i] -= alpha * q[i];
        }
        rho_before = rho;
        ++out.iterations;
        residual = length(r) / scale;
        if (!std::isfinite(residual)) break;
      }
      apply(stiffness, inertia, x, q);
      for (std::size_t i = 0; i < r.size(); ++i) r[i] = right[i] - q[i];
      residual = length(r) / scale;
      preconditioner_->solve(r, z);
      const double whole = std::abs(contacts_.twice_energy(stiffness, x, 1.0));
      energy_error = std::sqrt(energy(r, z) / whole);
      wanted_energy = 0.1 * energy_tolerance() * energy_tolerance() * whole;
    }
    out.residual = residual;
    if (!(residual <= options_.tolerance && energy_error <= energy_tolerance())) {
      throw RunError(fmt::format(
          "harmonic: residual {:.1e} (expected at most {:.1e}) and error in the energy norm {:.1e} (at most {:.1e}) "
          "after {} iterations at {:g} Hz: near a resonance, or a nearly singular stiffness",
          residual, options_.tolerance, energy_error, energy_tolerance(), out.iterations, frequency));
    }

    // The top wall's reaction at unit displacement is uᵀ·(K* − inertia·M)·u, without conjugates: the error of the
    // solution enters it squared, and nothing cancels where the wall is far stiffer than the specimen.
    Complex top = contacts_.twice_energy(stiffness, x, 1.0);
    if (inertia != 0.0) {
      for (std::size_t i = 0; i < x.size(); ++i) top -= inertia * inertia_at(inertia_, i) * x[i] * x[i];
    }
    const double to_modulus = box_.size.z / (box_.size.x * box_.size.y);  // stress per strain of a unit displacement
    out.top = modulus(to_modulus * top);
    out.bottom = modulus(-to_modulus * contacts_.bottom_force(stiffness, x));
    if (inertia == 0.0) {
      for (const Pin& pin : free_.pins) out.held_force += std::abs(pin.stiffness * x[pin.dof]);
      out.held_force /= std::abs(top);
    }
    last_ = x;
    last_frequency_ = frequency;
    out.motion = std::move(x);
    out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return out;
  }

 private:
  /// Forces of contacts that are far stiffer than the others, walls for instance, make up nearly all of ‖f‖, so that a
  /// small residual says nothing of the rest. The error in the energy norm over the energy of the solution does:
  /// √(rᴴ·P⁻¹·r / uᵀ·K·u). It enters E* squared, and reactions as it is.
  double energy_tolerance() const { return 100 * options_.tolerance; }
  static double energy(const Vector& r, const Vector& z) {
    double sum = 0;
    for (std::size_t i = 0; i < r.size(); ++i) sum += (std::conj(r[i]) * z[i]).real();
    return std::max(sum, 0.0);  // of a residual of rounding it may be below
  }

  static Stiffness modulus(Complex e) { return {std::abs(e), std::arg(e) * 180 / std::numbers::pi}; }

  /// out = (K* − inertia·M)·x, or (K* + pins)·x without inertia.
  void apply(const PairStiffness& stiffness, Complex inertia, const Vector& x, Vector& out) const {
    contacts_.forces(stiffness, x, 0.0, out);
    for (Complex& f : out) f = -f;
    if (inertia == 0.0) {
      for (const Pin& pin : free_.pins) out[pin.dof] += pin.stiffness * x[pin.dof];
      return;
    }
    // free motions then carry their own inertia and need no pins
    for (std::size_t i = 0; i < x.size(); ++i) { out[i] -= inertia * inertia_at(inertia_, i) * x[i]; }
  }

  /// The load is in equilibrium, so that with inertia nothing moves freely. The preconditioner, which has pins in place
  /// of that inertia, would have to find this out: it takes three times the iterations.
  void remove_free_motions(Vector& x) const {
    for (const std::vector<double>& motion : free_.motions) {
      Complex share = 0;
      for (std::size_t i = 0; i < x.size(); ++i) share += motion[i] * inertia_at(inertia_, i) * x[i];
      for (std::size_t i = 0; i < x.size(); ++i) x[i] -= share * motion[i];
    }
  }

  Box box_;
  std::array<std::optional<Law>, pair_types> laws_;
  Inertia inertia_;
  HarmonicOptions options_;
  ContactOperator contacts_;
  FreeMotions free_;
  std::unique_ptr<Preconditioner> preconditioner_;
  Vector last_;  ///< solution of last_frequency_
  double last_frequency_ = -1;
};

Harmonic::Harmonic(const Specimen& specimen, const ContactNetwork& network,
                   const std::array<std::optional<Law>, pair_types>& laws, const Inertia& inertia,
                   const HarmonicOptions& options, double typical_frequency)
    : implementation_(std::make_unique<Implementation>(specimen, network, laws, inertia, options, typical_frequency)) {}
Harmonic::~Harmonic() = default;

HarmonicResult Harmonic::solve(double frequency_hz, double density_scaling, double viscous_damping) {
  return implementation_->solve(frequency_hz, density_scaling, viscous_damping);
}

}  // namespace macadam
