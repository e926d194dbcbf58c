// SPDX-License-Identifier: GPL-3.0-or-later
// cuda_code.cpp  Loads libmacadam_cuda.so. It is a separate library because it needs a CUDA toolkit to be built, and
// because the licences of CUDA and CGAL do not allow distributing one library that contains both.
#include "host/backends/cuda_code.hpp"

#include "host/backends/plugin_file.hpp"

namespace macadam {
namespace {

/// Result of the search for the plugin.
struct Found {
  const kernels::CudaCode* code = nullptr;
  std::string why;
};

Found look() {
  Found out;
  const PluginFile asked{"libmacadam_cuda.so", "macadam_cuda_plugin", kernels::cuda_interface, "a CUDA toolkit"};
  const auto* plugin = static_cast<const kernels::CudaPlugin*>(find_plugin(asked, out.why));
  if (plugin) out.code = plugin->code;
  return out;
}

}  // namespace

const kernels::CudaCode* cuda_code(std::string* why) {
  static const Found found = look();
  if (why) *why = found.why;
  return found.code;
}

}  // namespace macadam
