// SPDX-License-Identifier: GPL-3.0-or-later
/// \file checkpoint_file.hpp  Reads and writes checkpoint files: named texts and arrays in HDF5. A checkpoint file is
/// either complete or absent.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "macadam/stepper.hpp"

namespace macadam {

/// Contents of a checkpoint file. The caller decides what the names mean.
struct Checkpoint {
  std::map<std::string, std::string> texts;
  std::vector<StateArray> arrays;  ///< names are unique and contain no '/'; a file does not keep their order
};

/// Writes a checkpoint. The new file is written to the disk first and then renamed to replace the older one. So if the
/// program is killed, or the disk is full, a complete file remains, which is either the old or the new one. HDF5's user
/// block, the first 512 bytes of the file, holds the length of the file and a checksum as text. The bytes of the file
/// are made in memory first, which takes twice the size of the file. \throws RunError.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Returns the user block for the bytes of an HDF5 file. The reader checks it before it passes the bytes to HDF5,
/// because HDF5 itself may fail on a damaged file.
std::string user_block_of(std::string_view image);

/// Reads a checkpoint. \throws InputError, naming the file, if it is missing, not a checkpoint, cut off or damaged.
Checkpoint read_checkpoint(const std::filesystem::path& file);

}  // namespace macadam
