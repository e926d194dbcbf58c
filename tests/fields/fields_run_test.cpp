// SPDX-License-Identifier: GPL-3.0-or-later
// fields_run_test.cpp  Tests the field files of specimens, stepped runs and steady states: which files are written and
// which frames they have, also after a run was resumed.
#include <sstream>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <numbers>

#include "tests/support/hdf5_numbers.hpp"
#include "tests/support/test_folder.hpp"

namespace macadam::test {
namespace {

class RunFields : public TestFolder {
 protected:
  Scene scene(const std::string& output, const std::string& loading = "frequencies = [20.0]\ncycles = 1\n",
              const std::string& solver = "density_scaling = 1e5\n") const {
    return read_scene(
        write_t8("kind = \"cyclic\"\nsamples_per_cycle = 40\n" + loading, "backend = \"cpu\"\n" + solver, output));
  }
  std::vector<std::string> files(const std::string& name) const {
    std::vector<std::string> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(out(name) / "fields", error)) {
      found.push_back(entry.path().filename().string());
    }
    std::sort(found.begin(), found.end());
    return found;
  }
};

using Names = std::vector<std::string>;

TEST_F(RunFields, NothingIsWrittenUnasked) {
  run(scene(""), out("out"));
  EXPECT_FALSE(fs::exists(out("out") / "fields"));
}

TEST_F(RunFields, ASteppedRunHasAFrameEverySoManySamples) {
  run(scene("fields = [\"particles\", \"cells\"]\nevery = 8\n"), out("out"));
  EXPECT_EQ(files("out"), (Names{"cells.vtkhdf", "particles_20Hz.vtkhdf"}));
  const H5::H5File file = open_hdf5(out("out") / "fields/particles_20Hz.vtkhdf");
  EXPECT_EQ(steps(file), 6);
  const auto times = numbers(file, "VTKHDF/Steps/Values"), u = numbers(file, "VTKHDF/PointData/displacement");
  constexpr std::size_t particles = 175;
  ASSERT_EQ(u.size(), 3 * particles * times.size());
  const auto z = numbers(file, "VTKHDF/Points");
  for (std::size_t k = 0; k < times.size(); ++k) {
    EXPECT_NEAR(times[k], 0.05 * static_cast<double>(k) / 5, 1e-12);
    // The wall moves as −A·sin ωt. Particles move in the same direction, but less; upper particles move more than lower
    // ones.
    const double wall = -1e-4 * 0.011 * std::sin(2 * std::numbers::pi * 20 * times[k]);
    double lower = 0, upper = 0;
    for (std::size_t i = 0; i < particles; ++i) {
      (z[3 * i + 2] < 0.0055 ? lower : upper) += u[3 * (k * particles + i) + 2] / wall;
    }
    if (k % 5 == 0) continue;  // the wall is at its initial position
    EXPECT_GT(upper, 1.5 * lower) << times[k];
    EXPECT_GT(lower, 0);
  }
}

// At every frame the contacts of the top wall carry the stress in response.csv. This holds in the contact forms
// `points` and `condensed`, and with rotating contact frames.
TEST_F(RunFields, ContactsOfASteppedRunCarryItsStress) {
  for (const std::string form : {"condensed", "points"}) {
    const Scene asked = scene("fields = [\"contacts\"]\nevery = 8\n", "frequencies = [20.0]\ncycles = 1\n",
                              "density_scaling = 1e5\nform = \"" + form + "\"\n");
    run(asked, out("out"));
    const ContactNetwork network = prepare(asked).network;
    const H5::H5File file = open_hdf5(out("out") / "fields/contacts_20Hz.vtkhdf");
    const auto force = numbers(file, "VTKHDF/CellData/force");
    const std::size_t contacts = network.contacts.size();
    ASSERT_EQ(force.size(), 3 * contacts * 6);
    std::istringstream response(read(out("out") / "response.csv"));
    std::string line;
    std::getline(response, line);
    double largest = 0;
    for (int sample = 0; std::getline(response, line); ++sample) {
      const double stress = std::stod(line.substr(line.rfind(',') + 1));
      largest = std::max(largest, std::abs(stress));
      if (sample % 8 != 0) continue;
      double sum = 0;
      for (std::size_t c = 0; c < contacts; ++c) {
        if (network.contacts[c].b == wall_z_hi)
          sum += force[3 * (static_cast<std::size_t>(sample / 8) * contacts + c) + 2];
      }
      EXPECT_NEAR(sum / (0.008 * 0.008), stress, 1e-5 * largest) << form << ", sample " << sample;
    }
    EXPECT_GT(largest, 1e5);
    EXPECT_EQ(file.openGroup("VTKHDF/CellData").exists("stretch_1"), form == "condensed");
  }
}

TEST_F(RunFields, TwentyFramesACycleWhereTheSceneDoesNotSay) {
  run(scene("fields = [\"particles\"]\nresponse = false\n"), out("out"));
  EXPECT_EQ(steps(open_hdf5(out("out") / "fields/particles_20Hz.vtkhdf")), 21);
}

/// A run that is interrupted and resumed leaves the same field files as an uninterrupted one.
TEST_F(RunFields, AResumedRunLeavesTheFileOfOneThatWasNotInterrupted) {
  const std::string two = "frequencies = [10.0, 20.0]\ncycles = 1\n";
  for (const std::string format : {"vtkhdf", "vtp"}) {
    const Scene asked = scene("fields = [\"particles\"]\nevery = 3\nformat = \"" + format + "\"\n", two);
    run_until(asked, "whole", 0);
    run_until(asked, "pieces", 25);
    run_until(asked, "pieces", 40, true);
    run_until(asked, "pieces", 0, true);
    ASSERT_EQ(files("pieces"), files("whole"));
    for (const std::string& name : files("whole")) {
      if (format == "vtp") {
        EXPECT_TRUE(read(out("pieces") / "fields" / name) == read(out("whole") / "fields" / name)) << name;
        continue;
      }
      const H5::H5File pieces = open_hdf5(out("pieces") / "fields" / name),
                       whole = open_hdf5(out("whole") / "fields" / name);
      EXPECT_EQ(steps(pieces), 14);
      for (const char* set :
           {"Steps/Values", "PointData/displacement", "PointData/force", "Steps/PointDataOffsets/spin"})
        EXPECT_EQ(numbers(pieces, std::string("VTKHDF/") + set), numbers(whole, std::string("VTKHDF/") + set)) << name;
    }
  }
}

/// If the field file is missing, a resumed run begins another one and warns.
TEST_F(RunFields, WithoutItsFileAResumedRunBeginsAnother) {
  const Scene asked = scene("fields = [\"particles\"]\nevery = 2\n");
  run_until(asked, "out", 25);
  fs::remove(out("out") / "fields/particles_20Hz.vtkhdf");
  const RunResult result = run(asked, out("out"), {}, true);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_HAS(result.warnings[0], "particles_20Hz had no frame to continue from; its first frame is at t = 0.0");
  const H5::H5File file = open_hdf5(out("out") / "fields/particles_20Hz.vtkhdf");
  EXPECT_GT(numbers(file, "VTKHDF/Steps/Values").front(), 0.01);
  EXPECT_EQ(numbers(file, "VTKHDF/Steps/Values").back(), 0.05);
}

TEST_F(RunFields, ASteadyStateHasAFileAFrequencyAndTemperature) {
  run(scene("fields = [\"particles\", \"contacts\", \"cells\"]\n", "frequencies = [20.0, 0.1]\n",
            "method = \"harmonic\"\n"),
      out("out"));
  EXPECT_EQ(files("out"), (Names{"cells.vtkhdf", "contacts_0.1Hz.vtkhdf", "contacts_20Hz.vtkhdf",
                                 "particles_0.1Hz.vtkhdf", "particles_20Hz.vtkhdf"}));
  const H5::H5File file = open_hdf5(out("out") / "fields/particles_20Hz.vtkhdf");
  EXPECT_FALSE(file.openGroup("VTKHDF").exists("Steps"));
  // the top wall moves by 1e-4 of 11 mm
  double most = 0;
  for (const double u : numbers(file, "VTKHDF/PointData/displacement_amplitude")) most = std::max(most, u);
  EXPECT_GT(most, 0.7 * 1.1e-6);
  EXPECT_LT(most, 1.1 * 1.1e-6);
  run(scene("fields = [\"particles\"]\nformat = \"vtp\"\n", "frequencies = [20.0]\n", "method = \"harmonic\"\n"),
      out("out"));
  EXPECT_EQ(files("out"), Names{"particles_20Hz.vtp"});  // the files of the earlier run are removed
}

TEST_F(RunFields, ASpecimenHasFieldsWithoutTime) {
  prepare_into(out("out"), scene("fields = [\"contacts\", \"cells\", \"particles\"]\n"));
  EXPECT_EQ(files("out"), (Names{"cells.vtkhdf", "contacts.vtkhdf", "particles.vtkhdf"}));
  const H5::H5File contacts = open_hdf5(out("out") / "fields/contacts.vtkhdf");
  EXPECT_FALSE(contacts.openGroup("VTKHDF/CellData").exists("force"));
  EXPECT_TRUE(contacts.openGroup("VTKHDF/CellData").exists("area"));
  write(out("out") / "fields/mine.txt", "the user's own");
  prepare_into(out("out"), scene("fields = [\"cells\"]\nformat = \"vtp\"\n"));
  EXPECT_EQ(files("out"), (Names{"cells.vtp", "mine.txt"}));
  prepare_into(out("out"), scene(""));
  EXPECT_EQ(files("out"), Names{"mine.txt"});
}

TEST_F(RunFields, AFileInPlaceOfTheFolderIsNamed) {
  fs::create_directories(out("out"));
  write(out("out") / "fields", "a file");
  EXPECT_HAS(message_of([&] { prepare_into(out("out"), scene("fields = [\"cells\"]\n")); }),
             (out("out") / "fields").string() + ": cannot make the folder of the fields");
}

TEST_F(RunFields, KeysOfASceneAreChecked) {
  const auto refused = [&](const std::string& output) { return message_of([&] { scene(output); }); };
  EXPECT_HAS(refused("fields = [\"particle\"]\n"), "found \"particle\", expected one of \"particles\", \"contacts\"");
  EXPECT_HAS(refused("fields = \"particles\"\n"), "[output] fields: found \"particles\", expected an array of");
  EXPECT_HAS(refused("fields = [\"cells\", \"cells\"]\n"), "entry 2: found \"cells\" twice, expected each field once");
  EXPECT_HAS(refused("fields = [\"cells\"]\nevery = 0\n"), "[output] every: found 0, expected an integer from 1");
  EXPECT_HAS(refused("fields = [\"cells\"]\nformat = \"vtk\"\n"), "expected one of \"vtkhdf\", \"vtp\"");
  EXPECT_HAS(refused("every = 3\n"), "[output] every: found 3 without the key fields");
  EXPECT_HAS(refused("fields = []\nformat = \"vtp\"\n"), "format: found \"vtp\" without the key fields");
  EXPECT_HAS(refused("field = []\n"), "expected fields (the nearest of");
  EXPECT_TRUE(scene("fields = []\n").output.fields.any() == false);
}

}  // namespace
}  // namespace macadam::test
