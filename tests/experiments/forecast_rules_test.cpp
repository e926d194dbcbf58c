// SPDX-License-Identifier: GPL-3.0-or-later
// forecast_rules_test.cpp  Compares the cycles and steps in the forecast of `macadam check` with the plan of the run.
// Compares the forecast's list of files with the files that runs of every kind and method write.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "host/experiments/cyclic/plan.hpp"
#include "host/experiments/transient/load_plan.hpp"
#include "host/simulation/forecast.hpp"
#include "tests/support/test_folder.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

/// Logarithm of the largest allowed ratio of the numbers of steps in forecast and plan, if the forecast estimates the
/// time step. The estimate uses the smallest sphere and its stiffest contact. For the specimen t8, where walls cut
/// spheres, the ratio is 2.07. A limit of 2 would require a better estimate from the areas of the contacts, which a
/// forecast does not know because it makes no cells.
const double estimated_step = std::log(2.5);

class ForecastRules : public TestFolder {
 protected:
  Scene scene(const std::string& loading, const std::string& solver, const std::string& output = "") const {
    return read_scene(write_t8(loading, "backend = \"cpu\"\n" + solver, output));
  }
};

// A forecast has no contacts, so it estimates the critical step, a part of the density scaling and the modulus of the
// slowest wave. Numbers of steps that depend on these estimates are within a factor of 2.5 of the plan; with a given
// time step they are exact.
TEST_F(ForecastRules, CyclesAndStepsOfACyclicTestAreThoseOfItsPlan) {
  const std::string twenty = "kind = \"cyclic\"\nfrequencies = [20.0, 2.0]\n";
  struct Case {
    std::string loading, solver;
    int cycles;
  };
  for (const Case& c : std::vector<Case>{
           {"", "density_scaling = 1e4\n", 5},
           {"", "density_scaling = [1e4, 1e6]\ntime_step = 1e-6\n", 5},
           {"cycles = 3\n", "density_scaling = 1e4\n", 3},
           {"ramp_cycles = 6\n", "density_scaling = 1e4\n", 8},
           {"", "tolerance = 1e-3\n", 1},
           {"", "tolerance = 1e-3\ntime_step = 2e-5\n", 1},
           {"start = \"rest\"\n", "tolerance = 1e-3\n", 5},
           {"start = \"rest\"\n", "tolerance = 1e-4\n", 12},
           {"start = \"steady\"\n", "density_scaling = 1e4\n", 1},
           {"start = \"steady\"\nstrain_amplitude = 1e-2\n", "density_scaling = 1e4\n", 5},
           {"start = \"steady\"\nstrain_amplitude = 1e-2\n", "density_scaling = 1e4\ngeometry = \"fixed\"\n", 1},
           {"start = \"steady\"\nfit_cycles = 4\n", "density_scaling = 1e4\ndamping = 0.1\n", 5},
           {"samples_per_cycle = 50\n", "density_scaling = 1e8\ndamping_kind = \"viscous\"\ndamping = 1e5\n", 5}}) {
    const Scene asked = scene(twenty + c.loading, c.solver);
    const Preparation made = prepare(asked);
    const Inertia inertia = make_inertia(made.specimen, asked.materials.aggregate, asked.materials.mastic);
    PhaseSeconds phases;
    const Plan plan = make_plan(asked, made, inertia, {}, Backend::cpu, phases);
    const Forecast found = forecast(asked);
    ASSERT_EQ(found.steps.size(), plan.frequencies.size());
    EXPECT_EQ(found.geometry, plan.geometry) << c.loading << c.solver;
    for (std::size_t i = 0; i < found.steps.size(); ++i) {
      const FrequencyPlan& f = plan.frequencies[i];
      EXPECT_EQ(f.cycles, c.cycles) << c.loading << c.solver;
      EXPECT_EQ(found.steps[i].cycles, c.cycles) << c.loading << c.solver;
      const double steps = static_cast<double>(f.loading.steps_per_period * f.cycles);
      const bool given = asked.solver.time_step || asked.solver.damping > 1;
      EXPECT_NEAR(std::log(found.steps[i].steps / steps), 0, given ? 1e-12 : estimated_step) << c.loading << c.solver;
      if (asked.solver.density_scaling) { EXPECT_EQ(found.steps[i].density_scaling, f.density_scaling); }
    }
  }
}

