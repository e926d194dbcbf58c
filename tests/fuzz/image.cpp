// SPDX-License-Identifier: GPL-3.0-or-later
// image.cpp  Fuzz target: an image of a scan, in the format that the name of the program states. Reads header and
// voxels.
#include "host/tools/ct/images/image_slices.hpp"
#include "tests/fuzz/forged_hdf5.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/fuzz/target.hpp"

namespace macadam::fuzz {
namespace {

// Largest number of voxels that is read. A header may announce up to 4000 bytes of voxels per byte of the file, so
// without this limit a small file could make the test slow.
constexpr std::int64_t most_voxels = 100'000;

MemoryFile& file() {
  static MemoryFile one("." MACADAM_FUZZ_ENDING);
  return one;
}

}  // namespace

std::string file_name() { return file().path().string(); }

void read(std::string_view bytes) {
  std::unique_ptr<ct::ImageSlices> image;
#ifdef MACADAM_FUZZ_HDF5  // the bytes are a recipe, except for complete HDF5 files among the seeds
  if (!bytes.starts_with("\x89HDF")) {
    image =
        ct::open_image(file().with(forged_hdf5(bytes, {"/", "scan"}, {"data", "grey", "b"}, {"element_size_um"})), {});
  }
#endif
  if (!image) image = ct::open_image(file().with(bytes), {});
  const auto [nx, ny, nz] = image->header().size;
  if (nx * ny * nz > most_voxels) return;
  std::vector<float> voxels(static_cast<std::size_t>(nx * ny * nz));
  if (image->apart())
    for (std::int64_t k = 0; k < nz; ++k) image->read(k, 1, voxels.data() + k * nx * ny);
  image->read(0, nz, voxels.data());
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
                                              "none",
                                              "space units:",
                                              "\"um\"",
                                              "DistanceUnits"};
  return macadam::fuzz::mutate_cells(data, size, most, seed, " \n", words);
}
#endif
