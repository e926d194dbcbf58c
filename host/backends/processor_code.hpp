// SPDX-License-Identifier: GPL-3.0-or-later
/// \file processor_code.hpp  Declares the code whose speed depends on the SIMD registers of the processor. It is
/// compiled once for each processor generation, and the newest that can run is chosen at run time.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "host/harmonic/check_solutions.hpp"
#include "host/harmonic/linear_solver.hpp"
#include "kernels/harmonic/linear_system.hpp"
#include "kernels/layout/layout.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

/// Functions compiled for one processor generation: the time step, the iterative solver of the frequency domain, and
/// the check of its solutions.
struct ProcessorCode {
  const char* name;  ///< "native": compiled for this machine; "x86-64", "x86-64-v3" (AVX2), "x86-64-v4" (AVX-512)
  std::unique_ptr<Stepper> (*make_stepper)(const Specimen& specimen, const ContactNetwork& network,
                                           const LawTable& laws, const Inertia& inertia, const StepperOptions& options,
                                           std::unique_ptr<Stepper> used);
  void (*solve_block)(const kernels::LinearSystem& system, const std::vector<double>& inverse,
                      const kernels::Layout& layout, std::vector<harmonic::LinearTask*> tasks,
                      const std::function<bool()>& stop);
  std::vector<harmonic::SolutionCheck> (*check_solutions)(const ContactNetwork& network, const Inertia& inertia,
                                                          const std::vector<const harmonic::LinearTask*>& tasks,
                                                          double rounding);
};

/// Returns the code of the newest generation that this processor can run. A build for this machine alone
/// (MACADAM_NATIVE) has only one. The environment variable MACADAM_PROCESSOR (x86-64, x86-64-v3, x86-64-v4) asks for an
/// older one.
const ProcessorCode& processor_code();

}  // namespace macadam
