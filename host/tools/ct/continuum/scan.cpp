// SPDX-License-Identifier: GPL-3.0-or-later
// scan.cpp  Reads MetaImages of phases or labels, and averages blocks of their voxels.
#include "host/tools/ct/continuum/scan.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "host/base/in_quotes.hpp"
#include "macadam/error.hpp"

namespace macadam::continuum {
namespace {

constexpr unsigned char mastic = 1, rock = 2, outside = 255;
constexpr double most_voxels = 4e9;    ///< of an image; more voxels than any computer can solve
constexpr double most_packing = 1100;  ///< zlib packs at most 1032 bytes into one

[[noreturn]] void refuse(const std::string& file, const std::string& what, const std::string& found,
                         const std::string& expected) {
  throw InputError(file, 0, what, found, expected);
}

/// Returns three values of a header line.
template <class T>
std::array<T, 3> three(const std::string& file, std::map<std::string, std::string>& header, const std::string& key) {
  std::istringstream words(header[key]);
  std::array<T, 3> out{};
  for (T& value : out)
    if (!(words >> value) || !(value > 0)) refuse(file, key, in_quotes(header[key]), "three positive numbers");
  return out;
}

/// Returns the bytes of the voxels behind the header.
std::vector<unsigned char> voxels(const std::string& file, std::ifstream& in, bool packed, std::size_t bytes) {
  std::vector<unsigned char> data((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!packed) {
    if (data.size() != bytes) refuse(file, "bytes of voxels", std::to_string(data.size()), std::to_string(bytes));
    return data;
  }
  const std::string expected = fmt::format("data for {} bytes of voxels", bytes);
  if (double(bytes) > most_packing * double(data.size()))
    refuse(file, "packed voxels", fmt::format("{} bytes", data.size()), expected);
  std::vector<unsigned char> out(bytes);
  z_stream stream{};
  stream.next_in = data.data();
  if (data.size() > 0xffffffffU || inflateInit2(&stream, 15 + 32) != Z_OK)
    refuse(file, "packed voxels", fmt::format("{} bytes", data.size()), "less than 4 GiB");
  stream.avail_in = uInt(data.size());
  int state = Z_OK;
  for (std::size_t done = 0; state == Z_OK && done < bytes; done = std::size_t(stream.next_out - out.data())) {
    stream.next_out = out.data() + done;
    stream.avail_out = uInt(std::min<std::size_t>(bytes - done, 1U << 30));
    state = inflate(&stream, Z_NO_FLUSH);
  }
  const bool whole = stream.total_out == bytes;
  inflateEnd(&stream);
  if (!whole) refuse(file, "packed voxels", "data that end early or are damaged", expected);
  return out;
}

/// Cuts a scan to the box around the voxels of the specimen.
void cut_to_specimen(Scan& scan, const std::string& file) {
  const Size n = scan.size;
  int low[3] = {n.x, n.y, n.z}, high[3] = {-1, -1, -1};
  for (std::size_t e = 0; e < n.elements(); ++e) {
    if (scan.phase[e] == outside) continue;
    const int at[3] = {int(e % n.x), int(e / n.x % n.y), int(e / n.x / n.y)};
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], at[i]), high[i] = std::max(high[i], at[i]);
  }
  if (high[0] < 0) refuse(file, "voxels of the specimen", "none", "at least one");
  const Size size{high[0] - low[0] + 1, high[1] - low[1] + 1, high[2] - low[2] + 1};
  std::vector<unsigned char> phase;
  phase.reserve(size.elements());
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j) {
      const auto begin = scan.phase.begin() + std::ptrdiff_t(n.element(low[0], j, k));
      phase.insert(phase.end(), begin, begin + size.x);
    }
  scan.size = size;
  scan.phase = std::move(phase);
}

}  // namespace

