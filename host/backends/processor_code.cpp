// SPDX-License-Identifier: GPL-3.0-or-later
// processor_code.cpp  Defines the table of the functions that step on the CPU, compiled for one processor generation.
// CMakeLists.txt compiles this file once for each generation, with its own MACADAM_CODE as the name of the table.
#include "host/backends/processor_code.hpp"

#include "kernels/contact/precision.hpp"
#include "kernels/steppers.hpp"

#ifndef MACADAM_CODE
#define MACADAM_CODE macadam_code_base
#define MACADAM_CODE_NAME MACADAM_BASE_NAME  // set by the build
#endif

namespace macadam {
namespace {

/// Makes a CPU stepper in the precision of the options.
std::unique_ptr<Stepper> make(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                              const Inertia& inertia, const StepperOptions& options, std::unique_ptr<Stepper> used) {
  const auto make_in = [&]<class P>(P) {
    return kernels::make_cpu_in<P, Law>(specimen, network, laws, inertia, options, std::move(used));
  };
  switch (options.precision) {
    case Precision::single:
      return make_in(kernels::SinglePrecision{});
    case Precision::mixed:
      return make_in(kernels::MixedPrecision{});
    default:
      return make_in(kernels::DoublePrecision{});
  }
}

}  // namespace

extern "C" {
extern const ProcessorCode MACADAM_CODE;
const ProcessorCode MACADAM_CODE{MACADAM_CODE_NAME, make};
}

}  // namespace macadam
