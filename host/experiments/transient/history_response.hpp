// SPDX-License-Identifier: GPL-3.0-or-later
/// \file history_response.hpp  Computes strain and stress of a linear specimen under a history of the strain in closed
/// form, from its relaxation as a sum of exponentials.
#pragma once

#include <cstddef>
#include <vector>

#include "macadam/drives/spec.hpp"
#include "macadam/spectrum.hpp"

namespace macadam {

/// A strain over time, given by its rate. The stress is the integral of E(t − t′)·ε̇(t′) over t′. Each unit of E adds
/// the convolution of ε̇ with an exponential, which has a closed form for each wave of each piece.
class HistoryResponse {
 public:
  /// `pieces`: at least one piece. The first piece begins at time 0, and every other piece at the end of its
  /// predecessor.
  explicit HistoryResponse(std::vector<drives::RatePiece> pieces);

  /// Returns the strain at a time [s]; after the last piece it is constant.
  double strain(double time) const;

  /// Returns the stress at a time [Pa]. Calls for the same series are fast, because the state at the beginning of each
  /// piece is kept.
  double stress(const PronySeries& relaxation, double time);

  /// Returns the times at which the rate jumps, in rising order; the first is 0.
  std::vector<double> jumps() const;

 private:
  std::size_t piece_at(double time) const;
  void prepare(const PronySeries& relaxation);

  std::vector<drives::RatePiece> pieces_;
  std::vector<double> strain_;  ///< at the beginning of each piece
  PronySeries series_;          ///< for which `memory_` holds
  /// [piece][unit] ∫ e^(−(t − t′)/τ)·ε̇ dt′ at the beginning t of the piece.
  std::vector<double> memory_;
};

}  // namespace macadam
