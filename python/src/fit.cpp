// SPDX-License-Identifier: GPL-3.0-or-later
// fit.cpp  Binds `macadam fit`, which fits contact laws to measured moduli. Results are returned as the texts of the
// files that the command writes.
#include "macadam/fit.hpp"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "macadam/fit_report.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"
#include "python/src/choices.hpp"

namespace macadam::python {
namespace {

using Folder = std::optional<std::filesystem::path>;

/// Returns the files, the text and the warnings as a dictionary.
nb::dict result_of(const FitReport& report, const std::vector<std::string>& warnings) {
  nb::dict out;
  out["files"] = nb::cast(report.files);
  out["text"] = report.text;
  out["warnings"] = nb::cast(warnings);
  return out;
}

nb::dict fit(const ModulusData& data, const std::string& model, std::optional<int> units, int most_units,
             const std::string& criterion, std::optional<bool> flow, const std::string& shift,
             std::optional<double> reference_temperature, std::optional<double> from, std::optional<double> to,
             double error, const Folder& out) {
  constexpr int largest = laws::GeneralisedKelvin::max_units;
  FitOptions options;
  options.model = choice<FitModel>(
      "model", model,
      {{"kelvin", FitModel::kelvin}, {"2s2p1d", FitModel::two_s2p1d}, {"huet-sayegh", FitModel::huet_sayegh}});
  options.units = in_range("units", units, 0, largest);
  options.most_units = in_range("most_units", most_units, 0, largest);
  options.criterion = choice<Criterion>("criterion", criterion, {{"aicc", Criterion::aicc}, {"bic", Criterion::bic}});
  options.flow = flow;
  options.shift = choice<ShiftKind>("shift", shift,
                                    {{"none", ShiftKind::none},
                                     {"wlf", ShiftKind::wlf},
                                     {"arrhenius", ShiftKind::arrhenius},
                                     {"free", ShiftKind::free}});
  options.reference_temperature = in_range("reference_temperature", reference_temperature, -273.0, 1000.0);
  in_range("error", error, 1e-6, 0.5);
  FitReport report;
  std::vector<std::string> warnings;
  {
    const nb::gil_scoped_release release;
    const Fit fitted = fit_modulus(data, options);
    report = report_of(fitted, from, to, error);
    warnings = fitted.warnings;
    if (!report.refusal.empty()) warnings.push_back(report.refusal);
    if (out) write_report(*out, report);
  }
  return result_of(report, warnings);
}

/// Converts a 2S2P1D or Huet-Sayegh model, whose parameters are in a file, into a chain of Kelvin units.
nb::dict convert(const std::filesystem::path& parameters, std::optional<double> from, std::optional<double> to,
                 double error, const Folder& out) {
  const ShiftedAnalogue analogue = read_analogue(parameters);
  const FitReport report = report_conversion(analogue, from, to, in_range("error", error, 1e-6, 0.5));
  if (out) write_report(*out, report);
  return result_of(report, {});
}

}  // namespace

void bind_fit(nb::module_& m) {
  nb::class_<ModulusData>(m, "ModulusData", "Measured complex moduli.")
      .def(
          "__init__",
          [](ModulusData* self, const std::filesystem::path& file, std::optional<double> poisson,
             const std::string& needed) {
            const auto measured = choice<Measured>("needed", needed,
                                                   {{"modulus-and-phase", Measured::modulus_and_phase},
                                                    {"modulus", Measured::modulus},
                                                    {"phase", Measured::phase}});
            new (self) ModulusData(read_modulus_data(file, in_range("poisson", poisson, -0.99, 0.5), measured));
          },
          nb::arg("file"), nb::arg("poisson") = nb::none(), nb::arg("needed") = "modulus-and-phase")
      .def_prop_ro(
          "unused", [](const ModulusData& d) { return d.unused; }, "Names of columns that are not used.")
      .def_rw("source", &ModulusData::source, "Name of the data in messages.")
      .def("__len__", [](const ModulusData& d) { return d.points.size(); })
      .def_prop_ro("frequency_hz",
                   [](const ModulusData& d) {
                     return member<double>(d.points, [](const ModulusPoint& p) { return &p.frequency_hz; });
                   })
      .def_prop_ro("e_star_pa",
                   [](const ModulusData& d) {
                     return member<double>(d.points, [](const ModulusPoint& p) { return &p.e_star_pa; });
                   })
      .def_prop_ro("phase_deg", [](const ModulusData& d) {
        return member<double>(d.points, [](const ModulusPoint& p) { return &p.phase_deg; });
      });
  m.def("fit", &fit, nb::arg("data"), nb::arg("model"), nb::arg("units").none(), nb::arg("most_units"),
        nb::arg("criterion"), nb::arg("flow").none(), nb::arg("shift"), nb::arg("reference_temperature").none(),
        nb::arg("from_hz").none(), nb::arg("to_hz").none(), nb::arg("error"), nb::arg("out").none());
  m.def("convert", &convert, nb::arg("parameters"), nb::arg("from_hz").none(), nb::arg("to_hz").none(),
        nb::arg("error"), nb::arg("out").none());
}

}  // namespace macadam::python
