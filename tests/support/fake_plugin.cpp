// SPDX-License-Identifier: GPL-3.0-or-later
// fake_plugin.cpp  A plugin that replaces the CUDA backend in tests. Compiled without options, it has the version of
// this build and one device that cannot be used. With FAKE_INTERFACE, it has another interface version. With
// FAKE_DEVICE, its devices compute on the processor; the environment variable FAKE_DEVICES sets their number (default
// 1). For every stepper that is made, the plugin appends the device's number to the file FAKE_DEVICE_LOG.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include "kernels/compiled/cuda_plugin.hpp"
#include "macadam/error.hpp"

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
/// Wraps the processor's stepper. Like a device (GPU), it returns up to seven samples (recorded time steps) at a time.
class InBatches : public Stepper {
 public:
  InBatches(std::unique_ptr<Stepper> on, int device) : on_(std::move(on)), device_(device) {}
  std::unique_ptr<Stepper> release() { return std::move(on_); }
  int device() const { return device_; }

  std::vector<Sample> advance_sampled(std::int64_t every, std::int64_t times) override {
    std::vector<Sample> out;
    for (std::int64_t k = 0; k < std::min<std::int64_t>(times, 7); ++k) {
      advance(every);
      out.push_back({observe(), first_divergent()});
    }
    return out;
  }
  void advance(std::int64_t steps) override { on_->advance(steps); }
  Observation observe() const override { return on_->observe(); }
  ParticleState particles() const override { return on_->particles(); }
  ContactState contacts(const ContactNetwork& network) const override { return on_->contacts(network); }
  void set_velocities(const std::vector<Vec3d>& velocity, const std::vector<Vec3d>& spin) override {
    on_->set_velocities(velocity, spin);
  }
  std::vector<StateArray> state() const override { return on_->state(); }
  void set_state(const std::vector<StateArray>& arrays) override { on_->set_state(arrays); }
  std::int64_t first_divergent() const override { return on_->first_divergent(); }
  std::string description() const override { return on_->description(); }
  std::int64_t bytes() const override { return on_->bytes(); }

 private:
  std::unique_ptr<Stepper> on_;
  int device_;
};

/// Makes a stepper. The device with the number in the environment variable FAKE_DEVICE_FULL reports that it has no
/// memory.
std::unique_ptr<Stepper> make(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                              const Inertia& inertia, const StepperOptions& options, std::unique_ptr<Stepper> used) {
  const int device = options.devices.front();
  if (const char* full = std::getenv("FAKE_DEVICE_FULL"); full && device == std::atoi(full))
    throw RunError("paper device " + std::to_string(device) + ": no memory");
  auto* before = dynamic_cast<InBatches*>(used.get());
  std::unique_ptr<Stepper> begun;
  if (before && before->device() == device) begun = before->release();
  if (const char* log = std::getenv("FAKE_DEVICE_LOG"); log && !begun)
    std::ofstream(log, std::ios::app) << device << '\n';
  StepperOptions given = options;
  given.devices.clear();
  return std::make_unique<InBatches>(
      make_stepper(Backend::cpu, specimen, network, laws, inertia, given, std::move(begun)), device);
}
#else
std::string refusal(int) { return "it is made of paper"; }
constexpr auto make = nullptr;
#endif

/// Refuses to solve: no test needs the frequency domain on a fake device.
std::unique_ptr<DeviceSolver> make_solver(const LinearSystem&, const DeviceList&, std::int64_t&) {
  throw RunError("the device of paper has no solver for the frequency domain");
}

constexpr CudaCode code{report, refusal, nullptr, make, make_solver, nullptr, nullptr};

}  // namespace

extern "C" {
extern const CudaPlugin macadam_cuda_plugin;
const CudaPlugin macadam_cuda_plugin{FAKE_INTERFACE, MACADAM_VERSION, &code};
}

}  // namespace macadam::kernels
