// SPDX-License-Identifier: GPL-3.0-or-later
/// \file step_functor.hpp  Makes the functor that steps the contacts of a law, for the contact form and geometry of a
/// run.
#pragma once

#include <string>
#include <type_traits>
#include <variant>

#include "kernels/contact/law_functors.hpp"
#include "macadam/error.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Calls f(std::integral_constant) with the value of an enum that has two values.
template <auto First, auto Second, class F>
void dispatch(decltype(First) value, F&& f) {
  if (value == First)
    f(std::integral_constant<decltype(First), First>{});
  else
    f(std::integral_constant<decltype(First), Second>{});
}

/// Calls f(law, functor) with the functor that steps the law's contacts on executor Exec; its view is not set.
/// \throws InputError if the precision of the executor does not suit the law.
template <class Exec, class F>
void with_functor(const typename Exec::AnyLaw& any, const StepperOptions& options, F&& f) {
  using P = typename Exec::Policy;
  using State = typename P::State;
  std::visit(
      [&](const auto& law) {
        using L = std::decay_t<decltype(law)>;
        [[maybe_unused]] const auto with = [&](auto units, auto form) {
          dispatch<Geometry::updated, Geometry::fixed>(options.geometry, [&](auto geometry) {
            const auto step = law.template step<State>(options.dt);
            f(law, ContactForces<P, std::decay_t<decltype(step)>, units(), form(), geometry()>{
                       {}, step, static_cast<State>(options.dt)});
          });
        };
        dispatch_units<Exec::five_units_in_registers>(law, [&]([[maybe_unused]] auto units) {
          if constexpr (!suits_precision<P, L>) {
            throw InputError(std::string("precision: found single beside law ") + L::name +
                             ", whose states need double precision; expected mixed or double");
          } else if constexpr (linear_law<L>) {
            dispatch<ContactForm::condensed, ContactForm::points>(options.form, [&](auto form) { with(units, form); });
          } else {
            with(units, std::integral_constant<ContactForm, ContactForm::points>{});
          }
        });
      },
      any);
}

}  // namespace macadam::kernels
