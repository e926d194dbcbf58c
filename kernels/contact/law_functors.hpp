// SPDX-License-Identifier: GPL-3.0-or-later
/// \file law_functors.hpp  Maps a list of laws, std::variant<…>, to the functors that step their contacts.
#pragma once

#include <algorithm>
#include <cstring>
#include <tuple>
#include <type_traits>
#include <variant>

#include "kernels/contact/contact_step.hpp"
#include "macadam/laws/law.hpp"

namespace macadam::kernels {

/// Stops the compilation with a message if L does not satisfy the contract of a law.
template <class L>
struct Steppable {
  static_assert(laws::SteppableLaw<L>,
                "this law lacks a part of the contract in macadam/laws/law.hpp; the compiler's notes say which part");
};
template <class... L>
constexpr void require_steppable(std::type_identity<std::variant<L...>>) {
  (static_cast<void>(Steppable<L>{}), ...);
}

/// The number of units for which a coupled law has its own compiled code; −1 for a law without such code.
template <class L>
constexpr int known_units() {
  if constexpr (requires { L::known_units; })
    return L::known_units;
  else
    return -1;
}
template <class L>
inline constexpr int known_units_of = known_units<L>();

/// Calls f(std::integral_constant<int, Units>) with the `Units` of ContactForces that suit the law.
template <bool five_units_in_registers, class L, class F>
void dispatch_units(const L& law, F&& f) {
  if constexpr (units_of<L>() >= 0) {
    f(std::integral_constant<int, units_of<L>()>{});
  } else if constexpr (coupled_law<L>) {
    if (law.units() == known_units_of<L>)
      f(std::integral_constant<int, known_units_of<L>>{});
    else
      f(std::integral_constant<int, -1>{});
  } else {
    if (law.units() == 3)
      f(std::integral_constant<int, 3>{});
    else if (five_units_in_registers && law.units() <= 5)
      f(std::integral_constant < int, five_units_in_registers ? 5 : -1 > {});
    else
      f(std::integral_constant<int, -1>{});
  }
}

/// Whether any law of a list can have rock in series.
template <class... L>
constexpr bool any_series_law(std::type_identity<std::variant<L...>>) {
  return (series_law<L> || ...);
}

/// Stands in a list of functors for a law that has no functor.
struct NoFunctor {};

/// Whether a law can be stepped in precision P.
template <class P, class L>
inline constexpr bool suits_precision = !needs_double_law<L> || std::is_same_v<typename P::State, double>;

/// Kinds of launches. Each kind has separate kernels, so that a kernel needs no registers for the work of another kind.
enum class LaunchKind {
  plain,   ///< no contact has rock in series
  series,  ///< some contacts have rock in series
  coupled  ///< laws that advance the components of a point together
};

/// The functor type of a law in a launch for `Units` units, or NoFunctor. Laws without memory fit any number of units.
template <class P, class L, ContactForm form, Geometry geometry, int Units, LaunchKind kind>
struct StepFunctor {
  static constexpr bool coupled = kind == LaunchKind::coupled;
  static constexpr bool memoryless = memoryless_law<L>;
  static constexpr bool fits_units = coupled
                                         ? units_of<L>() < 0 && (Units == known_units_of<L> || Units < 0)
                                         : memoryless || (units_of<L>() < 0 && (Units == 3 || Units == 5 || Units < 0));
  static constexpr bool fits = (linear_law<L> || form == ContactForm::points) && coupled_law<L> == coupled &&
                               suits_precision<P, L> && (units_of<L>() == Units || fits_units);
  template <bool any>
  static auto make() {
    if constexpr (any)
      return std::type_identity<ContactForces<P, typename L::template Step<typename P::State>, memoryless ? 0 : Units,
                                              form, geometry, kind == LaunchKind::series>>{};
    else
      return std::type_identity<NoFunctor>{};
  }
  using type = typename decltype(make<fits>())::type;
};

/// Holds one of several functors by value, so that it can be passed to a kernel. Stores the bytes of the functor and
/// its index in the list.
template <class... Functors>
struct AnyFunctor {
  int kind = 0;
  alignas(8) unsigned char bytes[std::max({sizeof(NoFunctor), sizeof(Functors)...})] = {};

  /// Stores a functor.
  template <class F>
  void put(const F& functor) {
    static_assert((std::is_same_v<F, Functors> || ...), "a law without a kernel");
    int number = 0;
    ((std::is_same_v<F, Functors> ? (kind = number, true) : (++number, false)) || ...);
    std::memcpy(bytes, &functor, sizeof functor);
  }
  /// Calls f(functor) with the stored functor.
  template <int number = 0, class F>
  MACADAM_HD void visit(F&& f) const {
    if constexpr (number < static_cast<int>(sizeof...(Functors))) {
      using Functor = std::tuple_element_t<static_cast<std::size_t>(number), std::tuple<Functors...>>;
      constexpr bool last = number + 1 == static_cast<int>(sizeof...(Functors));
      if (last || kind == number) {
        if constexpr (!std::is_same_v<Functor, NoFunctor>) f(*reinterpret_cast<const Functor*>(bytes));
      } else {
        visit<number + 1>(f);
      }
    }
  }
};

template <class List>
struct AnyFunctorOf;
template <class... Functors>
struct AnyFunctorOf<std::tuple<Functors...>> {
  using type = AnyFunctor<Functors...>;
};

}  // namespace macadam::kernels
