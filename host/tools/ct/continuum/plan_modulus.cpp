// SPDX-License-Identifier: GPL-3.0-or-later
// plan_modulus.cpp  Reads a scan, chooses the sizes of the elements, and checks that the scan can carry a load.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/tools/ct/continuum/connection.hpp"
#include "host/tools/ct/continuum/scan_modulus.hpp"
#include "macadam/error.hpp"

namespace macadam::continuum {
namespace {

namespace fs = std::filesystem;

constexpr int ratios[] = {4, 2, 1};  ///< edges of the elements, divided by the smallest edge
constexpr int least_elements = 4;    ///< smallest number of the largest elements along each axis
/// Memory of a node and its element [bytes]: 7 vectors of three complex doubles (r, z, p, q, the displacements of both
/// mixing rules, and a strain along z), the elements' constants, and 8/7 of the vectors of the preconditioner.
constexpr double bytes_per_node = 7 * 48 + 32 + 8.0 / 7 * 136 + 8;
constexpr double other_bytes = 1e8;  ///< coarsest matrix, libraries
/// An end of the specimen whose first layer has less than this fraction of the mean cross-section is not plane.
constexpr double plane_end = 0.9;
constexpr double much_loose = 0.01;  ///< fraction of the material

/// Returns the path of the image of the phases. \throws InputError if it does not exist.
std::string image_of(const fs::path& folder) {
  std::error_code ignored;
  const bool is_folder = fs::is_directory(folder, ignored);
  const fs::path file = is_folder ? folder / "phases.mha" : folder;
  if (fs::exists(file, ignored)) return file.string();
  if (is_folder && fs::exists(folder / "labels.mha", ignored))
    throw InputError(file.string(), 0, "image of the phases", "only labels.mha, which does not show voids",
                     "phases.mha, which macadam ct segment writes");
  throw InputError(file.string(), 0, "image of the phases", "no such file",
                   "phases.mha in a folder that macadam ct segment wrote");
}

/// Returns the memory for elements of `block` voxels of a scan [bytes].
double bytes_of(const Scan& scan, int block) {
  const auto blocks = [block](int n) { return (n + block - 1) / block; };
  const auto rounded = [](int n) { return (n + 7) / 8 * 8; };  // as in grid_of()
  const Size grid{rounded(blocks(scan.size.x)), rounded(blocks(scan.size.y)), scan.size.z / block};
  return bytes_per_node * double(grid.nodes()) + double(scan.size.elements()) + other_bytes;
}

std::string in_gb(double bytes) { return fmt::format("{:.2g} GB", bytes / 1e9); }

/// Returns the smallest block of voxels. \throws InputError.
int smallest_block(const std::string& file, const Scan& scan, double memory, double voxel) {
  const int voxels = std::min({scan.size.x, scan.size.y, scan.size.z}), largest = voxels / (ratios[0] * least_elements);
  const std::string why = fmt::format(
      "because {} of the largest elements, whose edge is four times the smallest edge, must fit along each axis",
      least_elements);
  if (largest < 1)
    throw InputError(file, 0, "voxels along the shortest edge of the specimen", std::to_string(voxels),
                     fmt::format("at least {}, {}", ratios[0] * least_elements, why));
  int block = 1;
  while (block < largest && bytes_of(scan, block) > memory) ++block;
  if (bytes_of(scan, block) > memory)
    throw InputError(
        file, 0, "memory", in_gb(memory),
        fmt::format("at least {}, for elements of {:g} mm", in_gb(bytes_of(scan, block)), 1e3 * block * scan.edge));
  if (voxel == 0) return block;
  const double given = std::round(voxel / scan.edge);
  if (!(given >= 1) || std::abs(given * scan.edge - voxel) > 1e-3 * voxel)
    throw InputError("command line", 0, "--voxel", fmt::format("{:g} mm", 1e3 * voxel),
                     fmt::format("a multiple of the scan's {:g} mm", 1e3 * scan.edge));
  if (given > largest)
    throw InputError("command line", 0, "--voxel", fmt::format("{:g} mm", 1e3 * voxel),
                     fmt::format("at most {:g} mm, {}", 1e3 * largest * scan.edge, why));
  if (given < block)
    throw InputError("command line", 0, "--voxel",
                     fmt::format("{:g} mm, which needs {}", 1e3 * voxel, in_gb(bytes_of(scan, int(given)))),
                     fmt::format("at least {:g} mm, because {} may be used", 1e3 * block * scan.edge, in_gb(memory)));
  return int(given);
}

/// Sets the volume fractions, and warns of ends that are not plane.
void measure_phases(ModulusPlan& plan) {
  const Size& n = plan.scan.size;
  std::vector<double> solid(std::size_t(n.z));  // voxels of each layer
  double inside = 0, counts[3] = {};
  for (std::size_t e = 0; e < n.elements(); ++e) {
    const unsigned char phase = plan.scan.phase[e];
    if (phase > 2) continue;
    ++inside, ++counts[phase];
    if (phase > 0) ++solid[e / n.x / n.y];
  }
  plan.voids = counts[0] / inside, plan.mastic = counts[1] / inside, plan.rock = counts[2] / inside;
  const double mean = (counts[1] + counts[2]) / n.z;
  for (const bool top : {false, true}) {
    const double part = (top ? solid.back() : solid.front()) / mean;
    if (part < plane_end)
      plan.warnings.push_back(fmt::format(
          "the {} layer of voxels has {:.0f} % of the mean cross-section of material; an end that is not plane lowers "
          "|E*|: segment the scan with a --region that ends inside the specimen",
          top ? "top" : "bottom", 100 * part));
  }
}

/// Checks that material connects the platens, with the smallest elements.
void check_connection(ModulusPlan& plan) {
  const PhaseFractions fractions = of_blocks(plan.scan, plan.blocks.back());
  std::vector<unsigned char> marks(fractions.size.elements());
  for (std::size_t e = 0; e < marks.size(); ++e)
    marks[e] = 1 - double(fractions.voids[e]) >= least_material ? Connection::solid : 0;
  const Connection connection = find_connection(fractions.size, std::move(marks));
  if (connection.of_both == 0)
    throw InputError(plan.file, 0, "connection of bottom and top", connection.words(plan.edge(plan.blocks.size() - 1)),
                     "material that connects both ends of the specimen");
  plan.loose = 1 - double(connection.of_both) / double(connection.count);
  if (plan.loose > much_loose)
    plan.warnings.push_back(
        fmt::format("{:.1f} % of the material is in pieces that do not connect both platens, and carries no load",
                    100 * plan.loose));
}

}  // namespace

ModulusPlan plan_modulus(const fs::path& folder, double memory, double voxel) {
  ModulusPlan plan;
  plan.file = image_of(folder);
  plan.scan = read_scan(plan.file);
  if (!plan.scan.has_voids)
    throw InputError(plan.file, 0, "image of the phases", "labels, which do not show voids",
                     "phases.mha, which macadam ct segment writes");
  const int block = smallest_block(plan.file, plan.scan, memory, voxel);
  for (const int ratio : ratios) plan.blocks.push_back(ratio * block);
  plan.removed_height = cut_layers(plan.scan, plan.blocks.front()) * plan.scan.edge;
  plan.bytes = bytes_of(plan.scan, block);
  measure_phases(plan);
  check_connection(plan);
  return plan;
}

}  // namespace macadam::continuum
