// SPDX-License-Identifier: GPL-3.0-or-later
// stepped_load_test.cpp  Tests stepped relaxation, creep and constant rates. Compares them with the spectrum, which is
// computed without time steps; interrupts and resumes runs; and checks which scenes are refused. The work of the load
// must equal the sum of stored, kinetic and damped energy.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/files/checkpoint_file.hpp"
#include "tests/support/long_tests.hpp"
#include "tests/support/stepper_cases.hpp"
#include "tests/support/test_folder.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

using experiments::SteppedPoint;
using experiments::SteppedResponse;

const std::string explicit_cpu = "method = \"explicit\"\nbackend = \"cpu\"\n";

class SteppedLoad : public TestFolder {
 protected:
  Scene scene(const std::string& loading, const std::string& solver = "", const std::string& output = "") const {
    return read_scene(write_t8(loading, explicit_cpu + solver, output));
  }
  SteppedResponse stepped(const Scene& scene) const {
    const RunResult result = run(scene, out("out"));
    EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
    return std::get<SteppedResponse>(result.found);
  }
  static Spectrum spectrum(const Scene& scene) {
    const Preparation prepared = prepare(scene);
    return spectrum_of(prepared.specimen, prepared.network, scene.laws, {1e-4, 1});
  }
  nlohmann::json summary(const std::string& name) const {
    return nlohmann::json::parse(read(out(name) / "summary.json"));
  }
  std::string refusal(const Scene& scene) const {
    const std::string message = message_of([&] { run(scene, out("refused")); });
    EXPECT_THROW(run(scene, out("refused")), InputError) << message;
    EXPECT_FALSE(fs::exists(out("refused") / "summary.json"));
    return message;
  }
};

/// Tolerance of the stepped response. Waves are damped to 2e-5 at the next point; damping and inertia have smaller
/// effects here; the spectrum is accurate to 1e-6.
constexpr double tolerance = 1e-4;

TEST_F(SteppedLoad, RelaxationIsThatOfTheSpectrum) {
  const double strain = -1e-5, ramp = 2e-4;
  const std::string loading =
      "kind = \"relaxation\"\nstrain = -1e-5\nramp = \"0.2 ms\"\ntimes = [\"1 ms\", \"2 ms\"]\npoints = 4\n";
  const Scene asked = scene(loading);
  const Spectrum known = spectrum(asked);
  for (const std::string solver :
       {"", "form = \"points\"\ngeometry = \"fixed\"\n", "precision = \"mixed\"\ndensity_scaling = 4\n"}) {
    const SteppedResponse found = stepped(scene(loading, solver));
    ASSERT_EQ(found.points.size(), 4u);
    for (const SteppedPoint& p : found.points) {
      EXPECT_NEAR(p.strain / strain, 1, 1e-9);
      EXPECT_NEAR(p.stress_pa / (strain * known.relaxation.after_ramp(p.time_s, ramp)), 1, tolerance) << p.time_s;
      EXPECT_NEAR(p.ratio * p.strain / p.stress_pa, 1, 1e-12);
      EXPECT_LT(p.error, tolerance);
    }
    EXPECT_NEAR(found.points[1].time_s, 1e-3 + 1e-3 / 3, found.dt_s);
    EXPECT_LT(found.kinetic_share, 1e-6);
  }
  const auto result = summary("out").at("results").at(0);
  EXPECT_EQ(result.at("method"), "explicit");
  EXPECT_EQ(result.at("ramp_s"), ramp);
  EXPECT_EQ(result.at("points").size(), 4u);
  EXPECT_EQ(summary("out").at("solver").at("damping").at("kind"), "viscous");
  EXPECT_HAS(read(out("out") / "relaxation.csv"),
             "time_s,strain,stress_pa,modulus_pa,error,bottom_pa,kinetic_j,poisson_ratio\n");
  EXPECT_FALSE(fs::exists(out("out") / "prony.csv"));  // a stepped run has no Prony series
}

TEST_F(SteppedLoad, HeldSidesAreOfAConfinedSpecimen) {
  const std::string held = "[network]\nlateral_walls = true\n";
  const Scene asked = scene("kind = \"relaxation\"\nramp = \"0.2 ms\"\ntimes = [\"1 ms\"]\n", "", held);
  const RunResult result = run(asked, out("out"));
  const auto& found = std::get<SteppedResponse>(result.found);
  EXPECT_TRUE(found.confined);
  // With a strain of 1e-4, updated normals and lever arms change the modulus by about 1e-4.
  EXPECT_NEAR(found.points[0].ratio / spectrum(asked).relaxation.after_ramp(1e-3, 2e-4), 1, 3e-4);
  EXPECT_HAS(results_table(result), "confined modulus");
  EXPECT_EQ(summary("out").at("results").at(0).at("sides"), "held");
}

