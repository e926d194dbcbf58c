// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scene_file.hpp  A valid scene whose lines tests can change, and a temporary folder for its file.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "macadam/error.hpp"
#include "macadam/scene.hpp"

namespace macadam::test {

/// A valid scene with every kind of section; line k of the file is entry k − 1.
inline const std::vector<std::string> good_scene = {
    "[specimen]",                           // 1
    "box = [0.02, \"20 mm\", 0.03]",        // 2
    "seed = 7",                             // 3
    "[[specimen.aggregate]]",               // 4
    "sieve = [0.00475, \"9.5 mm\"]",        // 5
    "volume_fraction = 0.25",               // 6
    "[specimen.mastic]",                    // 7
    "radius = [\"0.75 mm\", \"1.00 mm\"]",  // 8
    "porosity = \"5 %\"",                   // 9
    "[materials.aggregate]",                // 10
    "density = 2630",                       // 11
    "[materials.mastic]",                   // 12
    "density = \"2.11 g/cm3\"",             // 13
    "[[contacts]]",                         // 14
    "pair = \"M-M\"",                       // 15
    "law = \"generalised_kelvin\"",         // 16
    "E_m = 1.115e10",                       // 17
    "C_m = \"2.515 GPa s\"",                // 18
    "E = [3.799e8, \"1.6 GPa\"]",           // 19
    "C = [8.950e9, 5.695e9]",               // 20
    "alpha = 0.10",                         // 21
    "[[contacts]]",                         // 22
    "pair = \"A-W\"",                       // 23
    "law = \"elastic\"",                    // 24
    "E = \"115.1 GPa\"",                    // 25
    "delta = 2",                            // 26
    "[network]",                            // 27
    "quadrature = \"lumped\"",              // 28
    "[loading]",                            // 29
    "kind = \"cyclic\"",                    // 30
    "frequencies = [\"2 Hz\", 5]",          // 31
    "strain_amplitude = 1e-4",              // 32
    "cycles = 5",                           // 33
    "ramp_cycles = 0.5",                    // 34
    "[solver]",                             // 35
    "method = \"explicit\"",                // 36
    "density_scaling = [100, 16]",          // 37
    "time_step = \"0.1 us\"",               // 38
    "form = \"condensed\"",                 // 39
    "damping = 0.0",                        // 40
    "[output]",                             // 41
    "contacts = true",                      // 42
    "[[contacts]]",                         // 43
    "pair = \"M-A\"",                       // 44
    "law = \"elastic\"",                    // 45
    "E = 1e10",                             // 46
    "[[contacts]]",                         // 47
    "pair = \"M-W\"",                       // 48
    "law = \"elastic\"",                    // 49
    "E = 1e10",                             // 50
};

/// Line numbers and their new texts. An empty text leaves a blank line, so that later lines keep their numbers.
using Edits = std::map<int, std::string>;

inline std::string text_of(const Edits& edits = {}) {
  std::vector<std::string> lines = good_scene;
  for (const auto& [line, text] : edits) lines.at(static_cast<std::size_t>(line - 1)) = text;
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// Makes a folder for each test and removes it at the end.
class SceneFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("macadam_scene_") + test->name() + "_" + std::to_string(::getpid());
    for (char& c : name) c = c == '/' ? '_' : c;
    folder_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file() const { return folder_ / "scene.toml"; }
  Scene read(const std::string& text) const {
    std::ofstream(file(), std::ios::binary) << text;
    return read_scene(file());
  }
  /// Returns the error message of reading the text; empty if the text is accepted.
  std::string message(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& error) { return error.what(); }
    return {};
  }

  std::filesystem::path folder_;
};

}  // namespace macadam::test
