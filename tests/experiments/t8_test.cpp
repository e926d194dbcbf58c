// SPDX-License-Identifier: GPL-3.0-or-later
// t8_test.cpp  Compares complete runs on a specimen of 175 particles with |E*| and φ of an independent program without
// inertia. The remaining difference comes from the scaled mass, the time step and the start.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

constexpr Stiffness at_20_hz{11.69667e9, 6.97771}, at_2_hz{8.710352e9, 27.43740};
constexpr int cycles = 8, samples_per_cycle = 500;

struct Response {
  RunResult result;
  std::vector<ResponseSample> samples;  ///< as read from response.csv
  nlohmann::json summary;
};

class T8 : public testing::Test {
 protected:
  void SetUp() override {
    if (!long_tests) GTEST_SKIP() << "hundreds of thousands of steps: not in sanitizer and coverage builds";
    folder_ = std::filesystem::path(testing::TempDir()) /
              fmt::format("macadam_t8_{}_{}", testing::UnitTest::GetInstance()->current_test_info()->name(), getpid());
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  Response run_t8(double frequency, double density_scaling, ContactForm form) const {
    Scene scene;
    scene.specimen.file = MACADAM_TEST_DATA "/t8.csv";
    scene.specimen.box.size = {0.008, 0.008, 0.011};
    scene.materials = {2630, 2110};
    scene.laws = am1_laws();
    scene.cyclic().frequencies = {frequency};
    scene.cyclic().cycles = cycles;
    scene.cyclic().fit_cycles = 2;
    scene.cyclic().samples_per_cycle = samples_per_cycle;
    scene.solver.density_scaling = std::vector<double>{density_scaling};
    scene.solver.form = form;
    scene.solver.backend = Backend::cpu;
    scene.solver.threads = 1;  // the tests of this file run in parallel
    Response out;
    out.result = run(scene, folder_);
    out.samples = read_response(folder_ / "response.csv");
    out.summary = nlohmann::json::parse(std::ifstream(folder_ / "summary.json"));
    return out;
  }

  static void expect_accurate(const Response& response, const Stiffness& expected) {
    ASSERT_EQ(response.result.stepped().frequencies.size(), 1u);
    const Stiffness found = response.result.stepped().frequencies[0].stiffness;
    EXPECT_NEAR(found.e_star_pa / expected.e_star_pa, 1, 5e-5);
    EXPECT_NEAR(found.phase_deg, expected.phase_deg, 0.005);
  }

 private:
  static std::vector<ResponseSample> read_response(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(line, "frequency_hz,time_s,strain,stress_pa");
    std::vector<ResponseSample> out;
    ResponseSample s{};
    char comma = 0;
    while (in >> s.frequency_hz >> comma >> s.time_s >> comma >> s.strain >> comma >> s.stress_pa) out.push_back(s);
    EXPECT_TRUE(in.eof());
    return out;
  }

  std::filesystem::path folder_;
};

// The two contact forms, `condensed` and `points`, add the same numbers in a different order.
TEST_F(T8, TwentyHertzInBothForms) {
  const Response condensed = run_t8(20, 100, ContactForm::condensed), points = run_t8(20, 100, ContactForm::points);
  expect_accurate(condensed, at_20_hz);
  expect_accurate(points, at_20_hz);
  ASSERT_EQ(condensed.samples.size(), points.samples.size());
  double difference = 0, amplitude = 0;
  for (std::size_t k = 0; k < points.samples.size(); ++k) {
    ASSERT_EQ(condensed.samples[k].time_s, points.samples[k].time_s);
    difference = std::max(difference, std::abs(condensed.samples[k].stress_pa - points.samples[k].stress_pa));
    amplitude = std::max(amplitude, std::abs(points.samples[k].stress_pa));
  }
  EXPECT_LT(difference, 1e-10 * amplitude);
  EXPECT_GT(amplitude, 0.9e-4 * at_20_hz.e_star_pa);
  fmt::print("forms differ by {:.2g} of the amplitude\n", difference / amplitude);
}

TEST_F(T8, TwoHertzCondensed) { expect_accurate(run_t8(2, 1000, ContactForm::condensed), at_2_hz); }

// Inertia is proportional to scaling × f². At 2 Hz with a scaling of 10,000 it is therefore the same as at 20 Hz with a
// scaling of 100, and the tolerances are the same too. A scaling of 1,000 would take three times as many steps.
TEST_F(T8, TwoHertzPoints) { expect_accurate(run_t8(2, 10'000, ContactForm::points), at_2_hz); }

// The effect of inertia is proportional to the scaling: at 20 Hz a scaling of 1000 changes |E*| visibly. The test also
// checks the files of this run.
TEST_F(T8, TwentyHertzScaledByAThousand) {
  const Response response = run_t8(20, 1000, ContactForm::condensed);
  const Stiffness found = response.result.stepped().frequencies[0].stiffness;
  const double error = found.e_star_pa / at_20_hz.e_star_pa - 1;
  EXPECT_GT(error, -1.8e-4);
  EXPECT_LT(error, -1.0e-4);
  EXPECT_NEAR(found.phase_deg, at_20_hz.phase_deg, 0.005);

  ASSERT_EQ(response.samples.size(), static_cast<std::size_t>(cycles * samples_per_cycle + 1));
  EXPECT_EQ(response.samples.front().stress_pa, 0);
  EXPECT_NEAR(response.samples.back().time_s, cycles / 20.0, 1e-12);
  for (std::size_t k = 0; k < response.samples.size(); ++k) {
    const double angle = 2 * 3.14159265358979323846 * static_cast<double>(k) / samples_per_cycle;
    ASSERT_NEAR(response.samples[k].strain, -1e-4 * std::sin(angle), 1e-4 * 1e-12);
  }

  const nlohmann::json& summary = response.summary;
  EXPECT_EQ(summary.at("status"), "done");
  EXPECT_EQ(summary.at("particles"), 175);
  std::int64_t contacts = 0;
  for (const char* pair : {"A-A", "M-A", "M-M", "inner", "A-W", "M-W"}) {
    contacts += summary.at("contacts").at(pair).get<std::int64_t>();
  }
  EXPECT_GT(contacts, 4 * 175);
  EXPECT_EQ(summary.at("dropped").at("gap"), 0);
  EXPECT_EQ(summary.at("dropped").at("area"), 0);
  EXPECT_GT(summary.at("volume_fractions").at("aggregate"), 0);
  EXPECT_GT(summary.at("volume_fractions").at("mastic"), 0);
  ASSERT_EQ(summary.at("results").size(), 1u);
  const auto& result = summary.at("results").at(0);
  EXPECT_EQ(result.at("frequency_hz"), 20);
  EXPECT_EQ(result.at("e_star_pa"), found.e_star_pa);
  EXPECT_EQ(result.at("phase_deg"), found.phase_deg);
  EXPECT_EQ(result.at("method"), "explicit");
  EXPECT_LT(result.at("residual"), 1e-2);
  EXPECT_EQ(summary.at("solver").at("steps"), response.result.stepped().frequencies[0].steps);
  EXPECT_EQ(summary.at("solver").at("dt_s"), response.result.stepped().frequencies[0].dt_s);
  EXPECT_EQ(summary.at("solver").at("backend"), "cpu");
  EXPECT_EQ(summary.at("solver").at("precision"), "double");
  for (const char* stage : {"specimen", "tessellation", "network", "solve"}) {
    EXPECT_GE(summary.at("timing_s").at(stage), 0) << stage;
  }
}

}  // namespace
}  // namespace macadam::test
