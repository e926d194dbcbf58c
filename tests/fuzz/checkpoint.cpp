// SPDX-License-Identifier: GPL-3.0-or-later
// checkpoint.cpp  Fuzz target: a checkpoint as raw bytes, or a valid checksum around an HDF5 file that is made from a
// recipe.
#include "host/files/checkpoint_file.hpp"

#include <H5Cpp.h>

#include "tests/fuzz/forged_hdf5.hpp"
#include "tests/fuzz/target.hpp"

namespace macadam::fuzz {

std::string file_name() { return the_file().path().string(); }

void read(std::string_view bytes) {
  if (bytes.starts_with("Macadam checkpoint")) {
    read_checkpoint(the_file().with(bytes));
    return;
  }
  const std::string image =
      forged_hdf5(bytes, {"texts", "arrays"}, {"scene", "plan", "state x", "x\ny", "a/b"}, {"unit", "other"});
  read_checkpoint(the_file().with(user_block_of(image) + image));
}

}  // namespace macadam::fuzz
