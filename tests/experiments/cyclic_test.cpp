// SPDX-License-Identifier: GPL-3.0-or-later
// cyclic_test.cpp  Tests how cyclic tests are evaluated, with signals of known |E*| and φ. Then tests the prescribed
// motion of cyclic tests.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <span>

#include "macadam/macadam.hpp"

namespace macadam::test {
namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180;
constexpr double strain_amplitude = 1e-4, modulus = 1.17e10;

/// A test with the strain −ε·sin(ωt) and a stress of known modulus and phase.
struct Signal {
  double frequency = 20, phase_deg = 7;
  int per_cycle = 500, cycles = 4;
  double first_cycle = 0;  ///< cycle at which the samples begin

  using Addition = std::function<double(double cycles)>;  ///< added signal in units of the amplitude, as a function of
                                                          ///< the time in cycles

  std::vector<ResponseSample> samples(const Addition& to_stress = {}, const Addition& to_strain = {}) const {
    std::vector<ResponseSample> out;
    for (int k = 0; k <= per_cycle * cycles; ++k) {
      const double x = static_cast<double>(k) / per_cycle, angle = 2 * pi * x;
      const double strain = -std::sin(angle) + (to_strain ? to_strain(x) : 0);
      const double stress = -std::sin(angle + phase_deg * degree) + (to_stress ? to_stress(x) : 0);
      out.push_back(
          {frequency, (first_cycle + x) / frequency, strain_amplitude * strain, strain_amplitude * modulus * stress});
    }
    return out;
  }
};

void expect_stiffness(const Stiffness& found, double phase_deg, double relative, double radians) {
  EXPECT_NEAR(found.e_star_pa / modulus, 1, relative);
  EXPECT_NEAR(found.phase_deg * degree, phase_deg * degree, radians);
}

TEST(EvaluateCyclic, SinusoidsAreReadToRounding) {
  for (const double phase : {0.0, 1e-6, 6.97771, 27.4374, 45.0, 89.999, 90.0}) {
    for (const double frequency : {0.1, 2.0, 20.0, 1000.0}) {
      for (const auto& [per_cycle, cycles, fit_cycles] : {std::tuple{500, 4, 2}, {37, 3, 3}, {8, 1, 1}, {500, 5, 1}}) {
        SCOPED_TRACE(testing::Message() << phase << "°, " << frequency << " Hz, " << per_cycle << " a cycle");
        const Signal signal{frequency, phase, per_cycle, cycles};
        const CyclicResult found = evaluate_cyclic(signal.samples(), frequency, fit_cycles);
        expect_stiffness(found.fit, phase, 1e-12, 1e-12);
        EXPECT_LT(found.fit_rms, 1e-12);
      }
    }
  }
}

// Large strains add a second harmonic to the stress. The second harmonic is not orthogonal to the linear trend that is
// fitted, so it is fitted too. Otherwise a second harmonic of amplitude h would change the fundamental by −0.78·h over
// one cycle.
TEST(EvaluateCyclic, ASecondHarmonicDoesNotLeak) {
  for (const int cycles : {1, 2, 4}) {
    Signal signal;
    signal.cycles = cycles;
    const auto second = [](double x) { return 0.1 * std::sin(4 * pi * x) - 0.05 * std::cos(4 * pi * x) + 0.2 * x; };
    const CyclicResult found = evaluate_cyclic(signal.samples(second), signal.frequency, cycles);
    expect_stiffness(found.fit, signal.phase_deg, 1e-12, 1e-12);
    EXPECT_LT(found.fit_rms, 1e-12);
  }
}

// The product t·f has a rounding error of ε·t·f. After 1e5 cycles this is a phase error of 2π·1e-11, both in strain and
// in stress.
TEST(EvaluateCyclic, LateCyclesAreAsGood) {
  Signal signal;
  signal.first_cycle = 1e5;
  expect_stiffness(evaluate_cyclic(signal.samples(), signal.frequency, 2).fit, signal.phase_deg, 1e-10, 2e-10);
}

TEST(EvaluateCyclic, OffsetAndTrendAreTakenOutExactly) {
  const auto drift = [](double x) { return 3.0 - 0.8 * x; };
  const auto other = [](double x) { return -0.2 + 0.05 * x; };
  const Signal signal;
  const CyclicResult found = evaluate_cyclic(signal.samples(drift, other), signal.frequency, 2);
  expect_stiffness(found.fit, signal.phase_deg, 1e-12, 1e-12);
  EXPECT_LT(found.fit_rms, 1e-12);
}

// White noise of standard deviation s on N samples changes the fitted amplitudes of sine and cosine by s·√(2/N) each.
// Five such deviations are allowed. The residual is s, accurate to s/√(2N).
TEST(EvaluateCyclic, NoiseMovesTheFitByItsShare) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.05);
  const Signal signal;
  const CyclicResult found =
      evaluate_cyclic(signal.samples([&](double) { return noise(random); }), signal.frequency, 2);
  const double samples = 2.0 * signal.per_cycle, deviation = 0.05 * std::sqrt(2 / samples);
  expect_stiffness(found.fit, signal.phase_deg, 5 * deviation, 5 * deviation);
  EXPECT_NEAR(found.fit_rms, 0.05, 5 * 0.05 / std::sqrt(2 * samples));
  // peaks are more sensitive to noise, so results come from the fit
  EXPECT_GT(std::abs(found.peaks.e_star_pa / modulus - 1), 5 * deviation);
}

