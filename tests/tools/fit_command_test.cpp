// SPDX-License-Identifier: GPL-3.0-or-later
// fit_command_test.cpp  Runs `macadam fit` as a user does, and checks data files, results and messages.
#include <algorithm>
#include <cmath>

#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

using nlohmann::json;

class FitCommand : public Program {
 protected:
  void data(const std::string& text) const { write(folder_ / "data.csv", text); }
  Outcome fit(const std::string& options = "") const {
    return macadam(fmt::format("fit {} --out {} --no-pictures {}", path("data.csv"), path("law"), options));
  }
  /// Returns a column of a table of the fit; the first column has number 0.
  std::vector<double> column(const std::string& table, int number) const {
    std::vector<double> out;
    const std::vector<std::string> lines = lines_of(read(folder_ / "law" / table));
    for (std::size_t k = 1; k < lines.size(); ++k) {
      std::istringstream line(lines[k]);
      std::string cell;
      for (int c = 0; c <= number; ++c) std::getline(line, cell, ',');
      out.push_back(std::stod(cell));
    }
    return out;
  }
  /// Returns the error message for a data file that is refused.
  std::string refused(const std::string& text, const std::string& options = "") const {
    data(text);
    const Outcome outcome = fit(options);
    EXPECT_EQ(outcome.code, 2) << text << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "law")) << text;
    return outcome.err;
  }
};

constexpr const char* example = MACADAM_EXAMPLES "/laws/mastic.csv";

TEST_F(FitCommand, TheExampleGivesALawThatASceneReads) {
  fs::copy_file(example, folder_ / "data.csv");
  const Outcome outcome = fit("--shift wlf --reference-temperature 15");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* word : {"AICc", "taken", "E_m", "C1", "|E*|: rms", "law.toml fit.json"})
    EXPECT_HAS(outcome.out, word);
  const json found = json::parse(read(folder_ / "law" / "fit.json"));
  EXPECT_LT(found["errors"]["e_star_rms"], 0.05);
  EXPECT_EQ(found["reference_temperature_c"], 15);
  EXPECT_EQ(found["covariance"]["matrix"].size(), found["parameters"].size());
  EXPECT_EQ(lines_of(read(folder_ / "law" / "fit.csv")).size(), 1 + lines_of(read(example)).size() - 4) << "comments";

  const std::string contacts = read(folder_ / "law" / "law.toml");
  write(folder_ / "scene.toml", "[specimen]\nbox = [1, 1, 1]\nfile = \"t8.csv\"\n[materials.mastic]\ndensity = 2000\n" +
                                    contacts + "[loading]\nkind = \"cyclic\"\nfrequencies = [1]\n");
  const Scene scene = read_scene(folder_ / "scene.toml");
  const auto& law = std::get<laws::GeneralisedKelvin>(*scene.laws[static_cast<std::size_t>(PairType::mm)]);
  EXPECT_EQ(law.E_m, found["law"]["E_m_pa"]) << "to the bit";
  EXPECT_EQ(law.C, found["law"]["C_pa_s"].get<std::vector<double>>());
}

TEST_F(FitCommand, TheCovarianceMatrixIsSquareAndHasTheDeviations) {
  fs::copy_file(example, folder_ / "data.csv");
  ASSERT_EQ(fit("--shift arrhenius --units 2").code, 0);
  const json found = json::parse(read(folder_ / "law" / "fit.json"));
  const json &parameters = found["parameters"], &of = found["covariance"]["of"];
  const auto matrix = found["covariance"]["matrix"].get<std::vector<std::vector<double>>>();
  ASSERT_GE(parameters.size(), 6u);  // a spring, two units and the shift
  ASSERT_EQ(matrix.size(), parameters.size());
  for (const auto& row : matrix) ASSERT_EQ(row.size(), matrix.size());
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    // An entry of the matrix is a sum of a few terms. No term is larger than the square root of the product of the two
    // variances.
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_NEAR(matrix[i][k], matrix[k][i], 1e-14 * std::sqrt(matrix[i][i] * matrix[k][k])) << i << " " << k;
    const bool logarithmic = of[i].get<std::string>().starts_with("ln ");
    const double times = logarithmic ? parameters[i]["value"].get<double>() : 1;
    const double deviation = parameters[i]["standard_deviation"].get<double>();
    EXPECT_NEAR(deviation / (times * std::sqrt(matrix[i][i])), 1, 1e-14) << of[i];
  }
}

