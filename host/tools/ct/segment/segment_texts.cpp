// SPDX-License-Identifier: GPL-3.0-or-later
// segment_texts.cpp  Parses a region given by name or by coordinates, and an amount of memory.
#include "macadam/ct.hpp"

#include <limits>
#include <vector>

#include "host/base/in_quotes.hpp"
#include "host/base/units.hpp"
#include "macadam/error.hpp"
#include "macadam/lengths.hpp"

namespace macadam::ct {
namespace {

constexpr const char* option = "--region";

/// Returns the lengths [m] in a list separated by commas. \throws InputError.
std::vector<double> lengths_in(std::string_view list) {
  std::vector<double> out;
  for (;;) {
    const std::size_t end = list.find(',');
    const std::string_view text = list.substr(0, end);
    const std::size_t first = std::min(text.find_first_not_of(' '), text.size());
    out.push_back(length_of(std::string(text.substr(first)), option));
    if (end == std::string_view::npos) return out;
    list.remove_prefix(end + 1);
  }
}

}  // namespace

void read_region(const std::string& text, SegmentOptions& options) {
  const std::pair<const char*, ScanRegion> names[] = {{"found", ScanRegion::found},
                                                      {"whole", ScanRegion::whole},
                                                      {"cylinder", ScanRegion::cylinder},
                                                      {"prism", ScanRegion::prism}};
  options.given.reset();
  for (const auto& [name, region] : names) {
    if (text == name) {
      options.region = region;
      return;
    }
  }
  const auto refuse = [&](const std::string& expected) {
    throw InputError("command line", 0, option, in_quotes(text), expected);
  };
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  if (colon == std::string::npos || (kind != "cylinder" && kind != "prism"))
    refuse(
        "one of \"found\", \"whole\", \"cylinder\", \"prism\", \"cylinder:x,y,diameter[,z0,z1]\" or "
        "\"prism:x0,y0,z0,x1,y1,z1\"");
  const std::vector<double> at = lengths_in(std::string_view(text).substr(colon + 1));
  GivenRegion given;
  if (kind == "prism") {
    if (at.size() != 6) refuse("six lengths, as in \"prism:x0,y0,z0,x1,y1,z1\"");
    given = {{at[0], at[1], at[2]}, {at[3], at[4], at[5]}, false};
  } else {
    if (at.size() != 3 && at.size() != 5) refuse("three or five lengths, as in \"cylinder:x,y,diameter[,z0,z1]\"");
    constexpr double far = std::numeric_limits<double>::infinity();
    const double radius = at[2] / 2;
    given = {{at[0] - radius, at[1] - radius, at.size() == 5 ? at[3] : -far},
             {at[0] + radius, at[1] + radius, at.size() == 5 ? at[4] : far},
             true};
  }
  if (!(given.low.x < given.high.x && given.low.y < given.high.y && given.low.z < given.high.z))
    refuse("a region with a width, a depth and a height");
  options.given = given;
}

double memory_of(const std::string& text) {
  if (text.empty()) return 0.8 * memory_available();
  constexpr scene::Unit units[] = {{"GB", 9}, {"MB", 6}};
  const scene::Quantity memory{"memory", units};
  const std::optional<double> bytes = scene::parse(text, memory);
  if (!bytes || !(*bytes > 0))
    throw InputError("command line", 0, "--memory", in_quotes(text), "an amount: \"3 GB\", \"800 MB\"");
  return *bytes;
}

}  // namespace macadam::ct
