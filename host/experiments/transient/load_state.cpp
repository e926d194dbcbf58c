// SPDX-License-Identifier: GPL-3.0-or-later
// load_state.cpp  Stores the state of a stepped test of a load in a checkpoint. The plan and the wall times are stored
// as text. The points of the result, the broken contact points and the relaxation of the specimen, which was solved
// without time steps, are stored as arrays.
#include "host/experiments/transient/load_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "host/run/checkpoints.hpp"
#include "host/run/cracks.hpp"
#include "macadam/error.hpp"

namespace macadam {

using experiments::SteppedPoint;

// A number in JSON is written with the fewest digits from which the same double is read again. JSON has no infinity and
// no NaN, but all of these numbers are finite.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CriticalStep, dt, particle)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LoadPlan, form, geometry, precision, critical, density_scaling, damping_kind,
                                   damping, ramp, platen_mass, dt, decisions)
namespace experiments {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Peak, time_s, strain, stress_pa)
}
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LoadState, plan, peak, checksum, seconds_planning, seconds, warnings)

namespace {

constexpr const char *plan_text = "plan", *points_array = "points", *cracks_array = "cracks",
                     *unstepped_array = "unstepped", *ledger_array = "energies", *stresses_array = "stresses";
constexpr std::size_t point_words = 22 + pair_types;

/// Returns the numbers of a relaxation in one list: its error, the long-term modulus, then modulus and time of each
/// unit.
std::vector<double> to_numbers(const UnsteppedAnswer& answer) {
  std::vector<double> out{answer.error, answer.relaxation.long_term};
  for (const auto& u : answer.relaxation.units) out.insert(out.end(), {u.modulus, u.time});
  return out;
}

UnsteppedAnswer from_numbers(const std::vector<double>& numbers) {
  UnsteppedAnswer out{{numbers[1], {}}, numbers[0]};
  for (std::size_t i = 2; i + 1 < numbers.size(); i += 2) out.relaxation.units.push_back({numbers[i], numbers[i + 1]});
  return out;
}

}  // namespace

LoadState to_load_state(Checkpoint checkpoint, const std::filesystem::path& file) {
  const auto damaged = [&](const std::string& what) {
    throw InputError(file.string(), 0, "checkpoint", what, "data as this version of Macadam writes them");
  };
  LoadState out;
  try {
    out = nlohmann::json::parse(checkpoint.texts[plan_text]).get<LoadState>();
  } catch (const nlohmann::json::exception& error) { damaged(error.what()); }
  out.state = take_state(checkpoint);
  for (const StateArray& array : checkpoint.arrays) {
    const auto* values = std::get_if<std::vector<double>>(&array.values);
    if (array.name == unstepped_array) {
      if (!values || values->size() < 2 || values->size() % 2 != 0) damaged("array " + array.name + " of another kind");
      out.unstepped = from_numbers(*values);
    }
    if (array.name == cracks_array) {
      if (!values) damaged("array " + array.name + " of another kind");
      try {
        out.cracks = to_cracks(*values);
      } catch (const InputError& error) { damaged(error.what()); }
    }
    if (array.name == ledger_array) {
      if (!values) damaged("array " + array.name + " of another kind");
      try {
        out.ledger = LedgerState::from(*values);
      } catch (const InputError& error) { damaged(error.what()); }
    }
    if (array.name == stresses_array) {
      if (!values || values->size() % 2 != 0) damaged("array " + array.name + " of another kind");
      for (std::size_t i = 0; i < values->size(); i += 2) out.stresses.push_back({(*values)[i], (*values)[i + 1]});
    }
    if (array.name != points_array) continue;
    if (!values || values->size() % point_words != 0) damaged("array " + array.name + " of another kind");
    for (std::size_t i = 0; i < values->size(); i += point_words) {
      const double* w = &(*values)[i];
      for (const double count : {w[8], w[9]}) {
        if (!(count >= 0 && count <= std::numeric_limits<std::uint32_t>::max()))
          damaged(fmt::format("{} in array {}", count, array.name));
      }
      out.points.push_back({{w[0], w[1], w[2], w[3]},
                            w[4],
                            w[5],
                            w[6],
                            w[7],
                            static_cast<std::int64_t>(w[8]),
                            {static_cast<std::int64_t>(w[9]), w[10], w[11], {}},
                            {w[12], w[13], w[14], w[15], w[16], w[17], w[18], w[19]},
                            w[20],
                            w[21]});
      std::copy_n(w + 22, pair_types, out.points.back().cracks.cracked_area_m2.begin());
    }
  }
  if (out.state.empty()) damaged("no state");
  return out;
}

void add_to(Checkpoint& out, const LoadState& at) {
  out.texts[plan_text] = nlohmann::json(at).dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
  std::vector<double> points;
  for (const SteppedPoint& p : at.points) {
    points.insert(points.end(), {p.time_s,
                                 p.strain,
                                 p.stress_pa,
                                 p.ratio,
                                 p.top_pa,
                                 p.bottom_pa,
                                 p.kinetic_j,
                                 p.error,
                                 static_cast<double>(p.broken_points),
                                 static_cast<double>(p.cracks.cracked),
                                 p.cracks.crack_energy_j,
                                 p.cracks.friction_energy_j,
                                 p.energies.work_j,
                                 p.energies.elastic_j,
                                 p.energies.viscous_j,
                                 p.energies.crack_j,
                                 p.energies.friction_j,
                                 p.energies.kinetic_j,
                                 p.energies.damping_j,
                                 p.energies.thermal_j,
                                 p.temperature_c,
                                 p.poisson_ratio});
    points.insert(points.end(), p.cracks.cracked_area_m2.begin(), p.cracks.cracked_area_m2.end());
  }
  out.arrays.push_back({points_array,
                        "s, 1, Pa, by kind, Pa, Pa, J, 1, 1, 1, then 10 energies J, degrees C, 1, 6 areas m2",
                        std::move(points)});
  out.arrays.push_back({ledger_array, "J, J, s, J, then m, N, and chains", at.ledger.numbers()});
  if (!at.stresses.empty()) {
    std::vector<double> stresses;
    for (const StressSample& s : at.stresses) stresses.insert(stresses.end(), {s.strain, s.stress_pa});
    out.arrays.push_back({stresses_array, "1, Pa", std::move(stresses)});
  }
  out.arrays.push_back({cracks_array, "1, 1, 1, s, m, m", to_numbers(at.cracks)});
  if (at.unstepped) out.arrays.push_back({unstepped_array, "1, Pa, then Pa, s", to_numbers(*at.unstepped)});
}

}  // namespace macadam
