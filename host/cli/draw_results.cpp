// SPDX-License-Identifier: GPL-3.0-or-later
// draw_results.cpp  Finds a script of share/macadam and a Python that can run it.
#include "host/cli/draw_results.hpp"

#include <fmt/format.h>

#include "host/cli/programs.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

/// Beside an installed program, or where it was built from; empty where it is in neither place.
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
  // a python3 of somebody's own comes first in the search path and may lack what Debian's has
  for (const char* python : {"python3", "/usr/bin/python3"})
    if (runs({python, "-B", file.string(), folder.string()})) return fmt::format("pictures: {}\n", pictures);
  return fmt::format("no pictures: they take python3 with matplotlib; where that is, python3 {} {} draws them\n",
                     file.string(), folder.string());
}

}  // namespace macadam
