// SPDX-License-Identifier: GPL-3.0-or-later
/// \file checkpoint.hpp  A checkpoint as a file: texts and arrays by name in HDF5, whole or not there.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "macadam/stepper.hpp"

namespace macadam {

/// What is written and read; it knows nothing of what the names mean.
struct Checkpoint {
  std::map<std::string, std::string> texts;
  std::vector<StateArray> arrays;  ///< names without '/', each once; order is not kept
};

/// Replaces a checkpoint by a rename, once the new one is on the disk: a kill at any moment leaves the old one or the
/// new one, and so does a full disk. HDF5's user block, the first 512 bytes, holds the length and a checksum, as text.
/// It is made in memory first, which takes twice its size. \throws RunError.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// The user block before an image of HDF5: that itself may fail on a damaged file, so that none is given to it.
std::string user_block_of(std::string_view image);

/// \throws InputError naming the file: not there, no checkpoint, cut off, damaged.
Checkpoint read_checkpoint(const std::filesystem::path& file);

}  // namespace macadam
