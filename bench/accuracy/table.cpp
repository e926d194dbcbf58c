// SPDX-License-Identifier: GPL-3.0-or-later
// table.cpp  Writes the CSV of bench/accuracy.
#include <fmt/format.h>

#include "bench/accuracy/case.hpp"
#include "macadam/error.hpp"

namespace macadam::accuracy {
namespace {

std::string optional(const std::optional<double>& value) { return value ? fmt::format("{:g}", *value) : ""; }
double relative(const Stiffness& found, const Stiffness& expected) { return found.e_star_pa / expected.e_star_pa - 1; }

}  // namespace

Table::Table(const std::filesystem::path& file, const std::vector<std::string>& about)
    : file_(std::fopen(file.c_str(), "w")) {
  if (!file_) throw RunError("cannot write " + file.string());
  for (const std::string& line : about) fmt::print(file_, "# {}\n", line);
  fmt::print(file_,
             "study,scene,mix,backend,precision,form,geometry,density_scaling,step_share,damping_kind,damping,start,"
             "ramp_cycles,cycles,fit_cycles,quadrature,gap_max,area_min,strain,tolerance,frequency_hz,contacts,"
             "e_star_pa,phase_deg,error_e_star,error_phase_deg,own_error_e_star,own_error_phase_deg,model_e_star,"
             "model_phase_deg,dt_s,steps,seconds,seconds_harmonic,seconds_by_hand,bytes,status\n");
  std::fflush(file_);
}

Table::~Table() { std::fclose(file_); }

void Table::add(const Case& c, const Outcome& o) {
  fmt::print(file_, "{},{},{},{},{},{},{},{:.6g},{:.4f},{},{:g},{},{:g},{},{},{},{},{},{:g},{},{:g},{},", c.study,
             c.scene, c.mix, to_string(c.backend), to_string(c.precision), to_string(c.form), to_string(c.geometry),
             c.density_scaling, o.step_share, to_string(c.damping_kind), c.damping, to_string(c.start), c.ramp_cycles,
             o.cycles, o.fit_cycles, to_string(c.quadrature), optional(c.gap_max), optional(c.area_min), c.strain,
             optional(c.tolerance), c.frequency, o.contacts);
  if (o.status == "done") {
    fmt::print(file_, "{:.10g},{:.8f},{:.4e},{:.4e},{:.4e},{:.4e},{:.4e},{:.4e},", o.found.e_star_pa, o.found.phase_deg,
               relative(o.found, o.truth), o.found.phase_deg - o.truth.phase_deg, relative(o.found, o.own),
               o.found.phase_deg - o.own.phase_deg, relative(o.truth, o.model), o.truth.phase_deg - o.model.phase_deg);
  } else {
    fmt::print(file_, ",,,,,,,,");
  }
  fmt::print(file_, "{:.6g},{},{:.4g},{:.4g},{:.4g},{},\"{}\"\n", o.dt, o.steps, o.seconds, o.seconds_harmonic,
             o.seconds_by_hand, o.bytes, o.status);
  std::fflush(file_);
}

}  // namespace macadam::accuracy