// The stress on the platen (a wall that moves under a load) rises, is held and is released. The strain grows, and a
// part of it recovers.
TEST_F(SteppedLoad, CreepAndRecoveryAreThoseOfTheSpectrum) {
  const double stress = 1e5, ramp = 2e-4, release = 2e-3;
  const Scene asked = scene(
      "kind = \"creep\"\nstress = 1e5\nramp = 2e-4\nrelease = 2e-3\ntimes = [1e-3, 1.5e-3, 2e-3, 3e-3, 3.5e-3]\n");
  const CreepSeries known = spectrum(asked).creep;
  const SteppedResponse found = stepped(asked);
  ASSERT_EQ(found.points.size(), 5u);
  EXPECT_GT(found.platen_mass_kg, 0);
  EXPECT_GE(found.critical_particle, 0) << "the platen costs no step";
  double largest = 0;
  for (const SteppedPoint& p : found.points) {
    const bool held = p.time_s < release + found.dt_s;
    const double gone = held ? 0 : known.after_ramp(p.time_s - release, ramp);
    const double expected = stress * (known.after_ramp(p.time_s, ramp) - gone);
    largest = std::max(largest, expected);
    EXPECT_NEAR(p.strain, expected, tolerance * largest) << p.time_s;
    EXPECT_NEAR(p.stress_pa, held ? stress : 0, 1e-9 * stress);
    EXPECT_NEAR(p.top_pa, p.stress_pa, tolerance * stress);
    EXPECT_NEAR(p.bottom_pa, p.stress_pa, tolerance * stress);
    if (held) { EXPECT_NEAR(p.ratio * stress / p.strain, 1, 1e-9); }
    EXPECT_EQ(std::isnan(p.ratio), !held);
  }
  EXPECT_GT(found.points[3].strain, 1e-3 * largest) << "what has flowed stays";
  EXPECT_LT(found.points[3].strain, 0.5 * largest) << "elastic strain returns";
  EXPECT_LT(found.points[4].strain, found.points[3].strain) << "and goes on to";
  EXPECT_TRUE(summary("out").at("results").at(0).at("points").at(3).at("compliance_1_pa").is_null());
}

