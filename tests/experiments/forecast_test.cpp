// SPDX-License-Identifier: GPL-3.0-or-later
// forecast_test.cpp  Compares predictions of `macadam check` with measurements and with the specimen that is then made.
#include "host/simulation/forecast.hpp"

#include <cmath>
#include <map>

#include "host/simulation/measured_costs.hpp"
#include "macadam/macadam.hpp"
#include "tests/support/processor_time.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_scenes.hpp"
#include "tests/experiments/test_tables.hpp"

namespace macadam::test {
namespace {

struct Check : Program {
  Scene example(const std::string& name) const { return read_scene(fs::path(MACADAM_EXAMPLES) / name / "scene.toml"); }
};

// The forecast counts particles by sampling sizes as the run does, so the number of particles is exact except with
// shapes. The forecast estimates the number of contacts from the mean number of facets per cell, which varies by some
// per cent.
TEST_F(Check, CountsWhatIsMade) {
  for (const char* name : {"demo", "mastic", "stepped_creep", "aggregate_cube", "study"}) {
    Scene scene = example(name);
    scene.solver.backend = Backend::cpu;
    const Forecast foretold = forecast(scene);
    const Preparation made = prepare(scene);
    const double particles = static_cast<double>(made.specimen.size());
    // If packed shapes miss the volume of a class, other shapes are sampled, and mastic fills the rest of the box. So
    // the predicted number of particles is only approximate.
    EXPECT_NEAR(static_cast<double>(foretold.census.particles()), particles,
                scene.specimen.shapes ? 0.01 * particles : 0)
        << name;
    EXPECT_EQ(foretold.census.voids, std::ssize(made.specimen.voids)) << name;
    const double contacts = static_cast<double>(made.network.contacts.size());
    EXPECT_NEAR(foretold.contacts, contacts, 0.2 * contacts) << name;
  }
}

std::vector<std::map<std::string, std::string>> measured(const std::string& file) {
  return table_of(read(fs::path(MACADAM_EXAMPLES).parent_path() / "bench/results" / file));
}

// The predicted memory is within 10 % of the measured memory of runs. A memory request on a cluster that follows the
// prediction may therefore be up to 10 % too small.
TEST_F(Check, FindsTheMemoryThatRunsTook) {
  const auto rows = measured("forecast.csv");
  ASSERT_GT(rows.size(), 5u);
  for (const auto& row : rows) {
    Scene scene = example(row.at("scene"));
    scene.solver.backend = Backend::cpu;
    scene.solver.method = row.at("method") == "harmonic" ? SolverMethod::harmonic : SolverMethod::explicit_;
    const double found = 1e6 * std::stod(row.at("memory_mb"));
    EXPECT_NEAR(forecast(scene).host_bytes, found, 0.1 * found) << row.at("scene");
  }
}

TEST_F(Check, FindsTheMemoryOfMillionsOfParticles) {
  const auto rows = measured("forecast-large.csv");
  ASSERT_FALSE(rows.empty());
  ASSERT_EQ(rows[0].at("scene"), "ac14_ss_am1:points:x60");
  ASSERT_EQ(rows[0].at("device"), "");
  Scene scene = example("ac14_ss_am1");
  constexpr int times = 60;
  scene.specimen.box.size = std::cbrt(times) * scene.specimen.box.size;
  for (AggregateClass& c : scene.specimen.aggregate) *c.count *= times;
  *scene.specimen.mastic->count *= times;
  scene.solver.backend = Backend::cpu;
  scene.solver.tolerance.reset();
  scene.solver.form = ContactForm::points;
  scene.solver.precision = Precision::double_;
  const double found = 1e6 * std::stod(rows[0].at("memory_mb"));
  EXPECT_NEAR(forecast(scene).host_bytes, found, 0.1 * found);
}

// A forecast has no contacts; it estimates the critical step from the materials and the smallest particles.
TEST_F(Check, StepsOfACreepTestAreThoseOfItsCriticalStep) {
  const Scene scene = example("stepped_creep");
  const Preparation made = prepare(scene);
  const StepForecast foretold = forecast(scene).steps.front();
  const Inertia inertia = make_inertia(made.specimen, scene.materials.aggregate, scene.materials.mastic);
  const double expected =
      0.8 * critical_step(made.network, scene.laws, inertia, {}).dt * std::sqrt(foretold.density_scaling);
  EXPECT_NEAR(foretold.dt_s / expected, 1, 0.5);
}

// If the specimen comes from a file, the forecast uses the smallest spheres in the file.
TEST_F(Check, StepsOfASpecimenFromAFileAreThoseOfTheMixtureThatItWasMadeOf) {
  Scene scene = example("stepped_creep");
  const StepForecast of_mixture = forecast(scene).steps.front();
  write_specimen_csv(folder_ / "made.csv", prepare(scene).specimen);
  scene.specimen.file = folder_ / "made.csv";
  scene.specimen.mastic.reset(), scene.specimen.aggregate.clear();
  const StepForecast of_file = forecast(scene).steps.front();
  EXPECT_GE(of_file.dt_s, of_mixture.dt_s);
  // among hundreds of spheres one is nearly the smallest possible
  EXPECT_NEAR(of_file.dt_s / of_mixture.dt_s, 1, 0.02);
  EXPECT_NEAR(of_file.steps / of_mixture.steps, 1, 0.02);
}

// Data that fit into a processor's cache, or into a device's registers and shared memory, take less time per contact. A
// cube of 20 mm has 10,000 contacts, one of 40 mm 86,000, and one of 100 mm 1.4 million.
TEST_F(Check, AContactOfASmallSpecimenTakesLessTime) {
  for (const Backend backend : tested_backends()) {
    Scene scene = example("demo");
    scene.solver.backend = backend;
    scene.solver.precision = Precision::double_;
    const auto of_a_contact = [&](double edge) {
      scene.specimen.box.size = {edge, edge, edge};
      const Forecast f = forecast(scene);
      double steps = 0;
      for (const StepForecast& s : f.steps) steps += s.steps;
      return f.stepping_s / (steps * f.contacts);
    };
    EXPECT_LT(of_a_contact(backend == Backend::cuda ? 0.04 : 0.02), 0.9 * of_a_contact(0.1)) << to_string(backend);
  }
}

// Compares the cost of a step, relative to the cost with three Kelvin units, with measurements. The prediction scales
// the cost of the whole step with the number of units, although a part of the step does not depend on it. With few
// units the predicted cost is therefore a fifth too large.
TEST_F(Check, KelvinUnitsCostWhatWasMeasured) {
  const auto rows = measured("kelvin-units-cpu.csv");
  ASSERT_EQ(rows.size(), 8u);
  for (const auto form : {ContactForm::condensed, ContactForm::points}) {
    const auto found = [&](int units) {
      const std::string name = std::string("step/ac14_ss_am1/cpu/") + to_string(form) + "/double/fixed/" +
                               (units < 0 ? "" : fmt::format("units:{}/", units)) + "threads:2";
      for (const auto& row : rows) {
        if (row.at("row") == (units < 0 ? "elastic " : "") + name)
          return std::pair(std::stod(row.at("us")), std::stod(row.at("held_bytes_per_contact")));
      }
      throw std::runtime_error("no row " + name);
    };
    const auto cost = [&](int units) { return step_cost(false, form, Precision::double_, Geometry::fixed, units); };
    const auto [time, bytes] = found(3);
    for (const int units : {-1, 0, 16}) {
      const auto [time_of, bytes_of] = found(units);
      EXPECT_NEAR(cost(units).seconds / cost(3).seconds, time_of / time, 0.25 * time_of / time)
          << to_string(form) << ", " << units;
      EXPECT_NEAR(cost(units).bytes / cost(3).bytes, bytes_of / bytes, 0.05 * bytes_of / bytes)
          << to_string(form) << ", " << units;
    }
  }
}

TEST_F(Check, AStepOfElasticContactsTakesLessTimeThanOneOfChains) {
  Scene scene = example("demo");
  scene.solver.backend = Backend::cpu;
  scene.solver.precision = Precision::double_;
  scene.solver.geometry = Geometry::fixed;
  const auto of_a_step = [&] {
    const Forecast f = forecast(scene);
    double steps = 0;
    for (const StepForecast& s : f.steps) steps += s.steps;
    return f.stepping_s / steps;
  };
  const double with_chains = of_a_step();
  scene.laws = elastic_laws();
  EXPECT_LT(of_a_step(), 0.8 * with_chains);
}

// A fitted law has many Kelvin units, and each unit has a state. The predicted memory of these states is within 10 % of
// the memory that a stepper takes for them.
TEST_F(Check, KelvinUnitsTakeTheMemoryThatAStepperTakes) {
  Scene scene = example("demo");
  scene.solver.backend = Backend::cpu;
  scene.solver.tolerance.reset();
  const Preparation made = prepare(scene);
  const Inertia inertia = make_inertia(made.specimen, scene.materials.aggregate, scene.materials.mastic);
  for (const auto form : {ContactForm::condensed, ContactForm::points}) {
    for (const auto precision : {Precision::single, Precision::double_}) {
      scene.solver.form = form, scene.solver.precision = precision;
      const auto with_units = [&](std::size_t units) {
        for (const PairType pair : {PairType::mm, PairType::ma}) {
          auto& law = std::get<laws::GeneralisedKelvin>(*scene.laws[static_cast<std::size_t>(pair)]);
          law.E.assign(units, 1e9), law.C.assign(units, 1e9);
        }
        StepperOptions options;
        options.dt = 1e-7;
        options.form = form, options.precision = precision, options.geometry = Geometry::fixed;
        const auto stepper = make_stepper(Backend::cpu, made.specimen, made.network, scene.laws, inertia, options);
        return std::pair(forecast(scene).host_bytes, static_cast<double>(stepper->bytes()));
      };
      const auto [few_foretold, few] = with_units(3);
      const auto [many_foretold, many] = with_units(16);
      EXPECT_NEAR(many_foretold - few_foretold, many - few, 0.1 * (many - few))
          << to_string(form) << ", " << to_string(precision);
    }
  }
}

TEST_F(Check, ASpecimenThatIsMadeTakesMoreTimeThanOneFromAFile) {
  Scene scene = example("mastic");
  scene.solver.backend = Backend::cpu;
  const double made = forecast(scene).specimen_s;
  scene.specimen.box.size.z *= 2;
  EXPECT_GT(forecast(scene).specimen_s, made);
  scene.specimen.file = folder_ / "t8.csv";
  scene.specimen.box.size = {0.008, 0.008, 0.011};
  EXPECT_LT(forecast(scene).specimen_s, made);
}

TEST_F(Check, TakesNoTimeForAMillionParticles) {
  std::string text = read(fs::path(MACADAM_EXAMPLES) / "demo/scene.toml");
  const std::string box = "[\"20 mm\", \"20 mm\", \"30 mm\"]";
  ASSERT_TRUE(contains(text, box));
  text.replace(text.find(box), box.size(), "[\"160 mm\", \"160 mm\", \"200 mm\"]");
  write(folder_ / "large.toml", text);
  Outcome outcome;
  const double work =
      units_of_work([&] { outcome = macadam("check " + path("large.toml") + " --backend cpu --json"); });
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto found = nlohmann::json::parse(outcome.out);
  EXPECT_GT(found["particles"], 900'000);
  EXPECT_GT(found["host_bytes"], 1e9);
  EXPECT_LT(work, 100);  // 5 s on two cores, if a unit takes 0.1 s; it takes a fifth of this
}

TEST_F(Check, SaysWhatARunWouldDoAndWritesNothing) {
  write_scene();
  const Outcome outcome = macadam("check " + path("scene.toml") + " --backend cpu");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* words :
       {"175 particles", "method explicit", "cpu", "20 Hz: about", "memory", "summary.json", "response.csv"})
    EXPECT_TRUE(contains(outcome.out, words)) << words << "\n" << outcome.out;
  EXPECT_FALSE(fs::exists(folder_ / "summary.json"));
}

// The check gives a warning if the file of the specimen is in metres and the box in millimetres. In the reverse case it
// gives a warning too, if such a scene can run at all.
TEST_F(Check, WarnsOfABoxThatIsAlmostEmpty) {
  const fs::path scene = write_scene("method = \"harmonic\"\n");
  const std::string usual = read(scene), box = "box = [0.008, 0.008, 0.011]";
  ASSERT_TRUE(contains(usual, box));
  EXPECT_FALSE(contains(macadam("check " + path("scene.toml")).out, "warning"));
  std::string large = usual;
  write(scene, large.replace(large.find(box), box.size(), "box = [8, 8, 11]"));
  const char* words = "% of the box of 8 x 8 x 11 m, expected 10 % or more; check that the lengths of the spheres and";
  EXPECT_HAS(macadam("check " + path("scene.toml")).out, words);
  EXPECT_TRUE(
      contains(nlohmann::json::parse(macadam("check --json " + path("scene.toml")).out).at("warnings").at(0), words));
  EXPECT_HAS(run_quick("out").out, words);
  EXPECT_TRUE(contains(summary("out").at("warnings").at(0), words));
  EXPECT_HAS(macadam(fmt::format("specimen {} --out {}", path("scene.toml"), path("specimen"))).out, words);
}

TEST_F(Check, RefusesWhatARunRefuses) {
  write(folder_ / "wrong.toml", "[specimen]\nbox = [1, 1, 1]\nsede = 3\n");
  const Outcome outcome = macadam("check " + path("wrong.toml"));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(contains(outcome.err, "seed (the nearest of")) << outcome.err;
  EXPECT_EQ(macadam("check " + path("nowhere.toml")).code, 2);
  write_scene();
  write(folder_ / "t8.csv", "id,x,y,z,radius,phase,body\n0,0.5,0,0,0.1,mastic,-1\n");  // outside of the box
  EXPECT_EQ(macadam("check " + path("scene.toml")).code, 2);
}

}  // namespace
}  // namespace macadam::test
