// SPDX-License-Identifier: GPL-3.0-or-later
// backend.cpp  Reports the devices (GPUs) and threads of the machine, chooses a backend, and makes the stepper of this
// backend.
#include "macadam/backend.hpp"

#include <omp.h>

#include <utility>

#include "host/reference/reference_stepper.hpp"
#include "host/backends/cuda_code.hpp"
#include "host/backends/processor_code.hpp"
#include "kernels/step/stepper_input.hpp"
#include "kernels/steppers.hpp"
#include "macadam/error.hpp"

namespace macadam {

namespace {

/// Returns the device with this number. \throws InputError, which lists the devices of the report, if the report has no
/// such device.
const DeviceInfo& device_of(const BackendReport& report, int number) {
  std::string list, without_code;
  for (const DeviceInfo& d : report.devices) {
    if (d.number == number) return d;
    list += (list.empty() ? "" : ", ") + std::to_string(d.number) + " (" + d.name + ")";
  }
  for (const DeviceInfo& d : report.devices_without_code) {
    if (d.number == number) without_code = " (" + d.name + "), for which this program was not compiled";
  }
  throw InputError("device: found " + std::to_string(number) + without_code + ", expected one of " + list);
}

/// Returns the devices with the given numbers; all devices of the report if every device is requested; the first device
/// of the report if the list is empty. The report must have at least one device. \throws InputError when a number is
/// not in the report.
std::vector<DeviceInfo> chosen_devices(const BackendReport& report, const DeviceList& numbers) {
  if (numbers.empty()) return {report.devices.front()};
  if (numbers == DeviceList{every_device}) return report.devices;
  std::vector<DeviceInfo> out;
  for (const int number : numbers) out.push_back(device_of(report, number));
  return out;
}

/// Returns the reason why a device that responds cannot be used; empty if it can be used.
std::string refusal_of(const DeviceInfo& device) {
  const std::string why = cuda_code()->refusal(device.number);
  return why.empty() ? "" : device.name + " cannot be used: " + why;
}

}  // namespace

BackendReport report_backends() {
  BackendReport report;
  report.threads = omp_get_max_threads();
  report.processor = processor_code().name;
  if (const kernels::CudaCode* code = cuda_code(&report.cuda_status)) {
    report.cuda_compiled = true;
    code->report(report);
  }
  return report;
}

DeviceList device_numbers(const DeviceList& asked) {
  DeviceList out;
  for (const DeviceInfo& d : chosen_devices(report_backends(), asked)) out.push_back(d.number);
  return out;
}

DeviceSpeed measure_device(int device) {
  const kernels::CudaCode* code = cuda_code();
  if (!code)
    throw RunError("device " + std::to_string(device) +
                   " cannot be measured, because the CUDA backend is not available");
  return code->measure(device);
}

Backend select_backend(Backend asked, std::string* reason, const DeviceList& devices) {
  if (!devices.empty() && (asked == Backend::cpu || asked == Backend::reference)) {
    throw InputError("device: found " + to_string(devices) + " with backend " + to_string(asked) +
                     ", expected backend cuda or auto");
  }
  std::string why = "asked for";
  Backend chosen = asked;
  if (asked == Backend::automatic || asked == Backend::cuda) {
    const BackendReport report = report_backends();
    why = report.cuda_status;
    chosen = Backend::cpu;
    if (!report.devices.empty()) {
      const auto taken = chosen_devices(report, devices);
      why.clear();
      for (auto device = taken.rbegin(); device != taken.rend() && why.empty(); ++device) why = refusal_of(*device);
      if (why.empty()) {
        why = taken.front().name + (taken.size() > 1 ? " and " + std::to_string(taken.size() - 1) + " more" : "");
        chosen = Backend::cuda;
      }
    }
    if (chosen != Backend::cuda && (asked == Backend::cuda || !devices.empty())) {
      throw RunError(std::string(asked == Backend::cuda ? "backend cuda" : "a CUDA device") +
                     " was asked for but cannot run: " + why + "; use --backend cpu or auto" +
                     (devices.empty() ? "" : ", and do not name a device"));
    }
  }
  if (reason) *reason = why;
  return chosen;
}

Backend kernels::resolved(Backend asked, bool on_device, StepperOptions& options) {
  if (asked == Backend::reference) {
    throw InputError(
        "backend: found \"reference\", expected \"cpu\", \"cuda\" or \"auto\", because the reference backend computes "
        "only Macadam's built-in "
        "laws, not the laws of this program");
  }
  if (asked == Backend::automatic && options.devices.empty() && !on_device) return Backend::cpu;
  const Backend chosen = select_backend(asked, nullptr, options.devices);
  if (chosen != Backend::cuda) return chosen;
  if (!on_device) {
    throw RunError(
        "backend cuda was asked for but cannot run: this program was compiled without CUDA kernels for its own laws");
  }
  options.devices = device_numbers(options.devices);
  return chosen;
}

std::unique_ptr<Stepper> make_stepper(Backend backend, const Specimen& specimen, const ContactNetwork& network,
                                      const LawTable& laws, const Inertia& inertia, const StepperOptions& options,
                                      std::unique_ptr<Stepper> used) {
  kernels::require_input(specimen.size(), network, facts_of(laws), options);
  StepperOptions given = options;
  switch (select_backend(backend, nullptr, options.devices)) {
    case Backend::reference:
      return make_reference_stepper(specimen, network, laws, inertia, given);
    case Backend::cuda:
      given.devices = device_numbers(options.devices);
      return cuda_code()->make_stepper(specimen, network, laws, inertia, given, std::move(used));
    default:
      return processor_code().make_stepper(specimen, network, laws, inertia, given, std::move(used));
  }
}

}  // namespace macadam
