// SPDX-License-Identifier: GPL-3.0-or-later
// calibration.cpp  Binds `macadam calibrate`, which finds parameters of a scene from measured moduli of the mixture.
#include "macadam/calibration.hpp"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "python/src/bindings.hpp"
#include "python/src/calls.hpp"
#include "python/src/choices.hpp"

namespace macadam::python {
namespace {

using Pairs = std::map<std::string, std::pair<double, double>>;  // two numbers by name of a parameter

/// Returns the free parameters with their bounds (low, high) and priors (value, standard deviation of its
/// natural logarithm).
/// \throws InputError if bounds or priors name a parameter that is not free.
std::vector<FreeParameter> free_parameters(const std::vector<std::string>& names, const Pairs& bounds,
                                           const Pairs& priors) {
  std::vector<FreeParameter> out;
  for (const std::string& name : names) out.push_back({name, {}, {}, {}, 0});
  const auto find = [&](const char* option, const std::string& name) -> FreeParameter& {
    for (FreeParameter& p : out)
      if (p.name == name) return p;
    throw InputError(std::string(option) + ": found \"" + name + "\", expected a name in `free`");
  };
  for (const auto& [name, range] : bounds) {
    FreeParameter& p = find("bounds", name);
    p.low = range.first, p.high = range.second;
  }
  for (const auto& [name, known] : priors) {
    FreeParameter& p = find("priors", name);
    p.prior = known.first, p.prior_deviation = known.second;
  }
  return out;
}

/// Calibrates and writes the files into `out`. Returns the result as text, and the warnings.
nb::dict run_calibration(const GivenScene& scene, const ModulusData& data, const std::vector<std::string>& free,
                         const Pairs& bounds, const Pairs& priors, int seeds, const std::string& misfit,
                         double e_star_deviation, double phase_deviation, bool nearest,
                         const std::filesystem::path& out, nb::object progress) {
  CalibrationOptions options;
  options.free = free_parameters(free, bounds, priors);
  options.seeds = in_range("seeds", seeds, 1, 1000);
  options.misfit = choice<Misfit>("misfit", misfit,
                                  {{"modulus-and-phase", Misfit::modulus_and_phase},
                                   {"modulus", Misfit::modulus},
                                   {"phase", Misfit::phase},
                                   {"parts", Misfit::parts}});
  options.e_star_deviation = in_range("e_star_deviation", e_star_deviation, 1e-6, 100.0) / 100;
  options.phase_deviation = in_range("phase_deviation", phase_deviation, 1e-6, 90.0);
  options.nearest = nearest;
  LongCall call(std::move(progress));
  Watcher watcher;
  watcher.progress = call.progress_function();
  watcher.stop = [&] { return call.stop(); };
  const GivenScene copy = scene;  // another Python thread may change the caller's scene
  const Calibration calibration = call([&] { return calibrate_into(out, copy, data, options, watcher); });
  nb::dict result;
  result["text"] = calibration_text(calibration);
  result["warnings"] = nb::cast(calibration.warnings);
  return result;
}

}  // namespace

void bind_calibration(nb::module_& m) {
  m.def("calibrate", &run_calibration, nb::arg("scene"), nb::arg("data"), nb::arg("free"), nb::arg("bounds"),
        nb::arg("priors"), nb::arg("seeds"), nb::arg("misfit"), nb::arg("e_star_deviation"), nb::arg("phase_deviation"),
        nb::arg("nearest"), nb::arg("out"), nb::arg("progress").none());
}

}  // namespace macadam::python
