// SPDX-License-Identifier: GPL-3.0-or-later
// cuda_code.cpp  Looks for libmacadam_cuda.so, which is a library of its own: it needs a CUDA toolkit to be built, and
// the licences of CUDA and of CGAL do not go together in one that is passed on.
#include "host/stepping/cuda_code.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "macadam/version.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

constexpr const char* name = "libmacadam_cuda.so";

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
  if (dladdr(reinterpret_cast<const void*>(&cuda_code), &own) != 0)
    out.push_back(fs::path(own.dli_fname).parent_path());
  return out;
}

struct Found {
  const kernels::CudaCode* code = nullptr;
  std::string why;
};

/// The plugin of one file, which is there. It stays loaded.
Found load(const fs::path& file) {
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) return {nullptr, dlerror()};
  const auto* plugin = static_cast<const kernels::CudaPlugin*>(dlsym(library, "macadam_cuda_plugin"));
  if (!plugin) return {nullptr, file.string() + " is no plugin of Macadam"};
  if (plugin->interface != kernels::cuda_interface || std::string(plugin->version) != version()) {
    return {nullptr, file.string() + ": found a plugin of Macadam " + plugin->version + " (interface " +
                         std::to_string(plugin->interface) + "), expected one of " + version() + " (interface " +
                         std::to_string(kernels::cuda_interface) + ")"};
  }
  return {plugin->code, ""};
}

Found look() {
  for (const fs::path& folder : folders()) {
    std::error_code error;
    if (const fs::path file = folder / name; fs::exists(file, error)) return load(file);
  }
  return {nullptr, std::string("no CUDA backend: found no ") + name +
                       " beside the library or in MACADAM_PLUGIN_PATH (a build with a CUDA toolkit makes it)"};
}

}  // namespace

const kernels::CudaCode* cuda_code(std::string* why) {
  static const Found found = look();
  if (why) *why = found.why;
  return found.code;
}

}  // namespace macadam
