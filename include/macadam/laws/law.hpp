// SPDX-License-Identifier: GPL-3.0-or-later
/// \file law.hpp  Defines the contract of a contact law: the members that a law must have, and the members that it may
/// have.
///
/// A law relates one displacement component x of a contact (opening, slip, relative rotation) to a force-like value f
/// along it, tension positive (docs/model.md, section 6). Moduli are per unit of area over distance: the force of a
/// contact point is f·A_J/d (Eq. 11, 16, 17), so one set of coefficients serves every contact of a material pair. Shear
/// components use the same f times α (Eq. 12).
///
/// A law is a plain struct with
///   - `static constexpr const char* name` — its name in a scene file;
///   - `double alpha` — shear stiffness over normal stiffness; all moduli already include δ;
///   - `int units() const` — number of state values per component besides f (Kelvin units);
///   - `double instantaneous() const` — stiffness for an infinitely fast displacement [Pa]. This is the largest
///     stiffness that the law ever has, and it determines the critical time step;
///   - `double shortest_time() const` — the shortest of its relaxation or retardation times [s], ∞ if it has none;
///   - `template <class R> struct Step` — coefficients of one time step in precision R, made by
///     `template <class R> Step<R> step(double dt) const` (computed in double, then rounded once). It has
///     `template <int L, class S, class Units> S advance(S f, S dx, Units&& x) const`, which returns f(t+Δt) for the
///     displacement increment dx and updates the unit states x(0)…x(L−1) (references). L = −1 means that the number of
///     units is only known at run time. `static constexpr bool memoryless` says whether f is a function of x alone;
///     then `template <class S> S value(S x) const` is that function, and a contact of fixed geometry needs no state.
/// The concept SteppableLaw below checks these members. Code that makes steppers requires this concept of its laws. A
/// law of the library's own list (all.hpp) also has
///   - `template <class F> void each_key(F&& f)` — calls f(key, member, ValueKind, ValueNeed) for each value that a
///     scene may set, a double or a std::vector<double>, in the order in which the scene file names them.
/// All of the following members are optional:
///   - the members that rock in series with a contact (Contact::series) needs, both or none. Without them, a stepper
///     refuses such a contact and names the law:
///     `R step_stiffness() const` of Step — k, the change of f per dx within one step [Pa];
///     a last argument of advance(), by which the change of f is multiplied before the units are advanced:
///     `template <int L, class S, class Units, class Factor = NoFactor>
///     S advance(S f, S dx, Units&& x, const Factor& factor = {}) const`. A spring of compliance r in series takes r·δf
///     of the increment dx, so that δf is multiplied by 1/(1 + r·k): model (6.12). Factor is S, or NoFactor, which
///     stands for 1;
///   - `std::optional<LawFault> fault() const` — reports values that are valid separately but not together;
///   - `static constexpr bool linear = false` — f is not a linear function of the history of x. Such a law can only be
///     stepped in points form, and cannot be used in the frequency domain;
///   - the members that the frequency domain needs, all three or none (the trait `has_stiffness` of facts.hpp). A scene
///     with a law that lacks them can be stepped; the frequency domain refuses it and names the law:
///     `std::complex<double> stiffness(std::complex<double> s) const` — exact stiffness [Pa] for motions as e^(s·t);
///     s = iω for the steady state at ω [1/s];
///     `template <class F> void each_parameter(std::complex<double> s, F&& f) const` — calls f(name, ∂ln k*/∂ln θ) for
///     each parameter θ of the stiffness, by its symbol in docs/model.md ("E_m", "C_1");
///     `std::complex<double> unit_compliance(int l, std::complex<double> s) const` — x_l per unit of f [1/Pa], for l
///     below units();
///   - `PronySeries prony() const` — its relaxation as a sum of exponentials (prony_series.hpp): the stress f/x
///     after a step of strain [Pa]. All moduli are positive, and E(0) is instantaneous(). Relaxation, creep and
///     constant-rate tests without time steps need prony(), in addition to the members of the frequency domain, and
///     refuse a law without it by name. A law with prony() that is not in the library's list can be converted to a law
///     of the list (equivalent_laws(), spectrum.hpp);
///   - the members that energies of a test need, both or none (the trait `has_energy` of facts.hpp). Energies are per
///     unit of area over distance [Pa·m²], as f is; `x` points to the states of the units:
///     `double stored(double f, const double* x) const` — the energy in the springs of one component;
///     `double dissipated(double dt, double f_before, const double* x_before, double f, const double* x) const` — the
///     energy that its dashpots dissipate between two samples that are `dt` apart;
///   - `static constexpr int only_units` — units(), if it is always the same number;
///   - `Step::coupled = true` — opening and slips of a contact point act on one another. For example, a bond that has
///     broken under tension has no shear stiffness either. Such a law is not linear, has only_units, or
///     Step::most_units if their number is only known at run time, and has in place of advance()
///     `template <int L, class S, class State> void advance_point(const S (&dx)[3], S d, State&& state) const`. It
///     takes the increments of the opening and of the slips along s and t, and the contact's distance d [m], so that
///     f/d is the normal stress and α·f/d a shear stress. state(c, 0) is the f of component c, state(c, 1 + l) its x(l)
///     (references); it updates all of them. L is units(), or −1 if it is only known at run time. A last argument
///     with members `normal` and `shear`, the factors of rock in series in advance(), is needed for increments only;
///   - `static constexpr bool needs_double = true` — states in single precision would be too inaccurate. A stepper in
///     single precision refuses such a law;
///   - `Break break_of(const double* state) const` — for laws whose contact points can break: returns whether and how
///     a point is broken, from its numbers state(0, 0), state(0, 1), …, state(1, 0), … one after another. Such a law is
///     coupled. Stepped tests then count broken points (host/run/cracks.hpp);
///   - `PointCrack crack_of(const double* state) const` — for laws whose contact points crack gradually: returns
///     opening, damage and energies of a point (crack.hpp) from the same numbers;
///   - the members that a crack in series with the law needs (cracked.hpp): `static constexpr const char*`
///     `cracked_name`, `static constexpr int max_units`, and the two parts of advance() as separate functions of Step:
///     `trial<L>(f, dx, x, factor)` returns f(t+Δt), `follow<L>(sum, x)` updates the unit states from f(t+Δt) + f(t);
///   - `struct Block` — M steps taken as one block in which f changes little (without it, a device takes two kernels
///     per step), made by
///     `Block block(double dt, int M) const` (all double). It has members `rate`, `relax`, `follow`, `static constexpr
///     int most_units`, `void settled_as(const Block& before)`, which takes the coefficients of settle() from the block
///     that ends, and the functions
///     `template <int L, class Units> double drift(double f, Units&& x) const` and
///     `template <int L, class Units> void settle(double sum, Units&& x) const`. During the block the change δf of f
///     follows δf' = δf + rate·dx + drift + follow·s − relax·δf. The drift is computed from f and x(l) at the beginning
///     of the block; s is the sum of δf' + δf over its steps so far. At the end, settle() receives Σ (f' + f) and
///     updates x(l): model (6.8) and (6.9). The error is of second order in the block's length, and its mean over the
///     block is zero. A memoryless law must have relax = follow = drift = 0. `rate` is step_stiffness(). With rock in
///     series, the stepper multiplies δf' − δf by 1/(1 + r·rate), and f of a memoryless law is rate·x/(1 + r·rate).
/// S is a number or, on the CPU, a packet of numbers. So a law must not branch; it uses select().
///
/// Laws do not own memory and do not depend on arrays or threads. A law may use its units for states of any kind:
/// damage, slip, plasticity. To add a law, write a header here, a line in all.hpp, a reference implementation in
/// host/reference and a test. A program may also have laws of its own (examples/own_law).
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>

