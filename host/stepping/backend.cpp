// SPDX-License-Identifier: GPL-3.0-or-later
// backend.cpp  Names of the choices, what the machine offers, and the one switch between backends.
#include "macadam/backend.hpp"

#include <omp.h>

#include <utility>

#include "host/reference/reference_stepper.hpp"
#include "host/stepping/cuda_code.hpp"
#include "host/stepping/processor_code.hpp"
#include "kernels/stepper_input.hpp"
#include "kernels/steppers.hpp"
#include "macadam/error.hpp"

namespace macadam {

namespace {

/// The device of a number, or the first of the report, which has one at least. \throws InputError listing them.
const DeviceInfo& chosen_device(const BackendReport& report, std::optional<int> number) {
  std::string list;
  for (const DeviceInfo& d : report.devices) {
    if (d.number == number.value_or(d.number)) return d;
    list += (list.empty() ? "" : ", ") + std::to_string(d.number) + " (" + d.name + ")";
  }
  for (const DeviceInfo& d : report.devices_without_code) {
    if (d.number == number) list += "; " + std::to_string(d.number) + " (" + d.name + ") has no code in this build";
  }
  throw InputError("device: found " + std::to_string(*number) +
                   ", expected the number of one that can run: " + report.cuda_status + ": " + list);
}

/// Why a device that answers cannot be used after all; empty where it can.
std::string refusal_of(const DeviceInfo& device) {
  const std::string why = cuda_code()->refusal(device.number);
  return why.empty() ? "" : device.name + " cannot be used: " + why;
}

}  // namespace

const char* to_string(Backend b) {
  switch (b) {
    case Backend::cpu:
      return "cpu";
    case Backend::cuda:
      return "cuda";
    case Backend::reference:
      return "reference";
    default:
      return "auto";
  }
}
const char* to_string(Precision p) {
  switch (p) {
    case Precision::mixed:
      return "mixed";
    case Precision::single:
      return "single";
    default:
      return "double";
  }
}
const char* to_string(ContactForm f) { return f == ContactForm::points ? "points" : "condensed"; }
const char* to_string(Geometry g) { return g == Geometry::fixed ? "fixed" : "updated"; }
const char* to_string(Damping d) { return d == Damping::none ? "none" : d == Damping::local ? "local" : "viscous"; }

BackendReport report_backends() {
  BackendReport report;
  report.threads = omp_get_max_threads();
  if (const kernels::CudaCode* code = cuda_code(&report.cuda_status)) {
    report.cuda_compiled = true;
    code->report(report);
  }
  return report;
}

Backend select_backend(Backend asked, std::string* reason, std::optional<int> device) {
  if (device && (asked == Backend::cpu || asked == Backend::reference)) {
    throw InputError("device: found " + std::to_string(*device) + " beside backend " + to_string(asked) +
                     ", expected backend cuda or auto");
  }
  std::string why = "asked for";
  Backend chosen = asked;
  if (asked == Backend::automatic || asked == Backend::cuda) {
    const BackendReport report = report_backends();
    why = report.cuda_status;
    chosen = Backend::cpu;
    if (!report.devices.empty()) {
      const DeviceInfo& taken = chosen_device(report, device);
      why = refusal_of(taken);
      if (why.empty()) {
        why = taken.name;
        chosen = Backend::cuda;
      }
    }
    if (chosen != Backend::cuda && (asked == Backend::cuda || device)) {
      throw RunError(std::string(asked == Backend::cuda ? "backend cuda" : "a CUDA device") +
                     " was asked for but cannot run: " + why + "; use --backend cpu or auto" +
                     (device ? ", and no device" : ""));
    }
  }
  if (reason) *reason = why;
  return chosen;
}

Backend kernels::resolved(Backend asked, bool on_device, StepperOptions& options) {
  if (asked == Backend::reference) {
    throw InputError("backend: found reference, expected cpu, cuda or auto: it knows Macadam's own laws alone");
  }
  if (asked == Backend::automatic && !options.device && !on_device) return Backend::cpu;
  const Backend chosen = select_backend(asked, nullptr, options.device);
  if (chosen != Backend::cuda) return chosen;
  if (!on_device) {
    throw RunError("backend cuda was asked for, and this program has no kernels for devices compiled for its laws");
  }
  options.device = chosen_device(report_backends(), options.device).number;
  return chosen;
}

std::unique_ptr<Stepper> make_stepper(Backend backend, const Specimen& specimen, const ContactNetwork& network,
                                      const LawTable& laws, const Inertia& inertia, const StepperOptions& options,
                                      std::unique_ptr<Stepper> used) {
  kernels::require_input(specimen.size(), network, facts_of(laws), options);
  StepperOptions given = options;
  switch (select_backend(backend, nullptr, options.device)) {
    case Backend::reference:
      return make_reference_stepper(specimen, network, laws, inertia, given);
    case Backend::cuda:
      given.device = chosen_device(report_backends(), options.device).number;
      return cuda_code()->make_stepper(specimen, network, laws, inertia, given, std::move(used));
    default:
      return processor_code().make_stepper(specimen, network, laws, inertia, given, std::move(used));
  }
}

}  // namespace macadam
