// SPDX-License-Identifier: GPL-3.0-or-later
// laboratory.cpp  Fuzz target: measured moduli, which `macadam fit` and `macadam calibrate` read.
#include "macadam/fit.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/fuzz/target.hpp"

namespace macadam::fuzz {

std::string file_name() { return the_file().path().string(); }

void read(std::string_view bytes) {
  const bool shear = bytes.find("g_star_") != std::string_view::npos;
  read_modulus_data(the_file().with(bytes), shear ? std::optional(0.35) : std::nullopt);
}

}  // namespace macadam::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  static const std::vector<std::string> words{"frequency_hz",
                                              "e_star_pa",
                                              "g_star_pa",
                                              "phase_deg",
                                              "temperature_c",
                                              "e_star_std",
                                              "g_star_std",
                                              "phase_std",
                                              "e_prime_pa",
                                              "e_double_prime_pa",
                                              "e_star_mpa",
                                              "omega_rad_s",
                                              "temperature_k",
                                              "MPa",
                                              ";",
                                              "\t",
                                              "\"",
                                              "#",
                                              "\r",
                                              " ",
                                              "\xEF\xBB\xBF"};
  return macadam::fuzz::mutate_cells(data, size, most, seed, ",\n", words);
}
