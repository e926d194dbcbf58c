// SPDX-License-Identifier: GPL-3.0-or-later
// image.cpp  What an image of a scan says of itself, in the format of the program's name.
#include "host/ct/image_slices.hpp"
#include "tests/fuzz/forged_hdf5.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/fuzz/target.hpp"

namespace macadam::fuzz {
namespace {

MemoryFile& file() {
  static MemoryFile one("." MACADAM_FUZZ_ENDING);
  return one;
}

}  // namespace

std::string file_name() { return file().path().string(); }

void read(std::string_view bytes) {
#ifdef MACADAM_FUZZ_HDF5  // a recipe, but for whole files among the seeds
  if (!bytes.starts_with("\x89HDF")) {
    ct::open_image(file().with(forged_hdf5(bytes, {"/", "scan"}, {"data", "grey", "b"}, {"element_size_um"})), {});
    return;
  }
#endif
  ct::open_image(file().with(bytes), {});
}

}  // namespace macadam::fuzz

#ifndef MACADAM_FUZZ_HDF5
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  static const std::vector<std::string> words{"ObjectType",
                                              "Image",
                                              "NDims",
                                              "DimSize",
                                              "ElementType",
                                              "MET_UCHAR",
                                              "MET_USHORT",
                                              "MET_FLOAT",
                                              "MET_DOUBLE",
                                              "ElementSpacing",
                                              "Offset",
                                              "TransformMatrix",
                                              "ElementDataFile",
                                              "LOCAL",
                                              "LIST",
                                              "BinaryData",
                                              "BinaryDataByteOrderMSB",
                                              "CompressedData",
                                              "CompressedDataSize",
                                              "ElementNumberOfChannels",
                                              "HeaderSize",
                                              "=",
                                              "True",
                                              "False",
                                              "NRRD0004",
                                              "NRRD0005",
                                              "type:",
                                              "dimension:",
                                              "sizes:",
                                              "spacings:",
                                              "encoding:",
                                              "endian:",
                                              "space:",
                                              "kinds:",
                                              "gzip",
                                              "raw",
                                              "ascii",
                                              "little",
                                              "big",
                                              "uint8",
                                              "float",
                                              "block",
                                              "space directions:",
                                              "(1,0,0)",
                                              "none"};
  return macadam::fuzz::mutate_cells(data, size, most, seed, " \n", words);
}
#endif