TEST_F(FitCommand, TheCurveReachesHalfADecadeBeyondTheData) {
  fs::copy_file(example, folder_ / "data.csv");
  ASSERT_EQ(fit("--shift arrhenius --units 2").code, 0);
  const std::vector<double> data = column("fit.csv", 3), curve = column("curve.csv", 0);  // reduced frequencies
  const auto [lowest, highest] = std::minmax_element(data.begin(), data.end());
  ASSERT_GT(curve.size(), 2u);
  // Each value is a product of a few factors; the tolerance is their rounding.
  EXPECT_NEAR(curve.front() / (*lowest / std::sqrt(10.0)), 1, 1e-14);
  EXPECT_NEAR(curve.back() / (*highest * std::sqrt(10.0)), 1, 1e-14);
}

TEST_F(FitCommand, PicturesAreDrawnOrItIsSaidHow) {
  fs::copy_file(example, folder_ / "data.csv");
  const Outcome outcome =
      macadam(fmt::format("fit {} --out {} --shift arrhenius --units 2", path("data.csv"), path("law")));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const bool drawn = contains(outcome.out, "pictures: master-curve.png cole-cole.png black.png\n");
  for (const char* name : {"master-curve.png", "cole-cole.png", "black.png"})
    EXPECT_EQ(fs::exists(folder_ / "law" / name), drawn) << outcome.out;
  EXPECT_HAS(outcome.out, drawn ? "pictures" : "draw-fit");
}

TEST_F(FitCommand, ShearModuliTakePoissonsRatio) {
  data("phase_deg,g_star_pa,frequency_hz,g_star_std,phase_std\n0.5,1e9,1,1e7,1\n0.5,1e9,2,1e7,1\n0.5,1e9,4,1e7,1\n");
  const Outcome outcome = fit("--poisson 0.25 --units 0 --no-flow");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json found = json::parse(read(folder_ / "law" / "fit.json"));
  EXPECT_NEAR(found["law"]["E_m_pa"].get<double>(), 2.5e9, 25);  // 2·(1 + 0.25)·1e9, accurate to 1e-8
  EXPECT_EQ(found["deviations"], "of the data");
  // Each of the three measurements has a standard deviation of 1 %, so their mean has 1 %/√3.
  EXPECT_NEAR(found["parameters"][0]["standard_deviation"].get<double>(), 2.5e9 * 0.01 / std::sqrt(3.0), 1e3);
}

TEST_F(FitCommand, AModelBecomesAChain) {
  write(folder_ / "model.toml",
        "model = \"2s2p1d\"\nE_0 = \"35 GPa\"\nE_00 = 8e7\nk = 0.18\nh = 0.56\ndelta = 2.1\ntau = 0.08\nbeta = 250\n"
        "shift = \"arrhenius\"\nactivation_energy = \"210 kJ/mol\"\nreference_temperature = 10\n");
  const std::string convert = fmt::format("fit --parameters {} --out {} ", path("model.toml"), path("law"));
  const Outcome outcome = macadam(convert + "--from 0.01 --to 100 --error 0.01");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_HAS(outcome.out, "largest error 0.");
  EXPECT_HAS(read(folder_ / "law" / "law.toml"), "activation_energy = 210000.0");
  EXPECT_HAS(macadam(convert).err, "--from and --to");
  for (const auto& [key, value, said] : {std::tuple{"k = 0.18", "k = 0.6", "less than h"},
                                         {"beta = 250", "", "because the model is \"2s2p1d\""},
                                         {"tau = 0.08", "tau = -1", "a positive number"},
                                         {"E_00 = 8e7", "E_00 = 9e10", "less than E_0"},
                                         {"beta = 250", "betta = 250", "beta (the nearest"},
                                         {"reference_temperature = 10", "", "this key, which shift"}}) {
    std::string text = read(folder_ / "model.toml");
    text.replace(text.find(key), std::string(key).size(), value);
    write(folder_ / "wrong.toml", text);
    const Outcome wrong =
        macadam(fmt::format("fit --parameters {} --out {} --from 1 --to 2", path("wrong.toml"), path("x")));
    EXPECT_EQ(wrong.code, 2) << value;
    EXPECT_HAS(wrong.err, said);
  }
}

