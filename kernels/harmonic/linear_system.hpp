// SPDX-License-Identifier: GPL-3.0-or-later
/// \file linear_system.hpp  Stores the matrix K*(s) + s²·M of a contact network in the frequency domain, and its real
/// preconditioner, as arrays in the order of a layout.
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "kernels/base/aligned.hpp"
#include "kernels/harmonic/box_motion.hpp"
#include "kernels/harmonic/contact_end.hpp"
#include "macadam/backend.hpp"
#include "macadam/contact_network.hpp"

namespace macadam::kernels {

/// Largest number of free motions that the iteration can remove from a solution. A free motion is a motion of the whole
/// specimen that no wall resists; two separate specimens side by side in one box have some.
inline constexpr int most_free_motions = 6;

/// For each pair type: real stiffness k (times area over distance, it is the stiffness of a contact), and the factor α
/// of the shear stiffness.
struct RealStiffness {
  std::array<double, pair_types> k{}, alpha{};
};

/// A linear system and its preconditioner z = (Σ_i K_ii⁻¹ + R·(RᵀKR)⁻¹·Rᵀ)·r, where K is computed from the stiffnesses
/// in `typical`, and the columns of R are the six rigid motions of each box (a group of neighbouring particles).
struct LinearSystem {
  std::vector<std::int32_t> particle;  ///< body → particle of the specimen
  std::vector<std::size_t> row_begin;  ///< body → first of its ends; bodies + 1 entries
  RawVector<ContactEnd> ends;
  std::vector<double> series;  ///< [end] Contact::series [1/Pa]; empty if it is zero everywhere
  std::vector<double> mass;    ///< [body][2]: mass [kg], moment of inertia [kg·m²]
  /// [body] Resistance of cells to changes of volume (rule "volumetric"); empty without it. Only the solver on the CPU
  /// takes it into account, and the preconditioner does not contain it.
  std::vector<CellStiffness> cells;
  RealStiffness typical;
  std::vector<Lever> lever;            ///< [body]
  std::vector<std::int32_t> box_body;  ///< box → first body; boxes + 1 entries
  std::vector<double> coarse;  ///< (RᵀKR)⁻¹ [6·boxes][6·boxes]; free motions of the whole specimen are left out
  int free = 0;                ///< number of motions of the whole specimen that no wall resists
  std::vector<double> motion;  ///< [body][free][6], orthonormal with respect to M
  std::vector<std::uint8_t> own_motions;  ///< [body] number of the free motions that move this body alone
  std::vector<double> weight;             ///< [free][6·boxes]: Rᵀ·M·motion

  double series_of(std::size_t end) const { return series.empty() ? 0 : series[end]; }
  std::size_t bodies() const { return row_begin.size() - 1; }
  std::size_t boxes() const { return box_body.size() - 1; }
};

/// Force and moment on a body.
struct BodyLoad {
  std::int64_t body;
  std::complex<double> load[6];
};

/// One right-hand side to be solved, with the stiffness of its frequency.
struct LinearLoad {
  std::vector<BodyLoad> right;  ///< f: each body at most once; zero on all others
  /// Initial solution, [6·particles] in the order of the specimen; nullptr: zero.
  const std::complex<double>* start = nullptr;
  std::array<std::complex<double>, pair_types> k{};
  std::array<double, pair_types> alpha{};
  std::complex<double> inertia = 0;  ///< inertia·M is subtracted from K
  double scale = 1;                  ///< ‖f‖
  double tolerance = 0;              ///< largest accepted ‖r‖ / ‖f‖
  double energy_limit = 0;           ///< largest accepted rᴴ·P⁻¹·r
};

/// Result of the iteration for one load.
struct LinearState {
  double residual = 0;  ///< ‖r‖ / ‖f‖, with r updated by recurrence
  double energy = 0;    ///< rᴴ·P⁻¹·r, with r = f − K·x computed from x
  int iterations = 0;
  bool converged = false;
};

/// Largest number of iterations.
inline constexpr int most_iterations = 5000;
/// The iteration is given up if the residual has not fallen by 10 % within this number of iterations.
inline constexpr int most_stagnant = 500;

/// Largest number of loads solved side by side.
inline constexpr int most_loads = 4;

/// Solves linear systems on CUDA devices by conjugate gradients for complex symmetric matrices, for several loads
/// (right-hand sides) side by side. All vectors stay on the devices. Devices of the same kind give the same bits in
/// every run, however many of them share the work.
class DeviceSolver {
 public:
  virtual ~DeviceSolver() = default;
  /// Solves up to four loads. `look` is called between iterations and may throw.
  virtual std::vector<LinearState> solve(const std::vector<LinearLoad>& loads, const std::function<void()>& look) = 0;
  /// Receives `count` numbers of a solution, from number `first` on.
  using TakePart = std::function<void(std::size_t first, const std::complex<double>* numbers, std::size_t count)>;
  /// Passes the solution of load number `load` of the last solve() to `take`, in parts one after the other:
  /// [6·particles] in the order of the specimen.
  virtual void solution(std::size_t load, const TakePart& take) = 0;
};

/// Makes a solver on devices; see CudaCode::make_solver. Only in builds with CUDA.
std::unique_ptr<DeviceSolver> make_device_solver(const LinearSystem& system, const DeviceList& devices,
                                                 std::int64_t& singular_body);

}  // namespace macadam::kernels