/// For relaxation, creep and constant rates the forecast's number of steps agrees with the plan in the same way.
TEST_F(ForecastRules, StepsOfALoadAreThoseOfItsPlan) {
  const std::string times = "times = [1e-2, 5e-2]\n", method = "method = \"explicit\"\n";
  for (const std::string& loading :
       {"kind = \"relaxation\"\n" + times, "kind = \"relaxation\"\nramp = 3e-3\n" + times,
        "kind = \"creep\"\nstress = 1e5\nrelease = 3e-2\n" + times, "kind = \"monotonic\"\nrate = 0.01\n" + times}) {
    for (const std::string solver : {"density_scaling = 1e4\n", "density_scaling = 100\nsafety = 0.3\n",
                                     "density_scaling = 1e4\ndamping_kind = \"viscous\"\ndamping = 1e6\n",
                                     "density_scaling = 1e4\ntime_step = 7e-6\n"}) {
      const Scene asked = scene(loading, method + solver);
      const Preparation made = prepare(asked);
      const Inertia inertia = make_inertia(made.specimen, asked.materials.aggregate, asked.materials.mastic);
      const LoadPlan plan = make_load_plan(load_test_of(asked), asked, made, inertia);
      const StepForecast found = forecast(asked).steps.at(0);
      const double steps = static_cast<double>(plan.step_at(5e-2));
      const bool given = asked.solver.time_step || asked.solver.damping_given;
      EXPECT_NEAR(std::log(found.steps / steps), 0, given ? 0.01 : estimated_step) << loading << solver;
      EXPECT_EQ(found.density_scaling, plan.density_scaling);
    }
  }
}

/// Returns the files of a folder and their sizes in bytes. In names of frames, `*` replaces the number of the frame,
/// and the sizes of all frames are added up.
std::map<std::string, double> files_in(const fs::path& folder) {
  std::map<std::string, double> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::string name = fs::relative(entry.path(), folder).string();
    const std::size_t number = name.find("_0");
    if (name.starts_with("fields/") && name.ends_with(".vtp") && number != std::string::npos)
      name = name.substr(0, number + 1) + "*.vtp";
    out[name] += static_cast<double>(entry.file_size());
  }
  return out;
}

void expect_files(const Scene& asked, const fs::path& out) {
  run(asked, out);
  const Forecast found = forecast(asked);
  ASSERT_EQ(found.files.size(), found.file_bytes.size());
  const auto written = files_in(out);
  std::set<std::string> names;
  for (const auto& [name, bytes] : written) names.insert(name);
  EXPECT_EQ(std::set<std::string>(found.files.begin(), found.files.end()), names);
  double sum = 0;
  for (std::size_t i = 0; i < found.files.size(); ++i) {
    const auto at = written.find(found.files[i]);
    if (at == written.end()) continue;
    sum += at->second;
    // the sizes of smaller files vary with the text in them and with the block size of the disk
    constexpr double large = 2e4;
    if (at->second > large) {
      EXPECT_NEAR(std::log(found.file_bytes[i] / at->second), 0, std::log(2))
          << found.files[i] << ": " << at->second << ", predicted " << found.file_bytes[i];
    }
  }
  EXPECT_NEAR(std::log(found.disk_bytes() / sum), 0, std::log(2)) << sum << ", predicted " << found.disk_bytes();
}

