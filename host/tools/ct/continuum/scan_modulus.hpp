// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scan_modulus.hpp  Computes |E*|, phase angle and Poisson's ratio of a segmented scan, without separating its
/// grains.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/tools/ct/continuum/extrapolation.hpp"
#include "host/tools/ct/continuum/modulus_scene.hpp"
#include "host/tools/ct/continuum/scan.hpp"

namespace macadam::continuum {

/// The checked input of solve_modulus(), and the voxel sizes that it will use.
struct ModulusPlan {
  std::string file;           ///< the image of the phases
  Scan scan;                  ///< its height is a multiple of the largest block
  std::vector<int> blocks;    ///< edges of the elements in voxels of the scan, from the largest to the smallest
  double bytes = 0;           ///< memory that the smallest elements need [bytes]
  double removed_height = 0;  ///< of the layers at the top that fill no largest block [m]
  double rock = 0, mastic = 0, voids = 0;  ///< volume fractions of the specimen
  double loose = 0;  ///< fraction of the material in pieces that do not connect both platens, and carry no load
  std::vector<std::string> warnings;

  double edge(std::size_t size) const { return blocks[size] * scan.edge; }  ///< of the elements [m]
};

/// Reads phases.mha in a folder of `macadam ct segment`, and chooses three sizes of the elements. The edge of the
/// smallest elements is `voxel` [m] or, if `voxel` is 0, the smallest multiple of the scan's voxels for which `memory`
/// [bytes] suffices. The other two edges are two and four times as long.
/// \throws InputError naming the file if the file does not exist, if it has labels in place of phases or voxels that
/// are not cubes, if fewer than four of the largest elements fit along an axis, if the memory is too small, or if no
/// material connects the bottom and the top.
ModulusPlan plan_modulus(const std::filesystem::path& folder, double memory, double voxel = 0);

/// One solution: a point, an edge of the elements and a mixing rule.
struct ModulusSolution {
  std::size_t point = 0;  ///< index in ScanPhases::points
  double voxel = 0;       ///< edge of the elements [m]
  Mixing mixing = Mixing::stiff;
  Complex modulus, poisson;  ///< [Pa]; lateral over axial strain
  int iterations = 0;
  double seconds = 0;
};

/// The result of a point.
struct PointModulus {
  Limit limit;       ///< modulus and uncertainty [Pa], phase uncertainty [rad]
  int sizes = 0;     ///< number of sizes of elements in `limit`: 0 (no result yet), 2 or 3
  double voxel = 0;  ///< smallest edge of the elements in `limit` [m]
};

/// Functions that solve_modulus() calls; each may be empty.
struct ModulusWatcher {
  std::function<void(const std::string& stage, double fraction)> progress;
  std::function<bool()> stop;                          ///< whether to end with InterruptedError
  std::function<void(double seconds)> expected;        ///< remaining time, called after the largest elements
  std::function<void(const ModulusSolution&)> solved;  ///< after each solution
  std::function<void(const std::vector<PointModulus>&)> improved;  ///< after each new PointModulus::limit
};

/// Solves all points with all sizes of elements, from the largest to the smallest, and extrapolates to small elements.
/// Results do not depend on the number of threads. \throws RunError if a solution does not converge or is not a number,
/// InterruptedError if `stop` asks for it.
std::vector<PointModulus> solve_modulus(const ModulusPlan& plan, const ScanPhases& phases,
                                        const ModulusWatcher& watcher = {});

}  // namespace macadam::continuum
