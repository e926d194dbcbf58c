// SPDX-License-Identifier: GPL-3.0-or-later
/// \file known_aggregates.hpp  Reads the true surfaces of the aggregates of a specimen that is read from a file.
#pragma once

#include <filesystem>
#include <vector>

#include "macadam/specimen.hpp"

namespace macadam {

/// Aggregates with their places, and the surfaces to which Aggregate::surface refers.
struct KnownAggregates {
  std::vector<Aggregate> aggregates;
  std::vector<Surface> surfaces;
};

/// Reads a CSV file with the columns `body,shape,size,x,y,z` in any order and, if a shape is not "sphere",
/// `qw,qx,qy,qz`. Further columns are ignored, except `volume`. Lengths are in metres; `size` is D^I, or the diameter
/// of a sphere; x, y, z is the centroid of the volume. A shape is "sphere", a shape that comes with the program, or a
/// file of a surface, whose path is relative to the folder of the CSV file. The files of write_aggregates_csv() can be
/// read. \throws InputError with file, line, the value found and the value expected; also for a body that the specimen
/// lacks.
KnownAggregates read_aggregates_csv(const std::filesystem::path& file, const Specimen& specimen);

}  // namespace macadam
