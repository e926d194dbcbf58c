// SPDX-License-Identifier: GPL-3.0-or-later
/// \file grains.hpp  Which fragments of the watershed are one grain.
#pragma once

#include "host/ct/fragments.hpp"

namespace macadam::ct {

/// A part of a scan, and what is asked of two that touch.
struct Piece {
  double volume = 0;        ///< [m³]
  double radius = 0;        ///< of the largest inscribed sphere [m]
  std::vector<Vec3d> hull;  ///< corners of the convex hull [m]
  double hull_volume = 0;   ///< [m³]
};

/// Above 0 where a face rather parts two grains, below where it lies within one; from −1 to 1.
double margin_of(double neck, double solidity, double valley);

/// Which fragments are one grain: of each the grain's number, from 1 (0 for fragment 0), and the faces with what was
/// decided. Pairs are joined from the surest down, and seen anew as what they have become.
struct Decision {
  std::vector<std::uint32_t> grain;  ///< by fragment
  std::vector<GrainCut> cuts;
};
Decision decide(const Fragments& fragments);

/// The same from decisions that were made before and maybe changed by a person. \throws InputError naming the pair
/// where they are those of another scan, or contradict each other.
Decision decide(const Fragments& fragments, const std::vector<GrainCut>& cuts);

/// How sure the cuts of each grain are, by the numbers of `decision`, of the grains that `number` keeps (0: dropped):
/// the least of (1 + |margin|)/2 of its faces, which is what the margin's logistic curve says of being right. A cut
/// that contradicts its margin is a person's, and sure.
std::vector<double> certainty(const Decision& decision, const std::vector<std::uint32_t>& number);

}  // namespace macadam::ct
