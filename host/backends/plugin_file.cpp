// SPDX-License-Identifier: GPL-3.0-or-later
// plugin_file.cpp  Loads plugins with dlopen() from the folders in which plugins are searched for.
#include "host/backends/plugin_file.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "macadam/version.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

/// The first members of the table of every plugin.
struct Head {
  int interface;
  const char* version;
};

/// Returns the folders in which plugins are searched for.
std::vector<fs::path> folders() {
  std::vector<fs::path> out;
  const char* const named = std::getenv("MACADAM_PLUGIN_PATH");
  std::string rest = named ? named : "";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    if (end > 0) out.emplace_back(rest.substr(0, end));
    rest.erase(0, end + 1);
  }
  Dl_info own{};
  if (dladdr(reinterpret_cast<const void*>(&find_plugin), &own) != 0)
    out.push_back(fs::path(own.dli_fname).parent_path());
  return out;
}

}  // namespace

const void* find_plugin(const PluginFile& asked, std::string& why) {
  for (const fs::path& folder : folders()) {
    std::error_code error;
    const fs::path file = folder / asked.file;
    if (!fs::exists(file, error)) continue;
    void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) {
      why = dlerror();
      return nullptr;
    }
    const auto* head = static_cast<const Head*>(dlsym(library, asked.symbol));
    if (!head) {
      why = file.string() + " is not a plugin of Macadam";
      return nullptr;
    }
    if (head->interface == asked.interface && std::string(head->version) == version()) return head;
    why = file.string() + ": found a plugin of Macadam " + head->version + " (interface " +
          std::to_string(head->interface) + "), expected a plugin of Macadam " + version() + " (interface " +
          std::to_string(asked.interface) + ")";
    return nullptr;
  }
  why = std::string("found no ") + asked.file + " beside the library or in MACADAM_PLUGIN_PATH (a build with " +
        asked.makes + " makes this file)";
  return nullptr;
}

}  // namespace macadam