/// The isotherms are far apart, so the least-squares iteration tries shifts for which the modulus is not finite. The
/// command must not print anything about these shifts.
TEST_F(FitCommand, NothingIsSaidBesideTheFit) {
  data(
      "frequency_hz,temperature_c,e_star_pa,phase_deg\n"
      "1,0,1.1148303e+10,0.082527421\n"
      "2,0,1.1211191e+10,-0.73416492\n"
      "4,0,1.1199884e+10,0.59837539\n"
      "1,30,7.9823078e+08,77.084008\n"
      "2,30,1.5337389e+09,76.787277\n"
      "4,30,2.8844752e+09,68.670394\n"
      "1,60,4961798.7,88.985576\n"
      "2,60,9975852.3,88.416911\n"
      "4,60,19841053,85.618214\n");
  for (const char* shift : {"wlf", "arrhenius", "free"}) {
    const Outcome outcome = fit(fmt::format("--shift {}", shift));
    EXPECT_EQ(outcome.code, 0) << shift;
    EXPECT_EQ(outcome.err, "") << shift;
    const json found = json::parse(read(folder_ / "law" / "fit.json"));
    // The noise of the data is 1 %. There are nine measurements, and a free shift has more parameters than the
    // Arrhenius law. So with a free shift the criterion chooses one Kelvin unit less, and the error is larger.
    EXPECT_LT(found["errors"]["e_star_rms"], std::string(shift) == "free" ? 0.05 : 0.02) << shift;
  }
  data("frequency_hz,e_star_pa,phase_deg\n1,1e9,80\n2,5e8,10\n3,2e9,89\n4,1e8,1\n5,3e9,45\n6,1e9,30\n");
  EXPECT_HAS(fit().out, "warning: the fit misses |E*| by");
}

/// If no chain of Kelvin units approximates the fitted model to the requested error, the command still writes the fit,
/// but no law.
TEST_F(FitCommand, AModelThatNoChainReachesIsWrittenAllTheSame) {
  fs::copy_file(example, folder_ / "data.csv");
  write(folder_ / "law" / "fit.json", "{}");
  write(folder_ / "law" / "law.toml", "# of an older fit");
  const Outcome outcome = fit("--shift wlf --model 2s2p1d --error 1e-6");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_HAS(outcome.err, "units reach, or a shorter range");
  EXPECT_HAS(outcome.out, "beta");
  EXPECT_HAS(outcome.out, "law: fit.json fit.csv curve.csv\n");
  const json found = json::parse(read(folder_ / "law" / "fit.json"));
  EXPECT_LT(found["errors"]["e_star_rms"], 0.03);
  EXPECT_FALSE(found.contains("law"));
  EXPECT_FALSE(fs::exists(folder_ / "law" / "law.toml"));
}

TEST_F(FitCommand, ColumnsThatAreNotUsedAreNamed) {
  data("sample,frequency_hz,e_star_mpa,phase_deg\nA,1,2000,30\nA,10,4000,20\nA,100,6000,12");
  const Outcome outcome = fit("--units 0");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_HAS(outcome.out, "data.csv that are not used: sample\n");
  EXPECT_EQ(column("fit.csv", 4), (std::vector<double>{2e9, 4e9, 6e9}));
}

/// Pictures are drawn by the Python of MACADAM_PYTHON, as reports are.
TEST_F(FitCommand, PicturesTakeThePythonThatIsNamed) {
  fs::copy_file(example, folder_ / "data.csv");
  write(folder_ / "python", "#!/bin/sh\ntouch \"$3/master-curve.png\"\n");
  fs::permissions(folder_ / "python", fs::perms::owner_all);
  setenv("MACADAM_PYTHON", (folder_ / "python").c_str(), 1);
  const Outcome outcome =
      macadam(fmt::format("fit {} --out {} --shift arrhenius --units 2", path("data.csv"), path("law")));
  unsetenv("MACADAM_PYTHON");
  EXPECT_HAS(outcome.out, "pictures: master-curve.png");
  EXPECT_EQ(fs::file_size(folder_ / "law" / "master-curve.png"), 0u);
}

