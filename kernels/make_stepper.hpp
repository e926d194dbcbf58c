// SPDX-License-Identifier: GPL-3.0-or-later
/// \file make_stepper.hpp  Defines make_stepper() for any list of laws. Backend, device and precision are chosen as for
/// Macadam's own laws.
#pragma once

#include "kernels/contact/precision.hpp"
#include "kernels/steppers.hpp"
#include "macadam/error.hpp"

namespace macadam {

/// Makes a stepper like make_stepper(), for the laws of the user's own list: `Any` is a std::variant<…>. The program
/// compiles the kernels for these laws: one of its files includes kernels/make_cpu.hpp before it calls this function.
/// `on_device`: the program also has the kernels for devices, in one CUDA file with `#include <kernels/make_cuda.hpp>`
/// and MACADAM_CUDA_STEPPER(P, Any). `compiled`: the precisions in which the program has kernels; if no precision is
/// named, all three of them. A program with fewer precisions compiles faster.
///
/// \throws the same as make_stepper(), and InputError for a precision or a backend that the program does not have.
template <class Any, bool on_device = false, Precision... compiled>
std::unique_ptr<Stepper> make_stepper_of(Backend backend, const Specimen& specimen, const ContactNetwork& network,
                                         const std::array<std::optional<Any>, pair_types>& laws, const Inertia& inertia,
                                         const StepperOptions& options, std::unique_ptr<Stepper> used = nullptr) {
  StepperOptions given = options;
  const Backend chosen = kernels::resolved(backend, on_device, given);
  const auto make = [&]<class P>(P) {
    if constexpr (on_device) {
      if (chosen == Backend::cuda)
        return kernels::make_cuda_in<P, Any>(specimen, network, laws, inertia, given, std::move(used));
    }
    return kernels::make_cpu_in<P, Any>(specimen, network, laws, inertia, given, std::move(used));
  };
  constexpr auto has = []<Precision precision>(std::integral_constant<Precision, precision>) {
    return sizeof...(compiled) == 0 || ((compiled == precision) || ...);
  };
  using std::integral_constant;
  if constexpr (has(integral_constant<Precision, Precision::double_>{})) {
    if (options.precision == Precision::double_) return make(kernels::DoublePrecision{});
  }
  if constexpr (has(integral_constant<Precision, Precision::mixed>{})) {
    if (options.precision == Precision::mixed) return make(kernels::MixedPrecision{});
  }
  if constexpr (has(integral_constant<Precision, Precision::single>{})) {
    if (options.precision == Precision::single) return make(kernels::SinglePrecision{});
  }
  std::string names;
  ((names += (names.empty() ? "" : " or ") + std::string(to_string(compiled))), ...);
  throw InputError(std::string("precision: found ") + to_string(options.precision) + ", expected " + names +
                   ": this program was compiled for its own laws without the other precisions");
}

}  // namespace macadam
