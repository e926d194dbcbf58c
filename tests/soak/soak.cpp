// SPDX-License-Identifier: GPL-3.0-or-later
// soak.cpp  Repeats runs for hours in one process, and interrupts and resumes many of them. Each run must give the same
// bits every time. Neither the memory of the process nor the number of its open files may grow.
//
// usage: soak SECONDS [cpu|cuda] [TABLE.csv]
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <random>
#include <sstream>

#include "macadam/macadam.hpp"
#include "tests/support/test_files.hpp"

#ifdef MACADAM_CUDA
#include <cuda_runtime_api.h>
#endif

namespace macadam::test {
namespace {

using Clock = std::chrono::steady_clock;

/// Resources of the process that must not grow.
struct Held {
  double resident_mb = 0, allocated_mb = 0, device_mb = 0;
  int files = 0, threads = 0;
};

Held held_now() {
  Held out;
  std::ifstream statm("/proc/self/statm");
  double pages = 0, resident = 0;
  statm >> pages >> resident;
  out.resident_mb = resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
  out.allocated_mb = static_cast<double>(mallinfo2().uordblks + mallinfo2().hblkhd) / 1e6;
  const auto entries = [](const char* folder) {
    return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  };
  out.files = entries("/proc/self/fd"), out.threads = entries("/proc/self/task");
#ifdef MACADAM_CUDA
  std::size_t free = 0, all = 0;
  if (cudaMemGetInfo(&free, &all) == cudaSuccess) out.device_mb = static_cast<double>(all - free) / 1e6;
#endif
  return out;
}

/// A run that is repeated, and its first output, which every repetition must give.
struct Case {
  Scene scene;
  fs::path out;
  std::string response, first;  ///< `first` is the output of the first run
};

class Soak {
 public:
  Soak(const fs::path& folder, const std::string& backend) : folder_(folder) {
    fs::copy_file(MACADAM_TEST_DATA "/t8.csv", folder / "t8.csv", fs::copy_options::overwrite_existing);
    const std::string stepped = "backend = \"" + backend + "\"\ndensity_scaling = 1e5\n";
    const std::string kept = "checkpoint = 0.02\nfields = [\"particles\", \"cells\"]\nevery = 50\n";
    for (const char* precision : {"single", "mixed", "double"})
      for (const char* geometry : {"fixed", "updated"})
        add(stepped + fmt::format("precision = \"{}\"\ngeometry = \"{}\"\n", precision, geometry), kept);
    add(stepped + "form = \"points\"\n", kept);
    add("backend = \"" + backend + "\"\nmethod = \"harmonic\"\nlinear = \"iterative\"\n", "contacts = true\n");
  }

  /// Runs every case once, with or without interruptions. \throws RunError if the output of a case differs from its
  /// first output.
  void round() {
    for (Case& c : cases_) {
      const bool in_pieces = c.scene.solver.method == SolverMethod::explicit_ && random_() % 3 > 0;
      if (!in_pieces) run(c.scene, c.out);
      for (bool resume = false; in_pieces && interrupted(c, resume); resume = true) ++resumes;
      ++runs;
      const fs::path response = c.out / "response.csv";
      const std::string found = fs::exists(response) ? read(response) : results_of(c.out);
      if (c.first.empty()) c.first = found;
      if (found != c.first) throw RunError(response.string() + ": other bits than the first time");
      fs::remove_all(c.out);
    }
  }

  std::int64_t runs = 0, resumes = 0;

 private:
  void add(const std::string& solver, const std::string& output) {
    const fs::path file = folder_ / fmt::format("{}.toml", cases_.size());
    write(file,
          "[specimen]\nfile = \"t8.csv\"\nbox = [0.008, 0.008, 0.011]\n[loading]\nkind = \"cyclic\"\n"
          "frequencies = [20.0]\ncycles = 1\n[solver]\n" +
              solver + "[output]\n" + output + am1_contacts);
    cases_.push_back({read_scene(file), folder_ / fmt::format("out{}", cases_.size()), {}, {}});
  }

