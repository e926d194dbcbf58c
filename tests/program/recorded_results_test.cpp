// SPDX-License-Identifier: GPL-3.0-or-later
// recorded_results_test.cpp  Compares everything that commands print and write with recorded output, to nine digits.
// Other tests check that results are right. These tests notice every change, intended or not.
//
// Each folder of tests/recorded is a case. Its file `commands` has one macadam command per line, run in a copy of the
// folder, which contains the inputs; laws.toml is appended to every scene without contacts. If a case has a file
// `library`, its numbers depend on the version of that library, and the case is skipped with other versions.
// expected.json has the recorded output. After an intended change, record again with MACADAM_RECORD=1 in the
// environment and review the difference.
#include <ceres/version.h>

#include <algorithm>
#include <regex>

#include "tests/support/program.hpp"
#include "tests/program/recorded_files.hpp"

namespace macadam::test {
namespace {

using nlohmann::ordered_json;

const fs::path cases = MACADAM_RECORDED;

/// Code with sanitizers is optimized less, so sums in libraries are rounded differently, and iterations and searches
/// amplify these differences. For such builds only files, names, words and the count of numbers are compared.
#ifdef MACADAM_ROUNDS_OTHERWISE
constexpr bool compares_numbers = false;
#else
constexpr bool compares_numbers = true;
#endif

/// Returns whether this build can run a case: without computed tomography the program has no `ct` command, and its help
/// differs.
bool is_possible(const std::string& name) {
#ifdef MACADAM_HAS_CT
  return !name.empty();
#else
  return !name.starts_with("ct-") && name != "words";
#endif
}

/// Returns the version of a library (ceres or itk) in this build, in the form in which a case names it.
std::string as_built(const std::string& library) {
  if (library.starts_with("ceres ")) return fmt::format("ceres {}.{}", CERES_VERSION_MAJOR, CERES_VERSION_MINOR);
  return fmt::format("itk {}", MACADAM_ITK_VERSION);
}

std::vector<std::string> names_of_cases() {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(cases)) {
    const std::string name = entry.path().filename();
    if (fs::exists(entry.path() / "commands") && is_possible(name)) out.push_back(name);
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// Returns whether a value in JSON or an array in HDF5 is left out of the comparison: times, memory, versions,
/// residuals that consist of rounding, and phases in fields, which are only rounding where almost nothing moves.
bool is_left_out(const std::string& key) {
  static const std::regex names(
      R"(timing_s\..*|.*solve_s|solver\.bytes|macadam|.*residual|.*held_force|VTKHDF/.*_phase)");
  return std::regex_match(key, names);
}

/// Returns JSON with one line per part, so that a difference between two versions can be read.
std::string lines_of_json(const ordered_json& all) {
  std::string out;
  for (const auto& [file, contents] : all.items()) {
    out += out.empty() ? "{" : "},\n";
    out += ordered_json(file).dump() + ": {";
    const char* before = "\n ";
    for (const auto& [name, value] : contents.items()) {
      out += before + ordered_json(name).dump() + ": " + value.dump();
      before = ",\n ";
    }
  }
  return out + "}}\n";
}

class RecordedResults : public Program, public testing::WithParamInterface<std::string> {
 protected:
  fs::path source() const { return cases / GetParam(); }

  void SetUp() override {
    Program::SetUp();
    version_ = lines_of(macadam("--version").out).at(0);
    setenv("OMP_NUM_THREADS", "2", 1);  // the number of threads appears in descriptions and affects predicted times
    for (const auto& entry : fs::directory_iterator(source()))
      if (const fs::path name = entry.path().filename();
          name != "commands" && name != "expected.json" && name != "library")
        fs::copy(entry.path(), folder_ / entry.path().filename(), fs::copy_options::recursive);
    for (const auto& entry : fs::directory_iterator(folder_)) {
      if (entry.path().extension() != ".toml") continue;
      const std::string scene = read(entry.path());
      if (contains(scene, "[specimen]") && !contains(scene, "[[contacts]]"))
        write(entry.path(), scene + '\n' + read(cases / "laws.toml"));
    }
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) given_.push_back(entry.path());
  }

  /// Returns the text without everything that differs between machines or runs: times, memory, threads, version,
  /// folders, and the line of tessellation errors, which consist of rounding.
  std::string comparable(std::string text) const {
    const auto replace = [&](const std::string& what, const std::string& with) {
      for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
        text.replace(at, what.size(), with);
    };
    replace(folder_.string(), "{folder}");
    replace(version_, "{version}");
    static const std::regex amount("[0-9.e+-]+ (s|ms|kB|MB|GB|threads?)\\b"), last_column(" *[0-9.]+$");
    std::string out;
    bool times = false;
    for (std::string line : lines_of(text)) {
      times = line.ends_with("time (s)") || (times && !line.empty());
      line = std::regex_replace(line, amount, "some $1");
      if (times) line = std::regex_replace(line, last_column, " some");
      if (!line.starts_with("tessellation errors")) out += line + '\n';
    }
    return out;
  }

  /// Runs the commands and returns what they print and the files that they write.
  ordered_json happened() const {
    std::map<std::string, recorded::Contents> all;
    int number = 0;
    for (std::string line : lines_of(read(source() / "commands"))) {
      if (line.empty() || line.starts_with('#')) continue;
      const Outcome outcome = in_folder(line);
      recorded::Contents& said = all[fmt::format("command {}", ++number)];
      recorded::add(said["code"], std::to_string(outcome.code));
      recorded::add_lines(said, comparable(outcome.out), "out");
      recorded::add_lines(said, comparable(outcome.err), "err");
    }
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      if (entry.is_regular_file() && std::find(given_.begin(), given_.end(), entry.path()) == given_.end() &&
          entry.path().filename() != "stdout.txt" && entry.path().filename() != "stderr.txt")
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
      const fs::path local = file.lexically_relative(folder_);
      // The surfaces of many grains are combined into one list of numbers.
      const bool one_of_many = file.extension() == ".off";
      recorded::Contents& to = all[one_of_many ? (local.parent_path() / "*.off").string() : local.string()];
      recorded::Contents contents;
      recorded::add_file(contents, file);
      for (auto& [name, content] : contents) {
        if (is_left_out(name)) continue;
        to[name].text += comparable(content.text);
        to[name].numbers.insert(to[name].numbers.end(), content.numbers.begin(), content.numbers.end());
      }
    }
    ordered_json out;
    for (const auto& [file, contents] : all)
      for (const auto& [name, content] : contents) out[file][name] = recorded::digest(content);
    return out;
  }

