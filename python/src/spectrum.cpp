// SPDX-License-Identifier: GPL-3.0-or-later
// spectrum.cpp  Binds the relaxation and creep functions of a specimen at any time, and the evaluation of |E*| and
// phase angle from samples of stress and strain.
#include "macadam/spectrum.hpp"

#include <fmt/format.h>
#include <nanobind/stl/complex.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "macadam/results.hpp"
#include "macadam/thread_limit.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"
#include "python/src/calls.hpp"
#include "python/src/choices.hpp"
#include "python/src/given_arrays.hpp"

namespace macadam::python {
namespace {

/// Returns f(time) for all times, as an array of shape (n,).
template <class F>
nb::ndarray<nb::numpy, double> values_at(const ArrayLike& times, F&& f) {
  std::vector<double> out = numbers(times, "times");
  for (double& value : out) value = f(value);
  return owned(std::move(out));
}

/// Returns the pairs (value, time) of all units as an array of shape (n, 2). value: the member of Unit to return, a
/// modulus or a compliance.
template <class Unit>
nb::ndarray<nb::numpy, double> pairs_of(const std::vector<Unit>& units, double Unit::*value) {
  std::vector<double> out;
  for (const Unit& unit : units) out.insert(out.end(), {unit.*value, unit.time});
  return owned(std::move(out), {units.size(), 2});
}

Spectrum spectrum(const PreparedPointer& specimen, double shortest, double longest, double tolerance,
                  const std::string& backend, const std::string& linear, const Devices& device) {
  LongCall call;
  SpectrumOptions options{shortest, longest, tolerance, choice("backend", backend, backends),
                          choice("linear", linear, linear_methods)};
  options.devices = devices_of(device).value_or(DeviceList{});
  options.stop = [&] { return call.stop(); };
  return call([&] {
    const ThreadLimit threads(specimen->scene->solver.threads);
    return spectrum_of(specimen->made.specimen, specimen->made.network, specimen->scene->laws, options);
  });
}

nb::dict evaluate(const ArrayLike& times, const ArrayLike& strains, const ArrayLike& stresses, double frequency,
                  int fit_cycles) {
  const std::vector<double> time = numbers(times, "time"), strain = numbers(strains, "strain", time.size()),
                            stress = numbers(stresses, "stress", time.size());
  std::vector<ResponseSample> samples;
  for (std::size_t i = 0; i < time.size(); ++i) samples.push_back({frequency, time[i], strain[i], stress[i]});
  const CyclicResult result = evaluate_cyclic(samples, frequency, fit_cycles);
  nb::dict out;
  out["e_star_pa"] = result.fit.e_star_pa;
  out["phase_deg"] = result.fit.phase_deg;
  out["e_star_peaks_pa"] = result.peaks.e_star_pa;
  out["phase_peaks_deg"] = result.peaks.phase_deg;
  out["fit_rms"] = result.fit_rms;
  out["change_e_star"] = result.change_e_star;
  out["change_phase_deg"] = result.change_phase_deg;
  return out;
}

void bind_series(nb::module_& m) {
  nb::class_<PronySeries>(m, "PronySeries", "Relaxation modulus as a sum of Maxwell units.")
      .def("__repr__",
           [](const PronySeries& s) {
             return fmt::format("<macadam.PronySeries: {} units, E(0) {:.4g} Pa, E(inf) {:.4g} Pa>", s.units.size(),
                                s.instantaneous(), s.long_term);
           })
      .def_ro("long_term", &PronySeries::long_term, "E(∞) [Pa]; 0 for a fluid.")
      .def_prop_ro("instantaneous", &PronySeries::instantaneous, "E(0) [Pa].")
      .def_prop_ro(
          "units", [](const PronySeries& s) { return pairs_of(s.units, &PronySeries::Unit::modulus); },
          nb::rv_policy::move, "Modulus [Pa] and relaxation time [s] of each unit, by ascending time, (n, 2).")
      .def(
          "modulus",
          [](const PronySeries& s, const ArrayLike& t) { return values_at(t, [&](double x) { return s.modulus(x); }); },
          nb::arg("times"), "Returns E(t) [Pa] at times [s], (n,).")
      .def(
          "after_ramp",
          [](const PronySeries& s, const ArrayLike& t, double duration) {
            return values_at(t, [&](double x) { return s.after_ramp(x, duration); });
          },
          nb::arg("times"), nb::arg("duration"),
          "Returns stress over strain [Pa], (n,), if the strain grows at a constant rate for `duration` [s] and is "
          "then "
          "held.")
      .def(
          "stiffness", [](const PronySeries& s, std::complex<double> at) { return s.stiffness(at); }, nb::arg("s"),
          "Returns E*(s) [Pa] for motions e^(s·t); s = 2πi·f for a frequency f.");
  nb::class_<CreepSeries>(m, "CreepSeries", "Creep compliance as a chain of Kelvin units with a spring and a dashpot.")
      .def("__repr__",
           [](const CreepSeries& s) {
             return fmt::format("<macadam.CreepSeries: {} units, J(0) {:.4g} 1/Pa, fluidity {:.4g} 1/(Pa s)>",
                                s.units.size(), s.instantaneous, s.fluidity);
           })
      .def_ro("instantaneous", &CreepSeries::instantaneous, "J(0) [1/Pa].")
      .def_ro("fluidity", &CreepSeries::fluidity, "1/η [1/(Pa s)]; 0 for a solid.")
      .def_prop_ro(
          "units", [](const CreepSeries& s) { return pairs_of(s.units, &CreepSeries::Unit::compliance); },
          nb::rv_policy::move, "Compliance [1/Pa] and retardation time [s] of each unit, by ascending time, (n, 2).")
      .def(
          "compliance",
          [](const CreepSeries& s, const ArrayLike& t) {
            return values_at(t, [&](double x) { return s.compliance(x); });
          },
          nb::arg("times"), "Returns J(t) [1/Pa] at times [s], (n,).")
      .def(
          "after_ramp",
          [](const CreepSeries& s, const ArrayLike& t, double duration) {
            return values_at(t, [&](double x) { return s.after_ramp(x, duration); });
          },
          nb::arg("times"), nb::arg("duration"),
          "Returns strain over stress [1/Pa], (n,), if the stress grows at a constant rate for `duration` [s] and is "
          "then held.");
}

}  // namespace

void bind_spectrum(nb::module_& m) {
  bind_series(m);
  const SpectrumOptions usual;
  nb::class_<Spectrum>(m, "Spectrum", "Relaxation and creep functions of a specimen, and their errors.")
      .def("__repr__",
           [](const Spectrum& s) {
             return fmt::format("<macadam.Spectrum: {} units, E(0) {:.4g} Pa, error {:.2g}>", s.relaxation.units.size(),
                                s.relaxation.instantaneous(), s.error);
           })
      .def_ro("relaxation", &Spectrum::relaxation)
      .def_ro("creep", &Spectrum::creep)
      .def_ro("error", &Spectrum::error, "Estimate of the largest relative error of E(t).")
      .def_ro("checked", &Spectrum::checked,
              "Largest relative difference of E*(iω) from separate solutions at single frequencies.")
      .def_ro("solutions", &Spectrum::solutions, "Number of solutions of the whole network.");
  m.def(
      "spectrum", &spectrum, nb::arg("specimen"), nb::arg("shortest") = usual.shortest,
      nb::arg("longest") = usual.longest, nb::arg("tolerance") = usual.tolerance, nb::arg("backend") = "cpu",
      nb::arg("linear") = "auto", nb::arg("device") = nb::none(),
      "Returns the relaxation spectrum of a specimen between two times [s], without inertia. tolerance: relative error "
      "of E(t).");
  m.def(
      "evaluate_cyclic", &evaluate, nb::arg("time"), nb::arg("strain"), nb::arg("stress"), nb::arg("frequency"),
      nb::arg("fit_cycles") = 1,
      "Returns |E*| [Pa] and φ [degrees] of samples of time [s], strain and stress [Pa] (tension positive), (n,) each, "
      "at a frequency [Hz]: from a fit to the last `fit_cycles` cycles, and from the peaks of the last cycle.");
}

}  // namespace macadam::python
