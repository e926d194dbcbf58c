// SPDX-License-Identifier: GPL-3.0-or-later
// result_folder.cpp  Locks one folder by flock() on the directory.
#include "host/files/result_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "macadam/error.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

/// Removes the folders one after the other, up to the first that is not empty.
void remove_empty(const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    if (::rmdir(folder.c_str()) != 0) return;
  }
}

/// Returns whether an open folder is still the folder at this path.
bool is_same(int file, const fs::path& path) {
  struct stat open {
  }, named{};
  return ::fstat(file, &open) == 0 && ::stat(path.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

}  // namespace

ResultFolder::ResultFolder(const fs::path& folder) {
  std::error_code error;
  fs::path whole = fs::absolute(folder).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();  // the path ends with a slash
  // The folder may vanish between being made and being locked: another command that made it and was then refused
  // removes it again. In that case the attempt is repeated.
  constexpr int attempts = 100;
  for (int k = 0; k < attempts; ++k) {
    made_.clear();
    for (fs::path f = whole; !f.empty() && !fs::exists(f, error); f = f.parent_path()) made_.push_back(f);
    fs::create_directories(whole, error);
    file_ = ::open(whole.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file_ < 0 && errno == ENOENT && !error) continue;
    if (file_ < 0) {
      const std::string why = std::generic_category().message(errno);
      remove_empty(made_);
      throw RunError(folder.string() + ": cannot make the result folder: " + (error ? error.message() : why));
    }
    if (::faccessat(file_, ".", W_OK | X_OK, AT_EACCESS) != 0 && errno != ENOENT) {
      const std::string why = std::generic_category().message(errno);
      ::close(file_);
      throw RunError(folder.string() + ": files cannot be written into this folder: " + why);
    }
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      ::close(file_);
      throw InputError(folder.string(), 0, "folder of the results", "another command that is writing into it",
                       "no other command; wait until it has finished, or choose another folder");
    }
    if (is_same(file_, whole)) return;
    ::close(file_);
  }
  throw RunError(folder.string() + ": cannot make the result folder: another process removes it repeatedly");
}

ResultFolder::~ResultFolder() {
  remove_empty(made_);  // before the lock is released, so that no other command uses the folders
  ::close(file_);
}

}  // namespace macadam