  Outcome in_folder(const std::string& arguments) const {
    const fs::path before = fs::current_path();
    fs::current_path(folder_);
    const Outcome outcome = macadam(arguments);
    fs::current_path(before);
    return outcome;
  }

  /// Returns whether two values are equal. Numbers must agree to nine digits; other versions of the libraries change
  /// only later digits. Numbers in a list may also differ by the rounding error of the largest number in the list.
  /// `iterations`: they are, or contain, numbers of iterations, of which some hundred may differ by one on another
  /// processor, because the residual then reaches its limit earlier or later.
  static bool alike(const ordered_json& a, const ordered_json& b, bool iterations = false) {
    if (a.is_array() && b.is_array() && a.size() == b.size()) {
      if (!compares_numbers) return true;
      double largest = 0;
      for (const auto& part : a) largest = std::max(largest, std::abs(part.get<double>()));
      return std::equal(a.begin(), a.end(), b.begin(), [&](double x, double y) {
        const bool counts = iterations && x > 100 && x == std::floor(x) && y == std::floor(y);
        return std::abs(x - y) <= std::max({1e-9 * std::abs(x), 1e-13 * largest, counts ? 1.0 : 0.0});
      });
    }
    if (a.is_object() && b.is_object() && a.size() == b.size())
      return std::all_of(a.items().begin(), a.items().end(), [&](const auto& item) {
        return b.contains(item.key()) && alike(item.value(), b[item.key()], iterations);
      });
    return a == b;
  }

  std::vector<fs::path> given_;
  std::string version_;
};

TEST_P(RecordedResults, AreAsTheyWere) {
  const bool records = std::getenv("MACADAM_RECORD");
  if (const fs::path file = source() / "library"; fs::exists(file)) {
    const std::string recorded = lines_of(read(file)).at(0), here = as_built(recorded);
    if (records)
      write(file, here + '\n');
    else if (here != recorded)
      GTEST_SKIP() << "recorded with " << recorded << "; this is " << here;
  }
  const ordered_json now = happened();
  const fs::path file = source() / "expected.json";
  if (records) {
    write(file, lines_of_json(now));
    GTEST_SKIP() << "recorded";
  }
  const ordered_json before = ordered_json::parse(read(file));
  for (const auto& [name, contents] : before.items()) {
    ASSERT_TRUE(now.contains(name)) << name << " is not there any more";
    for (const auto& [part, value] : contents.items()) {
      ASSERT_TRUE(now[name].contains(part)) << name << ": " << part << " is not there any more";
      // a table on the terminal has a column of iterations
      EXPECT_TRUE(alike(value, now[name][part], part.starts_with("out") || part.ends_with("iterations")))
          << name << ": " << part << "\nwas " << value << "\nis  " << now[name][part];
    }
    EXPECT_EQ(now[name].size(), contents.size()) << name << " has more than it had";
  }
  EXPECT_EQ(now.size(), before.size()) << "there are more files than there were";
}

INSTANTIATE_TEST_SUITE_P(Cases, RecordedResults, testing::ValuesIn(names_of_cases()), [](const auto& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace macadam::test