TEST_F(FitCommand, FaultyDataAreNamedByLineAndColumn) {
  const std::string header = "frequency_hz,e_star_pa,phase_deg\n";
  EXPECT_HAS(refused(header + "1,1e9,10\n2,none,10\n"),
             "data.csv:3: column e_star_pa: found \"none\", expected a positive");
  EXPECT_HAS(refused(header + "1,1e9,10\n-2,1e9,10\n"), "data.csv:3: column frequency_hz: found \"-2\"");
  EXPECT_HAS(refused(header + "1,nan,10\n"), "data.csv:2: column e_star_pa");
  EXPECT_HAS(refused(header + "1,1e999,10\n"), "data.csv:2: column e_star_pa");
  EXPECT_HAS(refused(header + "1,1e9,-30\n"), "column phase_deg: found \"-30\", expected degrees between");
  EXPECT_HAS(refused(header + "1,1e9,95\n"), "column phase_deg: found \"95\", expected degrees between");
  EXPECT_HAS(refused(header + "1,1e9,-5\n"), "column phase_deg: found \"-5\", expected degrees between");
  EXPECT_HAS(refused(header + "1,inf,10\n"), "data.csv:2: column e_star_pa: found \"inf\"");
  EXPECT_HAS(refused(header + "0,1e9,10\n"), "data.csv:2: column frequency_hz: found \"0\"");
  EXPECT_HAS(refused(header + "1,1e9\n"), "columns: found 2 in \"1,1e9\", expected 3");
  EXPECT_HAS(refused(header), "only a header");
  EXPECT_HAS(refused(""), "an empty file");
  EXPECT_HAS(refused("frequency,e_star_pa,phase_deg\n1,1,1\n"),
             "found \"frequency\", expected frequency_hz (the nearest");
  EXPECT_HAS(refused("frequency_hz;e_star_pa;phase_deg\n"), "only a header");
  EXPECT_HAS(refused("frequency_hz,e_star_pa,e_star_pa,phase_deg\n"), "twice");
  EXPECT_HAS(refused("e_star_pa,phase_deg\n"), "a column frequency_hz");
  EXPECT_HAS(refused("frequency_hz,phase_deg\n"), "e_star_pa or g_star_pa with phase_deg, or e_prime_pa");
  EXPECT_HAS(refused("frequency_hz,e_star_pa,phase_deg,phase_std\n"), "of both modulus and phase");
  EXPECT_HAS(refused("frequency_hz,g_star_pa,phase_deg\n1,1,1\n"), "--poisson");
  EXPECT_HAS(refused(header + "1,1e9,10\n", "--poisson 0.3"),
             "expected no Poisson's ratio, because the file already has |E*|");
  EXPECT_HAS(refused(header + "1,1e9,10\n", "--shift wlf"), "no column temperature_c");
  EXPECT_HAS(refused(header + "1,1e9,10\n", "--units -1"), "--units");
  EXPECT_HAS(refused(header + "1,1e9,10\n", "--flow --no-flow"), "--no-flow");
  EXPECT_HAS(refused(header + "1,1e9,10\n"), "expected more");
  EXPECT_HAS(macadam(fmt::format("fit {} --out x", path("nowhere.csv"))).err, "no such file");
  EXPECT_HAS(macadam("fit --out x").err, "what to fit: found nothing");
}

/// Curves without a slope do not determine the shift between them. The shift is bounded, and the fit ends.
TEST_F(FitCommand, FlatIsothermsFarApartAreFitted) {
  std::string table = "temperature_c,frequency_hz,e_star_pa,phase_deg\n";
  for (const auto& [temperature, modulus] : {std::pair{-20.0, 3e10}, {60.0, 1e9}}) {
    for (int k = 0; k < 5; ++k)
      table += fmt::format("{},{},{},2\n", temperature, std::pow(10.0, 0.5 * k - 1), modulus * (1 + 0.005 * k));
  }
  write(folder_ / "flat.csv", table);
  const Outcome fit =
      macadam(fmt::format("fit {} --shift free --no-pictures --out {}", path("flat.csv"), path("flat")));
  EXPECT_EQ(fit.code, 0) << fit.err;
}

}  // namespace
}  // namespace macadam::test
