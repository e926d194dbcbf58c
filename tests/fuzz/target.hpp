// SPDX-License-Identifier: GPL-3.0-or-later
/// \file target.hpp  Functions that each fuzz target defines, and a file in memory for readers that need a file name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace macadam::fuzz {

/// Reads the bytes of a file from an untrusted source, under the name file_name(). Each target defines it once.
/// \throws Error if the file is invalid; every other exception is a defect.
void read(std::string_view bytes);

/// Returns the name of the file, which error messages must contain. Each target defines it once.
std::string file_name();

/// A file that exists only in memory.
class MemoryFile {
 public:
  /// `ending` is the extension of the name, such as ".tif"; empty if the reader does not need one.
  explicit MemoryFile(const std::string& ending = {});
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Replaces the content and returns the path.
  const std::filesystem::path& with(std::string_view bytes);

 private:
  int file_;
  std::filesystem::path path_, folder_;
};

/// Returns the only file of a target whose reader does not need an extension.
inline MemoryFile& the_file() {
  static MemoryFile one;
  return one;
}

}  // namespace macadam::fuzz
