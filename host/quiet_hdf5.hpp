// SPDX-License-Identifier: GPL-3.0-or-later
/// \file quiet_hdf5.hpp  HDF5 without its own messages, and for one thread at a time.
#pragma once

#include <H5Cpp.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <new>
#include <string>

namespace macadam {

/// HDF5 prints its errors unless told not to: while one of these lives it is silent, and its first error is remembered.
/// Runs side by side write files, and HDF5 is not for several threads, nor are two files in memory of one name: whoever
/// makes one waits for the others.
class QuietHdf5 {
 public:
  QuietHdf5() {
    H5::Exception::getAutoPrint(print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, note, this);
  }
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;
  ~QuietHdf5() {
    H5garbage_collect();  // it would keep megabytes for files to come
    H5::Exception::setAutoPrint(print_, data_);
  }

  /// Whether anything went wrong: destructors of HDF5's classes, which may write, throw nothing.
  bool failed() const { return why_[0] != '\0'; }
  /// Of the first error, where it arose; of one of the system, the system's words.
  std::string why() const {
    std::string text = why_.data();
    const std::string of_the_system = "error message = '";
    const std::size_t begin = text.find(of_the_system);
    if (begin == std::string::npos) return text;
    return text.substr(begin + of_the_system.size(),
                       text.find('\'', begin + of_the_system.size()) - begin - of_the_system.size());
  }

 private:
  static herr_t note(hid_t stack, void* to) { return H5Ewalk2(stack, H5E_WALK_UPWARD, note_innermost, to); }
  static herr_t note_innermost(unsigned depth, const H5E_error2_t* error, void* to) {
    auto& why = static_cast<QuietHdf5*>(to)->why_;
    if (depth != 0 || why[0] != '\0') return 0;
    const char* text = error->desc ? error->desc : "unknown";
    // where HDF5 cannot allocate, some of its words say only what for
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

/// Where HDF5 gets no memory it may crash or end the program: there must be some before it begins. `bytes`: of what it
/// shall hold. \throws std::bad_alloc.
inline void require_memory_for_hdf5(std::size_t bytes) {
  constexpr std::size_t its_own = 8 << 20;
  ::operator delete(::operator new(bytes + its_own));
}

}  // namespace macadam
