// SPDX-License-Identifier: GPL-3.0-or-later
// draw_results.cpp  Finds a script of share/macadam and runs it with the Python that reports use.
#include "host/cli/terminal/draw_results.hpp"

#include <fmt/format.h>

#include "host/cli/terminal/programs.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

/// Returns the script beside the installed program, or in the source tree of the build; empty if it is in neither
/// place.
fs::path find(const std::string& script) {
  std::error_code error;
  const fs::path program = own_program();
  fs::path installed = program.parent_path().parent_path() / "share/macadam" / script;
  if (fs::is_regular_file(installed, error)) return installed;
  if (const fs::path tree = source_tree(); !tree.empty() && fs::is_regular_file(tree / "scripts" / script, error))
    return tree / "scripts" / script;
  return {};
}

}  // namespace

std::string draw_results(const std::string& script, const fs::path& folder, const std::string& pictures) {
  const fs::path file = find(script);
  if (file.empty()) return fmt::format("no pictures: share/macadam/{} is not installed beside the program\n", script);
  const std::string python = python_interpreter();
  // the user's own Python may lack matplotlib although Debian's Python includes it
  for (const std::string& one : {python, std::string("/usr/bin/python3")})
    if (runs({one, "-B", file.string(), folder.string()})) return fmt::format("pictures: {}\n", pictures);
  return fmt::format(
      "no pictures: the Python interpreter {} has no matplotlib; set MACADAM_PYTHON to an interpreter that has "
      "matplotlib, or run such an interpreter with the arguments {} {}\n",
      python, file.string(), folder.string());
}

}  // namespace macadam
