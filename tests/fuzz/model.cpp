// SPDX-License-Identifier: GPL-3.0-or-later
// model.cpp  Fuzz target: a model of a binder as a TOML file, which `macadam fit` converts to a contact law.
#include "macadam/fit.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/fuzz/target.hpp"

namespace macadam::fuzz {

std::string file_name() { return the_file().path().string(); }

void read(std::string_view bytes) { read_analogue(the_file().with(bytes)); }

}  // namespace macadam::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  static const std::vector<std::string> words{"model",
                                              "\"2s2p1d\"",
                                              "\"huet_sayegh\"",
                                              "E_0",
                                              "E_00",
                                              "k",
                                              "h",
                                              "delta",
                                              "tau",
                                              "beta",
                                              "shift",
                                              "\"wlf\"",
                                              "\"arrhenius\"",
                                              "reference_temperature",
                                              "C1",
                                              "C2",
                                              "\"3 GPa\"",
                                              "\"1 ms\"",
                                              "\"20 degC\"",
                                              "[",
                                              "]",
                                              "=",
                                              "{",
                                              "}"};
  return macadam::fuzz::mutate_cells(data, size, most, seed, " \n", words);
}
