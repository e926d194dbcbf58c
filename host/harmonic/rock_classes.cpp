// SPDX-License-Identifier: GPL-3.0-or-later
// rock_classes.cpp  Divides contacts with rock in series between classes, and sums the matrices of the classes.
#include "host/harmonic/rock_classes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "host/harmonic/contact_motions.hpp"
#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam::harmonic {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Compliances whose relative difference is below this number are the same.
constexpr double same = 1e-12;
/// Number of parts in which matrices are summed. So the result does not depend on the number of threads.
constexpr std::size_t contact_pieces = 16;
/// Number of contacts whose products are computed as one matrix product.
constexpr Index stack = 48;

/// Returns w, see the top of rock_classes.hpp: 1/(r + z) is interpolated linearly between r₁ and r₂. z may be infinite.
double fraction_of_low(double r, double low, double high, double z) {
  const double linear = (high - r) / (high - low);
  return std::clamp(std::isfinite(z) ? linear * ((low + z) / (r + z)) : linear, 0.0, 1.0);
}

/// Products of motions and forces of some contacts that are divided between the same two classes.
class Stack {
 public:
  Stack(Index count, Index added)
      : u_(count), added_(added), motion_{MatrixXd(3 * stack, count), MatrixXd(3 * stack, count)} {
    for (auto* force : {&low_, &high_}) force->fill(MatrixXd(3 * stack, added));
  }

  void push(const Contact& c, const MatrixXd& basis, double normal, double shear) {
    u_.set(c, basis);
    put(0, u_.normal, normal_form(c) * u_.normal.rightCols(added_), normal);
    put(1, u_.shear, shear_form(c) * u_.shear.rightCols(added_), shear);
    ++filled_;
  }
  bool full() const { return filled_ == stack; }

  /// Adds the products to the matrices of the classes and empties the stack. `high` is null if the two classes are one.
  void add_to(RockForms& low, RockForms* high) {
    for (const bool shear : {false, true}) {
      const auto motion = motion_[shear].topRows(3 * filled_).transpose();
      (shear ? low.shear : low.normal).noalias() += motion * low_[shear].topRows(3 * filled_);
      if (high) (shear ? high->shear : high->normal).noalias() += motion * high_[shear].topRows(3 * filled_);
    }
    filled_ = 0;
  }

 private:
  void put(std::size_t form, const ContactMotions::Rows& motion, const MatrixXd& force, double low) {
    motion_[form].middleRows<3>(3 * filled_) = motion;
    low_[form].middleRows<3>(3 * filled_) = low * force;
    high_[form].middleRows<3>(3 * filled_) = (1 - low) * force;
  }

  ContactMotions u_;
  Index added_, filled_ = 0;
  std::array<MatrixXd, 2> motion_, low_, high_;  ///< normal, shear
};

}  // namespace

RockClasses::RockClasses(const ContactNetwork& network, const RockClassing& classing) : network_(network) {
  std::array<std::vector<std::uint32_t>, pair_types> of_pair;
  for (std::size_t i = 0; i < network.contacts.size(); ++i) {
    const Contact& c = network.contacts[i];
    if (c.series > 0) of_pair[static_cast<std::size_t>(c.pair)].push_back(static_cast<std::uint32_t>(i));
  }
  for (std::size_t pair = 0; pair < pair_types; ++pair)
    if (!of_pair[pair].empty()) add_pair(pair, of_pair[pair], classing);
}

void RockClasses::add_pair(std::size_t pair, const std::vector<std::uint32_t>& contacts, const RockClassing& classing) {
  if (!classing.laws[pair])
    throw InputError(std::string("reduced model: pair ") + to_string(static_cast<PairType>(pair)) + " has " +
                     std::to_string(contacts.size()) + " contacts with rock in series but no law");
  const auto [stiff, alpha] =
      std::visit([](const auto& law) { return std::pair(law.instantaneous(), law.alpha); }, *classing.laws[pair]);
  // z₀ of the stiffer of the two directions determines the classes of both
  const double stiffest = classing.reserve * stiff, z = 1 / (stiffest * std::max(1.0, alpha)), z_normal = 1 / stiffest,
               z_shear = 1 / (stiffest * alpha);
  const auto series_of = [&](std::uint32_t contact) { return network_.contacts[contact].series; };
  const auto interval_of = [&](double r) { return static_cast<std::int64_t>(std::log1p(r / z) / classing.spacing); };
  const auto border = [&](std::int64_t i) { return z * std::expm1(static_cast<double>(i) * classing.spacing); };
  std::map<std::int64_t, std::vector<std::uint32_t>> intervals;
  for (const std::uint32_t c : contacts) intervals[interval_of(series_of(c))].push_back(c);
  std::map<std::int64_t, std::uint32_t> at_border;  // class of each border that is used
  const auto class_at = [&](std::int64_t i) {
    const auto [entry, added] = at_border.try_emplace(i, static_cast<std::uint32_t>(classes_.size()));
    if (added) classes_.push_back({pair, border(i)});
    return entry->second;
  };
  for (const auto& [i, inside] : intervals) {
    const auto [least, most] = std::minmax_element(
        inside.begin(), inside.end(), [&](std::uint32_t a, std::uint32_t b) { return series_of(a) < series_of(b); });
    if (series_of(*most) - series_of(*least) <= same * series_of(*most)) {
      const auto own = static_cast<std::uint32_t>(classes_.size());
      classes_.push_back({pair, series_of(*most)});
      for (const std::uint32_t c : inside) contacts_.push_back({c, own, own, 1, 1});
      continue;
    }
    const std::uint32_t low = class_at(i), high = class_at(i + 1);
    for (const std::uint32_t c : inside) {
      const auto fraction = [&](double z0) { return fraction_of_low(series_of(c), border(i), border(i + 1), z0); };
      contacts_.push_back({c, low, high, fraction(z_normal), fraction(z_shear)});
    }
    const double t = std::tanh(classing.spacing / 4);
    error_ = t * t;
  }
}

std::vector<RockForms> RockClasses::columns(const MatrixXd& basis, Index from) const {
  const Index count = basis.cols(), added = count - from;
  std::vector<std::map<std::uint32_t, RockForms>> sums(contact_pieces);
  for_each_in_parallel(contact_pieces, [&](std::size_t piece) {
    Stack filling(count, added);
    const auto forms_of = [&](std::uint32_t number) -> RockForms& {
      const auto [entry, fresh] = sums[piece].try_emplace(number);
      if (fresh) entry->second = {MatrixXd::Zero(count, added), MatrixXd::Zero(count, added)};
      return entry->second;
    };
    const std::size_t end = (piece + 1) * contacts_.size() / contact_pieces;
    for (std::size_t i = piece * contacts_.size() / contact_pieces; i < end; ++i) {
      const Divided& d = contacts_[i];
      filling.push(network_.contacts[d.contact], basis, d.normal, d.shear);
      const bool last = i + 1 == end || contacts_[i + 1].low != d.low || contacts_[i + 1].high != d.high;
      if (last || filling.full()) {
        RockForms& low = forms_of(d.low);
        filling.add_to(low, d.high == d.low ? nullptr : &forms_of(d.high));
      }
    }
  });
  std::vector<RockForms> out(classes_.size(), {MatrixXd::Zero(count, added), MatrixXd::Zero(count, added)});
  for (const auto& of_piece : sums)
    for (const auto& [number, forms] : of_piece) out[number].normal += forms.normal, out[number].shear += forms.shear;
  return out;
}

}  // namespace macadam::harmonic
