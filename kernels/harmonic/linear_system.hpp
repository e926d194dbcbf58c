// SPDX-License-Identifier: GPL-3.0-or-later
/// \file linear_system.hpp  K*(s) + s²·M of a network and a real preconditioner of it, as arrays in the order of a
/// layout.
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "kernels/aligned.hpp"
#include "kernels/harmonic/box_motion.hpp"
#include "kernels/harmonic/contact_end.hpp"
#include "macadam/backend.hpp"
#include "macadam/contact_network.hpp"

namespace macadam::kernels {

/// Free motions of the whole that the iteration can keep out: of two specimens side by side in a box.
inline constexpr int most_free_motions = 6;

/// Real stiffness per unit of area over distance, and α, of each pair.
struct RealStiffness {
  std::array<double, pair_types> k{}, alpha{};
};

/// The preconditioner is z = (Σ_i K_ii⁻¹ + R·(RᵀKR)⁻¹·Rᵀ)·r with K of `typical`; R has the six motions of each box.
struct LinearSystem {
  std::vector<std::int32_t> particle;  ///< body → particle of the specimen
  std::vector<std::size_t> row_begin;  ///< body → first of its ends; bodies + 1 entries
  RawVector<ContactEnd> ends;
  std::vector<double> mass;  ///< [body][2]: mass [kg], moment of inertia [kg·m²]
  RealStiffness typical;
  std::vector<Lever> lever;            ///< [body]
  std::vector<std::int32_t> box_body;  ///< box → first body; boxes + 1 entries
  std::vector<double> coarse;  ///< (RᵀKR)⁻¹ [6·boxes][6·boxes], what free motions of the whole have in it left out
  int free = 0;                ///< motions of the whole that no wall resists
  std::vector<double> motion;             ///< [body][free][6], orthonormal with respect to M
  std::vector<std::uint8_t> own_motions;  ///< [body]: how many of them are motions of this body alone
  std::vector<double> weight;             ///< [free][6·boxes]: Rᵀ·M·motion

  std::size_t bodies() const { return row_begin.size() - 1; }
  std::size_t boxes() const { return box_body.size() - 1; }
};

/// Force and moment on a body.
struct BodyLoad {
  std::int64_t body;
  std::complex<double> load[6];
};

/// One system to be solved.
struct LinearLoad {
  std::vector<BodyLoad> right;  ///< f: each body once, nothing on the others
  /// Where to begin, [6·particles] in the order of the specimen; nullptr: at rest.
  const std::complex<double>* start = nullptr;
  std::array<std::complex<double>, pair_types> k{};
  std::array<double, pair_types> alpha{};
  std::complex<double> inertia = 0;  ///< taken off K: inertia·M
  double scale = 1;                  ///< ‖f‖
  double tolerance = 0;              ///< of ‖r‖ / ‖f‖
  double energy_limit = 0;           ///< of rᴴ·P⁻¹·r
};

/// What became of it.
struct LinearState {
  double residual = 0;  ///< ‖r‖ / ‖f‖ by recurrence
  double energy = 0;    ///< rᴴ·P⁻¹·r, of r = f − K·x computed anew
  int iterations = 0;
  bool converged = false;
};

/// Of a system, at the most.
inline constexpr int most_iterations = 5000;
/// Iterations without a tenth of progress after which no solution is expected any more.
inline constexpr int most_stagnant = 500;

/// Loads that are solved side by side.
inline constexpr int most_loads = 4;

/// Conjugate gradients for complex symmetric matrices on CUDA devices: several loads side by side, all of it on the
/// devices. The same kind of device gives the same bits every run, however many share the work.
class DeviceSolver {
 public:
  virtual ~DeviceSolver() = default;
  /// Up to four loads. `look` is called between iterations and may throw.
  virtual std::vector<LinearState> solve(const std::vector<LinearLoad>& loads, const std::function<void()>& look) = 0;
  /// take(first, numbers, count): `count` numbers of a solution, from number `first` on.
  using TakePart = std::function<void(std::size_t first, const std::complex<double>* numbers, std::size_t count)>;
  /// The solution of a load of the last solve(), by its number there: [6·particles] in the order of the specimen, in
  /// parts one after the other.
  virtual void solution(std::size_t load, const TakePart& take) = 0;
};

/// Only in builds with CUDA: as CudaCode::make_solver.
std::unique_ptr<DeviceSolver> make_device_solver(const LinearSystem& system, const DeviceList& devices,
                                                 std::int64_t& loose);

}  // namespace macadam::kernels
