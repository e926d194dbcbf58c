// SPDX-License-Identifier: GPL-3.0-or-later
/// \file quiet_hdf5.hpp  Suppresses the error output of HDF5, and lets one thread at a time use the library.
#pragma once

#include <H5Cpp.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <new>
#include <string>

namespace macadam {

/// While an object of this class exists, HDF5 prints no errors; the first error is kept for why(). The object also
/// holds a lock: runs of one process write files at the same time, but HDF5 is not safe for several threads and cannot
/// hold two in-memory files of the same name. Another thread that constructs a QuietHdf5 waits until this one is
/// destroyed.
class QuietHdf5 {
 public:
  QuietHdf5() {
    H5::Exception::getAutoPrint(print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, note, this);
  }
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;
  ~QuietHdf5() {
    H5garbage_collect();  // otherwise HDF5 keeps megabytes for later files
    H5::Exception::setAutoPrint(print_, data_);
  }

  /// Returns whether a call of HDF5 has failed since this object was made. This includes calls in the destructors of
  /// HDF5's classes, which may write to a file but throw nothing.
  bool failed() const { return why_[0] != '\0'; }
  /// Returns the text of the first error, from the function in which it arose. For an error of the operating system
  /// this is the system's message.
  std::string why() const {
    std::string text = why_.data();
    const std::string of_the_system = "error message = '";
    const std::size_t begin = text.find(of_the_system);
    if (begin == std::string::npos) return text;
    return text.substr(begin + of_the_system.size(),
                       text.find('\'', begin + of_the_system.size()) - begin - of_the_system.size());
  }

 private:
  /// HDF5's error handler. `to` is the QuietHdf5 object.
  static herr_t note(hid_t stack, void* to) { return H5Ewalk2(stack, H5E_WALK_UPWARD, note_innermost, to); }
  /// Keeps the text of the innermost error (depth 0), unless an error was kept before.
  static herr_t note_innermost(unsigned depth, const H5E_error2_t* error, void* to) {
    auto& why = static_cast<QuietHdf5*>(to)->why_;
    if (depth != 0 || why[0] != '\0') return 0;
    const char* text = error->desc ? error->desc : "unknown";
    // when HDF5 cannot allocate memory, some of its messages say only what the memory was for
    const bool hides_memory = error->maj_num == H5E_RESOURCE &&
                              (error->min_num == H5E_NOSPACE || error->min_num == H5E_CANTALLOC) &&
                              !std::strstr(text, "memory");
    std::snprintf(why.data(), why.size(), "%s%s", text, hides_memory ? ": no memory" : "");
    return 0;
  }
  static std::recursive_mutex& one_at_a_time() {
    static std::recursive_mutex mutex;
    return mutex;
  }
  std::lock_guard<std::recursive_mutex> alone_{one_at_a_time()};
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
  std::array<char, 512> why_{};
};

/// Checks that memory for `bytes`, the data that HDF5 will hold, and 8 MiB for HDF5 itself can be allocated. HDF5 may
/// crash or end the program if one of its own allocations fails. \throws std::bad_alloc.
inline void require_memory_for_hdf5(std::size_t bytes) {
  constexpr std::size_t its_own = 8 << 20;
  ::operator delete(::operator new(bytes + its_own));
}

}  // namespace macadam
