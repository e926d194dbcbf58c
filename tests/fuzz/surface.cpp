// SPDX-License-Identifier: GPL-3.0-or-later
// surface.cpp  Fuzz target: a surface, in the format that the name of the program states.
#include "host/shapes/files/surface_files.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/fuzz/target.hpp"

namespace macadam::fuzz {

std::string file_name() { return "surface." MACADAM_FUZZ_ENDING; }

void read(std::string_view bytes) {
  static const std::string name = file_name();
  static const SurfaceFormat format = format_of(name);
  surface_in({name, bytes}, format, 1);
}

}  // namespace macadam::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  static const std::vector<std::string> words{"OFF",
                                              "COFF",
                                              "NOFF",
                                              "STOFF",
                                              "v",
                                              "vn",
                                              "vt",
                                              "f",
                                              "l",
                                              "o",
                                              "solid",
                                              "facet",
                                              "normal",
                                              "outer",
                                              "loop",
                                              "vertex",
                                              "endloop",
                                              "endfacet",
                                              "endsolid",
                                              "1/2/3",
                                              "ply",
                                              "format",
                                              "ascii",
                                              "1.0",
                                              "binary_little_endian",
                                              "binary_big_endian",
                                              "comment",
                                              "obj_info",
                                              "element",
                                              "face",
                                              "vertices",
                                              "property",
                                              "list",
                                              "char",
                                              "uchar",
                                              "short",
                                              "ushort",
                                              "int",
                                              "uint",
                                              "float",
                                              "double",
                                              "int8",
                                              "uint8",
                                              "float64",
                                              "x",
                                              "y",
                                              "z",
                                              "vertex_indices",
                                              "vertex_index",
                                              "end_header",
                                              "#",
                                              "end",
                                              "\\",
                                              "\r"};
  return macadam::fuzz::mutate_cells(data, size, most, seed, " \t\n", words);
}
