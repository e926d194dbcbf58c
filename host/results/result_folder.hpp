// SPDX-License-Identifier: GPL-3.0-or-later
/// \file result_folder.hpp  The folder that a command writes into, for that command alone.
#pragma once

#include <filesystem>
#include <vector>

namespace macadam {

/// Makes a folder where there is none and holds it until the end of its life. The lock is the operating system's, on
/// the folder itself: it ends with the process, however that ends, and leaves no file. Where a file system knows no
/// locks (some that are mounted from other machines), there is none.
class ResultFolder {
 public:
  /// \throws RunError when the folder cannot be made or opened; InputError when another command is writing into it.
  explicit ResultFolder(const std::filesystem::path& folder);
  /// Also removes folders that were made for it and are still empty: a command that is refused leaves nothing.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< the innermost first
  int file_ = -1;
};

}  // namespace macadam