TEST_F(ForecastRules, FilesAreThoseThatRunsWrite) {
  const std::string times = "times = [1e-3, 2e-3]\npoints = 3\n", light = "density_scaling = 1e6\n",
                    heavy = "method = \"explicit\"\ndensity_scaling = 100\n", none = "method = \"harmonic\"\n";
  const std::string cyclic = "kind = \"cyclic\"\nfrequencies = [20.0]\ncycles = 1\n",
                    relaxation = "kind = \"relaxation\"\n" + times, creep = "kind = \"creep\"\nstress = 1e5\n" + times,
                    monotonic = "kind = \"monotonic\"\nrate = 0.01\n" + times,
                    sweep = "kind = \"sweep\"\nfrequencies = [1.0, 10.0]\n";
  struct Case {
    std::string loading, solver, output;
  };
  for (const Case& c :
       std::vector<Case>{{cyclic, light, ""},
                         {cyclic, light, "response = false\ncontacts = true\n"},
                         {cyclic, none, ""},
                         {cyclic, none, "fields = [\"particles\", \"contacts\", \"cells\"]\n"},
                         {cyclic, light, "fields = [\"particles\", \"contacts\", \"cells\"]\n"},
                         {cyclic, light, "fields = [\"particles\", \"contacts\"]\nevery = 100\nformat = \"vtp\"\n"},
                         {cyclic, light + "form = \"points\"\n", "fields = [\"contacts\"]\nevery = 10\n"},
                         {sweep, none, ""},
                         {sweep, none, "fields = [\"particles\"]\nformat = \"vtp\"\n"},
                         {relaxation, none, ""},
                         {relaxation, none, "[network]\nlateral_walls = true\n"},
                         {relaxation, heavy, ""},
                         {creep, none, ""},
                         {creep, heavy, "fields = [\"particles\"]\nevery = 1\n"},
                         {monotonic, none, ""},
                         {monotonic, heavy, "contacts = true\n"}}) {
    SCOPED_TRACE(c.loading + c.solver + c.output);
    const fs::path folder = out("out");
    fs::remove_all(folder);
    expect_files(scene(c.loading, c.solver, c.output), folder);
  }
}

// The list of files includes aggregates.csv if the generated specimen has aggregates.
TEST_F(ForecastRules, FilesOfAMadeSpecimen) {
  for (const char* name : {"stepped_creep", "mastic"}) {
    Scene asked = read_scene(fs::path(MACADAM_EXAMPLES) / name / "scene.toml");
    asked.solver.method = SolverMethod::harmonic;
    asked.solver.backend = Backend::cpu;
    SCOPED_TRACE(name);
    expect_files(asked, out(name));
  }
}

// Soft contacts beside stiff ones slow the iterative solver down. If they are soft enough, the forecast expects the
// direct solver instead, which needs more memory.
TEST_F(ForecastRules, SoftScenesTakeLonger) {
  const auto of = [&](const char* frequency, const char* linear = "auto") {
    return forecast(scene(fmt::format("kind = \"cyclic\"\nfrequencies = [{}]\n", frequency),
                          fmt::format("method = \"harmonic\"\nlinear = \"{}\"\n", linear)));
  };
  EXPECT_GT(of("1e-3").harmonic_s, 2 * of("10.0").harmonic_s);
  EXPECT_GT(of("1e-9").host_bytes, of("10.0").host_bytes);
  EXPECT_EQ(of("1e-9", "iterative").host_bytes, of("10.0").host_bytes);
  EXPECT_EQ(of("10.0", "direct").host_bytes, of("1e-9").host_bytes);
}

// Heat softens the viscoelastic contacts, which slows the iterative solver down. The same temperature gives the same
// forecast in [loading] as in [materials].
TEST_F(ForecastRules, SolutionsAreThoseOfTheirTemperature) {
  const auto seconds = [&](const std::string& materials, const std::string& temperatures) {
    const fs::path file = write_t8("kind = \"cyclic\"\nfrequencies = [10.0]\n" + temperatures,
                                   "backend = \"cpu\"\nmethod = \"harmonic\"\n");
    std::string text = read(file);
    const std::string shift = "shift = \"wlf\"\nC1 = 14.0\nC2 = 120.0\nreference_temperature = 10.0\n";
    for (std::size_t at = 0; (at = text.find("alpha = 0.10\n", at)) != std::string::npos; at += shift.size() + 1)
      text.insert(at, shift);
    text.insert(text.find("[loading]\n"), materials);
    write(file, text);
    return forecast(read_scene(file)).harmonic_s;
  };
  const double at_reference = seconds("", ""), hot = seconds("[materials]\ntemperature = 60.0\n", "");
  EXPECT_GT(hot, 2 * at_reference);
  EXPECT_EQ(seconds("", "temperatures = [60.0]\n"), hot);
  EXPECT_NEAR(seconds("", "temperatures = [10.0, 60.0]\n") / (at_reference + hot), 1, 1e-12);
}

}  // namespace
}  // namespace macadam::test
