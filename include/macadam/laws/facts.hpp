// SPDX-License-Identifier: GPL-3.0-or-later
/// \file facts.hpp  Defines the properties of a law that code may need without knowing its type, and traits that tell
/// which optional members a law has.
#pragma once

#include <array>
#include <complex>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "macadam/laws/prony_series.hpp"

namespace macadam {

inline constexpr int pair_types = 6;  ///< number of PairTypes (contact_network.hpp)

/// Whether and how a contact point is broken: by tension or by shear.
enum class Break : std::uint8_t { none, tension, shear };
inline constexpr const char* to_string(Break how) {
  switch (how) {
    case Break::none:
      return "none";
    case Break::tension:
      return "tension";
    case Break::shear:
      return "shear";
  }
  return "unknown";
}

/// Properties of a law of any type; the contract in law.hpp explains them.
struct LawFacts {
  const char* name = "";
  double alpha = 0;                                                ///< shear over normal stiffness
  double instantaneous = 0;                                        ///< [Pa]
  double shortest_time = std::numeric_limits<double>::infinity();  ///< [s]
  int units = 0;                                                   ///< number of states per component without f
  /// The number of units, if it is fixed at compile time; −1: not fixed.
  int only_units = -1;
  bool memoryless = false, linear = true, blocks = false;  ///< see law.hpp
  /// Whether opening and slips of a contact point act on one another.
  bool coupled = false;
  bool stiffness = true;      ///< whether the law can be used in the frequency domain
  bool breaks = false;        ///< whether its contact points can break
  bool series = true;         ///< whether contacts of the law can have rock in series (Contact::series)
  bool cracks = false;        ///< whether its contact points crack gradually, so that they have a crack energy
  bool needs_double = false;  ///< whether its states must be double
};

/// Traits for the optional parts of a law's contract (law.hpp).
/// @{
template <class L>
inline constexpr bool memoryless_law = L::template Step<double>::memoryless;
/// Returns whether f is a linear function of the history of x.
template <class L>
constexpr bool is_linear() {
  if constexpr (requires { L::linear; })
    return L::linear;
  else
    return true;
}
template <class L>
inline constexpr bool linear_law = is_linear<L>();
/// Whether a law's Step advances the components of a point together.
template <class Step>
inline constexpr bool coupled_step = requires {
  requires Step::coupled;
};
template <class L>
inline constexpr bool coupled_law = coupled_step<typename L::template Step<double>>;
/// Whether a law's Step can be weakened by a spring in series: it has step_stiffness(), and advance() takes a factor.
template <class Step>
inline constexpr bool takes_factor = requires(const Step& step, double x, double& (&unit)(int)) {
  step.step_stiffness();
  step.template advance<-1>(x, x, unit, x);
};
/// Whether contacts of a law can have rock in series.
template <class L>
inline constexpr bool series_law = linear_law<L> && !coupled_law<L> && takes_factor<typename L::template Step<double>>;
/// Whether a law has everything that the frequency domain needs.
template <class L>
inline constexpr bool has_stiffness = linear_law<L>&& requires(const L& law, std::complex<double> s,
                                                               void (&each)(const std::string&, std::complex<double>)) {
  law.stiffness(s);
  law.unit_compliance(0, s);
  law.each_parameter(s, each);
};
/// Whether a law provides its relaxation modulus as a sum of exponentials.
template <class L>
inline constexpr bool has_prony = linear_law<L>&& requires(const L& law) {
  { law.prony() } -> std::same_as<PronySeries>;
};
/// Whether a law gives the energy of its springs and dashpots.
template <class L>
inline constexpr bool has_energy = requires(const L& law, const double* x) {
  law.stored(0.0, x);
  law.dissipated(0.0, 0.0, x, 0.0, x);
};
/// Whether a law can be stepped in blocks.
template <class L>
inline constexpr bool has_blocks = requires(const L& law) {
  law.block(1.0, 1).rate;
};
/// Whether contact points of the law can break.
template <class L>
inline constexpr bool breakable_law = requires(const L& law, const double* state) {
  { law.break_of(state) } -> std::same_as<Break>;
};
/// Whether contact points of the law crack gradually.
template <class L>
inline constexpr bool cracking_law = requires(const L& law, const double* state) {
  law.crack_of(state).energy;
};
/// Whether the law needs states in double precision.
template <class L>
inline constexpr bool needs_double_law = requires {
  requires L::needs_double;
};
/// Whether a scene can name the law. A law with a crack is named by its chain and the key `crack`.
template <class L>
inline constexpr bool named_law = !requires {
  typename L::Chain;
};
/// Returns the number of units if it is fixed at compile time, else −1.
template <class L>
constexpr int units_of() {
  if constexpr (memoryless_law<L>)
    return 0;
  else if constexpr (requires { L::only_units; })
    return L::only_units;
  else
    return -1;
}
/// @}

/// Returns the properties of a law. The overload below returns the properties of each law of a table.
template <class L>
LawFacts facts_of(const L& law) {
  return {L::name,          law.alpha,         law.instantaneous(), law.shortest_time(), law.units(),
          units_of<L>(),    memoryless_law<L>, linear_law<L>,       has_blocks<L>,       coupled_law<L>,
          has_stiffness<L>, breakable_law<L>,  series_law<L>,       cracking_law<L>,     needs_double_law<L>};
}

/// One entry per pair type; empty for pairs without a law.
using FactsTable = std::array<std::optional<LawFacts>, pair_types>;

template <class... L>
FactsTable facts_of(const std::array<std::optional<std::variant<L...>>, pair_types>& laws) {
  FactsTable out;
  for (std::size_t pair = 0; pair < laws.size(); ++pair) {
    if (laws[pair]) out[pair] = std::visit([](const auto& law) { return facts_of(law); }, *laws[pair]);
  }
  return out;
}

/// Returns whether the table has a law whose contact points can break.
inline bool can_break(const FactsTable& laws) {
  for (const auto& law : laws) {
    if (law && law->breaks) return true;
  }
  return false;
}

/// Returns whether the table has a law whose contact points crack gradually.
inline bool can_crack(const FactsTable& laws) {
  for (const auto& law : laws) {
    if (law && law->cracks) return true;
  }
  return false;
}

}  // namespace macadam
