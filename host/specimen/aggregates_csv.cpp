// SPDX-License-Identifier: GPL-3.0-or-later
// aggregates_csv.cpp  Writes one line per aggregate. fmt's "{}" prints the shortest digits that are read back to the
// same double.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "host/files/result_files.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

void write_aggregates_csv(const std::filesystem::path& file, const std::vector<Aggregate>& aggregates,
                          const std::vector<CompositionRow>& classes) {
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  const bool turned =
      std::any_of(aggregates.begin(), aggregates.end(), [](const Aggregate& a) { return a.surface >= 0; });
  fmt::format_to(to, "body,size_class,class,shape,size,d_long,d_short,axis_x,axis_y,axis_z,volume,spheres,x,y,z{}\n",
                 turned ? ",qw,qx,qy,qz" : "");
  for (const Aggregate& a : aggregates) {
    fmt::format_to(to, "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", a.body, a.size_class,
                   classes.at(static_cast<std::size_t>(a.size_class)).name, csv_field(a.shape), a.size, a.d_long,
                   a.d_short, a.axis_long.x, a.axis_long.y, a.axis_long.z, a.volume, a.spheres, a.centre.x, a.centre.y,
                   a.centre.z);
    const auto& q = a.pose.turn;
    if (turned) fmt::format_to(to, ",{},{},{},{}", q[0], q[1], q[2], q[3]);
    fmt::format_to(to, "\n");
  }
  write_whole(file, fmt::to_string(text));
}

}  // namespace macadam
