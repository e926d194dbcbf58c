// SPDX-License-Identifier: GPL-3.0-or-later
// connection.cpp  Fills the material from both platens.
#include "host/tools/ct/continuum/connection.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace macadam::continuum {
namespace {

/// Marks all voxels that are connected with one platen.
void fill_from(unsigned char platen, const Size& n, std::vector<unsigned char>& marks) {
  std::vector<std::size_t> open;
  const auto visit = [&](int i, int j, int k) {
    if (i < 0 || j < 0 || k < 0 || i >= n.x || j >= n.y || k >= n.z) return;
    const std::size_t e = n.element(i, j, k);
    if (marks[e] == 0 || (marks[e] & platen) != 0) return;
    marks[e] |= platen, open.push_back(e);
  };
  for (int j = 0; j < n.y; ++j)
    for (int i = 0; i < n.x; ++i) visit(i, j, platen == Connection::bottom ? 0 : n.z - 1);
  while (!open.empty()) {
    const std::size_t e = open.back();
    open.pop_back();
    const int i = int(e % n.x), j = int(e / n.x % n.y), k = int(e / n.x / n.y);
    visit(i - 1, j, k), visit(i + 1, j, k), visit(i, j - 1, k);
    visit(i, j + 1, k), visit(i, j, k - 1), visit(i, j, k + 1);
  }
}

}  // namespace

std::string Connection::words(double edge) const {
  if (count == 0) return "no material";
  const auto percent = [this](std::size_t part) { return 100 * double(part) / double(count); };
  return fmt::format(
      "material whose pieces at the bottom ({:.1f} % of it) end at a height of {:.3g} mm, and whose pieces at the top "
      "({:.1f} %) begin at {:.3g} mm",
      percent(of_bottom), 1e3 * edge * highest, percent(of_top), 1e3 * edge * lowest);
}

Connection find_connection(const Size& n, std::vector<unsigned char> marks) {
  Connection out;
  out.marks = std::move(marks);
  fill_from(Connection::bottom, n, out.marks);
  fill_from(Connection::top, n, out.marks);
  out.lowest = n.z;
  for (std::size_t e = 0; e < n.elements(); ++e) {
    const unsigned char mark = out.marks[e];
    const int layer = int(e / n.x / n.y);
    if (mark != 0) ++out.count;
    if ((mark & Connection::bottom) != 0) ++out.of_bottom, out.highest = layer + 1;
    if ((mark & Connection::top) != 0) ++out.of_top, out.lowest = std::min(out.lowest, layer);
    if (out.spans(e)) ++out.of_both;
  }
  return out;
}

}  // namespace macadam::continuum
