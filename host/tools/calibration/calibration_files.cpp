// SPDX-License-Identifier: GPL-3.0-or-later
// calibration_files.cpp  Runs a calibration, and writes its results to a folder as JSON, CSV and text.
#include "macadam/calibration.hpp"

#include <fmt/format.h>

#include <cmath>
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

Json matrix(const std::vector<double>& values, std::size_t n) {
  Json out = Json::array();
  for (std::size_t i = 0; i < n; ++i) {
    Json row = Json::array();
    for (std::size_t k = 0; k < n; ++k) row.push_back(finite(values[i * n + k]));
    out.push_back(row);
  }
  return out;
}

Json parameter_json(const CalibratedParameter& p, const FreeParameter& asked) {
  Json out{{"name", p.name},   {"unit", p.unit}, {"value", p.value}, {"standard_deviation", finite(p.deviation)},
           {"start", p.start}, {"low", p.low},   {"high", p.high},   {"at_bound", p.at_bound}};
  if (asked.prior) out["prior"] = {{"value", *asked.prior}, {"deviation_of_logarithm", asked.prior_deviation}};
  return out;
}

Json residual_json(const CalibratedPoint& p, const Calibration& c) {
  const bool scatter = c.seeds.size() > 1;
  Json out{{"frequency_hz", p.measured.frequency_hz}};
  if (p.temperature_c) out["temperature_c"] = *p.temperature_c;
  if (c.moduli) out["e_star_pa"] = p.measured.e_star_pa;
  if (c.phases) out["phase_deg"] = p.measured.phase_deg;
  out["predicted_e_star_pa"] = p.e_star_pa;
  out["predicted_phase_deg"] = p.phase_deg;
  if (c.moduli) out["e_star_error"] = p.e_star_pa / p.measured.e_star_pa - 1;
  if (c.phases) out["phase_error_deg"] = p.phase_deg - p.measured.phase_deg;
  if (scatter) out["scatter"] = {{"e_star", p.e_star_scatter}, {"phase_deg", p.phase_scatter_deg}};
  return out;
}

/// Returns all data of a calibration.
std::string calibration_json(const Calibration& c) {
  Json out;
  out["macadam"] = version();
  out["solver"] = c.solver;
  out["seeds"] = c.seeds;
  out["misfit"] = {
      {"of", to_string(c.options.misfit)}, {"value", c.misfit}, {"degrees_of_freedom", c.degrees_of_freedom}};
  out["deviations"] = c.deviations ? "of the data" : "assumed, or from the misfit where that is larger";
  const std::size_t n = c.parameters.size();
  out["parameters"] = Json::array();
  for (std::size_t i = 0; i < n; ++i) out["parameters"].push_back(parameter_json(c.parameters[i], c.options.free[i]));
  out["correlation"] = matrix(c.correlation, n);
  out["covariance_of_logarithms"] = matrix(c.covariance, n);
  out["combinations"] = Json::array();
  for (const Combination& combination : c.combinations) {
    Json exponents;
    for (std::size_t i = 0; i < n; ++i) exponents[c.parameters[i].name] = combination.exponents[i];
    out["combinations"].push_back(
        {{"exponents", exponents}, {"deviation_of_logarithm", finite(combination.deviation)}});
  }
  out["errors"] = {{"e_star_rms", finite(c.errors.e_star_rms)},
                   {"e_star_largest", finite(c.errors.e_star_largest)},
                   {"phase_rms_deg", finite(c.errors.phase_rms_deg)},
                   {"phase_largest_deg", finite(c.errors.phase_largest_deg)}};
  out["residuals"] = Json::array();
  for (const CalibratedPoint& p : c.points) out["residuals"].push_back(residual_json(p, c));
  out["solutions"] = c.solutions;
  out["timing_s"] = {{"preparing", c.seconds_preparing}, {"solving", c.seconds_solving}};
  out["warnings"] = c.warnings;
  return out.dump(2) + "\n";
}

/// Returns one line per measurement: measured, predicted, difference.
std::string predicted_csv(const Calibration& c) {
  std::string out =
      "frequency_hz,temperature_c,e_star_pa,phase_deg,predicted_e_star_pa,predicted_phase_deg,e_star_error,"
      "phase_error_deg,e_star_scatter,phase_scatter_deg\n";
  for (const CalibratedPoint& p : c.points) {
    const ModulusPoint& m = p.measured;
    const auto cell = [](bool measured, double value) { return measured ? fmt::format("{}", value) : ""; };
    out += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", m.frequency_hz,
                       cell(p.temperature_c.has_value(), p.temperature_c.value_or(0)), cell(c.moduli, m.e_star_pa),
                       cell(c.phases, m.phase_deg), p.e_star_pa, p.phase_deg,
                       cell(c.moduli, p.e_star_pa / m.e_star_pa - 1), cell(c.phases, p.phase_deg - m.phase_deg),
                       p.e_star_scatter, p.phase_scatter_deg);
  }
  return out;
}

}  // namespace

