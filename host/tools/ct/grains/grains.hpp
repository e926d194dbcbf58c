// SPDX-License-Identifier: GPL-3.0-or-later
/// \file grains.hpp  Decides which fragments of the watershed form one grain.
#pragma once

#include "host/tools/ct/grains/fragments.hpp"

namespace macadam::ct {

/// Geometry of a fragment or of several joined fragments.
struct Piece {
  double volume = 0;        ///< [m³]
  double radius = 0;        ///< radius of the largest inscribed sphere [m]
  std::vector<Vec3d> hull;  ///< corners of the convex hull [m]
  double hull_volume = 0;   ///< [m³]
};

/// Returns a score from −1 to 1 from the measures of a face (see GrainCut): above 0 the face probably separates two
/// grains, below 0 it probably lies within one.
double margin_of(double neck, double solidity, double valley);

/// The grain of each fragment, and the decision about each face. Grains are numbered from 1.
struct Decision {
  std::vector<std::uint32_t> grain;  ///< by fragment; 0 for fragment 0
  std::vector<GrainCut> cuts;
};
/// Joins the pair of pieces with the lowest margin, measures the faces of the new piece again, and repeats until no
/// margin is below 0.
Decision decide(const Fragments& fragments);

/// Takes the decisions from `cuts`, the table of an earlier segmentation, which a person may have edited. \throws
/// InputError if the decisions belong to another scan or contradict each other; the message names the pair of
/// fragments.
Decision decide(const Fragments& fragments, const std::vector<GrainCut>& cuts);

/// Returns for each grain how certain its cuts are. `number` gives the new number of each grain of `decision` (0:
/// dropped). For one face, (1 + |margin|)/2 is the probability that its decision is right (logistic curve). A grain
/// gets the smallest value of its faces. A decision that contradicts its margin was made by a person and counts as
/// certain.
std::vector<double> certainty(const Decision& decision, const std::vector<std::uint32_t>& number);

}  // namespace macadam::ct
