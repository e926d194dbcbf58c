// SPDX-License-Identifier: GPL-3.0-or-later
// scenes.cpp  Makes the scenes and the measurements that several stability cases use.
#include <cmath>
#include <complex>
#include <mutex>
#include <numbers>

#include <fmt/format.h>

#include "bench/stability/stability.hpp"
#include "host/reference/reference_spectrum.hpp"
#include "macadam/error.hpp"

namespace macadam::stability {

std::string Setting::name() const { return std::string(to_string(backend)) + ", " + to_string(precision); }

std::vector<Setting> settings() {
  std::vector<Setting> out;
  for (const Backend backend : test::tested_backends()) {
    for (const Precision precision : {Precision::double_, Precision::mixed, Precision::single}) {
      out.push_back({backend, precision});
    }
  }
  return out;
}

test::Laws elastic_laws() { return test::same_law(laws::Elastic{3e10, 0.3}); }

laws::GeneralisedKelvin quick_law(double dt) { return {1e10, 1e10 * 300 * dt, {2e10}, {2e10 * 60 * dt}, 0.2}; }

Specimen generated_specimen(std::uint64_t seed, int particles) {
  SpecimenSpec spec;
  const double edge = 1.7e-3 * std::cbrt(particles);  // a mastic sphere of radius 0.75–1.00 mm takes about 1.7³ mm³
  spec.box.size = {edge, edge, edge};
  spec.seed = seed;
  AggregateClass aggregate;
  aggregate.sieve_min = 2e-3;
  aggregate.sieve_max = 4e-3;
  aggregate.count = std::max(1, particles / 20);
  spec.aggregate = {aggregate};
  MasticSpec mastic;
  mastic.radius_min = 0.75e-3;
  mastic.radius_max = 1.00e-3;
  mastic.porosity = 0.05;
  spec.mastic = mastic;
  return generate_specimen(spec).specimen;
}

ContactNetwork with_points_of_moments(const ContactNetwork& network) {
  ContactNetwork out = network;
  out.point_s.clear(), out.point_t.clear(), out.point_area.clear();
  for (Contact& c : out.contacts) {
    const AreaMoments& m = c.moments;
    const double s = m.s / m.a, t = m.t / m.a;
    const double ss = m.ss / m.a - s * s, st = m.st / m.a - s * t, tt = m.tt / m.a - t * t;
    const double l11 = std::sqrt(std::max(ss, 0.0)), l21 = l11 > 0 ? st / l11 : 0;
    const double l22 = std::sqrt(std::max(tt - l21 * l21, 0.0));
    c.point_begin = static_cast<std::uint32_t>(out.point_s.size());
    for (const double sign : {1.0, -1.0}) {
      for (const auto& [ds, dt] : {std::pair{l11, l21}, std::pair{0.0, l22}}) {
        out.point_s.push_back(s + sign * std::numbers::sqrt2 * ds);
        out.point_t.push_back(t + sign * std::numbers::sqrt2 * dt);
        out.point_area.push_back(m.a / 4);
      }
    }
    c.point_end = static_cast<std::uint32_t>(out.point_s.size());
  }
  return out;
}

double true_limit(const test::TestScene& scene) {
  return 2 / reference_largest_frequency(with_points_of_moments(scene.network), scene.laws, scene.inertia);
}

HarmonicResult harmonic_solution(const test::TestScene& scene, double frequency, double density_scaling,
                                 double residual) {
  static std::mutex one;
  const std::scoped_lock lock(one);
  return Harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {.tolerance = residual}, frequency)
      .solve(frequency, density_scaling);
}

void shake(Stepper& stepper, const test::TestScene& scene, double speed) {
  std::mt19937 random(6);
  const auto component = [&] { return speed * (2 * (static_cast<double>(random()) / 4294967296.0) - 1); };
  std::vector<Vec3d> velocity, spin;
  for (const double radius : scene.specimen.radius) {
    velocity.push_back({component(), component(), component()});
    spin.push_back((1 / radius) * Vec3d{component(), component(), component()});
  }
  stepper.set_velocities(velocity, spin);
}

double kinetic_energy(const test::TestScene& scene, const ParticleState& p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.velocity.size(); ++i) {
    sum += 0.5 * scene.inertia.mass[i] * dot(p.velocity[i], p.velocity[i]);
    sum += 0.5 * scene.inertia.inertia[i] * dot(p.spin[i], p.spin[i]);
  }
  return sum;
}

std::unique_ptr<Stepper> make(const Setting& setting, const test::TestScene& scene, StepperOptions options) {
  options.precision = setting.precision;
  options.threads = 1;
  return make_stepper(setting.backend, scene.specimen, scene.network, scene.laws, scene.inertia, options);
}

double energy_over_bound(const Setting& setting, const test::TestScene& scene, const StepperOptions& options,
                         double limit, std::int64_t steps, double speed) {
  const auto stepper = make(setting, scene, options);
  shake(*stepper, scene, speed);
  const double share = options.dt / limit;
  const double bound = kinetic_energy(scene, stepper->particles()) / (1 - share * share);
  double largest = 0;
  // odd: at the largest stable time step a mode oscillates with a period of two steps, and an even stride would always
  // sample it at the same phase
  const std::int64_t stride = std::max<std::int64_t>(1, steps / 400) | 1;
  for (std::int64_t done = 0; done < steps; done += stride) {
    stepper->advance(stride);
    const double energy = kinetic_energy(scene, stepper->particles());
    if (!std::isfinite(energy)) return INFINITY;
    largest = std::max(largest, energy / bound);
  }
  return largest;
}

std::vector<ResponseSample> last_cycle(Stepper& stepper, const Specimen& specimen, const drives::Cyclic& loading,
                                       std::int64_t cycles) {
  constexpr std::int64_t samples_per_cycle = 100;
  if (loading.steps_per_period % samples_per_cycle != 0) throw RunError("a cycle must be a multiple of 100 steps");
  const std::int64_t stride = loading.steps_per_period / samples_per_cycle;
  const double area = section_area(specimen);
  stepper.advance((cycles - 1) * loading.steps_per_period);
  std::vector<ResponseSample> samples;
  sample(stepper, stride, samples_per_cycle, [&](const Observation& now) {
    samples.push_back(
        {loading.frequency, now.time, now.top_displacement() / gauge_length(specimen), -now.top_force() / area});
  });
  return samples;
}

Stiffness fundamental(const std::vector<ResponseSample>& samples) {
  std::complex<double> strain = 0, stress = 0;
  const std::size_t n = samples.size() - 1;
  for (std::size_t k = 0; k < n; ++k) {
    const auto turn = std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
    strain += turn * samples[k].strain;
    stress += turn * samples[k].stress_pa;
  }
  return {std::abs(stress / strain), std::arg(stress / strain) * 180 / std::numbers::pi};
}

double stiffness_difference(const Stiffness& found, const Stiffness& expected) {
  const auto complex = [](const Stiffness& s) { return std::polar(s.e_star_pa, s.phase_deg * std::numbers::pi / 180); };
  return std::abs(complex(found) - complex(expected)) / expected.e_star_pa;
}

}  // namespace macadam::stability