TEST_F(SteppedLoad, AConstantRateEndsAtItsStrain) {
  for (const double sign : {1.0, -1.0}) {  // tension, then compression
    const Scene asked =
        scene(fmt::format("kind = \"monotonic\"\nrate = {}\nstrain = {}\npoints = 2\n", sign * 0.01, sign * 4e-5));
    const PronySeries known = spectrum(asked).relaxation;
    const SteppedResponse found = stepped(asked);
    ASSERT_EQ(found.points.size(), 2u);
    EXPECT_NEAR(found.points.back().strain / (sign * 4e-5), 1, 1e-9);
    for (const SteppedPoint& p : found.points) {
      EXPECT_NEAR(p.strain, sign * 0.01 * p.time_s, 1e-9 * 4e-5);
      EXPECT_NEAR(p.stress_pa / (sign * 0.01 * p.time_s * known.after_ramp(p.time_s, p.time_s)), 1, tolerance)
          << p.time_s;
    }
  }
  // The same scene computed without time steps has the same times.
  const Scene asked = read_scene(write_t8("kind = \"monotonic\"\nrate = 0.01\nstrain = 4e-5\npoints = 4\n", ""));
  const std::vector<double> times{1e-3, 2e-3, 3e-3, 4e-3};
  const auto& found = std::get<experiments::Monotonic>(asked.experiment).times;
  ASSERT_EQ(found.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(found[i] / times[i], 1, 1e-14);
}

/// Interrupting and resuming a stepped creep test does not change its files.
TEST_F(SteppedLoad, ARunInPiecesGivesTheBitsOfOne) {
  const Scene asked = scene(
      "kind = \"creep\"\nstress = -1e5\nramp = 2e-3\nrelease = 4e-3\ntimes = [1e-4, 2e-2]\npoints_per_decade = 8\n",
      "density_scaling = 100\n", "fields = [\"particles\"]\nevery = 3\nformat = \"vtp\"\n");
  run(asked, out("one"));
  int interrupted = 0;
  for (const int stop : {1, 5, 20, 11, 0}) interrupted += run_until(asked, "pieces", stop, interrupted > 0);
  EXPECT_EQ(interrupted, 4);
  EXPECT_TRUE(read(out("pieces") / "creep.csv") == read(out("one") / "creep.csv"));
  auto one = summary("one"), pieces = summary("pieces");
  for (auto* all : {&one, &pieces}) {
    all->erase("timing_s");
    for (auto& result : all->at("results")) result.erase("solve_s");
  }
  EXPECT_EQ(pieces, one);
  EXPECT_FALSE(fs::exists(out("pieces") / "checkpoint.h5"));
  int frames = 0;
  for (const auto& entry : fs::directory_iterator(out("one") / "fields")) {
    const fs::path other = out("pieces") / "fields" / entry.path().filename();
    EXPECT_TRUE(read(entry.path()) == read(other)) << other;
    frames += entry.path().extension() == ".vtp";
  }
  // There is one frame at the start and one at every third point.
  EXPECT_EQ(frames, 1 + static_cast<int>(one.at("results").at(0).at("points").size()) / 3);
}

// The processor, devices, and the reference, which has its own implementation of platens, give the same result. Only
// rounding differs: about 1e-16 per step over a few hundred steps, times a hundred, because the forces that are summed
// to a stress are about a hundred times as large as their sum.
TEST_F(SteppedLoad, EveryBackendFindsTheSame) {
  const std::string creep =
      "kind = \"creep\"\nstress = 1e5\nramp = 5e-3\nrelease = 1e-2\ntimes = [4e-3, 8e-3, 16e-3]\n";
  Scene asked = scene(creep, "density_scaling = 1e4\nform = \"points\"\n");
  const auto found = [&](Backend backend) {
    asked.solver.backend = backend;
    return std::get<SteppedResponse>(run(asked, out(to_string(backend))).found).points;
  };
  const std::vector<SteppedPoint> expected = found(Backend::cpu);
  std::vector<Backend> others = tested_backends();
  std::replace(others.begin(), others.end(), Backend::cpu, Backend::reference);
  for (const Backend backend : others) {
    const std::vector<SteppedPoint> points = found(backend);
    ASSERT_EQ(points.size(), expected.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(points[i].time_s, expected[i].time_s);
      EXPECT_NEAR(points[i].strain, expected[i].strain, 1e-10 * std::abs(expected[1].strain)) << to_string(backend);
      EXPECT_NEAR(points[i].top_pa, expected[i].top_pa, 1e-10 * 1e5) << to_string(backend);
      EXPECT_NEAR(points[i].bottom_pa, expected[i].bottom_pa, 1e-10 * 1e5) << to_string(backend);
      EXPECT_NEAR(points[i].kinetic_j, expected[i].kinetic_j, 1e-8 * expected[i].kinetic_j) << to_string(backend);
    }
  }
}

TEST_F(SteppedLoad, DamagedCheckpointsAreRefused) {
  const Scene asked = scene("kind = \"relaxation\"\ntimes = [1e-3]\n");
  ASSERT_TRUE(run_until(asked, "out", 5));
  Checkpoint checkpoint = read_checkpoint(out("out") / "checkpoint.h5");
  for (const char* plan : {"[]", "{\"seconds\": "}) {
    checkpoint.texts["plan"] = plan;
    write_checkpoint(out("out") / "checkpoint.h5", checkpoint);
    EXPECT_HAS(message_of([&] { run(asked, out("out"), {}, true); }), "checkpoint.h5: checkpoint: found ");
  }
}

TEST_F(SteppedLoad, ALargeErrorIsReported) {
  const Scene asked = scene("kind = \"relaxation\"\ntimes = [1e-3]\n", "density_scaling = 1e5\n");
  const RunResult result = run(asked, out("out"));
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_HAS(result.warnings[0], "the error is above 1 % in 1 of 1 rows");
  EXPECT_GT(std::get<SteppedResponse>(result.found).error(), 0.01);
  bool said = false;
  for (const std::string& decision : result.decisions) {
    said |= decision.find("grows over") != std::string::npos && decision.find("slowest wave") != std::string::npos;
  }
  EXPECT_TRUE(said) << "a load at once takes a wave's time";
}

/// A run with very many steps gives a warning with the predicted number of steps. A run with far too many is refused.
TEST_F(SteppedLoad, LongRunsAreForetold) {
  Watcher watcher;
  std::string warned;
  bool planned = false;
  watcher.warn = [&](const std::string& warning) { warned += warning; };
  watcher.planned = [&](const RunResult&) { planned = true; };
  watcher.stop = [&] { return planned; };
  EXPECT_THROW(run(scene("kind = \"monotonic\"\nrate = 1e-6\ntimes = [100]\n"), out("out"), watcher), InterruptedError);
  EXPECT_HAS(warned, "steps of ");
  EXPECT_HAS(warned, "method = \"harmonic\" needs none");
  const std::string hopeless = message_of([&] { run(scene("kind = \"relaxation\"\ntimes = [1e7]\n"), out("out")); });
  EXPECT_HAS(hopeless, "steps until 1e+07 s; increase density_scaling");
}

TEST_F(SteppedLoad, WhatDoesNotFitStepsIsRefused) {
  EXPECT_HAS(refusal(scene("kind = \"relaxation\"\ntimes = [1e-3]\n", "tolerance = 1e-3\n")),
             "tolerance in [solver]: found 0.001 with method \"explicit\" of kind \"relaxation\"");
  EXPECT_HAS(refusal(scene("kind = \"creep\"\nstress = 1e5\nrelease = 1e-7\ntimes = [1e-3]\n")),
             "release in [loading]: found 1e-07 s, expected the end of the ramp");
  const auto unread = [&](const std::string& loading, const std::string& solver = "", const std::string& output = "") {
    return message_of([&] { scene(loading, solver, output); });
  };
  EXPECT_HAS(unread("kind = \"sweep\"\nfrequencies = [1]\n"), "this kind is not stepped in time");
  EXPECT_HAS(unread("kind = \"creep\"\nstress = 1e5\nplaten_mass = 0\ntimes = [1]\n"), "positive");
  EXPECT_HAS(unread("kind = \"creep\"\nstress = 1e5\ntimes = [1]\n", "density_scaling = []\n"), "density_scaling");
  EXPECT_HAS(unread("kind = \"monotonic\"\nrate = 1\n"), "times, or the key strain, at which the test ends");
  EXPECT_HAS(unread("kind = \"monotonic\"\nrate = 1\nstrain = -0.1\n"), "a strain with the sign of the rate");
  EXPECT_HAS(unread("kind = \"monotonic\"\nrate = 1\nstrain = 0.1\ntimes = [1]\n"), "times with strain");
  EXPECT_HAS(unread("kind = \"monotonic\"\nrate = 1\ntimes = [1, 2]\npoints = 3\npoints_per_decade = 3\n"),
             "points together with points_per_decade");
  EXPECT_HAS(unread("kind = \"monotonic\"\nrate = 1\ntimes = [1, 2, 3]\npoints = 3\n"), "the two ends of a range");
  Scene spectral = scene("kind = \"relaxation\"\ntimes = [1e-3]\n", "", "fields = [\"particles\"]\n");
  spectral.solver.method = SolverMethod::harmonic;  // as the option --method does
  EXPECT_HAS(refusal(spectral), "fields in [output]");
}

// All laws are elastic, so the stored energy follows from the forces. Leapfrog with central damping satisfies the
// balances of momentum and energy exactly. Momentum: Σ γm(v⁺ − v⁻) = Δt·(P + reaction − β·Σ γm·v̄). Energy: the work
// P·Δu is the change of ½γmv² − ½u(k+1)·F(k), plus β·γm·v̄²·Δt. (P: load of the platen, γ: density scaling, β: viscous
// damping, v̄: mean of v⁻ and v⁺.)
TEST(PlatenBalance, OfMomentumAndEnergy) {
  Laws laws = am1_laws();
  for (auto& law : laws) law = laws::Elastic{std::visit([](const auto& l) { return l.instantaneous(); }, *law), 0.2};
  const TestScene scene = make_scene(read_specimen_csv(MACADAM_TEST_DATA "/t8.csv", {{0.008, 0.008, 0.011}}), {}, laws);
  const double scaling = 10, mass = 1e-4, beta = 2e4, force = 5;
  StepperOptions options;
  options.geometry = Geometry::fixed;
  options.density_scaling = scaling;
  options.damping_kind = Damping::viscous;
  options.damping = beta;
  options.boundary.load(wall_z_hi, 2, nullptr, mass);
  options.dt = 0.8 * critical_step(scene.network, scene.laws, scene.inertia, options).dt;
  const std::int64_t rise = 300, held = 400;
  const auto drive = std::make_shared<drives::Ramp>(force, options.dt, rise, held);
  options.boundary.load(wall_z_hi, 2, drive, mass);
  const auto stepper = make_stepper(Backend::cpu, scene.specimen, scene.network, scene.laws, scene.inertia, options);

  const std::size_t n = scene.specimen.size();
  const double dt = options.dt;
  ParticleState before = stepper->particles();
  Observation seen = stepper->observe();
  double wall_speed = 0, momentum = 0, impulse = 0, kinetic = 0, stored = 0, work = 0, damped = 0;
  double most_work = 0, most_kinetic = 0, most_impulse = 0;
  for (std::int64_t k = 0; k < 3 * rise + held; ++k) {
    stepper->advance(1);
    const ParticleState now = stepper->particles();
    const Observation next = stepper->observe();
    const double speed = (next.top_displacement() - seen.top_displacement()) / dt, mean = 0.5 * (speed + wall_speed);
    const double load = drive->value(k), up = seen.wall_force[wall_index(wall_z_lo)].z;
    double lost = mass * mean * mean, mean_momentum = mass * mean;
    momentum = mass * speed, kinetic = 0.5 * mass * speed * speed;
    stored = -0.5 * next.top_displacement() * seen.top_force();
    for (std::size_t i = 0; i < n; ++i) {
      const double m = scene.inertia.mass[i], turning = scene.inertia.inertia[i];
      const Vec3d v = 0.5 * (before.velocity[i] + now.velocity[i]), w = 0.5 * (before.spin[i] + now.spin[i]);
      momentum += m * now.velocity[i].z, mean_momentum += m * v.z;
      lost += m * dot(v, v) + turning * dot(w, w);
      kinetic += 0.5 * (m * dot(now.velocity[i], now.velocity[i]) + turning * dot(now.spin[i], now.spin[i]));
      stored -= 0.5 * (dot(now.displacement[i], before.force[i]) + dot(now.rotation[i], before.moment[i]));
    }
    momentum *= scaling, kinetic *= scaling;
    damped += beta * scaling * lost * dt;
    work += load * mean * dt;
    impulse += dt * (load - up - beta * scaling * mean_momentum);
    most_work = std::max(most_work, std::abs(work)), most_kinetic = std::max(most_kinetic, kinetic);
    most_impulse = std::max(most_impulse, std::abs(momentum));
    // The tolerance allows only for rounding: the rounding of a sum of about 1e3 steps, and of the platen velocity,
    // which is computed from displacements that change by a fraction of 1e-3 per step.
    ASSERT_NEAR(kinetic + stored + damped, work, 1e-9 * most_work) << k;
    ASSERT_NEAR(momentum, impulse, 1e-9 * most_impulse) << k;
    before = now, seen = next, wall_speed = speed;
  }
  EXPECT_GT(most_kinetic, 1e-3 * most_work) << "something moved";
  EXPECT_GT(damped, 1e-3 * most_work) << "something was damped";
  EXPECT_LT(stored, 1e-2 * most_work) << "and the springs gave back what they held";
}

TEST_F(SteppedLoad, AWarningOutlivesAnInterruption) {
  const Scene asked = scene(
      "kind = \"creep\"\nstress = -1e5\nramp = 2e-3\nrelease = 4e-3\ntimes = [1e-4, 2e-2]\npoints_per_decade = 8\n",
      "density_scaling = 100\n", "fields = [\"particles\"]\n");
  ASSERT_TRUE(run_until(asked, "out", 6));
  fs::remove_all(out("out") / "fields");
  Watcher watcher;
  std::string said;
  int looked = 0;
  bool planned = false;
  watcher.planned = [&](const RunResult&) { planned = true; };
  watcher.stop = [&] { return planned && ++looked >= 4; };
  watcher.warn = [&](const std::string& warning) { said = warning; };
  EXPECT_THROW(run(asked, out("out"), watcher, true), InterruptedError);
  EXPECT_HAS(said, "had no frame to continue from");
  const RunResult result = run(asked, out("out"), {}, true);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_EQ(result.warnings.front(), said);
}

}  // namespace
}  // namespace macadam::test
