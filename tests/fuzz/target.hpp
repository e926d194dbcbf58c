// SPDX-License-Identifier: GPL-3.0-or-later
/// \file target.hpp  What each target of the fuzzer defines, and a file in memory for readers that ask for a name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace macadam::fuzz {

/// Reads the bytes of a file that anyone may have made, under the name of file_name(). Defined once in each program.
/// \throws Error where they are no such file; anything else that it throws is a defect.
void read(std::string_view bytes);

/// How the file is called: messages must say it. Defined once in each program.
std::string file_name();

/// A file that is on no disk.
class MemoryFile {
 public:
  /// `ending`: that of its name, ".tif" for instance; empty where the reader does not ask.
  explicit MemoryFile(const std::string& ending = {});
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Replaces what is in it.
  const std::filesystem::path& with(std::string_view bytes);

 private:
  int file_;
  std::filesystem::path path_, folder_;
};

/// The one file of a program whose reader does not ask for an ending.
inline MemoryFile& the_file() {
  static MemoryFile one;
  return one;
}

}  // namespace macadam::fuzz
