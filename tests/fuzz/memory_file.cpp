// SPDX-License-Identifier: GPL-3.0-or-later
// memory_file.cpp  A file in memory with a name in /proc, which every reader opens as a regular file.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

#include "tests/fuzz/target.hpp"

namespace macadam::fuzz {

MemoryFile::MemoryFile(const std::string& ending) : file_(memfd_create("fuzz", MFD_CLOEXEC)) {
  if (file_ < 0) std::abort();
  path_ = "/proc/self/fd/" + std::to_string(file_);
  if (ending.empty()) return;
  std::string folder = (std::filesystem::temp_directory_path() / "macadam-fuzz-XXXXXX").string();
  if (!mkdtemp(folder.data())) std::abort();
  folder_ = folder;
  std::filesystem::create_symlink(path_, folder_ / ("file" + ending));
  path_ = folder_ / ("file" + ending);
}

MemoryFile::~MemoryFile() {
  close(file_);
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

const std::filesystem::path& MemoryFile::with(std::string_view bytes) {
  const auto size = static_cast<ssize_t>(bytes.size());
  if (pwrite(file_, bytes.data(), bytes.size(), 0) != size || ftruncate(file_, size) != 0) std::abort();
  return path_;
}

}  // namespace macadam::fuzz