#include "macadam/laws/facts.hpp"
#include "macadam/numeric.hpp"

namespace macadam::laws {

/// Kind of a value: modulus [Pa], viscosity [Pa·s] or strength [Pa]. The factor `delta` of a scene applies to moduli
/// and viscosities, not to strengths.
enum class ValueKind : std::uint8_t { modulus, viscosity, strength };
/// Whether a scene must give a value. A value that may be infinite is also optional.
enum class ValueNeed : std::uint8_t { required, optional, may_be_infinite };

/// A value of a law that is valid by itself but contradicts other values of the law.
struct LawFault {
  std::string key, found, expected;
};

/// Returns `yes` if the condition holds, else `no`, for a number or for each lane of a packet. For packets, where() is
/// found by argument-dependent lookup.
template <class Condition, class S>
MACADAM_HD S select(const Condition& condition, const S& yes, S no) {
  if constexpr (std::is_same_v<Condition, bool>) {
    return condition ? yes : no;
  } else {
    where(condition, no) = yes;
    return no;
  }
}

/// Returns the condition, or for packets whether it holds in any lane. A law may branch on this value, because no lane
/// takes another way than the others.
template <class Condition>
MACADAM_HD bool any(const Condition& condition) {
  if constexpr (std::is_same_v<Condition, bool>)
    return condition;
  else
    return any_of(condition);  // found by argument-dependent lookup
}

/// Factor 1 of a contact without rock in series. A product with it is the other number, so no code is compiled.
struct NoFactor {
  template <class S>
  MACADAM_HD friend S operator*(NoFactor, S x) {
    return x;
  }
};
/// The factors of normal and shear components of a contact without rock in series.
struct NoFactors {
  NoFactor normal, shear;
};

/// The parts of SteppableLaw as separate concepts, so that compilers name the missing one.
namespace contract {
/// Stand-in for the state references that a stepper passes to a law.
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
  step.template advance_point<-1>(dx, R(), state);
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
concept HasMostUnits = requires {
  { L::template Step<double>::most_units } -> std::convertible_to<int>;
};
template <class L>
concept IsNotLinear = !linear_law<L>;
template <class L>
concept IsUncoupled = !coupled_law<L>;
template <class L>
concept HasMemory = !memoryless_law<L>;

/// The law advances one component at a time.
template <class L, class R>
concept StepsComponents = Advances<typename L::template Step<R>, R> &&
    (HasMemory<L> || HasValue<typename L::template Step<R>, R>);
/// The law advances the three components of a point together.
template <class L, class R>
concept StepsPoints = AdvancesPoints<typename L::template Step<R>, R> && IsNotLinear<L> &&
    (HasOnlyUnits<L> || HasMostUnits<L>)&&HasMemory<L>;
}  // namespace contract

/// The members that a stepper requires of a law; see the top of the file.
template <class L>
concept SteppableLaw = contract::HasName<L> && contract::HasAlpha<L> && contract::HasUnits<L> &&
    contract::HasInstantaneous<L> && contract::HasShortestTime<L> && contract::HasStep<L, double> &&
    contract::HasStep<L, float> &&
    ((contract::IsUncoupled<L> && contract::StepsComponents<L, double> && contract::StepsComponents<L, float>) ||
     (!contract::IsUncoupled<L> && contract::StepsPoints<L, double> && contract::StepsPoints<L, float>));

}  // namespace macadam::laws
