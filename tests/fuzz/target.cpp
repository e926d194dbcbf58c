// SPDX-License-Identifier: GPL-3.0-or-later
// target.cpp  Runs a reader with one input and checks the rules that hold for every reader. The reader may throw only
// errors of Macadam, whose messages name the file. It may take one second per kilobyte of the input, and one second for
// a smaller input. It may use 64 MB plus a hundred times the size of the input. A violation aborts the program, which
// libFuzzer reports as a finding.
#include "tests/fuzz/target.hpp"

#include <cxxabi.h>
#include <sanitizer/allocator_interface.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <sstream>
#include <string>
#include <typeinfo>

#include "macadam/error.hpp"

namespace macadam::fuzz {
namespace {

constexpr std::int64_t fixed_bytes = 64 << 20, bytes_a_byte = 100;
std::int64_t live = 0, peak = 0, limit = 0, largest_peak = 0;
bool counting = false;
double slowest = 0;  // longest time of an input so far [s]

template <class... Values>
[[noreturn]] void finding(const char* words, Values... values) {
  counting = false;
  std::fprintf(stderr, "FINDING: ");
  std::fprintf(stderr, words, values...);
  std::fprintf(stderr, "\n");
  std::abort();
}

void allocated(const volatile void*, std::size_t bytes) {
  if (!counting) return;
  live += static_cast<std::int64_t>(bytes);
  peak = std::max(peak, live);
  if (live > limit) finding("%lld bytes of memory, expected at most %lld", (long long)live, (long long)limit);
}

void freed(const volatile void* memory) {
  if (counting && memory) live -= static_cast<std::int64_t>(__sanitizer_get_allocated_size(memory));
}

/// Returns the CPU time of this process [s], which other processes do not affect.
double seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Checks one line of an error message. The line must begin with the file, state what was found and what was expected,
/// and have no control characters.
void check_line(const std::string& line) {
  static const std::string name = file_name();
  const bool printable =
      std::none_of(line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7F; });
  const bool whole = line.starts_with(name) && line.find(": found ") != std::string::npos &&
                     line.find(", expected ") != std::string::npos;
  if (!printable || !whole)
    finding("a message that is not 'FILE:LINE: WHAT: found F, expected E' in a line: %s", line.c_str());
}

/// Checks an error message. A laboratory table may have several faults: each of the first ten faults has a line of its
/// own, and a last line counts the remaining faults.
void check_message(const std::string& message) {
  std::istringstream lines(message);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    if (count > 0 && line.starts_with("and ") && line.ends_with(" more in this file") && lines.peek() == EOF) return;
    check_line(line);
  }
  constexpr int most = 10;
  if (count == 0 || count > most) finding("a message of %d lines: %s", count, message.c_str());
}

void attempt(std::string_view bytes) {
  std::string message;
  try {
    read(bytes);
  } catch (const Error& error) { message = error.what(); } catch (const std::exception& error) {
    int status = 0;
    finding("an exception of another kind, %s: %s",
            abi::__cxa_demangle(typeid(error).name(), nullptr, nullptr, &status), error.what());
  }
  counting = false;
  if (!message.empty()) check_message(message);
}

}  // namespace
}  // namespace macadam::fuzz

using namespace macadam::fuzz;

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  if (__sanitizer_install_malloc_and_free_hooks(allocated, freed) == 0) std::abort();
  std::atexit([] {
    std::fprintf(stderr, "stat::slowest_s: %.6f\nstat::peak_mb: %.3f\n", slowest,
                 1e-6 * static_cast<double>(largest_peak));
  });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  live = peak = 0;
  limit = fixed_bytes + bytes_a_byte * static_cast<std::int64_t>(size);
  const double begin = seconds();
  counting = true;
  attempt({reinterpret_cast<const char*>(data), size});
  const double took = seconds() - begin, allowed = std::max(1.0, static_cast<double>(size) / 1000);
  if (took > allowed) finding("%g s for %zu bytes, expected at most %g", took, size, allowed);
  slowest = std::max(slowest, took);
  largest_peak = std::max(largest_peak, peak);
  return 0;
}

/// If memory is not available, malloc returns null, so that C libraries can report it; operator new ends the program.
extern "C" const char* __asan_default_options() {
  return "allocator_may_return_null=1:detect_stack_use_after_return=0:detect_leaks=0:quarantine_size_mb=16";
}
extern "C" const char* __ubsan_default_options() { return "print_stacktrace=1:halt_on_error=1"; }
