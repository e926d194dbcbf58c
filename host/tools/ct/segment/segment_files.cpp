// SPDX-License-Identifier: GPL-3.0-or-later
// segment_files.cpp  Writes surfaces, images and tables of grains, sizes and cuts.
#include "host/tools/ct/segment/segment_files.hpp"

#include <charconv>
#include <fstream>

#include "host/tools/ct/grains/gradation.hpp"
#include "host/tools/ct/segment/overlay.hpp"
#include "host/base/in_quotes.hpp"
#include "host/files/result_files.hpp"
#include "host/files/result_folder.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

constexpr const char* cuts_header = "a,b,x,y,z,neck,solidity,valley,margin,cut";

/// Returns the unit quaternion (w, x, y, z) that rotates x, y, z to the three perpendicular axes of a grain.
std::array<double, 4> turn_of(const ShapeMeasure& m) {
  const Vec3d x = m.axis_long, y = m.axis_intermediate, z = cross(x, y);
  // uses the one of four equivalent formulas that has no cancellation (Shepperd 1978)
  const double t[4] = {1 + x.x + y.y + z.z, 1 + x.x - y.y - z.z, 1 - x.x + y.y - z.z, 1 - x.x - y.y + z.z};
  const auto n = std::max_element(t, t + 4) - t;
  const double s = 2 * std::sqrt(t[n]);
  const double wx = (y.z - z.y) / s, wy = (z.x - x.z) / s, wz = (x.y - y.x) / s, xy = (x.y + y.x) / s,
               xz = (z.x + x.z) / s, yz = (y.z + z.y) / s, own = s / 4;
  switch (n) {
    case 0:
      return {own, wx, wy, wz};
    case 1:
      return {wx, own, xy, xz};
    case 2:
      return {wy, xy, own, yz};
    default:
      return {wz, xz, yz, own};
  }
}

/// Returns the number in a text. \throws InputError if it is not a finite number.
double number(std::string_view text, const std::string& file, int line) {
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(value))
    throw InputError(file, line, "field", in_quotes(text), "a number");
  return value;
}

}  // namespace

std::string grains_csv(const std::vector<ScannedGrain>& grains) {
  std::string text =
      "id,x,y,z,volume_m3,area_m2,d_long_m,d_intermediate_m,d_short_m,qw,qx,qy,qz,sieve_m,sphericity,border,"
      "confidence\n";
  for (const ScannedGrain& g : grains) {
    const ShapeMeasure& m = g.measure;
    const auto [w, x, y, z] = turn_of(m);
    text += fmt::format(
        "{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.6g},{},{:.4f}"
        "\n",
        g.id, m.centroid.x, m.centroid.y, m.centroid.z, m.volume, m.area, m.d_long, m.d_intermediate, m.d_short, w, x,
        y, z, g.sieve, m.sphericity_true, g.border ? 1 : 0, g.confidence);
  }
  return text;
}

std::string cuts_csv(const std::vector<GrainCut>& cuts) {
  std::string text = fmt::format("{}\n", cuts_header);
  for (const GrainCut& c : cuts) {
    text += fmt::format("{},{},{:.6f},{:.6f},{:.6f},{:.4f},{:.4f},{:.4f},{:.4f},{}\n", c.a, c.b, c.place.x, c.place.y,
                        c.place.z, c.neck, c.solidity, c.valley, c.margin, c.cut ? 1 : 0);
  }
  return text;
}

std::vector<GrainCut> read_cuts(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file.string() + ": cannot be read");
  std::string line;
  std::getline(in, line);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  if (line != cuts_header)
    throw InputError(file.string(), 1, "header", in_quotes(line), std::string("\"") + cuts_header + "\"");
  std::vector<GrainCut> cuts;
  for (int at = 2; std::getline(in, line); ++at) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty()) continue;
    std::vector<double> values;
    for (std::string_view rest = line;;) {
      const std::size_t end = rest.find(',');
      values.push_back(number(rest.substr(0, end), file.string(), at));
      if (end == std::string_view::npos) break;
      rest.remove_prefix(end + 1);
    }
    if (values.size() != 10) throw InputError(file.string(), at, "fields", std::to_string(values.size()), "10");
    if (values[9] != 0 && values[9] != 1)
      throw InputError(file.string(), at, "cut", fmt::format("{}", values[9]), "0 or 1");
    for (const std::size_t n : {0, 1}) {
      if (!(values[n] >= 1 && values[n] < 4e9) || values[n] != std::floor(values[n]))
        throw InputError(file.string(), at, "number of a fragment", fmt::format("{}", values[n]),
                         "a whole number from 1 on");
    }
    cuts.push_back({static_cast<std::uint32_t>(values[0]),
                    static_cast<std::uint32_t>(values[1]),
                    {values[2], values[3], values[4]},
                    values[5],
                    values[6],
                    values[7],
                    values[8],
                    values[9] == 1});
  }
  return cuts;
}

// Folders of surfaces are emptied first, so that no surface of an earlier segmentation remains.
void write_segmentation(const std::filesystem::path& folder, const Segmentation& out, const SegmentOptions& options) {
  namespace fs = std::filesystem;
  const ResultFolder held(folder);
  for (const char* below : {"library", "border"}) {
    fs::remove_all(folder / below);
    fs::create_directories(folder / below);
  }
  for (const ScannedGrain& grain : out.grains) {
    write_surface(folder / (grain.border ? "border" : "library") / (grain.surface.name + ".off"), grain.surface);
  }
  write_whole(folder / "grains.csv", grains_csv(out.grains));
  write_whole(folder / "gradation.csv", gradation_csv(out.grains, options.gradation, options.smallest));
  write_whole(folder / "cuts.csv", cuts_csv(out.cuts));
  write_image(folder / "labels.mha", out.labels);
  write_image(folder / "phases.mha", out.phases);
  write_image(folder / "confidence.mha", out.confidence);
  write_overlay(folder / "planes.png", out);
  write_view(folder / "grains.png", out);
}

}  // namespace macadam::ct
