// SPDX-License-Identifier: GPL-3.0-or-later
/// \file make_cuda.hpp  Makes a stepper on CUDA devices for a list of laws: ExecCudaTiles if the run can be stepped in
/// blocks of steps and the tiles fit the devices, else ExecCuda. Several ranks
/// whose contacts have rock in series also use ExecCuda.
#pragma once

#include "kernels/cuda/two_kernels/exec_cuda.hpp"
#include "kernels/cuda/tiles/exec_cuda_tiles.hpp"
#include "kernels/step/stepper_impl.hpp"
#include "kernels/steppers.hpp"

namespace macadam::kernels {

/// Whether any law of a list can be stepped in blocks.
template <class... L>
constexpr bool any_has_blocks(std::type_identity<std::variant<L...>>) {
  return (has_blocks<L> || ...);
}

template <class P, class Any>
std::unique_ptr<Stepper> make_cuda_in(const Specimen& specimen, const ContactNetwork& network,
                                      const std::array<std::optional<Any>, pair_types>& laws, const Inertia& inertia,
                                      const StepperOptions& options, std::unique_ptr<Stepper> used) {
  require_steppable(std::type_identity<Any>{});
  StepperOptions given = options;
  if (given.devices.empty()) given.devices = {0};
  if constexpr (!std::is_same_v<P, DoublePrecision> && any_has_blocks(std::type_identity<Any>{})) {
    using Tiles = ExecCudaTiles<P, Any>;
    if (tiles_can_step(network, given) && Tiles::block_of(given, facts_of(laws), specimen.box.size) > 0) {
      if (auto made = make_stepper_on<Tiles>(specimen, network, laws, inertia, given, used)) return made;
    }
  }
  return make_stepper_on<ExecCuda<P, Any>>(specimen, network, laws, inertia, given, used);
}

}  // namespace macadam::kernels

/// Compiles the steppers for a list of laws, given by name, in one of the precisions of kernels/contact/precision.hpp.
#define MACADAM_CUDA_STEPPER(P, Any)                                                                   \
  template std::unique_ptr<macadam::Stepper> macadam::kernels::make_cuda_in<macadam::kernels::P, Any>( \
      const macadam::Specimen&, const macadam::ContactNetwork&,                                        \
      const std::array<std::optional<Any>, macadam::pair_types>&, const macadam::Inertia&,             \
      const macadam::StepperOptions&, std::unique_ptr<macadam::Stepper>)