  bool interrupted(const Case& c, bool resume) {
    Watcher watcher;
    bool planned = false;
    std::int64_t left = 1 + static_cast<std::int64_t>(random_() % 400);
    watcher.planned = [&](const RunResult&) { planned = true; };
    watcher.stop = [&] { return planned && --left == 0; };
    try {
      run(c.scene, c.out, watcher, resume);
      return false;
    } catch (const InterruptedError&) { return true; }
  }

  /// Returns the lines of a summary with |E*| and phase, without times.
  static std::string results_of(const fs::path& out) {
    std::istringstream lines(read(out / "summary.json"));
    std::string all;
    for (std::string line; std::getline(lines, line);)
      if (line.find("e_star") != std::string::npos || line.find("phase") != std::string::npos) all += line;
    return all;
  }

  fs::path folder_;
  std::vector<Case> cases_;
  std::mt19937 random_{1};
};

int soak(double seconds, const std::string& backend, const std::string& table) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("macadam_soak_{}", getpid());
  fs::create_directories(folder);
  Soak soak(folder, backend);
  std::ofstream out(table.empty() ? "/dev/null" : table);
  out << fmt::format("# {:%F}, {}, Macadam {}\n", fmt::localtime(std::time(nullptr)), backend, version());
  const char* head = "seconds,runs,resumes,resident_mb,allocated_mb,device_mb,files,threads\n";
  out << head;
  fmt::print("{}", head);
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  soak.round();  // after this round every part of the program has allocated its buffers
  std::vector<Held> rows;
  for (double next = 0; elapsed() < seconds || rows.size() < 4;) {
    soak.round();
    if (elapsed() < next && elapsed() < seconds) continue;
    next = elapsed() + seconds / 60;
    rows.push_back(held_now());
    const Held& h = rows.back();
    const std::string row = fmt::format("{:.0f},{},{},{:.2f},{:.3f},{:.0f},{},{}\n", elapsed(), soak.runs, soak.resumes,
                                        h.resident_mb, h.allocated_mb, h.device_mb, h.files, h.threads);
    out << row << std::flush;
    fmt::print("{}", row);
    std::fflush(stdout);
  }
  fs::remove_all(folder);
  // Memory, open files and threads vary from moment to moment, and memory also varies with the fragmentation of the
  // heap. So the test compares the maximum of the last third of the run with the maximum before it.
  const auto most = [&](std::size_t from, std::size_t to, auto of) {
    double all = 0;
    for (std::size_t k = from; k < to; ++k) all = std::max(all, static_cast<double>(of(rows[k])));
    return all;
  };
  int grows = 0;
  const auto look = [&](const char* what, double allowed, auto of) {
    const std::size_t third = rows.size() - rows.size() / 3;
    const double before = most(0, third, of), after = most(third, rows.size(), of);
    const bool more = after > before + allowed;
    fmt::print("{}: {:.3f} at most, in the last third {:.3f}{}\n", what, before, after, more ? ": GROWS" : "");
    grows += more;
  };
  look("resident memory, MB", 8, [](const Held& h) { return h.resident_mb; });
  look("allocated memory, MB", 1, [](const Held& h) { return h.allocated_mb; });
  look("memory of the device, MB", 8, [](const Held& h) { return h.device_mb; });
  look("open files", 0, [](const Held& h) { return h.files; });
  look("threads", 0, [](const Held& h) { return h.threads; });
  fmt::print("{} runs, resumed {} times: the same bits\n", soak.runs, soak.resumes);
  return grows > 0;
}

}  // namespace
}  // namespace macadam::test

int main(int argc, char** argv) {
  try {
    return macadam::test::soak(argc > 1 ? std::stod(argv[1]) : 60, argc > 2 ? argv[2] : "cpu", argc > 3 ? argv[3] : "");
  } catch (const std::exception& error) {
    fmt::print(stderr, "soak: {}\n", error.what());
    return 1;
  }
}
