// SPDX-License-Identifier: GPL-3.0-or-later
/// \file law.hpp  The contract of a contact law.
///
/// A law relates one displacement component x of a contact (opening, slip, relative rotation) to a force-like value f
/// along it, tension positive (docs/model.md, section 6). Moduli are per unit of area over distance: the force of a
/// contact point is f·A_J/d (Eq. 11, 16, 17), so one set of coefficients serves every contact of a material pair. Shear
/// components use the same f times α (Eq. 12).
///
/// A law is a plain struct with
///   - `static constexpr const char* name` — the word in a scene file;
///   - `double alpha` — shear stiffness over normal stiffness; all moduli already include δ;
///   - `int units() const` — extra state numbers a component besides f (Kelvin units);
///   - `double instantaneous() const` — stiffness of an infinitely fast displacement [Pa], for the critical step: the
///     largest that it ever has;
///   - `double shortest_time() const` — the shortest of its relaxation or retardation times [s], ∞ for none;
///   - `template <class R> struct Step` — coefficients of one time step in precision R, made by
///     `template <class R> Step<R> step(double dt) const` (computed in double, then rounded once), with
///     `template <int L, class S, class Units> S advance(S f, S dx, Units&& x) const` — returns f(t+Δt) for the
///     displacement increment dx and updates the unit states x(0)…x(L−1) (references). L = −1: the number of units is
///     only known at run time. `static constexpr bool memoryless` says whether f is a function of x alone; then
///     `template <class S> S value(S x) const` is that function, and a contact of fixed geometry needs no state.
/// The concept SteppableLaw below is this list, and a stepper asks for it by name. A law of the library's own list
/// (all.hpp) also has
///   - `template <class F> void each_key(F&& f)` — calls f(key, member, ValueKind, ValueNeed) for each value, a double
///     or a std::vector<double>: what a scene may say of it, in the order of the names below.
/// All of the following may be absent:
///   - `std::optional<LawFault> fault() const` — what its values, each good by itself, fail to satisfy together;
///   - `static constexpr bool linear = false` — f is no linear function of the history of x. Such a law is stepped by
///     contact points only, and has no place in the frequency domain;
///   - what the frequency domain asks for, all three or none (the trait `has_stiffness` of facts.hpp; a scene whose law
///     has none is refused there by name, and may be stepped):
///     `std::complex<double> stiffness(std::complex<double> s) const` — exact stiffness [Pa] for motions as e^(s·t);
///     s = iω for the steady state at ω [1/s];
///     `template <class F> void each_parameter(std::complex<double> s, F&& f) const` — calls f(name, ∂ln k*/∂ln θ) for
///     each parameter θ of the stiffness, by its symbol in docs/model.md ("E_m", "C_1");
///     `std::complex<double> unit_compliance(int l, std::complex<double> s) const` — x_l per unit of f [1/Pa], for l
///     below units();
///   - `static constexpr int only_units` — units(), where it is always the same number;
///   - `Step::coupled = true` — opening and slips of a contact point act on one another: where the bond has broken
///   under
///     tension, there is no shear either. Such a law is not linear, has only_units, and in place of advance()
///     `template <class S, class State> void advance_point(const S (&dx)[3], S d, State&& state) const` — takes the
///     increments of the opening and of the slips along s and t, and the contact's distance d [m], so that f/d is the
///     normal stress and α·f/d a shear stress; state(c, 0) is the f of component c, state(c, 1 + l) its x(l)
///     (references), which it all updates;
///   - `static Break break_of(const double* state)` — contact points of the law can break: whether one is broken, and
///     how, from its numbers state(0, 0), state(0, 1), …, state(1, 0), … one after another. Such a law is coupled.
///     Tests then count broken points (host/experiments/stepped/cracks.hpp);
///   - `struct Block` — (without it a device takes two kernels a step) M steps taken as one block in which f changes
///   little, made by
///     `Block block(double dt, int M) const` (all double): members `rate`, `relax`, `follow`, `static constexpr int
///     most_units`, `void settled_as(const Block& before)`, which takes what settle() needs from the block that ends,
///     and functions
///     `template <int L, class Units> double drift(double f, Units&& x) const` and
///     `template <int L, class Units> void settle(double sum, Units&& x) const`. Within the block the change δf of f
///     follows δf' = δf + rate·dx + drift + follow·s − relax·δf, with the drift of f and x(l) at its beginning and s
///     the sum of δf' + δf over its steps so far; at its end settle() takes Σ (f' + f) and updates x(l): model (6.8)
///     and (6.9). What is neglected is of second order in the block's length and has no mean over it. A memoryless
///     law must have relax = follow = drift = 0.
/// S is a number or, on the CPU, a packet of them, so a law has no branches: select() chooses.
/// Laws own no memory, know no arrays and no threads. A law may use its units for a state of any kind: damage, slip,
/// plasticity. Add one: a header here, a line in all.hpp, its second writing in host/reference, a test; or in a program
/// of your own (examples/own_law).
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>