// Ringing with r periods per cycle, in a fit over c cycles, changes the fundamental by at most
// (1/(r − 1) + 1/(r + 1))/(π·c) of the amplitude of the ringing. The bound is doubled because ringing also changes the
// fitted trend. The evaluation by peaks contains almost the whole ringing.
TEST(EvaluateCyclic, RingingHardlyMovesTheFit) {
  constexpr double ringing = 0.02;
  const Signal signal;
  for (const double periods : {40.3, 83.0, 157.77}) {
    const double bound = 2 * ringing * (1 / (periods - 1) + 1 / (periods + 1)) / (2 * pi);
    const auto wave = [&](double x) { return ringing * std::sin(2 * pi * periods * x + 0.4); };
    const CyclicResult found = evaluate_cyclic(signal.samples(wave), signal.frequency, 2);
    expect_stiffness(found.fit, signal.phase_deg, bound, bound);
    EXPECT_NEAR(found.fit_rms, ringing / std::sqrt(2), 0.02 * ringing);
    EXPECT_GT(std::abs(found.peaks.e_star_pa / modulus - 1), 0.25 * ringing) << periods;
  }
}

// Expects peaks within the errors of a parabola through three samples that are h apart. If the crest is δ from the
// nearest sample, the parabola gives the angle (h/2)·tan δ/tan(h/2) in place of δ, and a height that is
// δ²·(h² − δ²)/8 too low. For |δ| ≤ h/2 these errors are at most h³/62 and 3h⁴/128. Strain and stress each have them.
void expect_peaks_good_to_the_sampling(double phase, int per_cycle, int left_out = 0) {
  SCOPED_TRACE(testing::Message() << phase << "°, " << per_cycle << " samples a cycle");
  const double h = 2 * pi / per_cycle;
  Signal signal;
  signal.phase_deg = phase;
  signal.per_cycle = per_cycle;
  const std::vector<ResponseSample> samples = signal.samples();
  const std::span<const ResponseSample> kept(samples.data(), samples.size() - static_cast<std::size_t>(left_out));
  const CyclicResult found = evaluate_cyclic(kept, signal.frequency, 2);
  expect_stiffness(found.peaks, phase, 2.2 * 3 * h * h * h * h / 128 + 1e-12, 2.2 * h * h * h / 62 + 1e-12);
}

TEST(EvaluateCyclic, PeaksAreGoodToTheSampling) {
  for (const int per_cycle : {50, 500}) {
    for (const double phase : {0.0, 0.3, 6.97771, 27.4374, 45.1, 80.0}) {
      expect_peaks_good_to_the_sampling(phase, per_cycle);
    }
  }
}

// Stress that leads −sin(ωt) by a quarter cycle has its trough at the end of a cycle.
TEST(EvaluateCyclic, PeaksAtTheEndOfACycleAreAsGood) {
  for (const int per_cycle : {50, 500}) {
    for (const double phase : {89.0, 89.64, 89.9, 90.0}) expect_peaks_good_to_the_sampling(phase, per_cycle);
  }
}

// Without its last half cycle, the signal ends at a crest of stress, three quarters of a cycle after the crest of
// strain.
TEST(EvaluateCyclic, PeaksOfCrestsOfTwoCyclesAreAsGood) {
  for (const int per_cycle : {50, 500}) {
    for (const double phase : {89.9, 90.0}) expect_peaks_good_to_the_sampling(phase, per_cycle, per_cycle / 2);
  }
}

