// SPDX-License-Identifier: GPL-3.0-or-later
// python_package.cpp  Finds the Python package and a Python that can run it.
#include "host/cli/terminal/python_package.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "host/cli/terminal/programs.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

/// Returns the folder of the Python package: in the build of this program, in the Python package that this program came
/// with, in the installation, or in the source tree. The result is empty if the package is in none of these folders;
/// Python must then find it by itself.
fs::path package_folder() {
  const fs::path program = own_program(), build = program.parent_path();
  std::error_code error;
  for (const fs::path& folder : {build / "python", build.parent_path().parent_path(),
                                 build.parent_path() / "share/macadam/python", source_tree() / "python"})
    if (folder.is_absolute() && fs::is_regular_file(folder / "macadam/__main__.py", error)) return folder;
  return {};
}

}  // namespace

void run_python(const std::string& command, const std::vector<std::string>& arguments) {
  const std::string python = python_interpreter();
  if (const fs::path folder = package_folder(); !folder.empty()) {
    const char* const before = std::getenv("PYTHONPATH");
    setenv("PYTHONPATH", (folder.string() + (before && *before ? ":" + std::string(before) : "")).c_str(), 1);
  }
  setenv("MACADAM_PROGRAM", own_program().c_str(), 0);  // studies run this program, unless the user names another one
  const std::string look =
      fmt::format("import sys, importlib.util as u; sys.exit(u.find_spec('macadam.{}') is None)", command);
  if (!runs({python, "-c", look})) {
    throw InputError(fmt::format(
        "macadam {0}: found no Python package macadam.{0} with the interpreter {1}, expected this package; install the "
        "package \"macadam\" with pip, or set MACADAM_PYTHON to an interpreter that has the package",
        command, python));
  }
  std::vector<std::string> words{python, "-m", "macadam", command};
  words.insert(words.end(), arguments.begin(), arguments.end());
  throw RunError(python + ": cannot be run: " + become(words));
}

}  // namespace macadam