#include "macadam/laws/facts.hpp"
#include "macadam/numeric.hpp"

namespace macadam::laws {

/// [Pa], [Pa·s], [Pa]. `delta` of a scene is a factor on moduli and viscosities, not on strengths.
enum class ValueKind : std::uint8_t { modulus, viscosity, strength };
enum class ValueNeed : std::uint8_t { required, optional, may_be_infinite };  ///< the last may be left out too

/// What of a law's values, each good by itself, does not fit the others.
struct LawFault {
  std::string key, found, expected;
};

/// `yes` where the condition holds, else `no`: of a number, or lane by lane of a packet, whose where() its type finds.
template <class Condition, class S>
MACADAM_HD S select(const Condition& condition, const S& yes, S no) {
  if constexpr (std::is_same_v<Condition, bool>) {
    return condition ? yes : no;
  } else {
    where(condition, no) = yes;
    return no;
  }
}

/// The parts of SteppableLaw, so that a compiler says which of them is not there.
namespace contract {
template <class R>
struct States {
  R& operator()(int unit) const;
  R& operator()(int component, int number) const;
};
template <class L>
concept HasName = requires {
  { L::name } -> std::convertible_to<const char*>;
};
template <class L>
concept HasAlpha = requires(const L& law) {
  { law.alpha } -> std::convertible_to<double>;
};
template <class L>
concept HasUnits = requires(const L& law) {
  { law.units() } -> std::same_as<int>;
};
template <class L>
concept HasInstantaneous = requires(const L& law) {
  { law.instantaneous() } -> std::same_as<double>;
};
template <class L>
concept HasShortestTime = requires(const L& law) {
  { law.shortest_time() } -> std::same_as<double>;
};
template <class L, class R>
concept HasStep = requires(const L& law) {
  { law.template step<R>(1.0) } -> std::same_as<typename L::template Step<R>>;
  { L::template Step<R>::memoryless } -> std::convertible_to<bool>;
};
template <class Step, class R>
concept Advances = requires(const Step& step, States<R> x) {
  { step.template advance<-1>(R(), R(), x) } -> std::same_as<R>;
};
template <class Step, class R>
concept AdvancesPoints = requires(const Step& step, const R (&dx)[3], States<R> state) {
  step.advance_point(dx, R(), state);
};
template <class Step, class R>
concept HasValue = requires(const Step& step) {
  { step.value(R()) } -> std::same_as<R>;
};
template <class L>
concept HasOnlyUnits = requires {
  { L::only_units } -> std::convertible_to<int>;
};
template <class L>
concept IsNotLinear = !linear_law<L>;
template <class L>
concept IsUncoupled = !coupled_law<L>;
template <class L>
concept HasMemory = !memoryless_law<L>;

/// One component at a time.
template <class L, class R>
concept StepsComponents = Advances<typename L::template Step<R>, R> &&
    (HasMemory<L> || HasValue<typename L::template Step<R>, R>);
/// The three of a point together.
template <class L, class R>
concept StepsPoints =
    AdvancesPoints<typename L::template Step<R>, R> && IsNotLinear<L> && HasOnlyUnits<L> && HasMemory<L>;
}  // namespace contract

/// What a stepper asks of a law.
template <class L>
concept SteppableLaw = contract::HasName<L> && contract::HasAlpha<L> && contract::HasUnits<L> &&
    contract::HasInstantaneous<L> && contract::HasShortestTime<L> && contract::HasStep<L, double> &&
    contract::HasStep<L, float> &&
    ((contract::IsUncoupled<L> && contract::StepsComponents<L, double> && contract::StepsComponents<L, float>) ||
     (!contract::IsUncoupled<L> && contract::StepsPoints<L, double> && contract::StepsPoints<L, float>));

}  // namespace macadam::laws
