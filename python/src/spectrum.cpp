// SPDX-License-Identifier: GPL-3.0-or-later
// spectrum.cpp  Binds the relaxation and creep functions of a specimen at any time, and the evaluation of |E*| and
// phase angle from samples of stress and strain.
#include "macadam/spectrum.hpp"

#include <nanobind/stl/complex.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "host/base/thread_limit.hpp"
#include "macadam/results.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"
#include "python/src/calls.hpp"
#include "python/src/choices.hpp"
#include "python/src/given_arrays.hpp"

namespace macadam::python {
namespace {

/// Returns the array of f(time), (n,).
template <class F>
nb::ndarray<nb::numpy, double> of_each(const ArrayLike& times, F&& f) {
  std::vector<double> out = numbers(times, "times");
  for (double& value : out) value = f(value);
  return owned(std::move(out));
}

/// Returns (value, time) of each unit, (n, 2). value: the member of Unit that is meant, a modulus or a compliance.
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
  const CyclicResult found = evaluate_cyclic(samples, frequency, fit_cycles);
  nb::dict out;
  out["e_star_pa"] = found.fit.e_star_pa;
  out["phase_deg"] = found.fit.phase_deg;
  out["e_star_peaks_pa"] = found.peaks.e_star_pa;
  out["phase_peaks_deg"] = found.peaks.phase_deg;
  out["fit_rms"] = found.fit_rms;
  out["change_e_star"] = found.change_e_star;
  out["change_phase_deg"] = found.change_phase_deg;
  return out;
}

void bind_series(nb::module_& m) {
  nb::class_<PronySeries>(m, "PronySeries", "Relaxation modulus as a sum of Maxwell units.")
      .def_ro("long_term", &PronySeries::long_term, "E(∞) [Pa]: 0 for what flows.")
      .def_prop_ro("instantaneous", &PronySeries::instantaneous, "E(0) [Pa].")
      .def_prop_ro(
          "units", [](const PronySeries& s) { return pairs_of(s.units, &PronySeries::Unit::modulus); },
          nb::rv_policy::move, "Modulus [Pa] and relaxation time [s] of each, times ascending, (n, 2).")
      .def(
          "modulus",
          [](const PronySeries& s, const ArrayLike& t) { return of_each(t, [&](double x) { return s.modulus(x); }); },
          nb::arg("times"), "E(t) [Pa] at times [s].")
      .def(
          "after_ramp",
          [](const PronySeries& s, const ArrayLike& t, double duration) {
            return of_each(t, [&](double x) { return s.after_ramp(x, duration); });
          },
          nb::arg("times"), nb::arg("duration"),
          "Stress over strain [Pa] where the strain grows evenly over `duration` [s] and is held.")
      .def(
          "stiffness", [](const PronySeries& s, std::complex<double> at) { return s.stiffness(at); }, nb::arg("s"),
          "E*(s) [Pa] of motions e^(s·t); s = 2πi·f for a frequency f.");
  nb::class_<CreepSeries>(m, "CreepSeries", "Creep compliance as a chain of Kelvin units with a spring and a dashpot.")
      .def_ro("instantaneous", &CreepSeries::instantaneous, "J(0) [1/Pa].")
      .def_ro("fluidity", &CreepSeries::fluidity, "1/η [1/(Pa s)]: 0 for what does not flow.")
      .def_prop_ro(
          "units", [](const CreepSeries& s) { return pairs_of(s.units, &CreepSeries::Unit::compliance); },
          nb::rv_policy::move, "Compliance [1/Pa] and retardation time [s] of each, times ascending, (n, 2).")
      .def(
          "compliance",
          [](const CreepSeries& s, const ArrayLike& t) {
            return of_each(t, [&](double x) { return s.compliance(x); });
          },
          nb::arg("times"), "J(t) [1/Pa] at times [s].")
      .def(
          "after_ramp",
          [](const CreepSeries& s, const ArrayLike& t, double duration) {
            return of_each(t, [&](double x) { return s.after_ramp(x, duration); });
          },
          nb::arg("times"), nb::arg("duration"),
          "Strain over stress [1/Pa] where the stress grows evenly over `duration` [s] and is held.");
}

}  // namespace

void bind_spectrum(nb::module_& m) {
  bind_series(m);
  const SpectrumOptions usual;
  nb::class_<Spectrum>(m, "Spectrum", "What a specimen's relaxation is, and how well it is known.")
      .def_ro("relaxation", &Spectrum::relaxation)
      .def_ro("creep", &Spectrum::creep)
      .def_ro("error", &Spectrum::error, "Estimate of the largest relative error of E(t).")
      .def_ro("checked", &Spectrum::checked, "Largest relative difference of E*(iω) from solutions of their own.")
      .def_ro("solutions", &Spectrum::solutions, "Of the whole network.");
  m.def("spectrum", &spectrum, nb::arg("specimen"), nb::arg("shortest") = usual.shortest,
        nb::arg("longest") = usual.longest, nb::arg("tolerance") = usual.tolerance, nb::arg("backend") = "cpu",
        nb::arg("linear") = "auto", nb::arg("device") = nb::none(),
        "The relaxation spectrum of a specimen between two times [s], without inertia; tolerance: relative, of E(t).");
  m.def("evaluate_cyclic", &evaluate, nb::arg("time"), nb::arg("strain"), nb::arg("stress"), nb::arg("frequency"),
        nb::arg("fit_cycles") = 1,
        "|E*| [Pa] and φ [degrees] of samples at times [s], tension positive, stresses in Pa, at a frequency [Hz]: "
        "fitted "
        "to the last `fit_cycles` cycles, and read off the peaks of the last.");
}

}  // namespace macadam::python
