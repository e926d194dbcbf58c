// SPDX-License-Identifier: GPL-3.0-or-later
// modulus_files.cpp  Formats the results of `macadam ct modulus`.
#include "host/tools/ct/continuum/modulus_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "macadam/version.hpp"

namespace macadam::continuum {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

std::string temperature_of(const ModulusPoint& point) {
  return point.temperature_c ? fmt::format("{}", *point.temperature_c) : "";
}

/// Returns modulus.csv: the points that have a result.
std::string modulus_csv(const ScanPhases& phases, const std::vector<PointModulus>& results) {
  std::string out =
      "temperature_c,frequency_hz,e_star_pa,e_star_uncertainty_pa,phase_deg,phase_uncertainty_deg,poisson_ratio,"
      "poisson_phase_deg,voxel_m,voxel_sizes\n";
  for (std::size_t p = 0; p < results.size(); ++p) {
    const PointModulus& r = results[p];
    if (r.sizes == 0) continue;
    out += fmt::format("{},{},{:.10g},{:.3g},{:.6f},{:.3g},{:.8f},{:.5f},{:g},{}\n", temperature_of(phases.points[p]),
                       phases.points[p].frequency_hz, std::abs(r.limit.modulus), r.limit.uncertainty,
                       std::arg(r.limit.modulus) * degrees, r.limit.phase_uncertainty * degrees,
                       std::abs(r.limit.poisson), std::arg(r.limit.poisson) * degrees, r.voxel, r.sizes);
  }
  return out;
}

nlohmann::ordered_json results_json(const ScanPhases& phases, const std::vector<PointModulus>& results) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (std::size_t p = 0; p < results.size(); ++p) {
    const PointModulus& r = results[p];
    if (r.sizes == 0) continue;
    const ModulusPoint& point = phases.points[p];
    nlohmann::ordered_json row;
    if (point.temperature_c) row["temperature_c"] = *point.temperature_c;
    row["frequency_hz"] = point.frequency_hz;
    row["e_star_pa"] = std::abs(r.limit.modulus);
    row["e_star_uncertainty_pa"] = r.limit.uncertainty;
    row["phase_deg"] = std::arg(r.limit.modulus) * degrees;
    row["phase_uncertainty_deg"] = r.limit.phase_uncertainty * degrees;
    row["poisson_ratio"] = std::abs(r.limit.poisson);
    row["poisson_phase_deg"] = std::arg(r.limit.poisson) * degrees;
    row["mastic_e_star_pa"] = point.mastic.modulus;
    row["mastic_phase_deg"] = point.mastic.phase;
    row["voxel_m"] = r.voxel;
    row["voxel_sizes"] = r.sizes;
    out.push_back(row);
  }
  return out;
}

std::string summary_json(const ModulusPlan& plan, const ScanPhases& phases, const std::string& scene,
                         const std::vector<PointModulus>& results, const std::string& status) {
  const Scan& scan = plan.scan;
  nlohmann::ordered_json edges = nlohmann::ordered_json::array();
  for (std::size_t size = 0; size < plan.blocks.size(); ++size) edges.push_back(plan.edge(size));
  const nlohmann::ordered_json out = {
      {"macadam", version()},
      {"solver", {{"method", "finite elements"}}},
      {"status", status},
      {"scan", plan.file},
      {"scene", scene},
      {"warnings", plan.warnings},
      {"size_m", {scan.size.x * scan.edge, scan.size.y * scan.edge, scan.size.z * scan.edge}},
      {"removed_height_m", plan.removed_height},
      {"scan_voxel_m", scan.edge},
      {"voxels_m", edges},
      {"aggregate", plan.rock},
      {"mastic", plan.mastic},
      {"void", plan.voids},
      {"loose", plan.loose},
      {"aggregate_e_pa", phases.rock.modulus},
      {"aggregate_poisson_ratio", phases.rock.poisson},
      {"mastic_poisson_ratio", phases.points.front().mastic.poisson},
      {"points", phases.points.size()},
      {"results", results_json(phases, results)}};
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

ModulusFiles::ModulusFiles(const std::filesystem::path& folder, const ModulusPlan& plan, const ScanPhases& phases,
                           const std::string& scene)
    : folder_(folder),
      plan_(plan),
      phases_(phases),
      scene_(scene),
      held_(folder),
      voxels_(
          folder / "voxels.csv",
          "temperature_c,frequency_hz,voxel_m,mixing,e_star_pa,phase_deg,poisson_ratio,poisson_phase_deg,iterations,"
          "seconds") {
  write({}, "running");
}

void ModulusFiles::add(const ModulusSolution& s) {
  const ModulusPoint& point = phases_.points[s.point];
  voxels_.add(fmt::format("{},{},{:g},{},{:.10g},{:.6f},{:.8f},{:.5f},{},{:.1f}", temperature_of(point),
                          point.frequency_hz, s.voxel, s.mixing == Mixing::stiff ? "stiff" : "soft",
                          std::abs(s.modulus), std::arg(s.modulus) * degrees, std::abs(s.poisson),
                          std::arg(s.poisson) * degrees, s.iterations, s.seconds));
}

void ModulusFiles::write(const std::vector<PointModulus>& results, const std::string& status) {
  write_whole(folder_ / "modulus.csv", modulus_csv(phases_, results));
  write_whole(folder_ / "summary.json", summary_json(plan_, phases_, scene_, results, status));
}

}  // namespace macadam::continuum
