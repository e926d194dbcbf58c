// SPDX-License-Identifier: GPL-3.0-or-later
// fake_plugin.cpp  What tests have in place of the CUDA backend: of this version with one device that cannot be used,
// or, with FAKE_INTERFACE, of another, or, with FAKE_DEVICE, with some that are the processor: as many as FAKE_DEVICES
// of the environment says, or one. Each line of the file FAKE_DEVICE_LOG is then the device of a stepper that was made.
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>

#include "kernels/cuda_plugin.hpp"

#ifndef FAKE_INTERFACE
#define FAKE_INTERFACE macadam::kernels::cuda_interface
#endif

namespace macadam::kernels {
namespace {

void report(BackendReport& out) {
  const char* number = std::getenv("FAKE_DEVICES");
  const int devices = number ? std::atoi(number) : 1;
  for (int k = 0; k < devices; ++k) out.devices.push_back({k, "paper device", 90, std::int64_t{1} << 30, 1});
  out.cuda_status = std::to_string(devices) + (devices == 1 ? " device answers" : " devices answer");
}
#ifdef FAKE_DEVICE
std::string refusal(int) { return ""; }
std::unique_ptr<Stepper> make(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                              const Inertia& inertia, const StepperOptions& options, std::unique_ptr<Stepper> used) {
  // That a stepper is on, by its place in memory.
  static std::mutex mutex;
  static std::map<const Stepper*, int> device_of;
  const std::lock_guard lock(mutex);
  const int device = options.devices.front();
  if (used && device_of[used.get()] != device) used.reset();
  const char* log = std::getenv("FAKE_DEVICE_LOG");
  if (log && !used) std::ofstream(log, std::ios::app) << device << '\n';
  StepperOptions given = options;
  given.devices.clear();
  auto made = make_stepper(Backend::cpu, specimen, network, laws, inertia, given, std::move(used));
  device_of[made.get()] = device;
  return made;
}
#else
std::string refusal(int) { return "it is made of paper"; }
constexpr auto make = nullptr;
#endif

constexpr CudaCode code{report, refusal, nullptr, make, nullptr, nullptr};

}  // namespace

extern "C" {
extern const CudaPlugin macadam_cuda_plugin;
const CudaPlugin macadam_cuda_plugin{FAKE_INTERFACE, MACADAM_VERSION, &code};
}

}  // namespace macadam::kernels
