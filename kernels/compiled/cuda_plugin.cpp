// SPDX-License-Identifier: GPL-3.0-or-later
// cuda_plugin.cpp  Defines the table of functions through which the library calls the code in libmacadam_cuda.so.
#include "kernels/compiled/cuda_plugin.hpp"

#include "kernels/contact/precision.hpp"
#include "kernels/cuda/device/devices.hpp"
#include "kernels/cuda/multi_gpu/idle_neighbour.hpp"
#include "kernels/steppers.hpp"

namespace macadam::kernels {
namespace {

std::unique_ptr<Stepper> make(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                              const Inertia& inertia, const StepperOptions& options, std::unique_ptr<Stepper> used) {
  switch (options.precision) {
    case Precision::single:
      return make_cuda_in<SinglePrecision, Law>(specimen, network, laws, inertia, options, std::move(used));
    case Precision::mixed:
      return make_cuda_in<MixedPrecision, Law>(specimen, network, laws, inertia, options, std::move(used));
    default:
      return make_cuda_in<DoublePrecision, Law>(specimen, network, laws, inertia, options, std::move(used));
  }
}

constexpr CudaCode code{report_cuda_devices, cuda_refusal,           cuda_idle_beside,       make,
                        make_device_solver,  make_device_increments, kernels::measure_device};

}  // namespace

extern "C" {
extern const CudaPlugin macadam_cuda_plugin;
const CudaPlugin macadam_cuda_plugin{cuda_interface, MACADAM_VERSION, &code};
}

}  // namespace macadam::kernels
