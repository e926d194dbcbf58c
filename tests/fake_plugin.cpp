// SPDX-License-Identifier: GPL-3.0-or-later
// fake_plugin.cpp  What plugin_test.cpp has in place of the CUDA backend: of this version with one device that cannot
// be used, or, with FAKE_INTERFACE, of another.
#include "kernels/cuda_plugin.hpp"

#ifndef FAKE_INTERFACE
#define FAKE_INTERFACE macadam::kernels::cuda_interface
#endif

namespace macadam::kernels {
namespace {

void report(BackendReport& out) {
  out.devices.push_back({0, "paper device", 90, std::int64_t{1} << 30, 1});
  out.cuda_status = "1 device answers";
}
std::string refusal(int) { return "it is made of paper"; }

constexpr CudaCode code{report, refusal, nullptr, nullptr, nullptr, nullptr};

}  // namespace

extern "C" {
extern const CudaPlugin macadam_cuda_plugin;
const CudaPlugin macadam_cuda_plugin{FAKE_INTERFACE, MACADAM_VERSION, &code};
}

}  // namespace macadam::kernels
