// SPDX-License-Identifier: GPL-3.0-or-later
/// \file result_folder.hpp  Locks the folder that a command writes into, so that no other command writes into it at the
/// same time.
#pragma once

#include <filesystem>
#include <vector>

namespace macadam {

/// Makes the folder if it does not exist, and locks it as long as the object exists. The operating system locks the
/// folder itself. The lock therefore ends with the process, however the process ends, and leaves no file. Some file
/// systems mounted from other machines have no locks; there the folder is not locked.
class ResultFolder {
 public:
  /// \throws RunError when the folder cannot be made or opened; InputError when another command is writing into it.
  explicit ResultFolder(const std::filesystem::path& folder);
  /// Also removes the folders that the constructor made, if they are still empty, so that a refused command leaves no
  /// folders.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< folders that the constructor made, the innermost first
  int file_ = -1;
};

}  // namespace macadam
