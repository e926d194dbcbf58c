// SPDX-License-Identifier: GPL-3.0-or-later
/// \file specimen_test.cpp  Tests reading, writing and checking of specimen files.
#include "macadam/specimen.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>

#include "host/spheres/sparse_box.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

const Box box{{0.05, 0.05, 0.08}};

/// Makes a folder for each test process and removes it at the end.
class SpecimenCsv : public testing::Test {
 protected:
  SpecimenCsv() { std::filesystem::create_directories(folder_); }
  ~SpecimenCsv() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path written(const std::string& text) const {
    const std::filesystem::path file = folder_ / "specimen.csv";
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  std::string message_for(const std::filesystem::path& file) const {
    try {
      read_specimen_csv(file, box);
    } catch (const InputError& error) { return error.what(); }
    return "(accepted)";
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("macadam_specimen_test_" + std::to_string(::getpid()));
};

const std::string header = "id,x,y,z,radius,phase,body\n";
const std::string good = "0,0.01,0.02,0.03,0.004,aggregate,0\n";

Specimen two_spheres() {
  return {box, {{0.01, 0.02, 0.03}, {0.04, 0.02, 0.03}}, {0.004, 0.001}, {Phase::aggregate, Phase::mastic}, {0, -1}};
}

// Stress is force over the cross-section, strain is displacement over the height.
TEST(LoadedSpecimen, SectionIsWidthTimesDepthAndGaugeLengthIsTheHeight) {
  Specimen s;
  s.box.size = {2, 3, 5};
  EXPECT_EQ(section_area(s), 6);
  EXPECT_EQ(gauge_length(s), 5);
  EXPECT_EQ(section_area(s.box), section_area(s));
  EXPECT_EQ(gauge_length(s.box), gauge_length(s));
}

TEST_F(SpecimenCsv, RoundTripIsExact) {
  Specimen s = two_spheres();
  // two of these numbers need 17 digits, and one is subnormal
  s.centre.push_back({1.0 / 3 * 0.05, std::nextafter(0.05, 0), 5e-324});
  s.radius.push_back(0.1 + 0.2);
  s.phase.push_back(Phase::aggregate);
  s.body.push_back(2147483647);
  const auto file = folder_ / "specimen.csv";
  write_specimen_csv(file, s);
  const Specimen t = read_specimen_csv(file, box);
  ASSERT_EQ(t.size(), s.size());
  for (std::size_t i = 0; i < s.size(); ++i) {
    EXPECT_EQ(t.centre[i].x, s.centre[i].x);
    EXPECT_EQ(t.centre[i].y, s.centre[i].y);
    EXPECT_EQ(t.centre[i].z, s.centre[i].z);
  }
  EXPECT_EQ(t.radius, s.radius);
  EXPECT_EQ(t.phase, s.phase);
  EXPECT_EQ(t.body, s.body);
  EXPECT_EQ(t.box.size.z, box.size.z);
}

/// A gzip file is recognized by its content, not its name.
TEST_F(SpecimenCsv, ReadsGzipToldByContent) {
  const std::string text = header + good;
  const auto file = folder_ / "no_gz_in_the_name";
  gzFile out = gzopen(file.c_str(), "wb");
  gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
  gzclose(out);
  EXPECT_EQ(read_specimen_csv(file, box).size(), 1u);
}

TEST_F(SpecimenCsv, ReadsThePaperSpecimen) {
  const Specimen s = read_specimen_csv(std::filesystem::path(MACADAM_TEST_DATA) / "ss_full.csv.gz", box);
  EXPECT_EQ(s.size(), 35760u);
  EXPECT_EQ(std::count(s.phase.begin(), s.phase.end(), Phase::mastic), 34164);
}

TEST_F(SpecimenCsv, KeepsFileOrderAndToleratesWindowsLineEnds) {
  const auto file = written(
      "\xEF\xBB\xBFid,x,y,z,radius,phase,body\r\n7,0.01,0.02,0.03,0.004,aggregate,0\r\n"
      "3,0.02,0.02,0.03,0.001,mastic,-1\r\n\r\n");
  const Specimen s = read_specimen_csv(file, box);
  ASSERT_EQ(s.size(), 2u);
  EXPECT_EQ(s.centre[0].x, 0.01);
  EXPECT_EQ(s.phase[1], Phase::mastic);
}

TEST_F(SpecimenCsv, BlankLinesMayEndALongFile) {
  std::string text = header;
  for (int i = 0; i < 1500; ++i)
    text += std::to_string(i) + "," + std::to_string(0.01 + 1e-5 * i) + ",0.02,0.03,0.001,mastic,-1\n";
  EXPECT_EQ(read_specimen_csv(written(text + "\n\n\n"), box).size(), 1500u);
}

TEST(SparseBox, IsOneOfWhichSpheresFillLessThanATenth) {
  const auto filled = [](double share) {
    Specimen s;
    s.box.size = {0.02, 0.03, 0.04};
    s.radius.assign(7, std::cbrt(share * s.box.volume() / 7 * 3 / (4 * std::numbers::pi)));
    return sparse_box(s);
  };
  EXPECT_EQ(filled(0.101), "");
  EXPECT_EQ(filled(0.099).rfind("spheres fill 9.9 % of the box of 0.02 x 0.03 x 0.04 m, expected 10 % or more", 0), 0u)
      << filled(0.099);
}

TEST_F(SpecimenCsv, BadFilesAreNamedByLine) {
  struct Case {
    std::string text, line;
    std::vector<std::string> words;
  };
  const Case cases[] = {
      {"", "", {"empty file", "id,x,y,z"}},
      {"\n\n", "", {"empty file"}},
      {header, "", {"particles", "found 0"}},
      {good, ":1:", {"header", "0,0.01", "id,x,y,z,radius,phase,body"}},
      {"id,x,y,z,radius,phase\n", ":1:", {"header"}},
      {header + good + "1,0.02,0.02,0.03,0.001,mastic\n", ":3:", {"columns", "found 6", "expected 7"}},
      {header + good + "1,0.02,0.02,0.03,0.001,mastic,-1,\n", ":3:", {"columns", "found 8"}},
      {header + "\n" + good, ":2:", {"line", "a blank line"}},
      {"\n" + header + good, ":1:", {"a blank line"}},
      {header + good + std::string(5000, '\n'), ":3:", {"a blank line"}},
      {header + good.substr(0, good.size() - 1), ":2:", {"last line", "no newline at its end", "may be cut off"}},
      {header + "0,0.01,0.02,0.03,0.004,mastic,-1", ":2:", {"no newline at its end"}},
      {header.substr(0, header.size() - 1), ":1:", {"no newline at its end"}},
      {header + good + std::string(100'000, '7') + "\n", ":3:", {"line", "more than 1000 bytes"}},
      {std::string(5'000'000, '\0'), ":1:", {"line", "more than 1000 bytes"}},
      {header + "0,abc,0.02,0.03,0.004,aggregate,0\n", ":2:", {"column x", "\"abc\"", "finite number"}},
      {header + "0,0.01,nan,0.03,0.004,aggregate,0\n", ":2:", {"column y", "\"nan\""}},
      {header + "0,0.01,0.02,inf,0.004,aggregate,0\n", ":2:", {"column z", "\"inf\""}},
      {header + "0,0.01,0.02,1e999,0.004,aggregate,0\n", ":2:", {"column z", "1e999"}},
      {header + "0,0.01,0.02,0.03mm,0.004,aggregate,0\n", ":2:", {"column z", "0.03mm"}},
      {header + "0,0.01,0.02, 0.03,0.004,aggregate,0\n", ":2:", {"column z", "\" 0.03\""}},
      {header + "0,0.01,0.02,0.03,,aggregate,0\n", ":2:", {"column radius", "\"\""}},
      {header + "0,0.01,0.02,0.03,0,aggregate,0\n", ":2:", {"particle 0", "radius", "found 0", "positive"}},
      {header + "0,0.01,0.02,0.03,-1,aggregate,0\n", ":2:", {"radius", "found -1"}},
      {header + "0,0.01,0.02,0.03,0.004,stone,0\n", ":2:", {"column phase", "stone", "aggregate, mastic or void"}},
      {header + "0,0.01,0.02,0.03,0.004,Mastic,-1\n", ":2:", {"column phase", "Mastic"}},
      {header + "0,0.01,0.02,0.03,0.004,aggregate,1.5\n", ":2:", {"column body", "1.5"}},
      {header + "0,0.01,0.02,0.03,0.004,aggregate,3000000000\n", ":2:", {"column body", "3000000000"}},
      {header + "0,0.01,0.02,0.03,0.004,aggregate,-1\n", ":2:", {"particle 0", "body", "found -1"}},
      {header + "0,0.01,0.02,0.03,0.004,mastic,0\n", ":2:", {"particle 0", "body", "expected -1"}},
      {header + "-1,0.01,0.02,0.03,0.004,aggregate,0\n", ":2:", {"column id", "-1"}},
      {header + "1.0,0.01,0.02,0.03,0.004,aggregate,0\n", ":2:", {"column id", "1.0"}},
      {header + good + "0,0.02,0.02,0.03,0.001,mastic,-1\n", ":3:", {"column id", "line 2"}},
      {header + good + "1,0.01,0.02,0.09,0.001,mastic,-1\n", ":3:", {"particle 1", "0.09", "box"}},
      {header + good + "1,0.01,0.02,0.03,0.001,mastic,-1\n", ":3:", {"particle 1", "particle 0", "coincident"}},
      {header + std::string("0,0.01,0.02,0.03,0.004,aggregate,\0\n", 36), ":2:", {"column body"}},
  };
  for (const Case& c : cases) {
    const auto file = written(c.text);
    const std::string message = message_for(file);
    EXPECT_EQ(message.rfind(file.string() + c.line, 0), 0u) << message << "\nfor: " << c.text;
    for (const std::string& word : c.words) EXPECT_NE(message.find(word), std::string::npos) << word << "\n" << message;
  }
}

TEST_F(SpecimenCsv, UnreadableFilesAreNamed) {
  EXPECT_NE(message_for(folder_ / "missing.csv").find("missing.csv: specimen: found No such file"), std::string::npos);
  EXPECT_NE(message_for(folder_).find("a directory"), std::string::npos);

  std::ifstream whole(std::filesystem::path(MACADAM_TEST_DATA) / "ss_full.csv.gz", std::ios::binary);
  std::string bytes(100'000, '\0');
  whole.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  EXPECT_NE(message_for(written(bytes)).find("complete readable file"), std::string::npos);
}

/// A compressed file may unpack to any size; the reader never keeps all of it in memory and stops at the first faulty
/// line.
TEST_F(SpecimenCsv, WhatUnpacksToGigabytesIsRefusedAtItsLine) {
  const auto bomb = [&](const std::string& begin, char c, std::size_t megabytes) {
    const auto file = folder_ / "bomb.csv.gz";
    gzFile out = gzopen(file.c_str(), "wb1");
    gzwrite(out, begin.data(), static_cast<unsigned>(begin.size()));
    const std::string filling(1 << 20, c);
    for (std::size_t k = 0; k < megabytes; ++k) gzwrite(out, filling.data(), static_cast<unsigned>(filling.size()));
    gzclose(out);
    return file;
  };
  for (const char c : {'\0', '0', '\n', '\r', ','}) {
    const auto file = bomb(header + good, c, 64);
    EXPECT_EQ(message_for(file).rfind(file.string() + ":3: line: found ", 0), 0u) << message_for(file);
  }
}

TEST_F(SpecimenCsv, LinesMayEndAnywhereInABlockOfTheReader) {
  for (std::size_t more = 0; more < 70; ++more) {  // the reader's blocks have 65,536 bytes
    std::string text = header + "999999,0.0" + std::string(more, '0') + "1,0.01,0.01,0.004,aggregate,0\n";
    std::size_t n = 1;
    for (; text.size() < 70'000; ++n)
      text +=
          std::to_string(n) + "," + std::to_string(1e-6 * static_cast<double>(n)) + ",0.02,0.03,0.004,aggregate,0\n";
    const auto file = written(text);
    EXPECT_EQ(message_for(file), "(accepted)");
    EXPECT_EQ(read_specimen_csv(file, box).size(), n);
  }
}

TEST_F(SpecimenCsv, ALineMayHaveAThousandBytesAndNoMore) {
  const auto of_length = [](std::size_t n) {  // lengthens the line by zeros at the end of x
    std::string line = good;
    line.insert(line.find(",0.02"), n + 1 - line.size(), '0');
    return line;
  };
  const auto file = written(header + of_length(1000));
  EXPECT_EQ(message_for(file), "(accepted)");
  EXPECT_EQ(read_specimen_csv(file, box).centre.at(0).x, 0.01);
  EXPECT_NE(message_for(written(header + of_length(1001))).find(":2: line: found more than 1000 bytes"),
            std::string::npos);
}

TEST_F(SpecimenCsv, KnowsTheLinesOfItsParticles) {
  const auto file = written(header + good + "1,0.01,0.02,0.04,0.004,aggregate,0\n");
  const Specimen s = read_specimen_csv(file, box);
  EXPECT_EQ(s.source, file.string());
  EXPECT_EQ(s.line_of(1), 3);
}

TEST_F(SpecimenCsv, AFileThatCannotBeWrittenIsARunError) {
  EXPECT_THROW(write_specimen_csv(folder_ / "no" / "such" / "folder.csv", two_spheres()), RunError);
}

TEST(Validate, AcceptsAGoodSpecimenAndThePointsOfTheWalls) {
  Specimen s = two_spheres();
  EXPECT_NO_THROW(validate(s, "here"));
  s.centre[0] = {0, 0.05, 0.08};
  EXPECT_NO_THROW(validate(s, "here"));
}

TEST(Validate, NamesSourceAndParticle) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  struct Case {
    std::function<void(Specimen&)> spoil;
    std::string expected;
  };
  const Case cases[] = {
      {[&](Specimen& s) { s.centre[1].y = nan; }, "here: particle 1: centre: found (0.04, nan, 0.03)"},
      {[&](Specimen& s) { s.centre[1].z = -1e-9; }, "here: particle 1: centre: found (0.04, 0.02, -1e-09)"},
      {[&](Specimen& s) { s.centre[0].x = inf; }, "here: particle 0: centre: found (inf"},
      {[&](Specimen& s) { s.radius[1] = inf; }, "here: particle 1: radius: found inf"},
      {[&](Specimen& s) { s.radius[1] = nan; }, "here: particle 1: radius: found nan"},
      {[&](Specimen& s) { s.radius[0] = 0; }, "here: particle 0: radius: found 0"},
      {[&](Specimen& s) { s.phase[0] = static_cast<Phase>(9); }, "here: particle 0: phase: found 9"},
      {[&](Specimen& s) { s.body[0] = -1; }, "here: particle 0: body of an aggregate particle: found -1"},
      {[&](Specimen& s) { s.body[1] = 0; }, "here: particle 1: body of a mastic particle: found 0"},
      {[&](Specimen& s) { s.centre[1] = s.centre[0]; }, "the centre of particle 0"},
      {[&](Specimen& s) { s.box.size.y = 0; }, "here: box: found (0.05, 0, 0.08)"},
      {[&](Specimen& s) { s.box.size.x = inf; }, "here: box: found (inf"},
      {[&](Specimen& s) { s.radius.pop_back(); }, "here: length of array radius: found 1, expected 2"},
      {[&](Specimen& s) {
         s = Specimen{box, {}, {}, {}, {}};
       },
       "here: particles: found 0"},
  };
  for (const Case& c : cases) {
    Specimen s = two_spheres();
    c.spoil(s);
    try {
      validate(s, "here");
      ADD_FAILURE() << "accepted; expected " << c.expected;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(c.expected), std::string::npos) << error.what();
    }
  }
}

TEST(Validate, MinusZeroCoincidesWithZero) {
  Specimen s = two_spheres();
  s.centre[0] = {0.0, 0.02, 0.03};
  s.centre[1] = {-0.0, 0.02, 0.03};
  EXPECT_THROW(validate(s, "here"), InputError);
}

TEST(PhaseName, IsTheFilesWord) {
  EXPECT_STREQ(to_string(Phase::aggregate), "aggregate");
  EXPECT_STREQ(to_string(Phase::mastic), "mastic");
}

}  // namespace
}  // namespace macadam
