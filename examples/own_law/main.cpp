// SPDX-License-Identifier: GPL-3.0-or-later
// main.cpp  Steps a column of spheres with the contact laws of this program, computes its relaxation and creep without
// time steps, and compares the results with closed forms.
#include <cmath>
#include <cstdio>
#include <numbers>

#include <kernels/make_cpu.hpp>
#include <kernels/make_stepper.hpp>

#include "laws.hpp"

namespace {

using namespace macadam;
constexpr int spheres = 4;
// side of a cubic cell [m]; cross-section [m²] and height [m] of the column
constexpr double side = 1e-3, area = side * side, height = spheres * side;

Specimen make_column() {
  Specimen out;
  out.box.size = {side, side, height};
  for (int i = 0; i < spheres; ++i) {
    out.centre.push_back({side / 2, side / 2, (i + 0.5) * side});
    out.radius.push_back(side / 2);
    out.phase.push_back(Phase::mastic);
    out.body.push_back(-1);
  }
  return out;
}

/// Steps the column while `drive` pulls its top. Returns the stress at the end [Pa], tension positive.
template <class D>
double stress_after(const OwnLaw& law, StepperOptions options, D drive, double seconds) {
  const Specimen column = make_column();
  const ContactNetwork network = build_network(column, tessellate(column));
  OwnLaws laws;
  laws.fill(law);
  const Inertia inertia = make_inertia(column, 2630, 2110);
  options.dt = 0.4 * critical_step(network, facts_of(laws), inertia, options).dt;
  drive.step = options.dt;
  drive.ramp_steps = std::llround(2e-4 / options.dt);
  options.boundary = moving_top(drive);
  // Compiles the CPU kernels for these laws and this precision; on_device.cu compiles the GPU kernels.
  const auto stepper = make_stepper_of<OwnLaw, on_device, Precision::double_>(Backend::automatic, column, network, laws,
                                                                              inertia, options);
  stepper->advance(std::llround(seconds / options.dt));
  std::printf("%s\n", stepper->description().c_str());
  return -stepper->observe().top_force() / area;
}

/// Prints both values and returns whether they agree within the relative tolerance.
bool agree(const char* what, double found, double expected, double tolerance) {
  const double error = std::abs(found / expected - 1);
  std::printf("%-42s %.6g Pa, closed form %.6g Pa: %.1e of %.0e\n", what, found, expected, error, tolerance);
  return error <= tolerance;
}

/// Checks the relaxation under a strain that rises as a half cosine within 0.2 ms and is then held.
bool relaxes() {
  const StandardLinearSolid law{1e9, 3e9, 3e6, 0.2};
  const double strain = 1e-5, at = 2e-3, rise = 2e-4, time = law.C_1 / law.E_1;
  drives::Ramp drive(strain * height, 1);
  drive.smooth = true;
  StepperOptions options;
  options.form = ContactForm::condensed;  // the law is linear
  options.geometry = Geometry::fixed;
  options.damping_kind = Damping::viscous;  // damps the waves that the rising strain causes
  options.damping = 2e4;
  const double found = stress_after(OwnLaw(law), options, drive, at);
  double memory = 0;  // convolution of the strain rate with exp(−t/time), by the midpoint rule
  const int pieces = 2000;
  for (int i = 0; i < pieces; ++i) {
    const double t = (i + 0.5) * rise / pieces;
    const double rate = strain * std::numbers::pi / (2 * rise) * std::sin(std::numbers::pi * t / rise);
    memory += rate * std::exp(-(at - t) / time) * rise / pieces;
  }
  return agree("standard linear solid, after 2 ms of hold", found, law.E_inf * strain + law.E_1 * memory, 2e-4);
}

/// Checks relaxation, creep and a constant strain rate of the column without time steps. The law has a function
/// prony(), so equivalent_laws() converts it to a law that all solutions without time steps accept.
bool responds_without_steps() {
  const StandardLinearSolid law{1e9, 3e9, 3e6, 0.2};
  const double at = 2e-3, time = law.C_1 / law.E_1, instantaneous = law.E_inf + law.E_1;
  const Specimen column = make_column();
  const ContactNetwork network = build_network(column, tessellate(column));
  OwnLaws laws;
  laws.fill(OwnLaw(law));
  SpectrumOptions options;
  options.shortest = 1e-5, options.longest = 1;
  const Spectrum found = spectrum_of(column, network, equivalent_laws(laws), options);
  // All contacts have the same law, so the column responds as one contact. A creep strain grows from 1/E(0) to 1/E_inf.
  const double slow = time * instantaneous / law.E_inf;
  const double creep = 1 / law.E_inf - (1 / law.E_inf - 1 / instantaneous) * std::exp(-at / slow);
  const double secant = law.E_inf - law.E_1 * time / at * std::expm1(-at / time);
  // options.tolerance is 1e-6
  const bool relaxation = agree("relaxation modulus after 2 ms", found.relaxation.modulus(at),
                                law.E_inf + law.E_1 * std::exp(-at / time), 1e-6);
  const bool creeps = agree("stress / creep strain after 2 ms", 1 / found.creep.compliance(at), 1 / creep, 1e-6);
  const bool grows =
      agree("secant modulus at a constant rate, 2 ms", found.relaxation.after_ramp(at, at), secant, 1e-6);
  return relaxation && creeps && grows;
}

/// Checks the stress in a column with bilinear contacts. The column was pulled until its longer contacts passed the
/// displacement x_0, and is at rest again.
bool yields() {
  const Bilinear law{2e9, 4e8, 2e-9, 0};
  const double pulled = 1.6e-8;
  drives::Ramp drive(pulled, 1);
  drive.smooth = true;
  StepperOptions options;
  options.form = ContactForm::points;
  options.geometry = Geometry::updated;
  options.damping_kind = Damping::local;
  options.damping = 0.5;
  const double found = stress_after(OwnLaw(law), options, drive, 3e-3);
  // The contacts are in series, so all carry the same stress f(x)/d. Bisection finds the stress at which the
  // displacements of the contacts add up to the displacement of the wall.
  const auto stretch = [&](double stress, double d) {
    const double f = stress * d, yield = law.E * law.x_0;
    return f <= yield ? f / law.E : law.x_0 + (f - yield) / law.E_2;
  };
  double low = 0, high = law.E * pulled / height;
  for (int i = 0; i < 100; ++i) {
    const double stress = (low + high) / 2;
    const double sum = 2 * stretch(stress, side / 2) + (spheres - 1) * stretch(stress, side);
    (sum < pulled ? low : high) = stress;
  }
  return agree("bilinear, at rest beyond its yield", found, low, 1e-4);
}

}  // namespace

int main() {
  const bool first = relaxes(), second = responds_without_steps(), third = yields();
  return first && second && third ? 0 : 1;
}