/// Returns a signal whose stiffness and phase change at the end of each cycle.
std::vector<ResponseSample> changing(int cycles, double growth, double turn_deg, int per_cycle = 200) {
  std::vector<ResponseSample> out;
  for (int k = 0; k <= cycles * per_cycle; ++k) {
    const int cycle = k == 0 ? 0 : (k - 1) / per_cycle;  // the sample at the end of a cycle belongs to this cycle
    const double angle = 2 * pi * k / per_cycle, phase = (10 + turn_deg * cycle) * degree;
    out.push_back({5, k / (5.0 * per_cycle), strain_amplitude * std::sin(angle),
                   strain_amplitude * modulus * std::pow(1 + growth, cycle) * std::sin(angle + phase)});
  }
  return out;
}

TEST(EvaluateCyclic, ChangeFromCycleToCycle) {
  const CyclicResult found = evaluate_cyclic(changing(4, 0.01, -0.2), 5, 1);
  EXPECT_NEAR(found.change_e_star, 0.01, 1e-11);
  EXPECT_NEAR(found.change_phase_deg, -0.2, 1e-10);
  EXPECT_NEAR(found.fit.e_star_pa / modulus, std::pow(1.01, 3), 1e-11);  // only the last cycle is fitted
  EXPECT_NEAR(found.fit.phase_deg, 10 - 3 * 0.2, 1e-10);

  const CyclicResult steady = evaluate_cyclic(Signal{}.samples(), 20, 1);
  EXPECT_NEAR(steady.change_e_star, 0, 1e-12);
  EXPECT_NEAR(steady.change_phase_deg, 0, 1e-10);

  const CyclicResult single = evaluate_cyclic(changing(1, 0, 0), 5, 1);
  EXPECT_TRUE(std::isnan(single.change_e_star));
  EXPECT_TRUE(std::isnan(single.change_phase_deg));
}

TEST(EvaluateCyclic, OnlyTheLastCyclesCount) {
  std::vector<ResponseSample> samples = Signal{}.samples();
  for (std::size_t k = 0; k <= 1000; ++k) samples[k].stress_pa = 1e12;  // two cycles, including the sample at their end
  expect_stiffness(evaluate_cyclic(samples, 20, 2).fit, 7, 1e-12, 1e-12);
  samples[1001].stress_pa = 1e12;
  EXPECT_GT(std::abs(evaluate_cyclic(samples, 20, 2).fit.e_star_pa / modulus - 1), 1e-3);
}

// The lateral strain is measured at every tenth sample. Drift of both strains does not change the ratio.
TEST(EvaluateCyclic, PoissonsRatioComesFromTheMeasuredSamples) {
  const double lag = -4 * degree;  // of the contraction behind the strain
  const auto drift = [](double x) { return 0.05 * x; };
  Signal signal;
  std::vector<ResponseSample> samples = signal.samples({}, drift);
  EXPECT_FALSE(evaluate_cyclic(samples, signal.frequency, 2).poisson_ratio);
  const CyclicResult without = evaluate_cyclic(samples, signal.frequency, 2);
  for (std::size_t k = 0; k < samples.size(); k += 10) {
    const double x = static_cast<double>(k) / signal.per_cycle;
    samples[k].lateral_strain = -0.3 * strain_amplitude * (-std::sin(2 * pi * x + lag) + 0.2 * x - 0.1);
  }
  const CyclicResult found = evaluate_cyclic(samples, signal.frequency, 2);
  ASSERT_TRUE(found.poisson_ratio);
  // the fit is exact for these signals; rounding is amplified by its condition number, which is below 100
  EXPECT_NEAR(std::abs(*found.poisson_ratio), 0.3, 1e-12);
  EXPECT_NEAR(std::arg(*found.poisson_ratio), lag, 1e-12);
  EXPECT_EQ(found.fit.e_star_pa, without.fit.e_star_pa) << "other results keep their bits";
  EXPECT_EQ(found.fit.phase_deg, without.fit.phase_deg);
}

TEST(EvaluateCyclic, TooLittleIsAnError) {
  const auto refused = [](std::span<const ResponseSample> samples, double frequency, int fit_cycles) {
    try {
      evaluate_cyclic(samples, frequency, fit_cycles);
      return std::string("accepted");
    } catch (const InputError& error) { return std::string(error.what()); }
  };
  const std::vector<ResponseSample> samples = Signal{20, 7, 100, 2}.samples();
  const std::span<const ResponseSample> all(samples);
  EXPECT_NE(refused(all.first(0), 20, 1).find("0 samples"), std::string::npos);
  EXPECT_NE(refused(all.first(4), 20, 1).find("4 samples"), std::string::npos);
  EXPECT_NE(refused(all.first(100), 20, 1).find("0.99"), std::string::npos) << "a sample short of a cycle";
  EXPECT_EQ(refused(all.first(101), 20, 1), "accepted");
  EXPECT_NE(refused(all, 20, 3).find("at least 3"), std::string::npos);
  EXPECT_NE(refused(all, 20, 0), "accepted");
  EXPECT_NE(refused(all, 0, 1), "accepted");
  EXPECT_NE(refused(all, NAN, 1), "accepted");
}

