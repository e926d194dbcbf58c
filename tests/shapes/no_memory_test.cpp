// SPDX-License-Identifier: GPL-3.0-or-later
// no_memory_test.cpp  Tests that std::bad_alloc is thrown if an allocation fails at any moment. The failure must not be
// reported as a faulty file, must not shorten a file, and must not end the process.
#include <gtest/gtest.h>
#include <omp.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <random>

#include <fmt/format.h>

#include "tests/support/test_files.hpp"
#include "tests/support/test_surfaces.hpp"

namespace {
/// The number of allocations so far, and the number of the allocation that fails; 0 means none.
std::atomic<int> counted{0}, failing{0};
std::atomic<bool> in_threads_only{false};

void* allocated(std::size_t bytes) {
  if ((!in_threads_only || omp_get_level() > 0) && ++counted == failing) return nullptr;
  return std::malloc(bytes > 0 ? bytes : 1);
}
}  // namespace

void* operator new(std::size_t bytes) {
  if (void* memory = allocated(bytes)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return allocated(bytes); }
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace macadam::test {
namespace {

/// Runs `work` repeatedly and makes one allocation fail in each run. If there are at most `tries` allocations, each of
/// them fails once; otherwise `tries` of them. Each failure must be std::bad_alloc.
void expect_bad_alloc(const std::string& what, const std::function<void()>& work, int tries = 100) {
  work();  // creates objects that are made only once and kept
  counted = 0;
  work();
  const int all = counted;
  ASSERT_GT(all, 3) << what;
  int thrown = 0;
  for (int k = 0; k < std::min(all, tries); ++k) {
    counted = 0, failing = 1 + static_cast<int>(static_cast<std::int64_t>(k) * all / std::min(all, tries));
    try {
      work();
    } catch (const std::bad_alloc&) { ++thrown; } catch (const std::exception& error) {
      failing = 0;
      ADD_FAILURE() << what << ": " << error.what();
    }
    failing = 0;
  }
  EXPECT_GT(thrown, 0) << what;
}

class NoMemory : public testing::Test {
 protected:
  NoMemory() { fs::create_directories(folder_); }
  ~NoMemory() override {
    failing = 0, in_threads_only = false;
    fs::remove_all(folder_);
  }
  fs::path folder_ = fs::path(testing::TempDir()) / fmt::format("macadam_no_memory_{}", getpid());
};

TEST_F(NoMemory, IsNoBadSurface) {
  const Surface s = icosphere(2);
  for (const char* ending : {"stl", "off", "ply", "obj"}) {
    const fs::path file = folder_ / (std::string("stone.") + ending);
    expect_bad_alloc(std::string("write ") + ending, [&] { write_surface(file, s); });
    write_surface(file, s);
    const std::string whole = read(file);
    expect_bad_alloc(std::string("read ") + ending, [&] { read_surface(file); });
    EXPECT_EQ(read(file), whole);
  }
}

TEST_F(NoMemory, IsNoBadOrShortSpecimen) {
  Specimen s{{{1, 1, 1}}, {}, {}, {}, {}};
  for (int i = 0; i < 300; ++i) {
    s.centre.push_back({(i + 0.5) / 300, 0.5, 0.5});
    s.radius.push_back(0.01);
    s.phase.push_back(Phase::mastic);
    s.body.push_back(-1);
  }
  const fs::path file = folder_ / "stones.csv";
  write_specimen_csv(file, s);
  const std::string whole = read(file);
  expect_bad_alloc("write", [&] { write_specimen_csv(file, s); });
  EXPECT_EQ(read(file), whole);
  expect_bad_alloc("read", [&] { read_specimen_csv(file, s.box); });
}

/// An exception may not leave an OpenMP thread: if a parallel piece of work does not catch it, the process ends.
TEST_F(NoMemory, InAnyThreadIsThrown) {
  Specimen s{{{1, 1, 1}}, {}, {}, {}, {}};  // nearly a lattice, so that flat tetrahedra are solved in exact arithmetic
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> u(-1e-9, 1e-9);
  for (int i = 0; i < 1000; ++i) {
    s.centre.push_back(
        {0.1 * (i % 10 + 0.5) + u(engine), 0.1 * (i / 10 % 10 + 0.5) + u(engine), 0.1 * (i / 100 + 0.5) + u(engine)});
    s.radius.push_back(0.05);
    s.phase.push_back(Phase::mastic);
    s.body.push_back(-1);
  }
  in_threads_only = true;
  expect_bad_alloc(
      "tessellate", [&] { tessellate(s); }, 10);
}

}  // namespace
}  // namespace macadam::test
