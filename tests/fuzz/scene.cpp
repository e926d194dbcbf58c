// SPDX-License-Identifier: GPL-3.0-or-later
// scene.cpp  Fuzz target: the text of a scene. The words for mutations come from the reader's own table of known keys.
#include "macadam/scene.hpp"

#include "host/scene/known_keys.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/fuzz/target.hpp"

namespace macadam::fuzz {
namespace {

std::vector<std::string> words_of_scenes() {
  std::vector<std::string> out{"\"\"",
                               "[",
                               "]",
                               "{",
                               "}",
                               "[[contacts]]\n",
                               "=",
                               "\"1 mm\"",
                               "\"10 Hz\"",
                               "\"3 GPa\"",
                               "[1, 2]",
                               "[1e-300, 1e300]",
                               "true",
                               "false",
                               "\"5 %\"",
                               "'''",
                               "\"\"\"",
                               "1979-05-27",
                               "\"M-M\"",
                               "\"generalised_kelvin\"",
                               "\"elastic\"",
                               "\"cyclic\"",
                               "\"sweep\"",
                               "\"creep\"",
                               "\"relaxation\"",
                               "\"monotonic\"",
                               "\"history\"",
                               "\"haversine\"",
                               "\"table\"",
                               "\"harmonic\"",
                               "\"explicit\"",
                               "\"wlf\"",
                               "\"arrhenius\""};
  for (const scene::KnownKey& key : scene::known_keys()) {
    out.push_back(key.name);
    out.push_back(key.name + " = 1\n");
    out.push_back(key.section + "\n");
    for (const std::string& choice : key.chosen) out.push_back('"' + choice + '"');
  }
  return out;
}

}  // namespace

std::string file_name() { return "scene.toml"; }

void read(std::string_view bytes) { read_scene("scene.toml", std::string(bytes)); }

}  // namespace macadam::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  static const std::vector<std::string> words = macadam::fuzz::words_of_scenes();
  return macadam::fuzz::mutate_cells(data, size, most, seed, " ,\n", words);
}