Scan read_scan(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file + ": cannot be read");
  std::map<std::string, std::string> header;
  for (std::string line; !header.contains("ElementDataFile") && std::getline(in, line);) {
    const std::size_t sign = line.find('=');
    if (sign == std::string::npos || line.size() > 300)
      refuse(file, "line of the header", in_quotes(line.substr(0, 40)), "KEY = VALUE, as in a MetaImage");
    const auto trimmed = [](const std::string& text) {
      const std::size_t begin = text.find_first_not_of(" \t\r"), end = text.find_last_not_of(" \t\r");
      return begin == std::string::npos ? std::string() : text.substr(begin, end - begin + 1);
    };
    header[trimmed(line.substr(0, sign))] = trimmed(line.substr(sign + 1));
  }
  if (header["ElementDataFile"] != "LOCAL")
    refuse(file, "ElementDataFile", in_quotes(header["ElementDataFile"]), "LOCAL, a MetaImage in one file");
  if (header["NDims"] != "3") refuse(file, "NDims", in_quotes(header["NDims"]), "3");
  const auto size = three<int>(file, header, "DimSize");
  const auto edge = three<double>(file, header, "ElementSpacing");
  if (std::max({edge[0], edge[1], edge[2]}) > 1.000001 * std::min({edge[0], edge[1], edge[2]}))
    refuse(file, "edges of a voxel", fmt::format("{} x {} x {} mm", edge[0], edge[1], edge[2]),
           "equal edges, because elements are cubes; resample the scan before it is segmented");
  const std::string type = header["ElementType"];
  if (type != "MET_UCHAR" && type != "MET_UINT")
    refuse(file, "ElementType", in_quotes(type), "MET_UCHAR (phases) or MET_UINT (labels)");
  Scan out{{size[0], size[1], size[2]}, 1e-3 * edge[0], {}, type == "MET_UCHAR"};  // lengths are millimetres
  const double count = double(size[0]) * size[1] * size[2];
  if (count > most_voxels) refuse(file, "voxels", fmt::format("{:g}", count), fmt::format("at most {:g}", most_voxels));
  const std::size_t width = type == "MET_UINT" ? 4 : 1;
  const bool packed = header["CompressedData"].starts_with('T');
  out.phase = voxels(file, in, packed, width * out.size.elements());
  for (std::size_t e = 0; width == 4 && e < out.size.elements(); ++e) {
    const unsigned char* const label = &out.phase[4 * e];
    out.phase[e] = (label[0] | label[1] | label[2] | label[3]) != 0 ? rock : mastic;
  }
  out.phase.resize(out.size.elements());
  for (const unsigned char phase : out.phase)
    if (phase > rock && phase != outside) refuse(file, "phase of a voxel", std::to_string(phase), "0, 1, 2 or 255");
  cut_to_specimen(out, file);
  return out;
}

int cut_layers(Scan& scan, int layers) {
  const int removed = scan.size.z % layers;
  scan.size.z -= removed;
  scan.phase.resize(scan.size.elements());
  return removed;
}

PhaseFractions of_blocks(const Scan& scan, int block) {
  const auto blocks = [&](int n) { return (n + block - 1) / block; };
  PhaseFractions out;
  out.size = {blocks(scan.size.x), blocks(scan.size.y), scan.size.z / block};
  if (out.size.z == 0)
    throw InputError("command line", 0, "edge of the voxels", fmt::format("{:g} m", block * scan.edge),
                     fmt::format("at most the scan's height of {:g} m", scan.size.z * scan.edge));
  out.rock.assign(out.size.elements(), 0);
  out.voids.assign(out.size.elements(), 1);
  const float part = 1 / (float(block) * float(block) * float(block));
  std::size_t inside = 0;
  for (int k = 0; k < out.size.z * block; ++k)
    for (int j = 0; j < scan.size.y; ++j)
      for (int i = 0; i < scan.size.x; ++i) {
        const unsigned char phase = scan.phase[scan.size.element(i, j, k)];
        const std::size_t e = out.size.element(i / block, j / block, k / block);
        if (phase != outside) ++inside;
        if (phase == rock) out.rock[e] += part;
        if (phase == rock || phase == mastic) out.voids[e] -= part;
      }
  for (float& v : out.voids)
    if (v < 1e-4F) v = 0;  // rounding of the sum
  out.area = double(inside) * part / out.size.z;
  return out;
}

PhaseFractions of_scan(const Scan& scan, double voxel) {
  const int block = int(std::lround(std::min(voxel / scan.edge, 1e6)));
  if (block < 1 || std::abs(block * scan.edge - voxel) > 1e-3 * voxel)
    throw InputError("command line", 0, "edge of the voxels", fmt::format("{:g} m", voxel),
                     fmt::format("a multiple of the scan's {:g} m", scan.edge));
  return of_blocks(scan, block);
}

}  // namespace macadam::continuum