// Tests of the prescribed motion of a cyclic test.

drives::Cyclic loading_of(std::int64_t steps_per_period, std::int64_t ramp_steps) {
  drives::Cyclic out;
  out.amplitude = 1.1e-6;
  out.frequency = 20;
  out.steps_per_period = steps_per_period;
  out.ramp_steps = ramp_steps;
  return out;
}

// The rounding of a sum of n steps of at most A·2π/n each is far below 1e-12·A.
TEST(CyclicLoading, VelocityIsTheMeanRateOfDisplacement) {
  for (const std::int64_t n : {8, 500, 43'500}) {
    const drives::Cyclic loading = loading_of(n, 0);
    double sum = 0;
    for (std::int64_t k = 0; k < 3 * n; ++k) {
      sum += loading.dt() * loading.rate(k);
      ASSERT_NEAR(sum, loading.value(k + 1), 1e-12 * loading.amplitude) << k << " of " << n;
    }
  }
}

// During the smooth start the displacement is a growing factor r(t) times a sine. The velocity is computed from r and
// the sine at the middle of the step. Each step adds an error of order Δt³, so at the end of the start the displacement
// has an error of order Δt². This error stays constant afterwards.
TEST(CyclicLoading, VelocityDuringTheSmoothStartIsOfSecondOrder) {
  std::vector<double> errors;
  for (const std::int64_t n : {100, 200, 400}) {
    const drives::Cyclic loading = loading_of(n, 3 * n / 4);
    double sum = 0, worst = 0;
    for (std::int64_t k = 0; k < 2 * n; ++k) {
      sum += loading.dt() * loading.rate(k);
      worst = std::max(worst, std::abs(sum - loading.value(k + 1)) / loading.amplitude);
    }
    EXPECT_LT(worst, std::pow(2 * pi / static_cast<double>(n), 2));
    errors.push_back(worst);
  }
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.4);
  EXPECT_NEAR(errors[1] / errors[2], 4, 0.2);
}

TEST(CyclicLoading, PhaseIsExactHoweverLongTheRun) {
  const drives::Cyclic loading = loading_of(43'500, 0);
  for (const std::int64_t k : {std::int64_t{1}, std::int64_t{12'345}, std::int64_t{43'499}}) {
    const double angle = 2 * pi * static_cast<double>(k) / 43'500;
    // angles below 2π have rounding errors of up to 9e-16
    EXPECT_NEAR(loading.value(k), -1.1e-6 * std::sin(angle), 2e-15 * 1.1e-6);
    EXPECT_NEAR(loading.value(k, 1), -1.1e-6 * std::sin(angle + pi / 43'500), 2e-15 * 1.1e-6);
    // the second value gives more than 1e13 steps
    for (const std::int64_t periods : {std::int64_t{23'000}, std::int64_t{1'000'000'000}}) {
      EXPECT_EQ(loading.value(k + periods * 43'500), loading.value(k));
      EXPECT_EQ(loading.rate(k + periods * 43'500), loading.rate(k));
    }
  }
}

TEST(CyclicLoading, StartsSmoothlyFromNothingToAll) {
  const drives::Cyclic plain = loading_of(1000, 0), smooth = loading_of(1000, 2500);
  EXPECT_EQ(smooth.value(0), 0);
  double before = 0;
  for (std::int64_t k = 1; k < 2500; ++k) {
    if (k % 500 == 0) continue;  // the sine is zero here
    const double ramp = smooth.value(k) / plain.value(k);
    ASSERT_GT(ramp, before) << k;
    ASSERT_LT(ramp, 1) << k;
    before = ramp;
  }
  EXPECT_NEAR(smooth.value(1250) / plain.value(1250), 0.5, 1e-14);
  for (const std::int64_t k : {2500, 2501, 3250, 99'999}) EXPECT_EQ(smooth.value(k), plain.value(k));
  // The velocity starts without a jump: r·sin ≈ (π/2·k/2500)²·2πk/1000 grows as the cube of time.
  EXPECT_LT(std::abs(smooth.rate(0)), 1e-5 * std::abs(plain.rate(0)));
}

}  // namespace
}  // namespace macadam::test
