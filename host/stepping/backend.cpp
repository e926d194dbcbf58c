// SPDX-License-Identifier: GPL-3.0-or-later
// backend.cpp  Names of the choices, what the machine offers, and the one switch between backends.
#include "macadam/backend.hpp"

#include <omp.h>

#include <cmath>
#include <utility>

#include "host/reference/reference_stepper.hpp"
#include "kernels/steppers.hpp"
#include "macadam/error.hpp"

namespace macadam {

namespace {

/// A start state must be one of this network.
void require_start(const Specimen& specimen, const ContactNetwork& network,
                   const std::array<std::optional<Law>, pair_types>& laws, const StepperOptions& options) {
  const StartState& start = *options.start;
  const auto require = [](const char* what, std::size_t found, std::size_t expected) {
    if (found != expected) {
      throw InputError(std::string("start state: ") + what + ": found " + std::to_string(found) + ", expected " +
                       std::to_string(expected));
    }
  };
  require("displacements", start.displacement.size(), specimen.size());
  require("rotations", start.rotation.size(), specimen.size());
  require("velocities", start.velocity.size(), specimen.size());
  require("spins", start.spin.size(), specimen.size());
  require("chains' beginnings", start.chain_begin.size(), network.contacts.size());
  std::size_t numbers = 0;
  for (std::size_t c = 0; c < network.contacts.size(); ++c) {
    const Law& law = *laws[static_cast<std::size_t>(network.contacts[c].pair)];
    require("beginning of a contact's chains", start.chain_begin[c], numbers);
    numbers += 6 * static_cast<std::size_t>(1 + std::visit([](const auto& l) { return l.units(); }, law));
  }
  require("numbers of the chains", start.chain.size(), numbers);
  for (const WallMotionSpec& wall : options.boundary.wall) {
    for (const WallAxis& axis : wall.axis) {
      if (axis.by == DrivenBy::force)
        throw InputError("start state: found a wall under a force, expected displacements");
      const auto* cyclic = dynamic_cast<const drives::Cyclic*>(axis.drive.get());
      if (cyclic) require("ramp steps", static_cast<std::size_t>(cyclic->ramp_steps), 0);
    }
  }
}

/// Drives must be there, of the stepper's step, and platens must have a mass.
void require_boundary(const Specimen& specimen, const StepperOptions& options) {
  const Boundary& boundary = options.boundary;
  const auto refuse = [](const std::string& what, const std::string& found, const std::string& expected) {
    throw InputError("boundary: " + what + ": found " + found + ", expected " + expected);
  };
  for (std::size_t w = 0; w < wall_count; ++w) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const WallAxis& a = boundary.wall[w].axis[axis];
      const std::string which = std::string("wall ") + wall_names[w] + ", axis " + "xyz"[axis];
      if (a.by == DrivenBy::rest) continue;
      if (!a.drive) refuse(which, "no drive", "one, as the axis is driven");
      if (!(std::abs(a.drive->dt() - options.dt) <= 1e-12 * options.dt)) {
        refuse(which + ": time step of its drive", std::to_string(a.drive->dt()) + " s",
               std::to_string(options.dt) + " s, the stepper's");
      }
      if (a.by == DrivenBy::force && !(boundary.wall[w].mass > 0)) {
        refuse(which + ": mass of a wall under a force", std::to_string(boundary.wall[w].mass) + " kg", "above 0");
      }
    }
  }
  for (const std::int32_t i : boundary.fixed) {
    if (i < 0 || static_cast<std::size_t>(i) >= specimen.size()) {
      refuse("fixed particle", std::to_string(i), "0 to " + std::to_string(specimen.size() - 1));
    }
  }
  if (!boundary.body_force.empty() && boundary.body_force.size() != specimen.size()) {
    refuse("body forces", std::to_string(boundary.body_force.size()),
           "none, or one a particle: " + std::to_string(specimen.size()));
  }
}

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
std::string refusal_of([[maybe_unused]] const DeviceInfo& device) {
#ifdef MACADAM_CUDA
  const std::string why = kernels::cuda_refusal(device.number);
  return why.empty() ? "" : device.name + " cannot be used: " + why;
#else
  return "";
#endif
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
#ifdef MACADAM_CUDA
  report.cuda_compiled = true;
  kernels::report_cuda_devices(report);
#else
  report.cuda_status = "this build has no CUDA backend (no CUDA toolkit was found when it was configured)";
#endif
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

std::unique_ptr<Stepper> make_stepper(Backend backend, const Specimen& specimen, const ContactNetwork& network,
                                      const std::array<std::optional<Law>, pair_types>& laws, const Inertia& inertia,
                                      const StepperOptions& options, std::unique_ptr<Stepper> used) {
  for (int pair = 0; pair < pair_types; ++pair) {
    const auto p = static_cast<std::size_t>(pair);
    if (network.count[p] > 0 && !laws[p]) {
      throw InputError(std::string("pair ") + to_string(static_cast<PairType>(pair)) + " has " +
                       std::to_string(network.count[p]) + " contacts but no law");
    }
  }
  if (options.damping_kind == Damping::viscous && !(options.damping * options.dt < 2)) {
    throw InputError("viscous damping: found beta * dt = " + std::to_string(options.damping * options.dt) +
                     ", expected below 2 (a smaller time_step, or less damping)");
  }
  require_boundary(specimen, options);
  if (options.start) require_start(specimen, network, laws, options);
  StepperOptions given = options;
  switch (select_backend(backend, nullptr, options.device)) {
    case Backend::reference:
      return make_reference_stepper(specimen, network, laws, inertia, given);
#ifdef MACADAM_CUDA
    case Backend::cuda:
      given.device = chosen_device(report_backends(), options.device).number;
      return kernels::make_in_precision<kernels::ExecCuda>(specimen, network, laws, inertia, given, std::move(used));
#endif
    default:
      return kernels::make_in_precision<kernels::ExecCpu>(specimen, network, laws, inertia, given, std::move(used));
  }
}

}  // namespace macadam
