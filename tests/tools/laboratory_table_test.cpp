// SPDX-License-Identifier: GPL-3.0-or-later
// laboratory_table_test.cpp  Reads tables of measured moduli as laboratories write them: units, spellings and error
// messages.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.hpp"

namespace macadam::test {
namespace {

class LaboratoryTable : public TestFolder {
 protected:
  ModulusData read_text(const std::string& text, std::optional<double> poisson = {},
                        Measured needed = Measured::modulus_and_phase) const {
    write(folder_ / "lab.csv", text);
    return read_modulus_data(folder_ / "lab.csv", poisson, needed);
  }
  std::string refusal(const std::string& text, std::optional<double> poisson = {},
                      Measured needed = Measured::modulus_and_phase) const {
    return message_of([&] { read_text(text, poisson, needed); });
  }
};

/// Expects two measurements: 2.5 GPa at 1.5 Hz and 5 GPa at 10 Hz, at 20 °C.
void expect_the_two(const ModulusData& data, const std::string& what) {
  ASSERT_EQ(data.points.size(), 2u) << what;
  EXPECT_TRUE(data.temperatures) << what;
  const double frequencies[] = {1.5, 10}, moduli[] = {2.5e9, 5e9}, phases[] = {30.5, 20};
  for (std::size_t i = 0; i < 2; ++i) {
    // Each number is a product of two or three rounded factors; the tolerance is their rounding.
    EXPECT_NEAR(data.points[i].frequency_hz / frequencies[i], 1, 1e-14) << what;
    EXPECT_NEAR(data.points[i].e_star_pa / moduli[i], 1, 1e-14) << what;
    EXPECT_NEAR(data.points[i].phase_deg, phases[i], 1e-12) << what;
    EXPECT_NEAR(data.points[i].temperature_c, 20, 1e-12) << what;
  }
}

TEST_F(LaboratoryTable, SpellingsOfLaboratoriesGiveTheSameNumbers) {
  const std::string plain = "frequency_hz,e_star_pa,phase_deg,temperature_c\n1.5,2.5e9,30.5,20\n10,5e9,20,20\n";
  for (const std::string& text : {
           plain,
           plain.substr(0, plain.size() - 1),  // no newline at the end of the file
           "\xEF\xBB\xBF" + plain,
           std::string("\"frequency_hz\",\"e_star_pa\",\"phase_deg\",\"temperature_c\"\r\n1.5,2.5e9,\"30.5\",20\r\n"
                       "10,5e9,20,20\r\n"),
           std::string("Frequency_Hz;E_star_MPa;Phase_deg;Temperature_C\n1,5;2500;30,5;20\n10;5,0e3;20;20\n;;;\n"),
           std::string("# rheometer\n\nfrequency_hz\te_star_gpa\tphase_deg\ttemperature_k\n1.5\t2.5\t30.5\t293.15\n"
                       "10\t5\t20\t293.15\n"),
           std::string("frequency_hz,e_star_mpa,phase_deg,temperature_c\nHz,[MPa],deg,\xC2\xB0"
                       "C\n1.5,2500,30.5,20\n10,5000,20,20\n"),
           std::string("frequency,e_star,phase,temperature\n(Hz),(kPa),(\xC2\xB0),K\n1.5,2500000,30.5,293.15\n"
                       "10,5e6,20,293.15\n"),
           std::string("sample,frequency_hz,e_star_pa,phase_deg,temperature_c,,strain\nA1,1.5,2.5e9,30.5,20,,1e-4\n"
                       "A1,10,5e9,20,20,,\n"),
       })
    expect_the_two(read_text(text), text);
  expect_the_two(read_text("omega_rad_s,g_star_kpa,phase_rad,temperature_c\n9.42477796076938,1e6,0.532325421858271,20\n"
                           "62.83185307179586,2e6,0.349065850398866,20\n",
                           0.25),
                 "shear, angular frequency, radians");  // |E*| = 2.5 |G*|
}

TEST_F(LaboratoryTable, DeviationsHaveTheUnitsOfTheirColumns) {
  const ModulusData data = read_text("frequency_hz,e_star_mpa,phase_rad,e_star_std,phase_std\n1,2500,0.5,50,0.01\n");
  EXPECT_TRUE(data.deviations);
  EXPECT_DOUBLE_EQ(data.points[0].e_star_std, 50e6);
  EXPECT_NEAR(data.points[0].phase_std, 0.572957795130823, 1e-14);
}

TEST_F(LaboratoryTable, RealAndImaginaryPartsMakeModulusAndPhase) {
  const ModulusData data = read_text("frequency_hz,e_prime_mpa,e_double_prime_gpa\n1,3000,4\n");
  EXPECT_DOUBLE_EQ(data.points[0].e_star_pa, 5e9);
  EXPECT_NEAR(data.points[0].phase_deg, 53.1301023541560, 1e-12);
  EXPECT_DOUBLE_EQ(read_text("frequency_hz,g_prime_kpa,g_double_prime_kpa\n1,3e6,4e6\n", 0.5).points[0].e_star_pa,
                   15e9);
  EXPECT_DOUBLE_EQ(read_text("frequency_hz,e_star_pa,phase_deg,e_prime_pa,e_double_prime_pa\n1,1e9,10,3e9,4e9\n")
                       .points[0]
                       .e_star_pa,
                   1e9)
      << "modulus and phase are there, the parts are passed over";
}

TEST_F(LaboratoryTable, OneMessageListsAllThatIsWrong) {
  const std::string said = refusal("frequency_hz,e_star_pa,phase_deg\n1,1e9,10\n-2,1e9,10\n3,none,10\n5,1e9,200\n");
  for (const char* line : {"lab.csv:3: column frequency_hz: found \"-2\"",
                           "lab.csv:4: column e_star_pa: found \"none\"", "lab.csv:5: column phase_deg: found \"200\""})
    EXPECT_HAS(said, line);
  const std::string cells = refusal("frequency_hz,e_star,phase_dg\n1,1e9\n2,1e9,10,3\n");
  for (const char* line : {"lab.csv:1: header: found \"e_star\"", "lab.csv:1: header: found \"phase_dg\"",
                           "lab.csv:2: columns: found 2", "lab.csv:3: columns: found 4"})
    EXPECT_HAS(cells, line);
  std::string many = "frequency_hz,e_star_pa,phase_deg\n";
  for (int i = 0; i < 30; ++i) many += "1,x,10\n";
  EXPECT_HAS(refusal(many), "and 20 more in this file");
}

TEST_F(LaboratoryTable, UnitsThatCannotBeMeantAreAskedAbout) {
  const std::string header = "frequency_hz,e_star_pa,phase_deg,temperature_c\n";
  EXPECT_HAS(refusal(header + "1,9000,15,20\n10,14000,9,20\n"), "is it in Pa? Moduli in MPa");
  EXPECT_HAS(refusal(header + "1,2e5,40,20\n"), "is it in Pa?");
  EXPECT_HAS(refusal(header + "1,9e9,15,283.15\n1,5e9,20,303.15\n"),
             "if these are kelvins, name the column temperature_k");
  EXPECT_HAS(refusal("frequency_hz,e_star_mpa,phase_deg,temperature_k\n1,9000,15,20\n"),
             "if these are degrees Celsius");
  EXPECT_HAS(refusal("frequency_hz,e_star_mpa,phase_deg\n1,9e9,15\n"), "another unit than the name of the column says");
  EXPECT_HAS(refusal("frequency_hz,e_star_pa,phase_deg\nHz,MPa,deg\n1,9000,15\n"),
             "unit of e_star_pa: found \"MPa\", expected Pa, as the name of the column says");
  // Shear moduli of a binder in kPa: at 46 degrees 5 MPa, at 68 degrees 0.6 MPa, at 82 degrees 40 kPa, at 88 degrees 2
  // kPa.
  for (const char* row : {"10,5000,46", "10,600,68", "10,40,82", "10,2,88"}) {
    const std::string said = refusal(std::string("frequency_hz,g_star_pa,phase_deg\n1,0.5,89\n") + row + "\n", 0.5);
    EXPECT_HAS(said, "column g_star_pa: found moduli of 0.5 to ") << row;
    EXPECT_HAS(said, "is it in Pa? Moduli in MPa, GPa or kPa have a column such as g_star_mpa") << row;
  }
  // A hot binder is soft, and a rubber has a modulus of some MPa; both are accepted.
  EXPECT_NO_THROW(read_text(header + "0.01,20,89,80\n10,9e3,84,80\n"));
  EXPECT_NO_THROW(read_text("frequency_hz,e_star_mpa,phase_deg\n1,2,5\n"));
}

/// |E*| that rises as f^(1/3) has a phase of about 30 degrees, which is 0.52 radians.
TEST_F(LaboratoryTable, RadiansInAColumnOfDegreesAreAskedAbout) {
  const std::string header = "frequency_hz,e_star_mpa,phase_deg\n";
  EXPECT_HAS(refusal(header + "1,1000,0.55\n10,2150,0.5\n"),
             "column phase_deg: found phases of 0.5 to 0.55, expected larger phases in degrees for such a change of "
             "the moduli; if these are radians, name the column phase_rad");
  EXPECT_HAS(refusal(header + "1,1000,0.12\n10,1200,0.1\n"), "if these are radians") << "nearly glassy: 0.079 · 90 = 7";
  EXPECT_HAS(refusal("frequency_hz,e_star_mpa,phase_deg,temperature_c\n1,9000,0.2,0\n1,900,0.9,30\n"),
             "if these are radians")
      << "one frequency, two temperatures";
  EXPECT_HAS(refusal("frequency_hz,phase_deg\n1,0.5\n", {}, Measured::phase), "if these are radians");
  EXPECT_NO_THROW(read_text(header + "1,60000,0.5\n10,60500,0.4\n")) << "a rock, nearly elastic";
  EXPECT_NO_THROW(read_text("frequency_hz,e_star_mpa,phase_rad\n1,1000,0.55\n10,2150,0.5\n"));
}

TEST_F(LaboratoryTable, DeviationsHaveTheUnitOfTheirColumnBelowARowOfUnitsToo) {
  const std::string header = "frequency_hz,e_star_mpa,phase_deg,e_star_std,phase_std\n";
  const std::string said = refusal(header + "Hz,MPa,deg,Pa,rad\n1,2500,30,5e7,0.01\n");
  EXPECT_HAS(said, "lab.csv:2: unit of e_star_std: found \"Pa\", expected MPa, the unit of e_star_mpa");
  EXPECT_HAS(said, "lab.csv:2: unit of phase_std: found \"rad\", expected degrees, the unit of phase_deg");
  EXPECT_DOUBLE_EQ(read_text(header + "Hz,MPa,deg,[MPa],\xC2\xB0\n1,2500,30,50,1\n").points[0].e_star_std, 50e6);
}

TEST_F(LaboratoryTable, OneMessageListsFaultsOfHeaderRowsAndUnits) {
  const std::string said = refusal(
      "frequency_hz,e_star_pa,phase_deg,temperature_c\n1,9000,0.3,293.15\n10,20000,0.2,293.15\nx,14000,0.2,293.15\n");
  for (const char* part :
       {"lab.csv:4: column frequency_hz: found \"x\"", "is it in Pa?", "if these are radians", "if these are kelvins"})
    EXPECT_HAS(said, part);
  const std::string header = refusal("frequency_hz,e_star_pa,phase_dg\n1,-9e9,15\n");
  EXPECT_HAS(header, "found \"phase_dg\"");
  EXPECT_HAS(header, "lab.csv:2: column e_star_pa: found \"-9e9\"");
}

TEST_F(LaboratoryTable, ColumnsThatAreNotNeededNeedNotBeThere) {
  const std::string moduli = "frequency_hz,e_star_pa\n1,9e9\n", phases = "frequency_hz,phase_deg\n1,15\n";
  EXPECT_HAS(refusal(moduli), "with phase_deg");
  EXPECT_FALSE(read_text(moduli, {}, Measured::modulus).phases);
  EXPECT_FALSE(read_text(phases, {}, Measured::phase).moduli);
  EXPECT_TRUE(read_text("frequency_hz,e_star_pa,e_star_std\n1,9e9,1e8\n", {}, Measured::modulus).deviations);
  EXPECT_EQ(read_text("sample,frequency_hz,e_star_pa,phase_deg,residual\nA,1,9e9,15,0\n").unused,
            (std::vector<std::string>{"sample", "residual"}));
  EXPECT_FALSE(read_text("temperature_c,frequency_hz,e_star_pa,phase_deg\n,1,9e9,15\n").temperatures)
      << "an empty column";
}

TEST_F(LaboratoryTable, MisspeltColumnsAreNotPassedOver) {
  EXPECT_HAS(refusal("frequency_hz,e_star_pa,phase_dg\n1,9e9,15\n"),
             "found \"phase_dg\", expected phase_deg (the nearest");
  EXPECT_HAS(refusal("frequency_hz,e_star_pa,phase_deg,temperature\n1,9e9,15,20\n"),
             "found \"temperature\", expected temperature_c");
  EXPECT_HAS(refusal("frequency_hz,e_star_pa,e_star_mpa,phase_deg\n1,9e9,9e3,15\n"), "beside e_star_pa");
  EXPECT_HAS(refusal("frequency_hz,e_star_pa,g_star_pa,phase_deg\n1,9e9,9e3,15\n"), "columns of E* and of G*");
  EXPECT_HAS(refusal("frequency_hz;e_star_pa;phase_deg\n1,5;9.000,0;15\n"), "found \"9.000,0\"");
  EXPECT_HAS(refusal("frequency_hz,e_star_pa,phase_deg\n1,\"9e9,15\n"), "as many opening as closing");
  // Either the comma of 0,1 or the point of 14.082 separates thousands, so the table is ambiguous.
  EXPECT_HAS(refusal("frequency_hz;e_star_mpa;phase_deg\n0,1;14.082;15\n"),
             "decimal sign: found \"14.082\", expected the same as in \"0,1\" of line 2");
}

}  // namespace
}  // namespace macadam::test
