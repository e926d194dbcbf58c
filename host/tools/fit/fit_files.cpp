// SPDX-License-Identifier: GPL-3.0-or-later
// fit_files.cpp  Writes a fit as TOML, JSON, CSV and text.
#include "host/tools/fit/fit_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/files/result_files.hpp"
#include "host/files/result_folder.hpp"
#include "macadam/error.hpp"
#include "macadam/version.hpp"

namespace macadam {
namespace {

using Json = nlohmann::ordered_json;

/// Returns a JSON number; null for infinity, which JSON does not have.
Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json shift_json(const laws::Shift& shift) {
  struct Write {
    Json operator()(const laws::NoShift&) const { return nullptr; }
    Json operator()(const laws::Wlf& s) const {
      return {{"shift", "wlf"}, {"C1", s.C1}, {"C2", s.C2}, {"reference_temperature_c", s.reference_temperature}};
    }
    Json operator()(const laws::Arrhenius& s) const {
      return {{"shift", "arrhenius"},
              {"activation_energy_j_per_mol", s.activation_energy},
              {"reference_temperature_c", s.reference_temperature}};
    }
    Json operator()(const laws::ShiftTable& s) const {
      return {{"shift", "table"}, {"temperatures_c", s.temperatures}, {"log10_a_T", s.log10_a_T}};
    }
  };
  return std::visit(Write{}, shift);
}

Json chain_json(const laws::GeneralisedKelvin& law) {
  return {{"E_m_pa", law.E_m}, {"C_m_pa_s", finite(law.C_m)}, {"E_pa", law.E}, {"C_pa_s", law.C}};
}

Json analogue_json(const AnalogueModel& m) {
  return {{"E_0_pa", m.E_0}, {"E_00_pa", m.E_00},     {"k", m.k}, {"h", m.h}, {"delta", m.delta},
          {"tau_s", m.tau},  {"beta", finite(m.beta)}};
}

std::string list_of(const std::vector<double>& values) { return fmt::format("[{}]", fmt::join(values, ", ")); }

/// Returns a number as a TOML float, which needs a point or an exponent.
std::string real(double v) {
  const std::string text = fmt::format("{}", v);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

/// Returns the frequencies of curve.csv, to half a decade beyond the data on both sides.
std::vector<double> curve_frequencies(const Fit& fit) {
  const auto [low, high] = fit.reduced_range();
  const double from = low / std::sqrt(10.0), to = high * std::sqrt(10.0);
  const int steps = std::max(2, static_cast<int>(std::ceil(20 * std::log10(to / from))));
  std::vector<double> out;
  for (int i = 0; i <= steps; ++i) out.push_back(from * std::pow(to / from, static_cast<double>(i) / steps));
  return out;
}

}  // namespace

std::string law_toml(const laws::GeneralisedKelvin& law, const laws::Shift& shift, const laws::LawRange& range,
                     const std::string& origin) {
  std::string out = fmt::format(
      "# {}\n[[contacts]]\npair = \"M-M\"  # the pair that has this law\nlaw = \"generalised_kelvin\"\nE_m = {}\n",
      origin, real(law.E_m));
  if (std::isfinite(law.C_m)) out += fmt::format("C_m = {}\n", real(law.C_m));
  out +=
      fmt::format("E = {}\nC = {}\nalpha = 0.1  # ratio of shear to normal stiffness; the data do not determine it\n",
                  list_of(law.E), list_of(law.C));
  struct Write {
    std::string operator()(const laws::NoShift&) const { return ""; }
    std::string operator()(const laws::Wlf& s) const {
      return fmt::format("shift = \"wlf\"\nC1 = {}\nC2 = {}\nreference_temperature = {}\n", real(s.C1), real(s.C2),
                         real(s.reference_temperature));
    }
    std::string operator()(const laws::Arrhenius& s) const {
      return fmt::format("shift = \"arrhenius\"\nactivation_energy = {}\nreference_temperature = {}\n",
                         real(s.activation_energy), real(s.reference_temperature));
    }
    std::string operator()(const laws::ShiftTable& s) const {
      return fmt::format("shift = \"table\"\ntemperatures = {}\nlog10_a_T = {}\n", list_of(s.temperatures),
                         list_of(s.log10_a_T));
    }
  };
  out += std::visit(Write{}, shift);
  if (range.limits_frequency())
    out += fmt::format("valid_frequencies = [{}, {}]  # Hz, at the reference temperature\n", real(range.lowest_hz),
                       real(range.highest_hz));
  if (range.limits_temperature())
    out += fmt::format("valid_temperatures = [{}, {}]\n", real(range.lowest_c), real(range.highest_c));
  return out;
}

std::string fit_json(const Fit& fit, const KelvinConversion* conversion) {
  Json out;
  out["macadam"] = version();
  out["model"] = to_string(fit.options.model);
  out["reference_temperature_c"] =
      fit.options.reference_temperature ? Json(*fit.options.reference_temperature) : Json();
  if (const auto* chain = std::get_if<laws::GeneralisedKelvin>(&fit.model)) {
    out["law"] = chain_json(*chain);
  } else {
    out["analogue"] = analogue_json(std::get<AnalogueModel>(fit.model));
  }
  if (conversion) {
    out["law"] = chain_json(conversion->law);
    out["law_largest_error"] = conversion->largest_error;
  }
  out["shift"] = shift_json(fit.shift);
  out["errors"] = {{"e_star_rms", fit.errors.e_star_rms},
                   {"e_star_largest", fit.errors.e_star_largest},
                   {"phase_rms_deg", fit.errors.phase_rms_deg},
                   {"phase_largest_deg", fit.errors.phase_largest_deg}};
  out["misfit"] = fit.misfit;
  out["degrees_of_freedom"] = fit.degrees_of_freedom;
  out["deviations"] = fit.deviations ? "of the data" : "from the misfit";
  for (const FitParameter& p : fit.parameters) {
    out["parameters"].push_back(
        {{"name", p.name}, {"unit", p.unit}, {"value", p.value}, {"standard_deviation", finite(p.deviation)}});
  }
  const std::size_t n = fit.parameters.size();
  out["covariance"]["of"] = Json::array();
  for (const FitParameter& p : fit.parameters)
    out["covariance"]["of"].push_back(p.logarithmic ? "ln " + p.name : p.name);
  for (std::size_t i = 0; i < n; ++i)
    out["covariance"]["matrix"].push_back(
        std::vector<double>(fit.covariance.begin() + static_cast<std::ptrdiff_t>(i * n),
                            fit.covariance.begin() + static_cast<std::ptrdiff_t>((i + 1) * n)));
  out["criterion"] = to_string(fit.options.criterion);
  out["candidates"] = Json::array();
  for (std::size_t i = 0; i < fit.candidates.size(); ++i) {
    const FitCandidate& c = fit.candidates[i];
    out["candidates"].push_back({{"units", c.units},
                                 {"flow", c.flow},
                                 {"parameters", c.parameters},
                                 {"misfit", c.misfit},
                                 {"criterion", c.criterion},
                                 {"determined", c.determined},
                                 {"chosen", i == fit.chosen}});
  }
  out["warnings"] = fit.warnings;
  return out.dump(2) + "\n";
}

std::string fit_csv(const Fit& fit) {
  std::string out =
      "frequency_hz,temperature_c,log10_a_T,reduced_frequency_hz,e_star_pa,phase_deg,fitted_e_star_pa,fitted_phase_deg,"
      "e_star_error,phase_error_deg\n";
  for (const FittedPoint& p : fit.points) {
    const ModulusPoint& m = p.measured;
    out += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", m.frequency_hz,
                       fit.temperatures ? fmt::format("{}", m.temperature_c) : "", p.log10_a_T,
                       m.frequency_hz * std::pow(10.0, p.log10_a_T), m.e_star_pa, m.phase_deg, p.e_star_pa, p.phase_deg,
                       p.e_star_pa / m.e_star_pa - 1, p.phase_deg - m.phase_deg);
  }
  return out;
}

std::string curve_csv(const Fit& fit) {
  std::string out =
      "reduced_frequency_hz,e_star_pa,e_star_low_pa,e_star_high_pa,phase_deg,phase_low_deg,phase_high_deg\n";
  for (const BandPoint& b : confidence_bands(fit, curve_frequencies(fit)))
    out += fmt::format("{},{},{},{},{},{},{}\n", b.frequency_hz, b.e_star_pa, b.e_star_low, b.e_star_high, b.phase_deg,
                       b.phase_low, b.phase_high);
  return out;
}

std::string unused_columns_text(const ModulusData& data) {
  if (data.unused.empty()) return "";
  return fmt::format("columns of {} that are not used: {}\n", data.source, fmt::join(data.unused, ", "));
}

std::string fit_text(const Fit& fit) {
  std::string out;
  if (!fit.candidates.empty()) {
    out += fmt::format("{:>5} {:>7} {:>10} {:>12} {:>12}\n", "units", "dashpot", "parameters", "misfit",
                       to_string(fit.options.criterion));
    for (std::size_t i = 0; i < fit.candidates.size(); ++i) {
      const FitCandidate& c = fit.candidates[i];
      out += fmt::format("{:>5} {:>7} {:>10} {:>12.5g} {:>12.5g}{}\n", c.units, c.flow ? "yes" : "no", c.parameters,
                         c.misfit, c.criterion,
                         i == fit.chosen ? "  taken"
                         : c.determined  ? ""
                                         : "  (a parameter at its bounds)");
    }
    out += "\n";
  }
  out += fmt::format("{:<20} {:>14} {:>14}\n", "parameter", "value", "std. deviation");
  for (const FitParameter& p : fit.parameters)
    out += fmt::format("{:<20} {:>14.6g} {:>14.2g} {}\n", p.name, p.value, p.deviation, p.unit);
  const FitErrors& e = fit.errors;
  out += fmt::format(
      "\n|E*|: rms {:.3g} %, largest {:.3g} %; phase: rms {:.3g}, largest {:.3g} degrees ({} measurements)\n",
      100 * e.e_star_rms, 100 * e.e_star_largest, e.phase_rms_deg, e.phase_largest_deg, fit.points.size());
  return out;
}

namespace {

/// Returns a sentence about the chain that replaces a fitted model.
std::string conversion_text(const KelvinConversion& conversion, std::pair<double, double> range_hz) {
  return fmt::format(
      "Kelvin chain of {} units that replaces the model from {:.4g} to {:.4g} Hz: largest error {:.2g} % of |E*|\n",
      conversion.law.units(), range_hz.first, range_hz.second, 100 * conversion.largest_error);
}

/// Returns the frequency range of the chain that replaces a fitted model [Hz]: the given limits or, without them, the
/// range of the data. \throws InputError when there is neither.
std::pair<double, double> chain_range(std::optional<double> from, std::optional<double> to,
                                      std::optional<std::pair<double, double>> data) {
  if (!data && !(from && to)) {
    throw InputError("command line", 0, "range of the Kelvin chain", "not both --from and --to",
                     "both, because a model without data has no frequency range");
  }
  return {from.value_or(data ? data->first : 0), to.value_or(data ? data->second : 0)};
}

}  // namespace

FitReport report_of(const Fit& fit, std::optional<double> from, std::optional<double> to, double error) {
  FitReport out;
  out.text = fit_text(fit);
  const auto range = chain_range(from, to, fit.reduced_range());
  const auto* law = std::get_if<laws::GeneralisedKelvin>(&fit.model);
  std::optional<KelvinConversion> conversion;
  if (!law) {
    try {
      conversion = to_kelvin(std::get<AnalogueModel>(fit.model), range.first, range.second, error);
      law = &conversion->law;
      out.text += conversion_text(*conversion, range);
    } catch (const InputError& refused) { out.refusal = refused.what(); }
  }
  out.files = {{"fit.json", fit_json(fit, conversion ? &*conversion : nullptr)},
               {"fit.csv", fit_csv(fit)},
               {"curve.csv", curve_csv(fit)}};
  if (law) {
    const std::string origin =
        fmt::format("macadam fit: |E*| of {} measurements within {:.3g} % (rms), phase {:.3g} degrees",
                    fit.points.size(), 100 * fit.errors.e_star_rms, fit.errors.phase_rms_deg);
    laws::LawRange valid = fit.range();
    if (conversion) valid.lowest_hz = range.first, valid.highest_hz = range.second;
    out.files["law.toml"] = law_toml(*law, fit.shift, valid, origin);
  }
  return out;
}

FitReport report_conversion(const ShiftedAnalogue& model, std::optional<double> from, std::optional<double> to,
                            double error) {
  const auto range = chain_range(from, to, {});
  const KelvinConversion conversion = to_kelvin(model.model, range.first, range.second, error);
  const std::string origin = fmt::format(
      "macadam fit: replaces a {} model from {} to {} Hz, largest error {:.2g} of |E*|",
      std::isfinite(model.model.beta) ? "2S2P1D" : "Huet-Sayegh", range.first, range.second, conversion.largest_error);
  return {{{"law.toml", law_toml(conversion.law, model.shift, {range.first, range.second}, origin)}},
          conversion_text(conversion, range),
          ""};
}

FitReport report_of(const CurveChain& chain, const ModulusData& curve, const laws::Shift& shift) {
  laws::LawRange range{std::numeric_limits<double>::infinity(), 0};
  for (const ModulusPoint& p : curve.points)
    range.lowest_hz = std::min(range.lowest_hz, p.frequency_hz),
    range.highest_hz = std::max(range.highest_hz, p.frequency_hz);
  const std::string text = fmt::format(
      "Kelvin chain of {} units that stands for {} moduli from {:.4g} to {:.4g} Hz: largest difference {:.2g} "
      "% of E*\n",
      chain.law.units(), curve.points.size(), range.lowest_hz, range.highest_hz, 100 * chain.largest_difference);
  const std::string origin = fmt::format("macadam fit: stands for {} moduli, largest difference {:.2g} of E*",
                                         curve.points.size(), chain.largest_difference);
  return {{{"law.toml", law_toml(chain.law, shift, range, origin)}}, text, ""};
}

void write_report(const std::filesystem::path& folder, const FitReport& report) {
  const ResultFolder locked(folder);
  std::error_code error;
  if (!report.files.contains("law.toml")) std::filesystem::remove(folder / "law.toml", error);
  for (const auto& [name, text] : report.files) write_whole(folder / name, text);
}

}  // namespace macadam
