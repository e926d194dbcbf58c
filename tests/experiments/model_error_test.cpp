// SPDX-License-Identifier: GPL-3.0-or-later
// model_error_test.cpp  Compares the table of the error of the model with the file of the study, and tests which row a
// run gets.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "host/run/model_error.hpp"

namespace macadam::test {
namespace {

/// Returns the rows of model-error.csv of rule "series" with the published spheres, by the names of the columns.
std::vector<std::map<std::string, std::string>> study() {
  std::ifstream in(MACADAM_EXAMPLES "/../bench/results/model-error.csv");
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> out;
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (names.empty()) {
      names = cells;
      continue;
    }
    auto& one = out.emplace_back();
    for (std::size_t i = 0; i < cells.size(); ++i) one[names[i]] = cells[i];
    // the cells of voids have the volumes of the voids unless a scene asks for the other cells
    if (one["rule"] != "series" || one["mastic_radius_m"] != "0.00075 0.001" || one["void_rule"] == "spheres")
      out.pop_back();
  }
  return out;
}

/// Returns the ratio of the table that is nearest to the ratio of a row, by their quotient.
double nearest_ratio(double ratio) {
  double out = 0;
  for (const StudiedModel& m : studied_models)
    if (out == 0 || std::abs(std::log(m.ratio / ratio)) < std::abs(std::log(out / ratio))) out = m.ratio;
  return out;
}

TEST(ModelError, TheTableIsThatOfTheStudy) {
  const auto rows = study();
  ASSERT_GT(rows.size(), 60u);
  for (const StudiedModel& m : studied_models) {
    SCOPED_TRACE(testing::Message() << m.voids << " " << m.rock << " " << m.ratio);
    ModelError found;
    int count = 0;
    for (const auto& r : rows) {
      const auto value = [&](const char* name) { return std::stod(r.at(name)); };
      const double rock = value("rock_nominal");
      const bool of_row =
          m.rock < 0.3 ? rock < 0.3
                       : std::abs(rock - m.rock) < 0.01;  // specimens with 12 % of rock (shapes) and 20 % share one row
      if ((value("void_nominal") > 0) != m.voids || !of_row || nearest_ratio(value("ratio")) != m.ratio) continue;
      ++count;
      found.e_star = std::max(found.e_star, std::abs(value("error_percent")) / 100);
      found.phase_deg = std::max(found.phase_deg, std::abs(value("phase_error_deg")));
      found.uncertainty = std::max(found.uncertainty, value("continuum_uncertainty") / value("continuum_over_mastic"));
    }
    EXPECT_GE(count, 3);
    // the table is rounded up to 0.1 %, 0.1 degrees
    EXPECT_GE(m.error.e_star, found.e_star);
    EXPECT_LE(m.error.e_star, found.e_star + 0.0011);
    EXPECT_GE(m.error.phase_deg, found.phase_deg);
    EXPECT_LE(m.error.phase_deg, found.phase_deg + 0.11);
    EXPECT_GE(m.error.uncertainty, found.uncertainty - 0.0005);
    EXPECT_LE(m.error.uncertainty, found.uncertainty + 0.0011);
  }
}

TEST(ModelError, TheRowsOnBothSidesDecide) {
  EXPECT_DOUBLE_EQ(model_error(false, 0.30, 10)->e_star, 0.056);  // 40 % of rock, ratios 5 and 20
  EXPECT_DOUBLE_EQ(model_error(false, 0.30, 2)->e_star, 0.020);   // below the lowest ratio
  EXPECT_DOUBLE_EQ(model_error(false, 0.402, 5)->e_star, 0.020);
  EXPECT_DOUBLE_EQ(model_error(true, 0.10, 30)->phase_deg, 2.1);
  EXPECT_FALSE(model_error(false, 0.60, 10));
  EXPECT_FALSE(model_error(true, 0.50, 10));
  EXPECT_FALSE(model_error(false, 0.30, 201));
  EXPECT_FALSE(model_error(false, 0.30, NAN));
}

TEST(ModelError, WordsSayWhatIsOutside) {
  ModelErrorOfRun of{0.6, 5, 20, false, {}};
  EXPECT_NE(words_of(of).find("outside of the studied range"), std::string::npos);
  of.error = ModelError{0.046, 0.032, 1.1};
  EXPECT_NE(words_of(of).find("4.6 % of |E*| and 1.1 degrees"), std::string::npos) << words_of(of);
}

}  // namespace
}  // namespace macadam::test
