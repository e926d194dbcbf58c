// SPDX-License-Identifier: GPL-3.0-or-later
// specimen.cpp  Fuzz target: a specimen as CSV. With a second mutator, the same source is the target for CSV in gzip
// files.
#include "macadam/specimen.hpp"

#include "tests/fuzz/gzip.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/fuzz/target.hpp"

namespace macadam::fuzz {

std::string file_name() { return the_file().path().string(); }

void read(std::string_view bytes) { read_specimen_csv(the_file().with(bytes), {{1, 1, 1}}); }

}  // namespace macadam::fuzz

using namespace macadam::fuzz;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  static const std::vector<std::string> words{
      "id,x,y,z,radius,phase,body",    "aggregate", "mastic", "void", "\r", "\n", "\xEF\xBB\xBF",
      "9,0.1,0.2,0.3,0.01,mastic,-1\n"};
#ifdef MACADAM_FUZZ_GZIP
  Random random(seed);
  if (below(random, 4) == 0) return give_back(changed_bytes({reinterpret_cast<char*>(data), size}, most), data, most);
  std::string text = unpacked({reinterpret_cast<const char*>(data), size});
  text = below(random, 4) == 0 ? changed_bytes(text, most) : changed_cells(text, random, ",\n", words);
  if (below(random, 50) == 0) text = repeated(text, random);
  return give_back(packed(text, random), data, most);
#else
  return mutate_cells(data, size, most, seed, ",\n", words);
#endif
}
