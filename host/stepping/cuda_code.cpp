// SPDX-License-Identifier: GPL-3.0-or-later
// cuda_code.cpp  Looks for libmacadam_cuda.so, which is a library of its own: it needs a CUDA toolkit to be built, and
// the licences of CUDA and of CGAL do not go together in one that is passed on.
#include "host/stepping/cuda_code.hpp"

#include "host/stepping/plugin_file.hpp"

namespace macadam {
namespace {

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
