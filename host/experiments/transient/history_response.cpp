// SPDX-License-Identifier: GPL-3.0-or-later
// history_response.cpp  Integrates the waves of a strain rate, alone and times a decaying exponential.
#include "host/experiments/transient/history_response.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

namespace macadam {
namespace {

using Complex = std::complex<double>;
using drives::RatePiece;

/// Returns e^z − 1 without cancellation for small z.
Complex expm1(Complex z) {
  const double half = std::sin(0.5 * z.imag());
  return {std::expm1(z.real()) * std::cos(z.imag()) - 2 * half * half, std::exp(z.real()) * std::sin(z.imag())};
}

/// Returns ∫ e^(−decay·(h − u))·rate(u) du over the first h seconds of a piece. For a wave A·e^(iωu) and z = decay + iω
/// this is A·(e^(iωh) − e^(−decay·h))/z = −A·e^(iωh)·(e^(−z·h) − 1)/z.
double integral(const RatePiece& piece, double h, double decay) {
  double out = 0;
  for (const drives::RateWave& wave : piece.waves) {
    const Complex z(decay, wave.omega);
    const Complex one = z == 0.0 ? Complex(h) : -std::polar(1.0, wave.omega * h) * expm1(-z * h) / z;
    out += (wave.amplitude * one).real();
  }
  return out;
}

/// Returns the rate u seconds after the beginning of a piece.
double rate_at(const RatePiece& piece, double u) {
  double out = 0;
  for (const drives::RateWave& wave : piece.waves) out += (wave.amplitude * std::polar(1.0, wave.omega * u)).real();
  return out;
}

bool same(const PronySeries& a, const PronySeries& b) {
  return a.long_term == b.long_term &&
         std::equal(a.units.begin(), a.units.end(), b.units.begin(), b.units.end(),
                    [](const auto& x, const auto& y) { return x.modulus == y.modulus && x.time == y.time; });
}

}  // namespace

HistoryResponse::HistoryResponse(std::vector<RatePiece> pieces) : pieces_(std::move(pieces)) {
  double sum = 0;
  for (const RatePiece& piece : pieces_) {
    strain_.push_back(sum);
    sum += integral(piece, piece.end - piece.begin, 0);
  }
}

std::size_t HistoryResponse::piece_at(double time) const {
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), time,
                                      [](double t, const RatePiece& piece) { return t < piece.begin; });
  return after == pieces_.begin() ? 0 : static_cast<std::size_t>(after - pieces_.begin()) - 1;
}

double HistoryResponse::strain(double time) const {
  const std::size_t k = piece_at(time);
  return strain_[k] + integral(pieces_[k], std::min(time, pieces_[k].end) - pieces_[k].begin, 0);
}

void HistoryResponse::prepare(const PronySeries& relaxation) {
  if (!memory_.empty() && same(series_, relaxation)) return;
  series_ = relaxation;
  const std::size_t units = relaxation.units.size();
  memory_.assign(pieces_.size() * units, 0);
  for (std::size_t k = 1; k < pieces_.size(); ++k) {
    const double h = pieces_[k - 1].end - pieces_[k - 1].begin;
    for (std::size_t u = 0; u < units; ++u) {
      const double decay = 1 / relaxation.units[u].time;
      memory_[k * units + u] = std::exp(-decay * h) * memory_[(k - 1) * units + u] + integral(pieces_[k - 1], h, decay);
    }
  }
}

double HistoryResponse::stress(const PronySeries& relaxation, double time) {
  prepare(relaxation);
  const std::size_t k = piece_at(time), units = relaxation.units.size();
  const double h = std::min(time, pieces_[k].end) - pieces_[k].begin, since = std::max(0.0, time - pieces_[k].end);
  double out = relaxation.long_term * strain(time);
  for (std::size_t u = 0; u < units; ++u) {
    const double decay = 1 / relaxation.units[u].time;
    const double held = std::exp(-decay * h) * memory_[k * units + u] + integral(pieces_[k], h, decay);
    out += relaxation.units[u].modulus * std::exp(-decay * since) * held;
  }
  return out;
}

std::vector<double> HistoryResponse::jumps() const {
  double largest = 0;
  for (const RatePiece& piece : pieces_) {
    double sum = 0;
    for (const drives::RateWave& wave : piece.waves) sum += std::abs(wave.amplitude);
    largest = std::max(largest, sum);
  }
  std::vector<double> out{0};
  for (std::size_t k = 1; k < pieces_.size(); ++k) {
    const RatePiece& before = pieces_[k - 1];
    constexpr double rounding = 1e-9;
    if (std::abs(rate_at(pieces_[k], 0) - rate_at(before, before.end - before.begin)) > rounding * largest)
      out.push_back(pieces_[k].begin);
  }
  return out;
}

}  // namespace macadam
