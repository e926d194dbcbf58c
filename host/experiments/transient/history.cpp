// SPDX-License-Identifier: GPL-3.0-or-later
// history.cpp  Implements kind "history": the stress under a strain that follows any drive.
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "host/experiments/transient/history_response.hpp"
#include "host/experiments/transient/transient_experiment.hpp"

namespace macadam {

using experiments::ResponsePoint;
using experiments::StrainHistory;

namespace {

/// Returns a checksum of the strain rates, so that a run is not resumed with another table.
std::uint32_t checksum(const std::vector<drives::RatePiece>& pieces) {
  std::vector<double> all;
  for (const drives::RatePiece& piece : pieces) {
    all.insert(all.end(), {piece.begin, piece.end});
    for (const drives::RateWave& wave : piece.waves)
      all.insert(all.end(), {wave.amplitude.real(), wave.amplitude.imag(), wave.omega});
  }
  const uLong sum =
      crc32_z(crc32(0, nullptr, 0), reinterpret_cast<const Bytef*>(all.data()), all.size() * sizeof(double));
  return static_cast<std::uint32_t>(sum);
}

}  // namespace

TransientExperiment load_test(const StrainHistory& spec) {
  return std::visit(
      [&](const auto& drive) {
        const double end = spec.duration;
        TransientExperiment out;
        out.kind = spec.kind;
        out.poisson_ratio = spec.poisson_ratio;
        out.temperature = spec.temperature;
        for (int i = 1; i <= spec.samples; ++i) out.history.times.push_back(end * i / spec.samples);
        out.history.ramps = {{0, end}};
        out.history.shortest_change = drive.shortest_time(end);
        out.load = {{"duration_s", end}};
        out.grows = out.reverses = true;
        const drives::StrainRange range = drive.range(end);
        out.strain = std::max(std::abs(range.lowest), std::abs(range.highest));
        const auto pieces = drive.pieces(end);
        out.checksum = checksum(pieces);
        const auto response = std::make_shared<HistoryResponse>(pieces);
        out.jumps = response->jumps();
        out.unstepped = [response](const Spectrum& spectrum, double t, const LoadTimes&) -> ResponsePoint {
          const double strain = response->strain(t), stress = response->stress(spectrum.relaxation, t);
          return {t, strain, stress, strain == 0 ? std::numeric_limits<double>::quiet_NaN() : stress / strain};
        };
        out.step = [drive, end](double largest) { return drive.step(largest, end); };
        out.drive = [drive, end](double unit, double dt, double) { return drive.drive(unit, dt, end); };
        return out;
      },
      spec.drive);
}

template <>
std::unique_ptr<PlannedExperiment> ExperimentOf<StrainHistory>::plan(const StrainHistory& spec, const Scene& scene,
                                                                     const Preparation& prepared,
                                                                     const Watcher& watcher,
                                                                     std::optional<Resumed> resumed,
                                                                     RunResult& result) {
  return plan_load_test(load_test(spec), scene, prepared, watcher, std::move(resumed), result);
}

template <>
std::vector<std::string> ExperimentOf<StrainHistory>::files(const StrainHistory& spec, const Scene& scene) {
  return load_files(spec.kind, scene);
}

}  // namespace macadam