std::string calibration_text(const Calibration& c) {
  std::string out = fmt::format("{:<16} {:>13} {:>13} {:>14}\n", "parameter", "scene", "calibrated", "within (95 %)");
  for (const CalibratedParameter& p : c.parameters) {
    // A confidence limit is the value times or divided by a factor, because the logarithm of the value has a normal
    // distribution. Factors below 1.5 are written as a percentage.
    const double factor = std::exp(1.96 * p.deviation / p.value);
    const std::string within = p.at_bound                    ? "at its bound"
                               : !std::isfinite(p.deviation) ? "unknown"
                               : factor < 1.5                ? fmt::format("+-{:.2g} %", 196 * p.deviation / p.value)
                                                             : fmt::format("*/ {:.2g}", factor);
    out += fmt::format("{:<16} {:>13.6g} {:>13.6g} {:>14} {}\n", p.name, p.start, p.value, within, p.unit);
  }
  const bool warm = !c.points.empty() && c.points.front().temperature_c;
  out += fmt::format("\n{}{:>10} {:>12} {:>12} {:>8} {:>9} {:>9} {:>8}\n", warm ? "   T (C) " : "", "f (Hz)",
                     "|E*| (GPa)", "predicted", "error", "phi (deg)", "predicted", "error");
  for (const CalibratedPoint& p : c.points) {
    if (warm) out += fmt::format("{:>8g} ", p.temperature_c.value_or(0));
    const auto cell = [](bool measured, const std::string& text) { return measured ? text : "-"; };
    out += fmt::format("{:>10.5g} {:>12} {:>12.6g} {:>8} {:>9} {:>9.4g} {:>8}\n", p.measured.frequency_hz,
                       cell(c.moduli, fmt::format("{:.6g}", p.measured.e_star_pa / 1e9)), p.e_star_pa / 1e9,
                       cell(c.moduli, fmt::format("{:+.2f}%", 100 * (p.e_star_pa / p.measured.e_star_pa - 1))),
                       cell(c.phases, fmt::format("{:.4g}", p.measured.phase_deg)), p.phase_deg,
                       cell(c.phases, fmt::format("{:+.2f}", p.phase_deg - p.measured.phase_deg)));
  }
  const std::string moduli =
      fmt::format("|E*|: rms {:.3g} %, largest {:.3g} %", 100 * c.errors.e_star_rms, 100 * c.errors.e_star_largest);
  const std::string phases =
      fmt::format("phase: rms {:.3g}, largest {:.3g} degrees", c.errors.phase_rms_deg, c.errors.phase_largest_deg);
  out += fmt::format("{}{}{}\n{}: {} solutions, preparing {:.1f} s, solving {:.1f} s\n", c.moduli ? moduli : "",
                     c.moduli && c.phases ? "; " : "", c.phases ? phases : "", c.solver, c.solutions,
                     c.seconds_preparing, c.seconds_solving);
  return out;
}

namespace {

/// Checks the output folder. \throws InputError if a scene.toml in the folder would be overwritten although it was not
/// written by a calibration.
void require_calibration_folder(const Scene& scene, const std::filesystem::path& out) {
  if (scene.text.empty()) {
    throw InputError("calibrated scene", 0, "scene", "a scene that was not read from a file",
                     "a scene file, because scene.toml is the text of this file with the calibrated values");
  }
  std::error_code error;
  if (std::filesystem::equivalent(scene.file, out / "scene.toml", error)) {
    throw InputError("command line", 0, "--out", "the folder of the scene, whose scene.toml would be replaced",
                     "another folder");
  }
  if (std::filesystem::exists(out / "scene.toml", error) && !std::filesystem::exists(out / "calibration.json", error)) {
    throw InputError("command line", 0, "--out", "a folder with a scene.toml that no calibration wrote",
                     "another folder, because this scene.toml would be replaced");
  }
}

/// Writes the calibrated scene and reads it again. \throws RunError, and removes the file, if it does not give the
/// calibrated values.
void write_scene(const Scene& scene, const Calibration& calibration, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "scene.toml";
  write_whole(file, calibrated_scene(scene, calibration, folder));
  try {
    require_calibrated(read_scene(file), calibration);
  } catch (const Error& error) {
    std::filesystem::remove(file);
    throw RunError(
        fmt::format("{}: the calibrated values cannot be written into the text of the scene ({}); the values are in {}",
                    file.string(), error.what(), (folder / "calibration.json").string()));
  }
}

/// Writes the files of a calibration. \throws InputError if the scene was not read from a file; RunError if a file
/// cannot be written, or if the scene.toml does not give the calibrated values when it is read.
void write_calibration(const std::filesystem::path& out, const Scene& scene, const Calibration& calibration) {
  std::error_code error;
  std::filesystem::remove(out / "calibration.png", error);  // from an older calibration
  write_whole(out / "calibration.json", calibration_json(calibration));
  write_whole(out / "predicted.csv", predicted_csv(calibration));
  write_scene(scene, calibration, out);
}

}  // namespace

Calibration calibrate_into(const std::filesystem::path& out, const Scene& scene, const ModulusData& data,
                           const CalibrationOptions& options, const Watcher& watcher) {
  require_calibration_folder(scene, out);
  const ResultFolder locked(out);
  Calibration calibration = calibrate(scene, data, options, watcher);
  write_calibration(out, scene, calibration);
  return calibration;
}

}  // namespace macadam
